#include "fuzz/findings_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <tuple>

#include "analysis/found_case.h"
#include "case/case_files.h"
#include "case/case_json.h"
#include "case/case_text.h"
#include "case/folder.h"
#include "case/input_error.h"
#include "case/json_object.h"
#include "case/printable.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

// The whole line or nothing, whoever else appends; on a full disk a part of it would spoil the next.
bool append(const fs::path& path, std::string_view line) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (file < 0) return false;
  flock(file, LOCK_EX);
  const off_t end = lseek(file, 0, SEEK_END);
  const bool written = write(file, line.data(), line.size()) == static_cast<ssize_t>(line.size());
  if (!written) std::ignore = ftruncate(file, end);
  close(file);
  return written;
}

// The severity that a case of ours says in its first comment.
double severity_said(const fs::path& file) {
  std::ifstream in(file);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  constexpr std::string_view mark = "# severity ";
  const auto at = text.find(mark);
  return at == std::string::npos ? -1 : std::strtod(text.c_str() + at + mark.size(), nullptr);
}

}  // namespace

Case to_case(const Finding& finding, const CampaignPlan& plan) {
  Case c = to_case(finding.input);
  const std::string& tracer = plan.tracer->info().name;
  c.id = to_word(finding.signature);
  c.provenance = {fmt::format("{} of {}", name(finding.signature.kind), printable(tracer)),
                  severity_text(finding.ulps, finding.signature.conditioning),
                  fmt::format("found by fuzz: space {}, domain {}, seed {}, execution {}", name(plan.space),
                              name(plan.domain), plan.seed, finding.execution)};
  set_finding(c, tracer, finding.signature.kind);
  return c;
}

FindingsFolder::FindingsFolder(fs::path path) : path_(std::move(path)), cases_(path_ / "findings") {
  make_folder(cases_);
}

bool FindingsFolder::tell(const Finding& finding, const CampaignPlan& plan) const {
  const Signature& s = finding.signature;
  std::string line;
  JsonObject json(line);
  json.text("signature", to_word(s));
  json.text("tracer", plan.tracer->info().name);
  json.text("kind", name(s.kind));
  json.text("element", name(s.element));
  json.text("rejection", name(s.rejection));
  json.text("conditioning", name(s.conditioning));
  json.number("severity_ulps", finding.ulps);
  json.number("execution", static_cast<double>(finding.execution));
  json.number("seed", static_cast<double>(plan.seed));
  add_members(json, to_case(finding.input));
  json.end_line();
  // The case first: whatever the lines tell is then there, wherever a kill comes between.
  const bool kept = keep(finding, plan);
  return append(path_ / "findings.ndjson", line) && kept;
}

bool FindingsFolder::keep(const Finding& finding, const CampaignPlan& plan) const {
  const fs::path file = cases_ / (to_word(finding.signature) + ".case");
  if (severity_said(file) > finding.ulps) return true;
  const fs::path part = cases_ / fmt::format(".part.{}", getpid());
  std::ofstream out(part);
  out << to_text(to_case(finding, plan));
  out.close();
  std::error_code error;
  if (out) fs::rename(part, file, error);
  if (out && !error) return true;
  fs::remove(part, error);
  return false;
}

void FindingsFolder::recall(const FuzzInput& like, const std::function<void(const FuzzInput&)>& take) const {
  if (count() == 0) return;
  for (const std::string& file : case_files(cases_.string()))
    for (const Case& found : read_cases(file))
      if (const auto input = from_case(found, like.space, like.precision)) take(*input);
}

std::size_t FindingsFolder::count() const {
  std::size_t n = 0;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(cases_, error)) n += entry.path().extension() == ".case";
  return n;
}

}  // namespace plumbline
