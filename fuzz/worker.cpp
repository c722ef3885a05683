#include "fuzz/worker.h"

#include <fmt/format.h>

#include "case/float_bits.h"
#include "case/input_error.h"
#include "findings/found.h"
#include "oracle/severity.h"

namespace plumbline {
namespace {

std::filesystem::path state_file(const WorkerPlan& plan) {
  return plan.folder / "jobs" / fmt::format("{}.json", plan.job);
}

Summary blank(const CampaignPlan& plan) {
  Summary s;
  s.tracer = plan.tracer->info().name;
  s.space = name(plan.space);
  s.domain = name(plan.domain);
  s.seed = plan.seed;
  return s;
}

Summary earlier(const WorkerPlan& plan) {
  const Summary now = blank(plan.campaign);
  if (plan.folder.empty()) return now;
  // Another process's state, too, tells whose campaign it is.
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(plan.folder / "jobs", error)) {
    if (entry.path().extension() != ".json") continue;
    const auto before = read_summary(entry.path());
    if (before && (before->tracer != now.tracer || before->space != now.space || before->domain != now.domain))
      throw InputError(fmt::format("{}: holds a campaign of {} (space {}, domain {}); name another folder",
                                   plan.folder.string(), before->tracer, before->space, before->domain));
  }
  return read_summary(state_file(plan)).value_or(now);
}

// A search that goes on draws other numbers than it drew before.
CampaignPlan going_on(CampaignPlan plan, const Summary& before) {
  plan.stream += before.executions;
  return plan;
}

FoundFinding to_found(const Finding& finding, const CampaignPlan& plan) {
  return found_finding(plan.tracer->info(), finding.signature, finding.ulps, to_case(finding.input),
                       fmt::format("fuzz: space {}, domain {}, seed {}, execution {}", name(plan.space), name(plan.domain),
                                   plan.seed, finding.execution));
}

}  // namespace

FuzzInput input_like(const CampaignPlan& plan) {
  FuzzInput like;
  like.space = plan.space;
  like.precision = plan.tracer->info().contract.precision;
  return like;
}

Worker::Worker(WorkerPlan plan) : plan_(std::move(plan)), before_(earlier(plan_)), campaign_(going_on(plan_.campaign, before_)) {
  const FuzzInput like = input_like(plan_.campaign);
  const auto recall = [this](const FuzzInput& input) { campaign_.recall(input); };
  if (!plan_.folder.empty()) {
    std::error_code error;
    std::filesystem::create_directories(plan_.folder / "jobs", error);
    findings_.emplace(plan_.folder);
    findings_->recall(like, recall);
    if (plan_.elites.empty()) plan_.elites = plan_.folder / "elites";
  }
  if (!plan_.elites.empty()) {
    elites_.emplace(plan_.elites);
    campaign_.on_elites = [this](const Elites& elites) { elites_->note(elites); };
    elites_->scan(campaign_.elites(), like, plan_.campaign.domain, recall);
  }
  if (!plan_.store.empty()) store_.emplace(plan_.store, Open::existing);
  // The store first: what the folder has is no news to the next process.
  campaign_.on_finding = [this](const Finding& finding) {
    if (store_) store_->tell(to_found(finding, plan_.campaign)), told_[finding.signature.key()] = finding.ulps;
    if (findings_) written_ &= findings_->tell(finding, plan_.campaign);
  };
  start_ = Clock::now();
  if (!plan_.folder.empty()) write_summary(state_file(plan_), summary());  // from now on it's this tracer's
  next_look_ = start_ + std::chrono::seconds(1);
}

void Worker::test(const FuzzInput& input) {
  const double worst = campaign_.worst_nominal();
  campaign_.test(input);
  if (!plan_.summary.empty() && campaign_.worst_nominal() > worst)
    rises_.push_back({campaign_.executions(), elapsed(), campaign_.worst_nominal()});
  if (elites_ && Clock::now() >= next_look_) look_around();
}

// Writes what has changed and takes over what others wrote; at most a twentieth of the time goes into it.
void Worker::look_around() {
  const auto begin = Clock::now();
  elites_->flush(campaign_.elites());
  elites_->scan(campaign_.elites(), input_like(plan_.campaign), plan_.campaign.domain,
                [this](const FuzzInput& input) { campaign_.recall(input); });
  if (!plan_.folder.empty()) write_summary(state_file(plan_), summary());
  const auto end = Clock::now();
  next_look_ = end + std::max<Clock::duration>(std::chrono::seconds(1), 20 * (end - begin));
}

bool Worker::over() const {
  if (stop.load(std::memory_order_relaxed)) return true;
  if (plan_.runs && campaign_.executions() >= *plan_.runs) return true;
  return plan_.seconds && elapsed() >= *plan_.seconds;
}

void Worker::finish() {
  bool written = written_;
  if (elites_) written &= elites_->flush(campaign_.elites()) == 0;
  if (findings_)
    for (const auto& [key, finding] : campaign_.findings())
      if (finding.execution != 0) written &= findings_->keep(finding, plan_.campaign);
  if (!plan_.folder.empty()) written &= write_summary(state_file(plan_), summary());
  if (!plan_.summary.empty()) {
    Summary all = summary();
    all.rises = rises_;
    written &= write_summary(plan_.summary, all);
  }
  if (store_) {  // what grew by less than twice since it was told
    for (const auto& [key, finding] : campaign_.findings())
      if (const auto told = told_.find(key); told != told_.end() && finding.ulps > told->second)
        store_->tell(to_found(finding, plan_.campaign));
    store_->finish();
  }
  if (!written)
    throw InputError(fmt::format("{}: not everything could be written; make room and go on with the same command",
                                 (plan_.folder.empty() ? plan_.elites : plan_.folder).string()));
}

Summary Worker::summary() const {
  Summary s = before_;
  s.seed = plan_.campaign.seed;
  if (!s.first_disagreement && campaign_.first_disagreement())
    s.first_disagreement = before_.executions + *campaign_.first_disagreement();
  s.executions += campaign_.executions();
  s.seconds += elapsed();
  s.signatures = campaign_.findings().size();
  s.cells = campaign_.elites().all().size();
  s.fingerprint = fmt::format("{:016x}", fingerprint(campaign_.elites()));
  s.worst_nominal_severity = campaign_.worst_nominal();
  if (const double least = std::min(campaign_.least_margin(), before_.least_margin.value_or(campaign_.least_margin())); is_finite(least))
    s.least_margin = least;
  return s;
}

}  // namespace plumbline
