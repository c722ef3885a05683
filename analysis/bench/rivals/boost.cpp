#include <boost/multiprecision/cpp_int.hpp>

#include "analysis/bench/rivals/direct_formula.h"
#include "analysis/bench/rivals/rivals.h"

namespace plumbline {

Truth ask_cpp_rational(const Triangle& triangle, const Ray& ray) {
  return direct_formula<boost::multiprecision::cpp_rational>(triangle, ray);
}

}  // namespace plumbline
