// Contracts as text, for tracers that can't declare theirs otherwise: "edges=open,slack_relative=1e-6".
//
// The keys and words are those of `plumbline tracers --json`: edges, range, t_min, t_max, coplanar, degenerate,
// culling; slack_absolute and slack_relative take a number. What isn't named stays as it is.
#pragma once
#include <string_view>

#include "case/contract.h"

namespace plumbline {

/// `contract`, changed as the text says; by an empty one not at all. Throws InputError that names the word at fault
/// and those that could be meant.
Contract changed(Contract contract, std::string_view text);

}  // namespace plumbline
