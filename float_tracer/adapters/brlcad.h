// BRL-CAD's librt, rt_shootray at a "bag of triangles" (BoT) alone in a database in memory; built only where CMake
// finds a BRL-CAD (cmake/FindBrlcad.cmake, BRLCAD_ROOT). Written for 7.24.
//
// A bag becomes one BoT of that mode and orientation, a plate with its thickness for every face. Nothing is converted:
// the database holds binary64, in BRL-CAD's millimetres.
//
// A ray is passed on as it is. BRL-CAD's documentation asks for a direction of unit length, but unless the environment
// sets LIBRT_DEBUG it neither checks that nor scales, and what it calls distances are parameters along the direction.
// It clears components of at most 1e-39, which isn't told by `asked`. t_min and t_max are not read.
//
// Answers: in and out are those of the first partition, the piece of the ray inside the object that begins first;
// `passages` tells all, with the faces of their ends. A surface's or solid's t is in; a plate has none, since the hit
// between its in and out is not reported. No barycentrics. Faces that BRL-CAD drops as degenerate can't be hit, and
// only its log and the number of solids say that it did: a bag of which no face is left is missed by every ray, and so
// is one without triangles.
//
// Limits, Outcome::fault beyond them: every coordinate and the thickness is finite, a bag has no more faces than an int
// can count, and of more than 32 faces more than four are left: what fits in one piece, rt_shootray bombs at. At a bag
// in pieces it hangs of a direction so short that the walk's step of 0.0005 lengths is lost in rounding: so it runs in
// a process of its own, where passages are not told; `brlcad_tracers` itself gives it as it is.
//
// librt stops the process in bu_bomb where it finds its own state damaged. Here that jumps back and gives
// Outcome::fault, but may leave locks of the library held, so from then on every answer in the process is a fault. The
// jump's target is a global variable of the library: one thread at a time is let into it. What it logs is discarded.
#pragma once
#include <memory>
#include <vector>

#include "float_tracer/tracer.h"

namespace plumbline {

/// brlcad_librt
std::vector<std::unique_ptr<Tracer>> brlcad_tracers();

}  // namespace plumbline
