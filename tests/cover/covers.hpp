// Covers of small models, and sums over them.
#pragma once

#include <utility>

#include "host/cover/cover.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

struct Covered {
  Model model;
  Blocks blocks;
  Covering covering;

  const CoverArrays& arrays() const { return covering.arrays; }
};

inline Covered cover(Model model, const CoverSpec& spec) {
  model.cover = spec;
  model.materials = {{"rock", 2700, 30e9, 0.25, {}}};
  Covered result{std::move(model), {}, {}};
  result.blocks = cut(result.model);
  Progress silent;
  result.covering = build_covers(result.blocks.cutting, result.model, silent);
  return result;
}

inline CoverSpec spacing(Real s) {
  CoverSpec spec;
  spec.spacing = {s, s, s};
  return spec;
}

inline Vec3 vertex(const CoverArrays& a, Index v) {
  return {a.vertex_xyz[3 * v], a.vertex_xyz[3 * v + 1], a.vertex_xyz[3 * v + 2]};
}

/// Six times the signed volume that the triangles of a piece enclose, m³.
inline Real piece_volume(const CoverArrays& a, Index q) {
  Real six = 0;
  for (Index t = a.triangle_begin[q]; t < a.triangle_begin[q + 1]; ++t)
    six += dot(vertex(a, a.triangle_vertex[3 * t]), cross(vertex(a, a.triangle_vertex[3 * t + 1]),
                                                          vertex(a, a.triangle_vertex[3 * t + 2])));
  return six / 6;
}

inline Real lattice_cell_volume(const CoverArrays& a) {
  return dot(a.lattice.edge[0], cross(a.lattice.edge[1], a.lattice.edge[2]));
}

inline Real total_volume(const CoverArrays& a) {
  Real sum = a.regular_count() * lattice_cell_volume(a);
  for (Index q = 0; q < a.piece_count(); ++q) sum += piece_volume(a, q);
  return sum;
}

}  // namespace rockfold::test
