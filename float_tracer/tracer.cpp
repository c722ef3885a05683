#include "float_tracer/tracer.h"

#include "float_tracer/float_environment.h"

namespace plumbline {

// Not in the header: a file compiled for a processor with FMA would leave its copies of them to the linker.
Query PreparedBag::asked(const Ray& ray) { return ray; }
Rejection PreparedBag::rejection(const Ray&) { return Rejection::none; }
bool PreparedBag::passages(const Ray&, std::vector<Passage>& passages) {
  passages.clear();
  return false;
}

void PreparedBag::trace(std::span<const Ray> rays, std::span<Answer> answers) {
  const FloatEnvironment before;
  answer(rays, answers);
  if (before.restore()) conduct_.disturbed = true;
}

}  // namespace plumbline
