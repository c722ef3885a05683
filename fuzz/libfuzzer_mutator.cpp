// Has libFuzzer test what the search wants next. The search has random numbers of its own: who drives it makes no
// difference.
#include <cstdint>

#include "fuzz/libfuzzer_target.h"

namespace plumbline {

const Tracer& as_traced(const Tracer& tracer) { return tracer; }

}  // namespace plumbline

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned) {
  using namespace plumbline;
  const FuzzInput next = libfuzzer_worker().next();
  const std::size_t needed = input_size(next.space, next.precision);
  if (most < needed) return size;
  encode(next, std::as_writable_bytes(std::span(data, needed)));
  return needed;
}
