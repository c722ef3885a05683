// BRL-CAD's BoT tracer since 7.42.0 (2025-08): the same prep, walk and segments, but a bounding volume hierarchy whose
// boxes are not widened, and a triangle test on the unit normal times its length.
#pragma once
#include <memory>

#include "float_tracer/tracer.h"

namespace plumbline {

/// No pieces and one cell, however many faces. Hits at one distance come in the opposite order of the hierarchy's
/// leaves. Checked against the source's functions, compiled alone, not against a whole library: the walk is that
/// of 7.24.2.
std::unique_ptr<Tracer> brlcad_bot_hlbvh();

}  // namespace plumbline
