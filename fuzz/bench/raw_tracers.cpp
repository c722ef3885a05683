// Tracers as plain libFuzzer sees them: this file is compiled for coverage. Our own kernels are compiled here once more; of
// any other tracer coverage shows the outcome alone.
#define PLUMBLINE_KERNELS instrumented
#include "float_tracer/variants/prepare.h"
#include "fuzz/libfuzzer_target.h"

namespace plumbline {
namespace {

class Watched final : public PreparedBag {
 public:
  explicit Watched(std::unique_ptr<PreparedBag> bag) : bag_(std::move(bag)) {}
  Query asked(const Ray& ray) override { return bag_->asked(ray); }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    bag_->trace(rays, answers);
    for (const Answer& a : answers) {
      switch (a.outcome) {  // three branches to be seen
        case Outcome::miss: seen_ = 1; break;
        case Outcome::hit: seen_ = 2; break;
        case Outcome::fault: seen_ = 3; break;
      }
    }
  }

  std::unique_ptr<PreparedBag> bag_;
  volatile int seen_ = 0;
};

class Instrumented final : public Tracer {
 public:
  explicit Instrumented(const Tracer& of) : Tracer(of.info()), of_(of) {
    std::size_t at = 0;
    for_each_kernel([&]<class Kernel>() {
      if (KernelTracer<Kernel>().info().name == of.info().name) kernel_ = at;
      ++at;
    });
  }
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override {
    if (kernel_) return prepare_kernel(*kernel_, bag);
    return std::make_unique<Watched>(of_.prepare(bag));
  }

 private:
  const Tracer& of_;
  std::optional<std::size_t> kernel_;
};

}  // namespace

const Tracer& as_traced(const Tracer& tracer) {
  static const Instrumented instrumented(tracer);
  return instrumented;
}

}  // namespace plumbline
