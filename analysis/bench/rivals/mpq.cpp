#include <gmpxx.h>

#include "analysis/bench/rivals/direct_formula.h"
#include "analysis/bench/rivals/rivals.h"

namespace plumbline {

Truth ask_mpq(const Triangle& triangle, const Ray& ray) { return direct_formula<mpq_class>(triangle, ray); }

}  // namespace plumbline
