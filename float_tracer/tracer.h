// The interface of everything under test. The only inheritance in the project: tracers plug in here.
#pragma once
#include <memory>
#include <span>
#include <string>

#include "case/answer.h"
#include "case/case.h"
#include "case/contract.h"

namespace plumbline {

/// A bag as a tracer keeps it for shooting: built once, shot at many times, by one thread at a time.
class PreparedBag {
 public:
  virtual ~PreparedBag() = default;
  /// answers[i] is what the tracer says of rays[i]; both spans have the same size. Never throws: what the tracer can't
  /// take is Outcome::fault.
  virtual void trace(std::span<const Ray> rays, std::span<Answer> answers) = 0;
};

struct TracerInfo {
  std::string name;     ///< as on the command line
  std::string summary;  ///< one sentence
  std::string source;   ///< paper and section, or package and version
  Contract contract;
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
