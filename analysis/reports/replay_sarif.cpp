#include "analysis/reports/replay_sarif.h"

#include <fmt/format.h>

#include <array>

#include "case/json_object.h"

namespace plumbline {
namespace {

struct RuleText {
  std::string_view name, summary, help;
};
constexpr std::array<RuleText, replay_rule_names.size()> rule_texts = {{
    {"FalseMiss", "The tracer misses a triangle that the ray hits.",
     "The ray, its numbers taken exactly, hits the triangle, and by its contract the tracer has to say so. The "
     "severity is how far the ray would have to move to miss. See why with 'plumbline explain'; if it is to stay for "
     "now, add the line 'known TRACER false-miss' to the case."},
    {"FalseHit", "The tracer hits a triangle that the ray misses.",
     "The ray, its numbers taken exactly, misses the triangle, and by its contract the tracer has to say so. The "
     "severity is the distance between ray and triangle. See why with 'plumbline explain'; if it is to stay for now, "
     "add the line 'known TRACER false-hit' to the case."},
    {"Fault", "The tracer gives no answer.",
     "It says that it can't take the case, or it died of it, hung or broke its interface. That is no wrong answer, "
     "and no disagreement unless the case lists the tracer as known for something."},
    {"KnownNowPasses", "A finding that is listed as known is gone.",
     "The tracer is no longer wrong here. Remove the line 'known' from the case, which then guards the fix."},
    {"ExpectationDiffers", "The case expects what is not the truth.",
     "The line 'expect' says otherwise than the oracle, which derives it again in every run. The case was edited, or "
     "its expectation was written by hand and is wrong: 'plumbline explain' has the exact numbers."},
    {"Leak", "The tracer misses several triangles of which the ray hits one.",
     "The ray, its numbers taken exactly, meets the triangles where by the tracer's contract one of them has to be "
     "hit, inside of one or where they meet, and the tracer says that it hits none. The severity is how far the ray "
     "would have to move to miss. See why with 'plumbline explain'; if it is to stay for now, add the line "
     "'known TRACER leak' to the case."},
    {"WrongNearest", "The tracer hits another triangle than the ray hits first.",
     "The ray, its numbers taken exactly, hits one triangle, and the tracer says that it hits another. The severity "
     "is the way along the ray between the two, if it crosses both. See why with 'plumbline explain'; if it is to stay "
     "for now, add the line 'known TRACER wrong-nearest' to the case."},
}};

template <class Range, class Append>
void append_array(std::string& out, const Range& range, const Append& append) {
  out += '[';
  bool first = true;
  for (const auto& value : range) {
    if (!first) out += ',';
    first = false;
    append(value);
  }
  out += ']';
}

// {"text": "..."}; braces stand for themselves only when doubled.
void append_message(std::string& out, std::string_view text) {
  std::string doubled;
  for (const char c : text) doubled.append(c == '{' || c == '}' ? 2 : 1, c);
  JsonObject message(out);
  message.text("text", doubled);
  message.end();
}

// A relative reference (RFC 3986): all but what may stand there as it is becomes %XX.
std::string uri(std::string_view path) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-._~/";
  std::string out;
  for (const char c : path)
    plain.find(c) != plain.npos ? out += c : out += fmt::format("%{:02X}", static_cast<unsigned char>(c));
  return out;
}

std::string_view level(bool disagrees) { return disagrees ? "error" : "warning"; }

void append_rule(std::string& out, ReplayRule rule) {
  const RuleText& text = rule_texts[static_cast<unsigned>(rule)];
  JsonObject object(out);
  object.text("id", name(rule));
  object.text("name", text.name);
  append_message(object.member("shortDescription"), text.summary);
  append_message(object.member("help"), text.help);
  JsonObject configuration(object.member("defaultConfiguration"));
  configuration.text("level", level(rule != ReplayRule::fault));
  configuration.end();
  object.end();
}

void append_driver(std::string& out, std::string_view version) {
  JsonObject driver(out);
  driver.text("name", "plumbline");
  driver.text("version", version);
  std::array<ReplayRule, rule_texts.size()> rules{};
  for (std::size_t i = 0; i < rules.size(); ++i) rules[i] = static_cast<ReplayRule>(i);
  append_array(driver.member("rules"), rules, [&out](ReplayRule rule) { append_rule(out, rule); });
  driver.end();
}

void append_location(std::string& out, const ReplayedCase& at) {
  JsonObject location(out);
  JsonObject physical(location.member("physicalLocation"));
  JsonObject artifact(physical.member("artifactLocation"));
  artifact.text("uri", uri(at.path));
  artifact.end();
  JsonObject region(physical.member("region"));
  region.number("startLine", static_cast<double>(at.line));
  region.end();
  physical.end();
  append_array(location.member("logicalLocations"), std::array{at.id}, [&out](const std::string& id) {
    JsonObject logical(out);
    logical.text("name", id);
    logical.end();
  });
  location.end();
}

void append_result(std::string& out, const ReplaySummary& summary, const ReplayResult& result) {
  const ReplayedCase& at = summary.cases[result.which];
  const std::string tracer = result.tracer ? summary.tracers[*result.tracer] : "";
  const std::string_view rule = name(*result.rule);
  JsonObject object(out);
  object.text("ruleId", rule);
  object.number("ruleIndex", static_cast<unsigned>(*result.rule));
  object.text("level", level(disagrees(result)));
  append_message(object.member("message"), fmt::format("{}: {}{}\n\n{}", at.id, tracer.empty() ? "" : tracer + ": ",
                                                       result.message, result.why));
  append_array(object.member("locations"), std::array{&at},
               [&out](const ReplayedCase* place) { append_location(out, *place); });
  JsonObject fingerprints(object.member("partialFingerprints"));
  fingerprints.text("plumblineSignature/v1", tracer + (tracer.empty() ? "" : " ") +
                                                 (result.signature.empty() ? std::string(rule) : result.signature));
  fingerprints.end();
  object.end();
}

}  // namespace

std::string to_sarif(const ReplaySummary& summary, std::string_view version) {
  std::vector<const ReplayResult*> told;
  for (const ReplayResult& result : summary.results)
    if (result.rule) told.push_back(&result);
  std::string out;
  JsonObject log(out);
  log.text("$schema", "https://json.schemastore.org/sarif-2.1.0.json");
  log.text("version", "2.1.0");
  append_array(log.member("runs"), std::array{0}, [&](int) {
    JsonObject run(out);
    JsonObject tool(run.member("tool"));
    append_driver(tool.member("driver"), version);
    tool.end();
    append_array(run.member("results"), told,
                 [&](const ReplayResult* result) { append_result(out, summary, *result); });
    run.end();
  });
  log.end_line();
  return out;
}

}  // namespace plumbline
