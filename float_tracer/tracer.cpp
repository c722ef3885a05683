#include "float_tracer/tracer.h"

#include "float_tracer/float_environment.h"

namespace plumbline {

void PreparedBag::trace(std::span<const Ray> rays, std::span<Answer> answers) {
  const FloatEnvironment before;
  answer(rays, answers);
  if (before.restore()) disturbed_ = true;
}

}  // namespace plumbline
