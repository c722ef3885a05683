#include "case/folder.h"

#include <fmt/format.h>

#include "case/input_error.h"

namespace plumbline {

void make_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (!std::filesystem::is_directory(folder))
    throw InputError(fmt::format("{}: can't be made a folder: {}; name another", folder.string(), error.message()));
}

}  // namespace plumbline
