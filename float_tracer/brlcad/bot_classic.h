// BRL-CAD's BoT tracer as it was from 7.22 to 7.40.2, and its triangle test alone.
#pragma once
#include <memory>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Everything between rt_shootray and the first partition: prep, ray walk with its nudge, triangle test from the moved
/// origin, plate, weave.
std::unique_ptr<Tracer> brlcad_bot_classic();

/// The primitive's shot function alone: no box, no walk, no weave, the origin as given. It takes the whole line: a hit
/// behind the origin counts.
std::unique_ptr<Tracer> brlcad_bot_classic_kernel();

}  // namespace plumbline
