// All planes of a cutting, the vertices they define, and the one predicate of the program: on which side of a
// plane lies the meeting point of three others. It is the exact sign: a double filter with an error bound decides
// nearly always, integer arithmetic the rest (docs/decisions/0005-exact-inside.md).
//
// Positions are relative to the table's centre.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct ExactPlane;    // plane_exact.hpp
struct IntegerPlane;  // plane_exact.hpp
struct NewPlane;      // plane_exact.hpp
struct UnitPlane;     // plane_exact.hpp

/// A side of a plane: 2·plane + (1 if above). Above = the side that the plane's normal points to.
using HalfSpaceId = std::int32_t;
constexpr HalfSpaceId half_space(Index plane, bool above) {
  return 2 * plane + (above ? 1 : 0);
}
constexpr Index plane_of(HalfSpaceId h) {
  return h / 2;
}
constexpr bool is_above(HalfSpaceId h) {
  return (h & 1) != 0;
}

/// The meeting of three planes. Its position is a function of their ids alone.
struct Vertex {
  std::array<Index, 3> plane{};           ///< ascending
  std::array<Index, 2> also{none, none};  ///< others that are known to pass through it
  float error = 0;                        ///< m, bound on |x − the exact point|
  Vec3 x{};                               ///< m, relative to the table's centre

  bool is_on(Index p) const {
    return p == plane[0] || p == plane[1] || p == plane[2] || p == also[0] || p == also[1];
  }
  /// Remembers a plane that passes through it, as far as there is room: the next question needs no arithmetic.
  void note(Index p) {
    if (is_on(p)) return;
    if (also[0] == none)
      also[0] = p;
    else if (also[1] == none)
      also[1] = p;
  }
};

class PlaneTable {
 public:
  /// `size` is the model's size L (m).
  PlaneTable(const Vec3& centre, Real size);
  ~PlaneTable();
  PlaneTable(PlaneTable&&) noexcept;
  PlaneTable& operator=(PlaneTable&&) noexcept;
  PlaneTable(const PlaneTable& other);
  PlaneTable& operator=(const PlaneTable&) = delete;

  /// Adds a plane and returns its id.
  Index add(const ExactPlane& plane);

  /// The half-space above `plane`, bounded by the plane of the table that is equal to it, or by itself, added. O(log n).
  HalfSpaceId find_or_add(const ExactPlane& plane);
  HalfSpaceId find_or_add(NewPlane plane);

  /// The same, but that a plane which coincides with it to 1e-10 (angle, and distance over L) counts as equal; of several the
  /// one that was added first.
  HalfSpaceId identify_or_add(const ExactPlane& plane);

  /// −1, 0, +1: on which side of the plane the point (m, model coordinates) lies, exactly.
  int exact_side(const Vec3& x, Index plane) const;

  Index size() const { return static_cast<Index>(normal_.size()); }
  const Vec3& normal(Index plane) const { return normal_[plane]; }  ///< unit
  Real offset(Index plane) const { return offset_[plane]; }  ///< m, n·x of the centred plane
  const Vec3& centre() const { return centre_; }
  Real model_size() const { return size_; }
  /// m, 1e-10·L: given planes, lines and corners that are nearer are one (rules 2 and 3).
  Real identity_tolerance() const { return 1e-10 * size_; }
  /// m, 1e-9·L: what is narrower connects and divides nothing (rules 4 to 6).
  Real width_tolerance() const { return 1e-9 * size_; }

  /// m, 7.1e-13·L: positions of one point of the model, made by different planes, are no farther apart.
  Real position_tolerance() const;

  /// The meeting of three planes that no line is parallel to. Throws std::logic_error if they have none.
  Vertex vertex(Index p, Index q, Index r) const;

  /// −1 below, 0 on, +1 above: exactly.
  int side(const Vertex& vertex, Index plane) const {
    if (vertex.is_on(plane)) return 0;
    const Real d = distance(vertex, plane);
    const Real error = rounding(vertex, plane);
    return d > error ? 1 : d < -error ? -1 : exact_side(vertex, plane);
  }

  /// Signed distance of a vertex from a plane in double precision, m.
  Real distance(const Vertex& vertex, Index plane) const {
    const Vec3& n = normal_[plane];
    return n[0] * vertex.x[0] + n[1] * vertex.x[1] + n[2] * vertex.x[2] - offset_[plane];
  }

  /// Volume and first moment of a convex cell from its triangulated boundary, for cells so thin that doubles cannot measure
  /// them: vertices rounded once to 2^-224 of the model's size, all else exact.
  struct ExactMoments {
    Real volume;  ///< m³
    Vec3 first;   ///< about the table's centre
  };
  ExactMoments exact_moments(std::span<const Vertex> vertices,
                             const std::vector<std::array<Index, 3>>& triangles) const;

 private:
  struct Store;  // exact coefficients

  Index append(const UnitPlane& unit, IntegerPlane plane);
  /// Bound on what rounding does to distance(): of the unit normal (2 ε a component), of the products and of the offset.
  Real rounding(const Vertex& vertex, Index plane) const {
    constexpr Real eight_epsilon = 8 * 2.220446049250313e-16;
    const auto size = [](Real a) { return a < 0 ? -a : a; };
    return vertex.error + eight_epsilon * (size(vertex.x[0]) + size(vertex.x[1]) +
                                           size(vertex.x[2]) + size(offset_[plane]));
  }
  int exact_side(const Vertex& vertex, Index plane) const;
  Vec3 exact_position(const std::array<Index, 3>& p) const;

  Vec3 centre_;
  Real size_;
  std::vector<Vec3> normal_;
  std::vector<Real> offset_;
  std::unique_ptr<Store> store_;
};

}  // namespace rockfold
