// Writes cases and answers as JSON, with the keys that case_lines.h reads.
#pragma once
#include <string>

#include "case/answer.h"
#include "case/case.h"
#include "case/json_object.h"

namespace plumbline {

/// Appends one line.
void append_json(std::string& out, const Case& what);

/// Adds the members of a case but its id; what is at its default is left out, except t_min and t_max.
void add_members(JsonObject& object, const Case& what);

/// Adds the members of an answer: hit, t, u, v, in, out; null where the tracer gave none. A fault is hit null and a
/// member `fault`.
void add_members(JsonObject& object, const Answer& answer);

}  // namespace plumbline
