// Prescribed displacements on a surface as rows over the unknowns: as many as the covers beside it can follow.
//
// Where a surface runs through lattice nodes, the displacement on it is that of the covers of these nodes: what the functions of each of them
// are on the surface is held by itself. Elsewhere the surface cuts a layer of elements. Held
// at every corner, a displacement there would have to vanish together with its slope: the layer locks. The multipliers must then be fewer than
// the covers: here they are polynomials on patches some spacings wide, of one degree more than the cover functions, which is what the
// displacement's own order of convergence needs (Béchet, Moës & Wohlmuth 2009 thin out point multipliers to the same end; Haslinger & Renard
// 2009 and Burman & Hansbo 2010 have multipliers on patches).
#pragma once

#include <vector>

#include "host/cover/points/free_faces.hpp"
#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// A point of a surface with its share of the area.
struct SurfacePoint {
  Index element = none;
  Vec3 x{};       ///< m
  Real area = 0;  ///< m²
};

/// A mean over points of a surface, or a moment of them (weights that sum to 0).
struct HeldRow {
  Index element = none;  ///< one of them
  Vec3 x{};              ///< m, its place
  std::vector<Index> unknown;
  std::vector<Real> weight;
  Real area = 0;  ///< m²
  bool moment = false;
  Real motion_ratio = 1;  ///< how far the surface moves with one metre of the row, at most
};

/// Appends the rows of a plane surface that lies in one connected part of the rock. `spacing`: m, of the lattice. `slack`: m, so
/// near to its plane nodes lie in it: rock between them is a sliver, which has no functions of its own (decision 5, rule 8).
void hold_surface(const CoverArrays& covers, const std::vector<FacePolygon>& surface, Real spacing,
                  Real slack, std::vector<HeldRow>& rows);

}  // namespace rockfold
