#include "analysis/scan.h"

#include <algorithm>
#include <chrono>
#include <future>
#include <memory>
#include <sstream>

#include "analysis/ask.h"
#include "analysis/scan_rays.h"
#include "case/input_error.h"
#include "case/precision.h"
#include "oracle/bag/scene.h"
#include "oracle/judge.h"

namespace plumbline {
namespace {

constexpr std::uint64_t block_size = 4096;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

std::size_t index_of(HitClass c) { return std::min<std::size_t>(static_cast<std::size_t>(c), 3); }

// The mesh at a precision.
struct Ground {
  Precision precision;
  Bag bag;
  Scene scene;
  Ground(const Mesh& mesh, Precision p) : precision(p), bag(rounded_bag(mesh, p)), scene(bag.triangles) {}

 private:
  static Bag rounded_bag(const Mesh& mesh, Precision p) {
    Bag rounded = at_precision(to_bag(mesh), p);
    const auto beyond = std::ranges::find_if_not(
        rounded.triangles, [p](const Triangle& t) { return has_room(t.a, p) && has_room(t.b, p) && has_room(t.c, p); });
    if (beyond != rounded.triangles.end())
      throw InputError("triangle " + std::to_string(beyond - rounded.triangles.begin()) +
                       " of the mesh is so far out that rays around it overflow binary32, which a tracer named reads; "
                       "name those of binary64 alone");
    return rounded;
  }
};

// What the truth is asked for: the same for all tracers of a precision and a searched range that are asked the rays
// themselves.
struct Question {
  Precision precision;
  RangeRule range;
  friend bool operator==(const Question&, const Question&) = default;
};

Question question_of(const Contract& contract, const Mesh& mesh) {
  // A mesh of binary32 numbers is the same in both; [0, inf) is the range given.
  const Precision precision = mesh.precision == Precision::binary32 ? mesh.precision : contract.precision;
  return {precision, contract.range == RangeRule::line ? RangeRule::line : RangeRule::ray};
}

std::uint64_t blocks_of(std::uint64_t rays) { return (rays + block_size - 1) / block_size; }

struct Block {
  std::size_t set = 0;
  std::uint64_t first = 0, size = 0;
};

std::vector<Block> all_blocks(const ScanPlan& plan) {
  std::vector<Block> blocks;
  for (std::size_t set = 0; set < plan.sets.size(); ++set)
    for (std::uint64_t k = 0; k < blocks_of(plan.sets[set].size); ++k)
      blocks.push_back({set, k * block_size, std::min(block_size, plan.sets[set].size - k * block_size)});
  return blocks;
}

// A wrong answer worth telling: of its tracer and signature the worst of its block.
struct Candidate {
  std::size_t tracer = 0;
  BagSignature signature;
  BagJudgement judgement;
  std::uint64_t index = 0;
};

struct BlockResult {
  ScanTruth truth;
  std::vector<ScanTally> tallies;  // by tracer
  std::vector<Candidate> candidates;
  ScanTimes times;
};

class Grounds {
 public:
  Grounds(const Mesh& mesh, const std::vector<const Tracer*>& tracers) {
    add(mesh, mesh.precision);
    for (const Tracer* tracer : tracers) add(mesh, tracer->info().contract.precision);
  }
  // A mesh of binary32 numbers is the same in both precisions.
  const Ground& at(Precision p) const {
    for (const auto& ground : list_)
      if (ground->precision == p) return *ground;
    return *list_.front();
  }
  const Ground& own() const { return *list_.front(); }

 private:
  void add(const Mesh& mesh, Precision p) {
    const bool there = !list_.empty() && (at(p).precision == p || mesh.precision == Precision::binary32);
    if (!there) list_.push_back(std::make_unique<Ground>(mesh, p));
  }
  std::vector<std::unique_ptr<Ground>> list_;
};

// One thread's bags and buffers.
class Worker {
 public:
  Worker(const ScanPlan& plan, const Grounds& grounds) : plan_(plan), grounds_(grounds), whole_(plan.tracers.size()) {
    for (std::size_t t = 0; t < plan.tracers.size(); ++t)
      if (asked_whole(t)) whole_[t] = plan.tracers[t]->prepare(ground(t).bag);
    conduct_.resize(plan.tracers.size());
  }

