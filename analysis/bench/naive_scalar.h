// What a single call of the oracle is measured against: Moller and Trumbore's test as the textbook has it, with early
// exits, as one function written out. (The tracer moller_trumbore is the same test; but compiled by clang by way of its
// prepared triangle it takes four times as long, which would flatter the oracle.)
#pragma once
#include "case/geometry.h"

namespace plumbline {

bool naive_scalar(const Triangle& triangle, const Ray& ray);

}  // namespace plumbline
