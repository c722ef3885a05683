// What the tests of this folder tell: findings with values that a test can name.
#pragma once
#include <string>

#include "findings/event.h"

namespace plumbline {

/// The ray passes x = 1, beyond the edge bc of the triangle (0,0,0) (1,0,0) (0,1,0); `x` tells cases apart.
inline FoundFinding told(std::string tracer, std::string signature, double ulps, unsigned bits, double x = 1) {
  FoundFinding f;
  f.tracer = std::move(tracer);
  f.signature = std::move(signature);
  f.kind = FindingKind::false_hit;
  f.element = Element::bc;
  f.found = {.ulps = ulps, .bits = bits, .what = {}};
  f.found.what.bag.triangles = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  f.found.what.ray = {{x, 1, 1}, {0, 0, -1}};
  f.build = "a build";
  f.source = "a test";
  f.seen = "2026-01-01T00:00:00Z";
  return f;
}

inline SearchRow search_of(std::string tracer, std::uint64_t executions = 1) {
  SearchRow s;
  s.tracer = std::move(tracer);
  s.source = "a test";
  s.ended = "2026-01-02T00:00:00Z";
  s.executions = executions;
  return s;
}

}  // namespace plumbline
