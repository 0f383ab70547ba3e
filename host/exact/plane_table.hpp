// All planes of a cutting, the vertices they define, and the one predicate of the program: on which side of a
// plane lies the meeting point of three others.
//
// Positions are relative to the table's centre. Exactness: a double filter with an error bound decides nearly
// always; where it cannot, exact rational arithmetic does. Near-concurrency is concurrency (DESIGN.md, rule 5).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct ExactPlane;  // plane_exact.hpp

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
  std::array<Index, 3> plane{};  ///< ascending
  float error = 0;               ///< m, bound on |x − the exact point|
  Vec3 x{};                      ///< m, relative to the table's centre
};

/// How well a plane is known: by numbers that stand for what the user meant, or exactly, as a plane through corners that
/// other such planes share. Among exact planes near-concurrency is an accident, not meant.
enum class Known { nearly, exactly };

/// How often intent, not arithmetic, decided; kept by each task and added up.
struct IntentCount {
  Index vertices_identified = 0;
  Index near_decisions = 0;
  Index close_calls = 0;           ///< near decisions, between planes that are nearly parallel too
  std::vector<Index> near_planes;  ///< planes of near decisions, with repeats

  void add(const IntentCount& other);
};

class PlaneTable {
 public:
  /// `size` is the model's size L (m): tolerances are 1e-10·L.
  PlaneTable(const Vec3& centre, Real size);
  ~PlaneTable();
  PlaneTable(PlaneTable&&) noexcept;
  PlaneTable& operator=(PlaneTable&&) noexcept;
  PlaneTable(const PlaneTable& other);
  PlaneTable& operator=(const PlaneTable&) = delete;

  /// Adds a plane and returns its id.
  Index add(const ExactPlane& plane, Known known = Known::nearly);

  /// The plane that coincides with `plane` to the tolerance, on either orientation, or none. O(log n).
  HalfSpaceId find(const ExactPlane& plane) const;

  /// The half-space above `plane`, bounded by the plane that coincides with it to the tolerance, or that is turned by less than
  /// 1e-9 and passes all of `corners` (m, about the centre) within the tolerance, or else by itself, added. What stands for
  /// two planes that are not equal is known nearly from then on.
  HalfSpaceId find_or_add(const ExactPlane& plane, const std::vector<Vec3>& corners,
                          Known known = Known::nearly);

  /// The same without corners, but that two planes known exactly coincide only where they are equal.
  HalfSpaceId find_or_add(const ExactPlane& plane, Known known = Known::nearly);

  bool exactly_known(Index plane) const { return known_[plane] == Known::exactly; }
  /// −1, 0, +1: on which side of the plane the point (m, model coordinates) lies, exactly.
  int exact_side(const Vec3& x, Index plane) const;
  /// From now on the plane stands for points that lie on it only nearly.
  void loosen(Index plane) { known_[plane] = Known::nearly; }

  /// From now on arithmetic alone decides among the planes that are in the table.
  void know_exactly() { known_.assign(known_.size(), Known::exactly); }

  /// Whether another plane is within a factor 100 of coinciding with this one. O(log n).
  bool is_near_another(Index plane) const;

  Index size() const { return static_cast<Index>(normal_.size()); }
  const Vec3& normal(Index plane) const { return normal_[plane]; }  ///< unit
  Real offset(Index plane) const { return offset_[plane]; }  ///< m, n·x of the centred plane
  const Vec3& centre() const { return centre_; }
  Real model_size() const { return size_; }
  Real tolerance() const { return tolerance_; }

  /// The meeting of three planes that no line is parallel to. Throws std::logic_error if they have none.
  Vertex vertex(Index p, Index q, Index r) const;

  /// −1 below, 0 on, +1 above. On, too, where the four planes miss a common point by at most the tolerance,
  /// measured by the least of their four distances (docs/decisions/0005-near-planes.md), unless all four are known exactly.
  int side(const Vertex& vertex, Index plane, IntentCount& intent) const;

  /// Signed distance of a vertex from a plane in double precision, m.
  Real distance(const Vertex& vertex, Index plane) const;

  /// Volume and first moment of a convex cell from its triangulated boundary, for slivers that doubles cannot measure:
  /// vertices rounded once to 2^-224 of the model's size, all else exact. 0 for a cell without volume.
  struct ExactMoments {
    Real volume;  ///< m³
    Vec3 first;   ///< about the table's centre
  };
  ExactMoments exact_moments(std::span<const Vertex> vertices,
                             const std::vector<std::array<Index, 3>>& triangles) const;

 private:
  struct Store;  // exact coefficients
  template <class Visit>
  void visit_near(const Vec3& normal, Real offset, Real times, Visit visit) const;
  HalfSpaceId find_exactly(const ExactPlane& plane) const;
  Real guarded_sine(const Vertex& vertex, Index s) const;
  Real least_share(const Vertex& vertex, Index s) const;
  Real exact_distance(const Vertex& vertex, Index plane) const;
  Vec3 exact_position(const std::array<Index, 3>& p) const;

  Vec3 centre_;
  Real size_;
  Real tolerance_;
  std::vector<Vec3> normal_;
  std::vector<Real> offset_;
  std::vector<Known> known_;
  std::unique_ptr<Store> store_;
};

}  // namespace rockfold
