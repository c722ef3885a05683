// The floating-point controls that arithmetic with proved bounds asks for: round to nearest, no FTZ or DAZ. Private to
// the oracle.
#pragma once
#include <cfenv>

namespace plumbline {

/// Sets them, and puts back what was there at its end, exception flags included.
class DefaultControls {
 public:
  DefaultControls() {
    std::fegetenv(&before_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultControls() { std::fesetenv(&before_); }
  DefaultControls(const DefaultControls&) = delete;
  DefaultControls& operator=(const DefaultControls&) = delete;

 private:
  std::fenv_t before_;
};

}  // namespace plumbline
