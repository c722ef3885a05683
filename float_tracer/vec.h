// Three-dimensional vectors of a tracer's own precision. Sums of three terms go left to right: answers are compared
// bit for bit, so the order is part of the contract.
#pragma once
#include <cmath>

#include "case/geometry.h"

// The kernels compiled with other flags are other tracers: variants/ gives them a namespace of their own, so that the
// linker merges no function of one with that of another.
#ifndef PLUMBLINE_KERNELS
#define PLUMBLINE_KERNELS as_written
#endif

namespace plumbline::inline PLUMBLINE_KERNELS {

template <class Real>
struct Vec {
  Real x, y, z;
  constexpr Real operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  constexpr Real& operator[](int axis) { return axis == 0 ? x : axis == 1 ? y : z; }
};

/// Exact if the coordinates are Real's numbers.
template <class Real>
constexpr Vec<Real> to_vec(const Vec3& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}

template <class Real>
constexpr Vec<Real> operator+(const Vec<Real>& a, const Vec<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
constexpr Vec<Real> operator-(const Vec<Real>& a, const Vec<Real>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class Real>
constexpr Vec<Real> operator*(Real factor, const Vec<Real>& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}

template <class Real>
constexpr Real dot(const Vec<Real>& a, const Vec<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
constexpr Vec<Real> cross(const Vec<Real>& a, const Vec<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The axis of the component of largest magnitude, the first of equals.
template <class Real>
int largest_axis(const Vec<Real>& a) {
  const Real x = std::abs(a.x), y = std::abs(a.y), z = std::abs(a.z);
  if (x >= y && x >= z) return 0;
  return y >= z ? 1 : 2;
}

/// The axis after this one, cyclically.
constexpr int next_axis(int axis) { return axis == 2 ? 0 : axis + 1; }

}  // namespace plumbline::inline PLUMBLINE_KERNELS