  BlockResult run(const Block& block) {
    BlockResult result;
    result.tallies.resize(plan_.tracers.size());
    result.times.tracers.resize(plan_.tracers.size());
    rays_.clear();
    for (std::uint64_t i = 0; i < block.size; ++i) rays_.push_back(plan_.sets[block.set].ray(block.first + i));
    asked_.clear();
    truth_of_the_mesh(result);
    for (std::size_t t = 0; t < plan_.tracers.size(); ++t) run_tracer(t, block, result);
    return result;
  }

  const std::vector<Conduct>& conduct() const { return conduct_; }

 private:
  const Ground& ground(std::size_t tracer) const {
    return grounds_.at(plan_.tracers[tracer]->info().contract.precision);
  }
  bool asked_whole(std::size_t tracer) const {
    return plan_.tracers[tracer]->info().has_tree || plan_.mesh->triangles.size() <= whole_limit;
  }

  void truth_of_the_mesh(BlockResult& result) {
    const Asked& asked = ask_once({plan_.mesh->precision, RangeRule::ray});
    result.times.exact = asked.seconds;
    for (std::size_t i = 0; i < rays_.size(); ++i) {
      HitClass least = HitClass::exterior;
      for (const auto& owner : asked.hits.of(i)) least = std::min(least, owner.truth.hit_class);
      ++result.truth.nearest[index_of(least)];
    }
  }

  struct Asked {
    Question question;
    std::vector<Query> queries;
    NearestHits hits;
    double seconds = 0;  // for these
  };

  const Asked& ask_once(const Question& question) {
    for (const auto& asked : asked_)
      if (asked->question == question) return *asked;
    asked_.push_back(std::make_unique<Asked>());
    Asked& asked = *asked_.back();
    asked.question = question;
    const Contract contract{.precision = question.precision, .range = question.range};
    for (const Ray& ray : rays_) asked.queries.push_back(searched_ray(at_precision(ray, question.precision), contract));
    const auto start = Clock::now();
    grounds_.at(question.precision).scene.nearest(asked.queries, asked.hits);
    asked.seconds = seconds_since(start);
    return asked;
  }

  void run_tracer(std::size_t t, const Block& block, BlockResult& result) {
    const TracerInfo& info = plan_.tracers[t]->info();
    put_.clear();
    for (const Ray& ray : rays_) put_.push_back(at_precision(ray, info.contract.precision));
    answers_.assign(rays_.size(), {});
    died_.assign(rays_.size(), 0);
    own_.clear();
    if (asked_whole(t))
      trace_whole(t, result);
    else
      trace_nearby(t, result);
    // Names of triangles are the mesh's from here on.
    if (!info.own_queries) {
      const Asked& asked = ask_once(question_of(info.contract, *plan_.mesh));
      for (std::size_t i = 0; i < rays_.size(); ++i) judge(t, block, i, asked.queries[i], asked.hits.of(i), result);
      return;
    }
    for (Query& query : own_) query = searched_ray(query, info.contract);
    ground(t).scene.nearest(own_, own_hits_);
    for (std::size_t i = 0; i < rays_.size(); ++i) judge(t, block, i, own_[i], own_hits_.of(i), result);
  }

  void trace_whole(std::size_t t, BlockResult& result) {
    const auto start = Clock::now();
    whole_[t]->trace(put_, answers_);
    result.times.tracers[t] = seconds_since(start);
    const Conduct conduct = whole_[t]->take_conduct();
    if (!conduct.deaths.empty()) died_.assign(rays_.size(), 1);  // of which ray isn't told
    conduct_[t] += conduct;
    if (plan_.tracers[t]->info().own_queries)
      for (const Ray& ray : put_) own_.push_back(whole_[t]->asked(ray));
  }

  void trace_nearby(std::size_t t, BlockResult& result) {
    const Tracer& tracer = *plan_.tracers[t];
    const Ground& here = ground(t);
    Bag nearby;
    for (std::size_t i = 0; i < put_.size(); ++i) {
      here.scene.boxes_met(searched_ray(put_[i], tracer.info().contract), met_);
      nearby.triangles.clear();
      for (const std::uint32_t k : met_) nearby.triangles.push_back(here.bag.triangles[k]);
      const auto bag = tracer.prepare(nearby);
      const auto start = Clock::now();
      bag->trace({&put_[i], 1}, {&answers_[i], 1});
      result.times.tracers[t] += seconds_since(start);
      if (tracer.info().own_queries) own_.push_back(bag->asked(put_[i]));
      const Conduct conduct = bag->take_conduct();
      died_[i] = !conduct.deaths.empty();
      conduct_[t] += conduct;
      Answer& answer = answers_[i];
      // A triangle that isn't there is none of the mesh's either.
      if (answer.outcome == Outcome::hit)
        answer.triangle = answer.triangle < met_.size() ? met_[answer.triangle] : ~std::uint32_t{0};
    }
  }

