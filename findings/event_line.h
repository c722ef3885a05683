// An event as a line of the journal: a JSON object, the case in it with the keys of case/case_json.h.
#pragma once
#include <string>

#include "findings/event.h"

namespace plumbline {

/// With its newline. Text that is no UTF-8 is escaped.
std::string to_line(const Event& event);

}  // namespace plumbline
