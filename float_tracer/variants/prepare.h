// A kernel by its place in the list, in the namespace of the file that includes this. Private to variants/.
#pragma once
#include <cstddef>
#include <memory>

#include "float_tracer/kernel_list.h"
#include "float_tracer/kernel_tracer.h"

namespace plumbline::inline PLUMBLINE_KERNELS {

inline std::unique_ptr<PreparedBag> prepare_kernel(std::size_t index, const Bag& bag) {
  std::unique_ptr<PreparedBag> prepared;
  std::size_t at = 0;
  for_each_kernel([&]<class Kernel>() {
    if (at++ == index) prepared = std::make_unique<PreparedKernelBag<Kernel>>(bag);
  });
  return prepared;
}

}  // namespace plumbline::inline PLUMBLINE_KERNELS
