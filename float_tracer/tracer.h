// The interface of everything under test. The only inheritance in the project: tracers plug in here.
#pragma once
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "case/answer.h"
#include "case/case.h"
#include "case/contract.h"
#include "case/query.h"
#include "float_tracer/conduct.h"
#include "float_tracer/rejection.h"

namespace plumbline {

/// A bag as a tracer keeps it for shooting: built once, shot at many times, by one thread at a time.
class PreparedBag {
 public:
  virtual ~PreparedBag() = default;

  /// answers[i] is what the tracer says of rays[i]; both spans have the same size. Never throws: what the tracer can't
  /// take is Outcome::fault. The floating-point controls are afterwards as before.
  void trace(std::span<const Ray> rays, std::span<Answer> answers);

  /// What the tracer is really asked for this ray, which its interface may not hold; t of the answer counts in it. The
  /// ray itself unless TracerInfo::own_queries.
  virtual Query asked(const Ray& ray);

  /// Which of its tests a miss of this ray failed first; none: it hits, or the tracer doesn't tell. No tracer tells of
  /// a bag that isn't one triangle.
  virtual Rejection rejection(const Ray& ray);

  /// Replaces `passages` by every piece of the ray inside the object, in order along it; none of a miss. The first is what
  /// Answer::in and out tell. False, and none: no answer (Outcome::fault), or the tracer doesn't tell.
  virtual bool passages(const Ray& ray, std::vector<Passage>& passages);

  /// Whether a call of trace, up to now, left the floating-point controls changed.
  bool disturbed() const { return conduct_.disturbed; }

  /// That, what it died of, and where it broke its interface, up to now.
  const Conduct& conduct() const { return conduct_; }

  /// The same, since it was taken last.
  Conduct take_conduct() { return std::exchange(conduct_, {}); }

 protected:
  Conduct conduct_;

 private:
  virtual void answer(std::span<const Ray> rays, std::span<Answer> answers) = 0;
};

/// Where the code under test runs.
enum class Isolation : unsigned char {
  none,     ///< in this process
  process,  ///< in a child, by isolated.h: it may abort, hang or print
};

struct TracerInfo {
  std::string name;         ///< as on the command line
  std::string summary;      ///< one sentence
  std::string source;       ///< paper and section, or the function that is called
  std::string package = ""; ///< that it comes from, with its version; empty: written here
  Contract contract;
  /// Lengths and limits of its own, near which its answers change: a search puts tolerances and standoffs there.
  std::vector<double> constants = {};
  /// Finds its way among many triangles, as far as is known, in less time than looking at each; a foreign one may.
  bool has_tree = false;
  bool own_queries = false; ///< asks something else than the ray given: see PreparedBag::asked
  Isolation isolation = Isolation::none;
};

class Tracer {
 public:
  explicit Tracer(TracerInfo info) : info_(std::move(info)) {}
  virtual ~Tracer() = default;
  const TracerInfo& info() const { return info_; }
  /// Thread-safe. A tracer with binary32 inputs is given binary32 values only (see at_precision).
  virtual std::unique_ptr<PreparedBag> prepare(const Bag& bag) const = 0;

 private:
  TracerInfo info_;
};

}  // namespace plumbline
