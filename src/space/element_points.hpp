// Points inside manifold elements with weights: what functions are evaluated at where elements differ in theirs.
//
// An element is made of tetrahedra: a whole part is one, or a hexahedron; a convex piece is the tetrahedra between one of its vertices and
// the triangles away from it. Each has products of Gauss & Jacobi's points, collapsed to it (Stroud 1971, 2.4): all inside, all weights
// positive.
#pragma once

#include <array>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

struct RockPoint {
  Vec3 eta{};       ///< in units of the cell's edges from its centre
  Real weight = 0;  ///< m³ of rock that it stands for
};

class ElementPoints {
 public:
  /// Exact for polynomials up to `degree` ≥ 1 over each tetrahedron; over a hexahedron, in each direction.
  ElementPoints(const CoverArrays& covers, int degree);

  /// Appends the points of an element, numbered as in CoverArrays. A piece that rounding has flattened gets one of the volume that
  /// its moments have (kernels/integrate/moments.hpp).
  void add_element(Index element, std::vector<RockPoint>& to) const;
  /// Of a whole part of a cell.
  void add_part(const CellSplit& split, const CellPart& part, std::vector<RockPoint>& to) const;
  /// Of one piece alone.
  void add_piece(Index piece, std::vector<RockPoint>& to) const;

 private:
  struct Shared {
    std::array<Real, 4> at;  // shares of the corners
    Real weight;             // share of the volume
  };
  void add_tetrahedron(const std::array<Vec3, 4>& corner, Real volume,
                       std::vector<RockPoint>& to) const;

  const CoverArrays& covers_;
  Mat3 reciprocal_;  // gradients of η, 1/m
  Real cell_volume_, share_;
  std::vector<Shared> tetrahedron_;
  std::vector<RockPoint> hexahedron_;  // weights: shares of the volume
};

}  // namespace rockfold
