#include "tests/cover/cover_rules.hpp"

#include <cmath>
#include <map>

#include <fmt/format.h>

#include "host/cover/points/free_faces.hpp"
#include "host/cover/points/surface_split.hpp"
#include "host/cut/bodies/union_find.hpp"
#include "host/cut/bodies/width.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::test {

namespace {

long double exact_piece_volume(const CoverArrays& a, Index q) {
  using Long = std::array<long double, 3>;
  const Vec3 o = vertex(a, a.vertex_begin[q]);
  const auto at = [&](Index t) {
    const Vec3 x = vertex(a, a.triangle_vertex[t]);
    return Long{static_cast<long double>(x[0]) - o[0], static_cast<long double>(x[1]) - o[1],
                static_cast<long double>(x[2]) - o[2]};
  };
  long double six = 0;
  for (Index t = a.triangle_begin[q]; t < a.triangle_begin[q + 1]; ++t) {
    const Long x = at(3 * t), y = at(3 * t + 1), z = at(3 * t + 2);
    six += x[0] * (y[1] * z[2] - y[2] * z[1]) + x[1] * (y[2] * z[0] - y[0] * z[2]) +
           x[2] * (y[0] * z[1] - y[1] * z[0]);
  }
  return six / 6;
}

void check_volumes(const Covered& c, Faults& faults) {
  const CoverArrays& a = c.arrays();
  const Complex& complex = c.blocks.complex();
  const Real share = cell_split(a.lattice.kind).share;
  std::vector<long double> expected(complex.block_count, 0), found(complex.block_count, 0);
  long double all = 0, sum = 0;
  for (Index cell = 0; cell < complex.cells.size(); ++cell)
    if (complex.is_analysed(cell))
      expected[complex.cell_block[cell]] += complex.moments[cell].volume;
  for (const Index b : a.regular_block) found[b] += lattice_cell_volume(a);
  for (Index q = 0; q < a.piece_count(); ++q)
    found[a.piece_block[q]] += share * exact_piece_volume(a, q);
  for (const long double v : expected) all += v;
  for (const long double v : found) sum += v;
  if (!(std::abs(sum - all) <= 1e-12L * all))
    faults.push_back(fmt::format("volume: {} m3 of {}: {:.2g} of it is missing",
                                 static_cast<Real>(sum), static_cast<Real>(all),
                                 static_cast<Real>((all - sum) / all)));
  // Vertices are rounded to 1e-16 of the rock's size.
  for (Index b = 0; b < complex.block_count; ++b)
    if (!(std::abs(found[b] - expected[b]) <= 1e-9L * expected[b] + 1e-14L * all))
      faults.push_back(fmt::format("volume: block {} has {} m3, its elements {}", b,
                                   static_cast<Real>(expected[b]), static_cast<Real>(found[b])));
  // A sliver that nothing is beside is an element of its own: of its volume rounding may be all that is left.
  const std::vector<Real> volume = element_volumes(a);
  for (std::size_t e = 0; e < volume.size(); ++e)
    if (!(volume[e] > -1e-16L * all))
      faults.push_back(fmt::format("volume: element {} has {} m3", e, volume[e]));
}

/// Bodies that blocks form over joints wider than `least` (m), where they are welded.
Index body_count(const Covered& c, Real least) {
  const Complex& complex = c.blocks.complex();
  UnionFind bodies(complex.block_count);
  if (c.model.cover->joints == JointTreatment::welded) {
    for (const Fragment& f : complex.fragments)
      if (!complex.touches_sliver(f) && complex.is_analysed(f.cell[0]) &&
          complex.is_analysed(f.cell[1])) {
        std::vector<Vec3> corner;
        const Polygon polygon = complex.polygon_of(f);
        for (const Vertex& v : polygon.corner) corner.push_back(v.x);
        if (width_in_plane(corner, complex.planes.normal(polygon.plane)) > least)
          bodies.join(complex.cell_block[f.cell[0]], complex.cell_block[f.cell[1]]);
      }
    for (const Beam& b : complex.beams)
      if (b.cell[1] != none && complex.is_analysed(b.cell[0]) && complex.is_analysed(b.cell[1]) &&
          width_in_plane(b.polygon, complex.planes.normal(plane_of(
                                        complex.cells[b.cell[0]].faces[b.face[0]].inside))) > least)
        bodies.join(complex.cell_block[b.cell[0]], complex.cell_block[b.cell[1]]);
  }
  Index count = 0;
  for (Index b = 0; b < complex.block_count; ++b)
    if (complex.block_stage[b] == 0 && bodies.find(b) == b) ++count;
  return count;
}

void check_connection(const Covered& c, Faults& faults) {
  const CoverArrays& a = c.arrays();
  const Complex& complex = c.blocks.complex();
  UnionFind joined(a.cover_count() + complex.block_count);  // covers that elements join
  std::vector<Index> block(a.cover_count(), none);
  const bool welded = c.model.cover->joints == JointTreatment::welded;
  std::vector<bool> held(a.cover_count(), false);
  for (Index e = 0; e < a.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(a, e);
    const Index b = block_of(a, e);
    for (int n = 0; n < a.nodes_per_part(); ++n) {
      const Index p = nodes.cover[n];
      held[p] = true;
      joined.join(nodes.cover[0], p);
      if (!welded && block[p] != none && block[p] != b)
        faults.push_back(fmt::format("cover: {} is of blocks {} and {}", p, block[p], b));
      block[p] = b;
    }
  }
  Index parts = 0;
  for (Index p = 0; p < a.cover_count(); ++p) {
    if (joined.find(p) == p) ++parts;
    if (!held[p]) faults.push_back(fmt::format("cover: {} is of no element", p));
  }
  const Real tolerance = complex.planes.width_tolerance();
  const Index least = body_count(c, 0.1 * tolerance), most = body_count(c, 10 * tolerance);
  // Joints that go on may part a block.
  const bool parted = c.model.cover->joint_tips == JointTips::extend;
  if (parts < least || (parts > most && !parted))
    faults.push_back(fmt::format("cover: {} bodies move apart from each other, expected {} to {}",
                                 parts, least, most));
}

void check_surface(const Covered& c, Faults& faults) {
  const Complex& complex = c.blocks.complex();
  const Real share = cell_split(c.arrays().lattice.kind).share;
  SurfaceSplitter splitter(complex, c.covering);
  const Real rounding = 1e-13 * complex.planes.model_size() * complex.planes.model_size();
  for (const FreePart& f : complex.free_parts) {
    if (!complex.is_analysed(f.cell)) continue;
    Real area = 0;
    Index strangers = 0;
    splitter.split(complex.polygon_of(f), f.cell, f.face, [&](const Holder& h, const Polygon& q) {
      area += share * polygon_moments(q).area;
      if (h.block != complex.cell_block[f.cell] || !h.found()) ++strangers;
    });
    if (!(std::abs(area - f.area) <= 1e-9 * f.area + rounding))
      faults.push_back(fmt::format("surface: {} m2 of {} of cell {}{}", area, f.area, f.cell,
                                   complex.is_sliver[f.cell] ? ", a sliver" : ""));
    if (strangers > 0)
      faults.push_back(fmt::format("surface: {} parts of an area of block {} in others", strangers,
                                   complex.cell_block[f.cell]));
  }
}

void check_points(const Covered& c, Faults& faults) {
  const BlockArrays& blocks = c.blocks.arrays;
  const MaterialPoints points = locate_block_vertices(c.covering, blocks);
  Index missing = 0, strangers = 0;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    if (c.blocks.complex().block_stage[b] != 0) continue;
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v)
      if (points.element[v] == none)
        ++missing;
      else if (c.model.cover->joints == JointTreatment::separate &&
               block_of(c.arrays(), points.element[v]) != b)
        ++strangers;
  }
  if (missing > 0 || strangers > 0)
    faults.push_back(fmt::format("points: {} vertices of blocks are not found, {} in other blocks",
                                 missing, strangers));
}

}  // namespace

std::vector<Real> element_volumes(const CoverArrays& a) {
  std::vector<Real> volume;
  for (Index r = 0; r < a.regular_count(); ++r) {
    const CellSplit& split = a.lattice.split(a.regular_cell[r]);
    for (const CellPart& part : split.part)
      volume.push_back(part_share(split, part) * lattice_cell_volume(a));
  }
  for (Index e = 0; e < a.cut_count(); ++e) {
    long double sum = 0;
    for (Index q = a.piece_begin[e]; q < a.piece_begin[e + 1]; ++q) sum += exact_piece_volume(a, q);
    volume.push_back(static_cast<Real>(sum));
  }
  return volume;
}

Faults faults_of_covers(const Covered& c) {
  Faults faults;
  check_volumes(c, faults);
  check_connection(c, faults);
  check_surface(c, faults);
  check_points(c, faults);
  if (faults.size() > 8) faults.resize(8);
  return faults;
}

}  // namespace rockfold::test
