// The processor's floating-point controls: rounding mode, flush-to-zero, denormals-are-zero, exception masks, x87
// precision. Code under test may leave them changed, and then every later answer in the process is in doubt.
#pragma once
#include <cfenv>
#include <cstdint>
#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

namespace plumbline {

/// The controls at its construction. Sticky exception flags are no controls.
class FloatEnvironment {
 public:
  FloatEnvironment() { read(*this); }

  /// Puts the controls back; whether they had changed.
  bool restore() const {
    FloatEnvironment now;
    if (now.vector_ == vector_ && now.x87_ == x87_) return false;
    write();
    return true;
  }

 private:
#if defined(__x86_64__)
  static void read(FloatEnvironment& e) {
    e.vector_ = _mm_getcsr() & ~std::uint32_t{_MM_EXCEPT_MASK};
    asm volatile("fnstcw %0" : "=m"(e.x87_));
  }
  void write() const {
    _mm_setcsr(vector_);
    asm volatile("fldcw %0" : : "m"(x87_));
  }
#else
  static void read(FloatEnvironment& e) { e.vector_ = static_cast<std::uint32_t>(std::fegetround()); }
  void write() const { std::fesetround(static_cast<int>(vector_)); }
#endif

  std::uint32_t vector_ = 0;
  std::uint16_t x87_ = 0;
};

}  // namespace plumbline
