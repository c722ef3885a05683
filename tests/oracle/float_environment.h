// The floating-point environments a caller may run in: rounding mode, FTZ (subnormal results become zero) and DAZ
// (subnormal operands are zero), set for the life of an object.
#pragma once
#include <cfenv>
#include <ostream>
#include <vector>
#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace plumbline {

struct FloatEnvironment {
  int rounding = FE_TONEAREST;
  bool flush_results = false, flush_operands = false;
};

inline std::ostream& operator<<(std::ostream& out, const FloatEnvironment& e) {
  const char* mode = e.rounding == FE_TONEAREST  ? "nearest"
                     : e.rounding == FE_UPWARD   ? "upward"
                     : e.rounding == FE_DOWNWARD ? "downward"
                                                 : "toward zero";
  return out << mode << (e.flush_results ? " FTZ" : "") << (e.flush_operands ? " DAZ" : "");
}

inline const std::vector<FloatEnvironment>& float_environments() {
  static const std::vector<FloatEnvironment> all = [] {
    std::vector<FloatEnvironment> list;
    for (const int rounding : {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
      list.push_back({rounding, false, false});
#if defined(__SSE2__)
      list.push_back({rounding, true, false});
      list.push_back({rounding, false, true});
      list.push_back({rounding, true, true});
#endif
    }
    return list;
  }();
  return all;
}

/// Calls into other translation units only between construction and destruction: a compiler may move arithmetic of the
/// same function past either.
class FloatScope {
 public:
  explicit FloatScope(const FloatEnvironment& e) {
    std::fegetenv(&before_);
    std::fesetround(e.rounding);
#if defined(__SSE2__)
    _mm_setcsr(_mm_getcsr() | (e.flush_results ? 0x8000u : 0u) | (e.flush_operands ? 0x0040u : 0u));
#endif
  }
  ~FloatScope() { std::fesetenv(&before_); }
  FloatScope(const FloatScope&) = delete;
  FloatScope& operator=(const FloatScope&) = delete;

 private:
  std::fenv_t before_;
};

}  // namespace plumbline
