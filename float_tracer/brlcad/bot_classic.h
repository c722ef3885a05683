// BRL-CAD's BoT tracer as it was from 7.22 to 7.40.2, and its shot function alone.
#pragma once
#include <memory>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Everything between rt_shootray and the partitions: prep, ray walk with its nudge, triangle test from the moved
/// origin, passages by mode and orientation, weave. Above 32 faces the walk goes through cells, with the faces in
/// pieces of four. Outcome::fault where librt doesn't answer: of more than 32 faces four at most are left, or its walk
/// never ends.
std::unique_ptr<Tracer> brlcad_bot_classic();

/// The primitive's shot function alone, for faces in one piece, however many: no box, no walk, no weave, the origin as
/// given. It takes the whole line: a hit behind the origin counts. (librt's stops at 128 hits, but is never asked so.)
std::unique_ptr<Tracer> brlcad_bot_classic_kernel();

}  // namespace plumbline