  // The common answers, without more than the nearest hits; the rest by judge_nearest.
  static std::optional<BagVerdict> plain_verdict(const Contract& contract, const Query& query,
                                                 std::span<const NearestHits::Owner> owners, const Answer& answer) {
    if (answer.outcome == Outcome::fault) return BagVerdict::fault;
    // What is only touched is none of the owners, and may be on the way.
    const bool touch_counts = contract.coplanar != TouchRule::miss || contract.degenerate != TouchRule::miss;
    if (contract.culling != Culling::none || query.ray.direction == Vec3{}) return std::nullopt;
    if (touch_counts &&
        (owners.empty() || contract.coplanar == TouchRule::hit || contract.degenerate == TouchRule::hit))
      return std::nullopt;
    if (owners.empty()) return answer.outcome == Outcome::miss ? std::optional(BagVerdict::correct) : std::nullopt;
    if (answer.outcome != Outcome::hit || !answer.has_t) return std::nullopt;
    const auto named = std::ranges::find(owners, answer.triangle, &NearestHits::Owner::triangle);
    const bool well_within = named != owners.end() && named->truth.hit_class == HitClass::interior &&
                             named->truth.versus_t_min > 0 && named->truth.versus_t_max < 0;
    return well_within ? std::optional(BagVerdict::correct) : std::nullopt;
  }

  void judge(std::size_t t, const Block& block, std::size_t i, const Query& query,
             std::span<const NearestHits::Owner> owners, BlockResult& result) {
    const Contract& contract = plan_.tracers[t]->info().contract;
    ScanTally& tally = result.tallies[t];
    if (const auto plain = plain_verdict(contract, query, owners, answers_[i])) {
      ++tally.verdicts[static_cast<std::size_t>(*plain)];
      if (*plain == BagVerdict::fault && died_[i]) offer({t, death_signature, {*plain}, block.first + i}, result);
      return;
    }
    const Ground& here = ground(t);
    const BagTruth truth = here.scene.truth(query);
    const BagJudgement judged = judge_nearest({here.bag.triangles, query, truth, contract}, answers_[i]);
    ++tally.verdicts[static_cast<std::size_t>(judged.verdict)];
    const bool lost = judged.verdict == BagVerdict::leak || judged.verdict == BagVerdict::wrong_nearest;
    if (!lost && judged.verdict != BagVerdict::false_hit) return;
    const bool culling = lost && asked_whole(t) && lost_by_culling(judged, truth, answers_[i], hits_alone(t, i, truth));
    const BagSignature signature = plumbline::signature(judged, culling);
    if (judged.verdict == BagVerdict::leak) ++tally.leaks[std::min<std::size_t>(index_of(signature.where), 2)];
    tally.through += signature.through;
    tally.culled += culling;
    tally.worst_ulps = std::max(tally.worst_ulps, judged.ulps);
    offer({t, signature, judged, block.first + i}, result);
  }

  static void offer(const Candidate& found, BlockResult& result) {
    const auto told = std::ranges::find_if(result.candidates, [&](const Candidate& c) {
      return c.tracer == found.tracer && c.signature == found.signature;
    });
    if (told == result.candidates.end())
      result.candidates.push_back(found);
    else if (found.judgement.ulps > told->judgement.ulps)
      *told = found;
  }

  std::vector<Answer> hits_alone(std::size_t t, std::size_t i, const BagTruth& truth) {
    std::vector<Answer> hits;
    for (const BagHit& hit : truth.hits) {
      const auto alone = plan_.tracers[t]->prepare(Bag{.triangles = {ground(t).bag.triangles[hit.triangle]}});
      Answer answer;
      alone->trace({&put_[i], 1}, {&answer, 1});
      answer.triangle = hit.triangle;
      if (answer.outcome == Outcome::hit) hits.push_back(answer);
    }
    return hits;
  }

