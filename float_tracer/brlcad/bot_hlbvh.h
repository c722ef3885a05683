// BRL-CAD's BoT tracer since 7.42.0 (2025-08): the same prep, walk and segments, but a bounding volume hierarchy whose
// boxes are not widened, and a triangle test on the unit normal times its length.
#pragma once
#include <memory>

#include "float_tracer/tracer.h"

namespace plumbline {

/// Of one face, so the hierarchy is its root.
std::unique_ptr<Tracer> brlcad_bot_hlbvh();

}  // namespace plumbline
