// A search for the worst errors of one tracer: mutate, examine, keep the worst of each cell, record what is found.
//
// The search is the sequence of next() and test(): whoever calls them (libFuzzer, or the loop in loop.h) only drives. For
// a fixed plan the sequence and all that is kept are the same, bit for bit, as long as no other process puts anything
// into the folder.
#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include "analysis/examine.h"
#include "analysis/signature.h"
#include "case/case_bytes.h"
#include "case/random.h"
#include "fuzz/elites.h"
#include "fuzz/mutator.h"

namespace plumbline {

/// How a search goes on.
enum class Search : unsigned char {
  elites,  ///< from the worst cases found so far
  fresh,   ///< from a new random case every time: for comparison
  given,   ///< from what the driver comes up with, which sees no more than coverage: for comparison
};
inline constexpr std::array<std::string_view, 3> search_names = {"elites", "fresh", "given"};
constexpr std::string_view name(Search s) { return search_names[static_cast<unsigned>(s)]; }

struct CampaignPlan {
  const Tracer* tracer = nullptr;
  Space space = Space::ray;
  Domain domain = Domain::nominal;
  std::uint64_t seed = 1;
  std::uint64_t stream = 0;  ///< of random numbers under that seed
  Search search = Search::elites;
};

/// The worst case of one signature.
struct Finding {
  Signature signature;
  double ulps = 0;           ///< finding_ulps; 0 where none is defined
  std::uint64_t execution = 0;  ///< at which it was found, from 1; 0: recalled
  FuzzInput input;
};

class Campaign {
 public:
  explicit Campaign(const CampaignPlan& plan);

  /// The next input to test: a changed elite, or one of 64 times a fresh one.
  FuzzInput next();

  /// Examines the input and keeps what is worth it.
  void test(const FuzzInput& input);
  /// An execution without an input: what the driver came up with is none.
  void skip();
  /// Examines likewise what was found before: that isn't counted as an execution, and is no news.
  void recall(const FuzzInput& input);

  /// Called for each finding that is new, or twice as severe as when it was last told.
  std::function<void(const Finding&)> on_finding;
  /// Called for each input that elites took, with their places changed().
  std::function<void(const Elites&)> on_elites;

  const CampaignPlan& plan() const { return plan_; }
  const Elites& elites() const { return elites_; }
  const std::unordered_map<std::uint32_t, Finding>& findings() const { return findings_; }
  std::uint64_t executions() const { return executions_; }
  /// Of the first answer with a severity above 0; none so far.
  std::optional<std::uint64_t> first_disagreement() const { return first_disagreement_; }
  /// The greatest severity of a nominal case, in ulps.
  double worst_nominal() const { return worst_nominal_; }
  /// How near to another answer the nearest nominal case was that the tracer got right, in ulps; those on the boundary itself
  /// don't count. Infinite: none so far.
  double least_margin() const { return least_margin_; }
  const Conduct& conduct() const { return examiner_.conduct(); }
  const Features& last_features() const { return features_; }

 private:
  void examine(const FuzzInput& input, bool news);
  void record(const Signature& found, const FuzzInput& input, bool news);

  CampaignPlan plan_;
  Mutator mutator_;
  Examiner examiner_;
  Random random_;
  Elites elites_;
  Features features_;
  std::unordered_map<std::uint32_t, Finding> findings_;
  std::unordered_map<std::uint32_t, double> told_;
  std::uint64_t executions_ = 0;
  std::optional<std::uint64_t> first_disagreement_;
  double worst_nominal_ = 0;
  double least_margin_ = std::numeric_limits<double>::infinity();
};

/// The wish of an input in the target space, none in the ray space.
Wish wish_of(const FuzzInput& input);

}  // namespace plumbline
