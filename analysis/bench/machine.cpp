#include "analysis/bench/machine.h"

#include <fstream>

namespace plumbline {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

std::string compiler() {
#if defined(__clang__)
  std::string text = "clang " __clang_version__;
#else
  std::string text = "g++ " __VERSION__;
#endif
#if defined(__OPTIMIZE__)
  return text + ", optimised";
#else
  return text + ", NOT OPTIMISED: the times mean nothing";
#endif
}

}  // namespace plumbline
