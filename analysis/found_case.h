// What a .case file says of a finding beside its numbers.
#pragma once
#include <string>
#include <string_view>

#include "analysis/signature.h"
#include "case/case.h"

namespace plumbline {

/// Sets `known`: a line where the finding is one of what is hit and what isn't, and the tracer's name is one word, as
/// .case files have it. No line stands for anything else.
void set_known(Case& found, std::string_view tracer, FindingKind kind);

/// The same, and of one triangle `expect`: what the oracle says of it and the ray.
void set_finding(Case& found, std::string_view tracer, FindingKind kind);

/// "severity 12.5 ulps of the largest coordinate, ill-conditioned: far"
std::string severity_text(double ulps, Conditioning conditioning);

}  // namespace plumbline
