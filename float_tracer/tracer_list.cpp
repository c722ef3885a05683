#include "float_tracer/tracer_list.h"

#include "float_tracer/adapters/adapter_list.h"
#include "float_tracer/baldwin_weber.h"
#include "float_tracer/brlcad/bot_classic.h"
#include "float_tracer/brlcad/bot_hlbvh.h"
#include "float_tracer/kernel_tracer.h"
#include "float_tracer/moller_trumbore.h"
#include "float_tracer/plucker.h"
#include "float_tracer/woop_watertight.h"

namespace plumbline {
namespace {

using List = std::vector<std::unique_ptr<Tracer>>;

template <template <class> class Kernel>
void add_both_precisions(List& list) {
  list.push_back(std::make_unique<KernelTracer<Kernel<float>>>());
  list.push_back(std::make_unique<KernelTracer<Kernel<double>>>());
}

}  // namespace

List float_tracers() {
  List list;
  add_both_precisions<MollerTrumbore>(list);
  add_both_precisions<WoopWatertight>(list);
  add_both_precisions<Plucker>(list);
  add_both_precisions<BaldwinWeber>(list);
  list.push_back(brlcad_bot_classic());
  list.push_back(brlcad_bot_classic_kernel());
  list.push_back(brlcad_bot_hlbvh());
  for (const Adapter& adapter : adapters())
    if (adapter.make)
      for (auto& tracer : adapter.make()) list.push_back(std::move(tracer));
  return list;
}

}  // namespace plumbline