  const ScanPlan& plan_;
  const Grounds& grounds_;
  std::vector<std::unique_ptr<PreparedBag>> whole_;  // by tracer; null: asked nearby
  std::vector<Conduct> conduct_;
  std::vector<Ray> rays_, put_;
  std::vector<Answer> answers_;
  std::vector<char> died_;  // of a ray, or of another of its block
  std::vector<std::unique_ptr<Asked>> asked_;
  std::vector<Query> own_;
  NearestHits own_hits_;
  std::vector<std::uint32_t> met_;
};

// The triangles of the mesh that a finding can be seen again with.
class Reproducer {
 public:
  Reproducer(const ScanPlan& plan, const Grounds& grounds) : plan_(plan), grounds_(grounds) {}

  ScanFinding finding(const Candidate& c, const ScanSet& set) const {
    const Tracer& tracer = *plan_.tracers[c.tracer];
    const Ground& ground = grounds_.at(tracer.info().contract.precision);
    ScanFinding f;
    f.tracer = &tracer;
    f.signature = c.signature;
    f.judgement = c.judgement;
    f.set = &set;
    f.index = c.index;
    f.what.precision = tracer.info().contract.precision;
    f.what.ray = at_precision(set.ray(c.index), f.what.precision);
    const Query query = searched_ray(f.what.ray, tracer.info().contract);
    std::vector<std::uint32_t> met;
    ground.scene.boxes_met(query, met);
    const auto try_with = [&](std::vector<std::uint32_t> triangles) {
      std::ranges::sort(triangles);
      const auto twice = std::ranges::unique(triangles);
      triangles.erase(twice.begin(), twice.end());
      Case what = f.what;
      what.bag.triangles.clear();
      for (const std::uint32_t k : triangles) what.bag.triangles.push_back(ground.bag.triangles[k]);
      f.reproduced = signature(examine_bag(tracer, what)) == f.signature;
      if (!f.reproduced && !f.triangles.empty()) return false;
      f.what = std::move(what);
      f.triangles = std::move(triangles);
      return f.reproduced;
    };
    if (met.empty()) met.push_back(0);
    if (try_with(met)) return f;
    for (const std::size_t count : {64u, 512u, 4096u}) {
      auto more = around(ground, met.front(), count);
      more.insert(more.end(), met.begin(), met.end());
      if (try_with(std::move(more))) return f;
    }
    return f;
  }

 private:
  // Those whose first corners are nearest to its.
  std::vector<std::uint32_t> around(const Ground& ground, std::uint32_t triangle, std::size_t count) const {
    const auto& triangles = ground.bag.triangles;
    const Vec3 middle = triangles[triangle].a;
    std::vector<std::pair<double, std::uint32_t>> by_distance;
    for (std::uint32_t k = 0; k < triangles.size(); ++k) {
      const Vec3& v = triangles[k].a;
      const double x = v.x - middle.x, y = v.y - middle.y, z = v.z - middle.z;
      by_distance.emplace_back(x * x + y * y + z * z, k);
    }
    count = std::min(count, by_distance.size());
    std::ranges::partial_sort(by_distance, by_distance.begin() + static_cast<std::ptrdiff_t>(count));
    std::vector<std::uint32_t> list;
    for (std::size_t i = 0; i < count; ++i) list.push_back(by_distance[i].second);
    return list;
  }

