#include "findings/event_line.h"

#include <fmt/format.h>

#include "case/case_json.h"
#include "case/json_object.h"
#include "case/printable.h"
#include "findings/utc.h"

namespace plumbline {
namespace {

// The time that the event names, or now: 2026-11-26T01:30:00Z.
std::string time_of(const std::string& said) {
  if (!said.empty()) return said;
  return utc_text(std::chrono::system_clock::now());
}

class Line {
 public:
  Line(std::string_view event, const std::string& time) : json_(text_) {
    json_.text("event", event);
    json_.text("at", time_of(time));
  }
  void text(std::string_view key, std::string_view value) { json_.text(key, valid_utf8(value)); }
  void number(std::string_view key, double value) { json_.number(key, value); }
  void count(std::string_view key, std::uint64_t value) { json_.member(key) += std::to_string(value); }
  std::string& member(std::string_view key) { return json_.member(key); }
  std::string end() {
    json_.end_line();
    return std::move(text_);
  }

 private:
  std::string text_;
  JsonObject json_;
};

void append_case(std::string& out, const Case& what) {
  JsonObject object(out);
  add_members(object, what);
  object.end_line();
  out.pop_back();  // its newline: it's a member
}

std::string to_line(const FoundFinding& f) {
  Line line("finding", f.seen);
  line.text("tracer", f.tracer);
  line.text("signature", f.signature);
  line.text("kind", name(f.kind));
  line.text("element", name(f.element));
  line.text("conditioning", name(f.conditioning));
  line.number("severity_ulps", f.found.ulps);
  line.count("bits", f.found.bits);
  line.text("build", f.build);
  line.text("source", f.source);
  append_case(line.member("case"), f.found.what);
  return line.end();
}

std::string to_line(const SearchRow& s) {
  Line line("search", s.ended);
  line.text("tracer", s.tracer);
  line.text("source", s.source);
  line.count("executions", s.executions);
  line.number("worst_nominal_ulps", s.worst_nominal_ulps);
  line.number("least_margin_ulps", s.least_margin_ulps);
  line.count("signatures", s.signatures);
  return line.end();
}

std::string to_line(const StatusSet& s) {
  Line line("status", s.set);
  line.text("tracer", s.finding.tracer);
  line.text("signature", s.finding.signature);
  line.text("status", name(s.status));
  if (s.status == FindingStatus::duplicate) {
    line.text("of_tracer", s.duplicate_of.tracer);
    line.text("of_signature", s.duplicate_of.signature);
  }
  line.text("by", s.by);
  return line.end();
}

}  // namespace

std::string to_line(const Event& event) {
  return std::visit([](const auto& e) { return to_line(e); }, event);
}

}  // namespace plumbline
