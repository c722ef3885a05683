#include "float_tracer/variants/variants.h"

#include <immintrin.h>

#include "float_tracer/float_environment.h"
#include "float_tracer/variants/prepare.h"

namespace plumbline {
namespace {

using Prepare = std::unique_ptr<PreparedBag> (*)(std::size_t, const Bag&);

class Flushed final : public PreparedBag {
 public:
  explicit Flushed(std::unique_ptr<PreparedBag> bag) : bag_(std::move(bag)) {}

  Rejection rejection(const Ray& ray) override {
    Rejection why{};
    flushed([&] { why = bag_->rejection(ray); });
    return why;
  }

 private:
  void answer(std::span<const Ray> rays, std::span<Answer> answers) override {
    flushed([&] { bag_->trace(rays, answers); });
  }

  template <class Call>
  static void flushed(Call call) {
    const FloatEnvironment before;
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    call();
    before.restore();
  }

  std::unique_ptr<PreparedBag> bag_;
};

class Variant final : public Tracer {
 public:
  Variant(TracerInfo info, std::size_t kernel, Prepare prepared_by)
      : Tracer(std::move(info)), kernel_(kernel), prepare_(prepared_by) {}
  std::unique_ptr<PreparedBag> prepare(const Bag& bag) const override { return prepare_(kernel_, bag); }

 private:
  std::size_t kernel_;
  Prepare prepare_;
};

std::unique_ptr<PreparedBag> prepare_flushed(std::size_t kernel, const Bag& bag) {
  return std::make_unique<Flushed>(prepare_kernel(kernel, bag));
}

}  // namespace

std::vector<std::unique_ptr<Tracer>> kernel_variants() {
  std::vector<std::unique_ptr<Tracer>> list;
  const auto add_all = [&list](const char* suffix, const char* how, Prepare prepare) {
    std::size_t index = 0;
    for_each_kernel([&]<class Kernel>() {
      TracerInfo info = KernelTracer<Kernel>().info();
      info.summary = info.name + " " + how;
      info.name += suffix;
      list.push_back(std::make_unique<Variant>(std::move(info), index++, prepare));
    });
  };
  if (__builtin_cpu_supports("fma"))
    add_all(fma_suffix, "contracted to fused multiply-adds", prepare_with_fma);
  add_all(fast_math_suffix, "compiled with -ffast-math", prepare_with_fast_math);
  add_all(ftz_daz_suffix, "with subnormals flushed to zero", prepare_flushed);
  return list;
}

}  // namespace plumbline