  const ScanPlan& plan_;
  const Grounds& grounds_;
};

}  // namespace

ScanTally& operator+=(ScanTally& sum, const ScanTally& more) {
  for (std::size_t k = 0; k < sum.verdicts.size(); ++k) sum.verdicts[k] += more.verdicts[k];
  for (std::size_t k = 0; k < sum.leaks.size(); ++k) sum.leaks[k] += more.leaks[k];
  sum.through += more.through;
  sum.culled += more.culled;
  sum.worst_ulps = std::max(sum.worst_ulps, more.worst_ulps);
  return sum;
}

ScanTruth& operator+=(ScanTruth& sum, const ScanTruth& more) {
  for (std::size_t k = 0; k < sum.nearest.size(); ++k) sum.nearest[k] += more.nearest[k];
  return sum;
}

ScanState blank(const ScanPlan& plan) {
  return {.blocks = 0,
          .truths = std::vector<ScanTruth>(plan.sets.size()),
          .tallies = {plan.sets.size(), std::vector<ScanTally>(plan.tracers.size())}};
}

std::string to_line(const ScanState& state) {
  std::ostringstream out;
  out << "done " << state.blocks;
  for (const ScanTruth& truth : state.truths)
    for (const std::uint64_t n : truth.nearest) out << ' ' << n;
  for (const auto& tallies : state.tallies) {
    for (const ScanTally& tally : tallies) {
      for (const std::uint64_t n : tally.verdicts) out << ' ' << n;
      for (const std::uint64_t n : tally.leaks) out << ' ' << n;
      out << ' ' << tally.through << ' ' << tally.culled << ' ' << std::hexfloat << tally.worst_ulps;
    }
  }
  return out.str();
}

std::optional<ScanState> from_line(const std::string& line, const ScanPlan& plan) {
  std::istringstream in(line);
  std::string word;
  ScanState state = blank(plan);
  if (!(in >> word >> state.blocks) || word != "done") return std::nullopt;
  for (ScanTruth& truth : state.truths)
    for (std::uint64_t& n : truth.nearest) in >> n;
  for (auto& tallies : state.tallies) {
    for (ScanTally& tally : tallies) {
      for (std::uint64_t& n : tally.verdicts) in >> n;
      for (std::uint64_t& n : tally.leaks) in >> n;
      in >> tally.through >> tally.culled >> word;  // streams don't read hexfloats
      tally.worst_ulps = std::strtod(word.c_str(), nullptr);
    }
  }
  if (!in || in >> word) return std::nullopt;
  return state;
}

ScanResult scan(const ScanPlan& plan, ScanState begin, const std::atomic<bool>& stop,
                const std::function<void(const ScanProgress&)>& progress) {
  const std::vector<Block> blocks = all_blocks(plan);
  ScanResult result;
  result.state = std::move(begin);
  ScanState& state = result.state;
  result.times.tracers.resize(plan.tracers.size());
  ScanProgress at{.state = &state};
  for (std::size_t k = 0; k < blocks.size(); ++k) (k < state.blocks ? at.rays : at.all) += blocks[k].size;
  at.all += at.rays;

  const Grounds grounds(*plan.mesh, plan.tracers);
  result.bytes = grounds.own().scene.bytes() + grounds.own().bag.triangles.capacity() * sizeof(Triangle);
  const Reproducer reproducer(plan, grounds);
  auto told = plan.told;
  std::vector<Worker> workers;
  const unsigned jobs = std::max(1u, plan.jobs);
  workers.reserve(jobs);
  for (unsigned j = 0; j < jobs; ++j) workers.emplace_back(plan, grounds);

  // Rounds of a few blocks for each thread; their results are added in order.
  while (state.blocks < blocks.size() && !stop) {
    const std::size_t round = std::min<std::size_t>(blocks.size() - state.blocks, 4 * std::size_t{jobs});
    std::vector<BlockResult> results(round);
    std::atomic<std::size_t> next = 0;
    std::vector<std::future<void>> running;
    for (Worker& worker : workers)
      running.push_back(std::async(std::launch::async, [&] {
        for (std::size_t k; (k = next++) < round;) results[k] = worker.run(blocks[state.blocks + k]);
      }));
    for (auto& each : running) each.get();
    for (std::size_t k = 0; k < round; ++k) {
      const Block& block = blocks[state.blocks];
      const ScanSet& set = plan.sets[block.set];
      for (const Candidate& c : results[k].candidates) {
        const auto [it, is_new] =
            told.emplace(std::pair(plan.tracers[c.tracer]->info().name, to_word(c.signature)), c.judgement.ulps);
        if (!is_new && !(c.judgement.ulps > 2 * it->second)) continue;
        it->second = c.judgement.ulps;
        if (plan.on_finding) plan.on_finding(reproducer.finding(c, set));
      }
      state.truths[block.set] += results[k].truth;
      for (std::size_t t = 0; t < plan.tracers.size(); ++t) {
        state.tallies[block.set][t] += results[k].tallies[t];
        result.times.tracers[t] += results[k].times.tracers[t];
      }
      result.times.exact += results[k].times.exact;
      result.rays += block.size;
      at.rays += block.size;
      ++state.blocks;
    }
    if (progress) progress(at);
  }
  result.complete = state.blocks == blocks.size();
  result.conduct.resize(plan.tracers.size());
  for (const Worker& worker : workers)
    for (std::size_t t = 0; t < plan.tracers.size(); ++t) result.conduct[t] += worker.conduct()[t];
  return result;
}

}  // namespace plumbline
