#include "fuzz/summary.h"

#include <fmt/format.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "case/input_error.h"

namespace plumbline {

using Json = nlohmann::ordered_json;

std::string to_json(const Summary& s) {
  Json json;
  json["tracer"] = s.tracer;
  json["space"] = s.space;
  json["domain"] = s.domain;
  json["seed"] = s.seed;
  json["executions"] = s.executions;
  json["seconds"] = s.seconds;
  json["executions_per_s"] = s.seconds > 0 ? static_cast<double>(s.executions) / s.seconds : 0;
  json["first_disagreement"] = s.first_disagreement ? Json(*s.first_disagreement) : Json(nullptr);
  json["signatures"] = s.signatures;
  json["worst_nominal_severity"] = s.worst_nominal_severity;
  json["least_margin"] = s.least_margin ? Json(*s.least_margin) : Json(nullptr);
  json["cells"] = s.cells;
  json["fingerprint"] = s.fingerprint;
  if (!s.rises.empty()) {
    Json& rises = json["rises"] = Json::array();
    for (const auto& [execution, seconds, ulps] : s.rises)
      rises.push_back({{"execution", execution}, {"seconds", seconds}, {"ulps", ulps}});
  }
  return json.dump(2) + "\n";
}

Summary summary_of(const std::string& text, const std::string& place) {
  try {
    const Json json = Json::parse(text);
    Summary s;
    json.at("tracer").get_to(s.tracer);
    json.at("space").get_to(s.space);
    json.at("domain").get_to(s.domain);
    json.at("seed").get_to(s.seed);
    json.at("executions").get_to(s.executions);
    json.at("seconds").get_to(s.seconds);
    if (const Json& first = json.at("first_disagreement"); !first.is_null()) s.first_disagreement = first.get<std::uint64_t>();
    json.at("signatures").get_to(s.signatures);
    json.at("worst_nominal_severity").get_to(s.worst_nominal_severity);
    if (const Json least = json.value("least_margin", Json()); !least.is_null()) s.least_margin = least.get<double>();
    json.at("cells").get_to(s.cells);
    json.at("fingerprint").get_to(s.fingerprint);
    for (const Json& rise : json.value("rises", Json::array()))
      s.rises.push_back({rise.at("execution").get<std::uint64_t>(), rise.at("seconds").get<double>(), rise.at("ulps").get<double>()});
    return s;
  } catch (const Json::exception& error) {
    throw InputError(fmt::format("{}: no summary of a campaign: {}; remove it, or name another", place, error.what()));
  }
}

std::optional<Summary> read_summary(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) return std::nullopt;
  return summary_of(std::string((std::istreambuf_iterator<char>(in)), {}), file.string());
}

bool write_summary(const std::filesystem::path& file, const Summary& summary) {
  std::filesystem::path part = file;
  part += fmt::format(".{}.part", getpid());
  {
    std::ofstream out(part);
    out << to_json(summary);
    out.close();
    if (!out) {
      std::error_code ignored;
      std::filesystem::remove(part, ignored);
      return false;
    }
  }
  std::error_code error;
  std::filesystem::rename(part, file, error);
  return !error;
}

}  // namespace plumbline
