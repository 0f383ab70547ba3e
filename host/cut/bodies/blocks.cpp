#include "host/cut/bodies/blocks.hpp"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "host/cut/bodies/connectivity.hpp"
#include "host/cut/bodies/numbering.hpp"
#include "host/cut/bodies/specks.hpp"
#include "host/cut/bodies/union_find.hpp"
#include "host/refuse.hpp"
#include "src/base/place_text.hpp"
#include "src/base/vector.hpp"
#include "src/model/openings.hpp"

namespace rockfold {

namespace {

// The cell that holds a point of a merge, deepest inside if it lies on a boundary. Throws Error(model) outside of all.
Index cell_at(const CellStore& cells, const PlaneTable& planes, const Vec3& point,
              const Place& place) {
  const Vec3 x = point - planes.centre();
  Index best = none;
  Real deepest = -planes.width_tolerance();
  for (Index c = 0; c < cells.size(); ++c) {
    Real depth = Box::infinity;
    for (const auto& face : cells[c].faces) {
      const Index plane = plane_of(face.inside);
      const Real d = dot(planes.normal(plane), x) - planes.offset(plane);
      depth = std::min(depth, is_above(face.inside) ? d : -d);
      if (depth <= deepest) break;
    }
    if (depth > deepest) best = c, deepest = depth;
  }
  if (best == none)
    refuse(place, place.key + ".points",
           fmt::format("{} is not in the rock", given_place_text(point)));
  return best;
}

// Joints between and inside the parts that hold the points become virtual. Throws Error(model) where that leaves the parts
// apart.
void merge_parts(Complex& complex, const Merge::Blocks& merge, const Place& place,
                 std::vector<Index>& part) {
  std::vector<bool> joined(complex.cells.size(), false);  // [parts]
  std::vector<Index> part_of_point;
  for (const Vec3& point : merge.points) {
    const Index cell = cell_at(complex.cells, complex.planes, point, place);
    joined[part[cell]] = true;
    part_of_point.push_back(part[cell]);
  }
  UnionFind parts(complex.cells.size());
  const auto join = [&](auto& area) {
    const Index one = part[area.cell[0]], two = part[area.cell[1]];
    if (area.joint == none || !joined[one] || !joined[two] ||
        complex.zone(area.cell[0]).stage != complex.zone(area.cell[1]).stage)
      return;
    area.joint = area.instance = none;
    parts.join(one, two);
  };
  for (Fragment& f : complex.fragments) join(f);
  for (Beam& b : complex.beams)
    if (b.cell[1] != none) join(b);
  for (std::size_t i = 1; i < part_of_point.size(); ++i)
    if (parts.find(part_of_point[i]) != parts.find(part_of_point[0])) {
      const Vec3 &a = merge.points[0], &b = merge.points[i];
      refuse(place, place.key + ".points",
             fmt::format("the blocks at {} and {} cannot become one: no "
                         "joint between the blocks of the points leads from one to the other",
                         place_text(a), place_text(b)));
    }
  for (Index& p : part) p = parts.find(p);
}

// Rock all of which is narrower than the tolerance, with none wider beside it, is a block all the same.
void keep_lone_slivers(Complex& complex, std::vector<Index>& part) {
  if (std::find(part.begin(), part.end(), none) == part.end()) return;
  UnionFind parts(complex.cells.size());
  for (const Fragment& f : complex.fragments)
    if (f.joint == none && part[f.cell[0]] == none && part[f.cell[1]] == none)
      parts.join(f.cell[0], f.cell[1]);
  for (Index c = 0; c < complex.cells.size(); ++c)
    if (part[c] == none) {
      part[c] = parts.find(c);
      complex.is_sliver[c] = 0;
      complex.moments[c] = cell_moments(complex.cells[c], complex.planes);
    }
}

// Takes the blocks that cells were numbered by.
void take_blocks(Complex& complex, NumberedBlocks numbered) {
  complex.cell_block = std::move(numbered.of_cell);
  complex.block_count = static_cast<Index>(numbered.moments.size());
  complex.block_stage.assign(complex.block_count, 0);
  for (Index c = 0; c < complex.cells.size(); ++c)
    if (complex.is_sliver[c] == 0)
      complex.block_stage[complex.cell_block[c]] = complex.zone(c).stage;
}

// A joint beside a sliver lies between what beams through it meet, not between the sliver and the block that owns it.
void find_dead_ends(Complex& complex) {
  std::vector<Real> within(complex.fragments.size(), 0);  // m², of beams both ways
  for (const Beam& b : complex.beams)
    if (b.cell[1] != none && complex.cell_block[b.cell[0]] == complex.cell_block[b.cell[1]])
      for (const Index f : b.fragments) within[f] += b.area;
  for (std::size_t i = 0; i < complex.fragments.size(); ++i) {
    Fragment& f = complex.fragments[i];
    if (f.joint == none || complex.cell_block[f.cell[0]] != complex.cell_block[f.cell[1]]) continue;
    f.dead_end = complex.touches_sliver(f)
                     ? within[i] > f.area
                     : width_of(complex, f) >= complex.planes.width_tolerance();
  }
}

// A sliver that only its own block shows through is a cell like others.
void find_hidden(Complex& complex) {
  const auto& block = complex.cell_block;
  complex.is_hidden.assign(complex.cells.size(), 0);
  std::vector<std::uint8_t> passed(complex.cells.size(), 0);
  for (const Beam& b : complex.beams)
    for (const Index s : b.slivers) {
      passed[s] = 1;
      if (b.narrow) continue;
      if (b.cell[1] == none || block[b.cell[0]] != block[s] || block[b.cell[1]] != block[s])
        complex.is_hidden[s] = complex.is_sliver[s];
    }
  // What no beam passes lies before free faces on both sides, or is narrow there: a skin.
  for (std::size_t c = 0; c < passed.size(); ++c)
    if (passed[c] == 0) complex.is_hidden[c] = complex.is_sliver[c];
}

}  // namespace

void check_merge_points(const CellStore& cells, const PlaneTable& planes, const Model& model) {
  for (const Merge& merge : model.merges)
    if (const auto* blocks = std::get_if<Merge::Blocks>(&merge.region))
      for (const Vec3& point : blocks->points) cell_at(cells, planes, point, merge.place);
}

std::optional<SpeckReport> find_blocks(Complex& complex, const Model& model) {
  std::vector<Index> part = wide_parts(complex);
  give_slivers(complex, part);
  keep_lone_slivers(complex, part);
  for (const Merge& merge : model.merges)
    if (const auto* blocks = std::get_if<Merge::Blocks>(&merge.region))
      merge_parts(complex, *blocks, merge.place, part);
  NumberedBlocks numbered = number_blocks(complex, part);
  std::optional<SpeckReport> specks;
  if (model.cut.specks == Specks::merge) specks = merge_specks(complex, model.cut, numbered);
  take_blocks(complex, std::move(numbered));
  for (const Index stage : complex.block_stage)
    complex.block_is_analysed.push_back(is_there_at_first(model, stage) ? 1 : 0);
  find_dead_ends(complex);
  find_hidden(complex);
  return specks;
}

}  // namespace rockfold
