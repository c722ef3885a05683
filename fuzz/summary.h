// What a campaign comes to, as summary.json holds it.
#pragma once
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace plumbline {

struct Summary {
  std::string tracer, space, domain;
  std::uint64_t seed = 0;
  std::uint64_t executions = 0;
  double seconds = 0;  ///< of searching, of all processes together
  std::optional<std::uint64_t> first_disagreement;  ///< the execution of the first answer of severity > 0
  std::uint64_t signatures = 0;
  double worst_nominal_severity = 0;  ///< in ulps of the largest coordinate; 0: none found
  std::optional<double> least_margin;  ///< of a nominal case answered rightly: how near to another answer, in ulps
  std::uint64_t cells = 0;
  std::string fingerprint;  ///< of the archive, hexadecimal

  /// When the worst nominal severity rose.
  struct Rise {
    std::uint64_t execution = 0;
    double seconds = 0, ulps = 0;
  };
  std::vector<Rise> rises;
};

/// One object, with executions_per_s (of one process) derived.
std::string to_json(const Summary& summary);

/// Of the JSON; `place` stands for it in messages. Throws InputError where it is no summary.
Summary summary_of(const std::string& json, const std::string& place);

/// No value where there is no such file. Throws InputError, naming it, where it holds no summary.
std::optional<Summary> read_summary(const std::filesystem::path& file);

/// The file appears whole or not at all; false where it can't be written.
bool write_summary(const std::filesystem::path& file, const Summary& summary);

}  // namespace plumbline
