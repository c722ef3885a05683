#include "findings/event_reader.h"

#include <fmt/format.h>

#include "case/case_lines.h"
#include "case/enum_names.h"
#include "case/input_error.h"
#include "case/real_text.h"
#include "findings/json_text.h"

namespace plumbline {

using Json = nlohmann::json;

class EventReader::Impl {
 public:
  Event read(std::string_view line) {
    Json json;
    try {
      json = Json::parse(line);
      if (!json.is_object()) throw InputError("no event: no JSON object");
      const std::string event = json.at("event");
      if (event == "finding") return finding(json);
      if (event == "search") return search(json);
      if (event == "status") return status(json);
      throw InputError(fmt::format("unknown event '{}'", event));
    } catch (const Json::exception& error) {
      throw InputError(error.what());
    }
  }

 private:
  template <class Enum, std::size_t N>
  static Enum word(const Json& json, const char* key, const std::array<std::string_view, N>& names) {
    const std::string said = json.at(key);
    const auto value = from_name<Enum>(names, said);
    if (!value) throw InputError(fmt::format("unknown {} '{}'", key, said));
    return *value;
  }

  static double ulps(const Json& json, const char* key) {
    const Json& said = json.at(key);
    const auto x = said.is_string() ? parse_real(said.get<std::string>()) : std::optional(said.get<double>());
    if (!x || !(*x >= 0)) throw InputError(fmt::format("{} is no severity", key));
    return *x;
  }

  template <class Count>
  static Count count(const Json& json, const char* key) {
    if (!json.at(key).is_number_unsigned()) throw InputError(fmt::format("{} is no count", key));
    return json.at(key).get<Count>();
  }

  Event finding(const Json& json) {
    FoundFinding f;
    f.seen = json.at("at");
    f.tracer = json.at("tracer");
    f.signature = json.at("signature");
    if (f.signature.empty()) throw InputError("an empty signature");
    f.kind = word<FindingKind>(json, "kind", finding_kind_names);
    f.element = word<Element>(json, "element", element_names);
    f.conditioning = word<Conditioning>(json, "conditioning", conditioning_names);
    f.found.ulps = ulps(json, "severity_ulps");
    f.found.bits = count<unsigned>(json, "bits");
    f.build = json.at("build");
    f.source = json.at("source");
    f.found.what = cases_.read(text_of(json.at("case")));
    return f;
  }

  static Event search(const Json& json) {
    SearchRow s;
    s.ended = json.at("at");
    s.tracer = json.at("tracer");
    s.source = json.at("source");
    s.executions = count<std::uint64_t>(json, "executions");
    s.worst_nominal_ulps = ulps(json, "worst_nominal_ulps");
    s.least_margin_ulps = ulps(json, "least_margin_ulps");
    s.signatures = count<std::uint64_t>(json, "signatures");
    return s;
  }

  static Event status(const Json& json) {
    StatusSet s;
    s.set = json.at("at");
    s.finding = {json.at("tracer"), json.at("signature")};
    s.status = word<FindingStatus>(json, "status", finding_status_names);
    if (s.status == FindingStatus::duplicate) s.duplicate_of = {json.at("of_tracer"), json.at("of_signature")};
    s.by = json.at("by");
    return s;
  }

  CaseObjects cases_{"case"};
};

EventReader::EventReader() : impl_(std::make_unique<Impl>()) {}
EventReader::~EventReader() = default;
Event EventReader::read(std::string_view line) { return impl_->read(line); }

}  // namespace plumbline
