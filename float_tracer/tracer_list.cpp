#include "float_tracer/tracer_list.h"

#include "float_tracer/adapters/adapter_list.h"
#include "float_tracer/brlcad/bot_classic.h"
#include "float_tracer/brlcad/bot_hlbvh.h"
#include "float_tracer/isolated.h"
#include "float_tracer/kernel_list.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/variants/variants.h"

namespace plumbline {

std::vector<std::unique_ptr<Tracer>> float_tracers() {
  std::vector<std::unique_ptr<Tracer>> list;
  for_each_kernel([&list]<class Kernel>() { list.push_back(std::make_unique<KernelTracer<Kernel>>()); });
#ifdef PLUMBLINE_VARIANTS
  for (auto& tracer : kernel_variants()) list.push_back(std::move(tracer));
#endif
  list.push_back(brlcad_bot_classic());
  list.push_back(brlcad_bot_classic_kernel());
  list.push_back(brlcad_bot_hlbvh());
  for (const Adapter& adapter : adapters())
    if (adapter.make)
      for (auto& tracer : adapter.make())
        list.push_back(tracer->info().isolation == Isolation::process ? isolated(std::move(tracer))
                                                                      : std::move(tracer));
  return list;
}

}  // namespace plumbline
