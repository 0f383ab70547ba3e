// Vectors of space and of a plane in it, on the device.
#pragma once

#include "kernels/device/device_kernel.hpp"

namespace rockfold::contact {

namespace math = device::math;
using device::Array;
using device::Field;

struct Vector {
  Real x = 0, y = 0, z = 0;
};

KOKKOS_INLINE_FUNCTION Vector operator+(const Vector& a, const Vector& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
KOKKOS_INLINE_FUNCTION Vector operator-(const Vector& a, const Vector& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
KOKKOS_INLINE_FUNCTION Vector operator-(const Vector& a) {
  return {-a.x, -a.y, -a.z};
}
KOKKOS_INLINE_FUNCTION Vector operator*(Real s, const Vector& a) {
  return {s * a.x, s * a.y, s * a.z};
}
KOKKOS_INLINE_FUNCTION Real dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
KOKKOS_INLINE_FUNCTION Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
KOKKOS_INLINE_FUNCTION Real length(const Vector& a) {
  return math::sqrt(dot(a, a));
}
/// Zero stays zero.
KOKKOS_INLINE_FUNCTION Vector unit(const Vector& a) {
  const Real l = length(a);
  return l > 0 ? (1 / l) * a : a;
}
KOKKOS_INLINE_FUNCTION Vector at(const Field& f, Index i) {
  return {f(i, 0), f(i, 1), f(i, 2)};
}
KOKKOS_INLINE_FUNCTION Vector to_vector(const Real* a) {
  return {a[0], a[1], a[2]};
}
KOKKOS_INLINE_FUNCTION void store(const Vector& a, Real* to) {
  to[0] = a.x;
  to[1] = a.y;
  to[2] = a.z;
}

/// A unit vector across n: across the axis that n is farthest from.
KOKKOS_INLINE_FUNCTION Vector any_across(const Vector& n) {
  const Real x = math::fabs(n.x), y = math::fabs(n.y), z = math::fabs(n.z);
  const Vector axis = x <= y && x <= z ? Vector{1, 0, 0}
                      : y <= z         ? Vector{0, 1, 0}
                                       : Vector{0, 0, 1};
  return unit(cross(n, axis));
}

struct Flat {
  Real u = 0, v = 0;
};
KOKKOS_INLINE_FUNCTION Flat operator+(const Flat& a, const Flat& b) {
  return {a.u + b.u, a.v + b.v};
}
KOKKOS_INLINE_FUNCTION Flat operator-(const Flat& a, const Flat& b) {
  return {a.u - b.u, a.v - b.v};
}
KOKKOS_INLINE_FUNCTION Flat operator*(Real s, const Flat& a) {
  return {s * a.u, s * a.v};
}
KOKKOS_INLINE_FUNCTION Real cross(const Flat& a, const Flat& b) {
  return a.u * b.v - a.v * b.u;
}
KOKKOS_INLINE_FUNCTION Real length(const Flat& a) {
  return math::sqrt(a.u * a.u + a.v * a.v);
}

}  // namespace rockfold::contact
