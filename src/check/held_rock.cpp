#include "src/check/held_rock.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "src/base/vector.hpp"
#include "src/model/jointed.hpp"
#include "src/model/openings.hpp"
#include "src/report/error_text.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

using Row = std::vector<Real>;

/// Of rows, by elimination with the largest pivot of all (they are of functions that are 1 and less in size on the rock).
std::size_t rank_of(std::vector<Row> rows, std::size_t columns) {
  constexpr Real least = 1e-6;  // of the first pivot: smaller ones are rounding
  Real first = 0;
  std::size_t rank = 0;
  for (; rank < std::min(rows.size(), columns); ++rank) {
    std::size_t row = rank, column = rank;
    for (std::size_t r = rank; r < rows.size(); ++r)
      for (std::size_t c = rank; c < columns; ++c)
        if (std::abs(rows[r][c]) > std::abs(rows[row][column])) row = r, column = c;
    const Real pivot = rows[row][column];
    if (rank == 0) first = std::abs(pivot);
    if (!(std::abs(pivot) > least * first)) break;
    std::swap(rows[row], rows[rank]);
    for (Row& r : rows) std::swap(r[column], r[rank]);
    for (std::size_t r = rank + 1; r < rows.size(); ++r) {
      const Real factor = rows[r][rank] / pivot;
      for (std::size_t c = rank; c < columns; ++c) rows[r][c] -= factor * rows[rank][c];
    }
  }
  return rank;
}

/// The block of more than half of what is there at first, or none.
Index most_of_rock(const Model& model, const BlockArrays& blocks) {
  Real rock = 0;
  Index largest = none;
  for (Index b = 0; b < blocks.block_count(); ++b) {
    if (!is_there_at_first(model, blocks.stage[b])) continue;
    rock += blocks.volume[b];
    if (largest == none || blocks.volume[b] > blocks.volume[largest]) largest = b;
  }
  return largest != none && blocks.volume[largest] > 0.5 * rock ? largest : none;
}

/// [B] the fixed points of each block.
using PointsOfBlocks = std::vector<std::vector<std::size_t>>;

PointsOfBlocks points_of_blocks(const BlockArrays& blocks, const CoverArrays& covers,
                                const FixedPoints& fixed) {
  PointsOfBlocks points(blocks.volume.size());
  for (std::size_t n = 0; n < fixed.points.size(); ++n)
    if (const Index e = fixed.points.element[n]; e != none)
      points[block_of(covers, e)].push_back(n);
  return points;
}

/// Whether a [[fixed]] that holds some of these points names its block.
bool is_named(const Model& model, const FixedPoints& fixed,
              const std::vector<std::size_t>& points) {
  return !fixed.condition.empty() && std::any_of(points.begin(), points.end(), [&](std::size_t n) {
    const Index condition = fixed.condition[n];
    return condition != none && std::holds_alternative<BlockRegion>(model.fixed[condition].where);
  });
}

/// Whether what these points of a block hold leaves none of the functions of its cover.
bool is_held_whole(const CoverArrays& covers, const FixedPoints& fixed,
                   const std::vector<std::size_t>& points) {
  const auto functions = static_cast<std::size_t>(covers.functions());
  std::array<std::vector<Row>, 3> rows;
  for (const std::size_t n : points) {
    Row row(functions, 0);
    for (Index i = fixed.points.begin[n]; i < fixed.points.begin[n + 1]; ++i)
      row[static_cast<std::size_t>(fixed.points.unknown[i] / covers.cover_count())] +=
          fixed.points.weight[i];
    for (std::size_t d = 0; d < 3; ++d)
      if (fixed.component[n][d] != 0) rows[d].push_back(row);
  }
  return std::all_of(rows.begin(), rows.end(), [&](std::vector<Row>& of_axis) {
    return rank_of(std::move(of_axis), functions) == functions;
  });
}

/// Whether it keeps points where they are: neither by springs, which give, nor on a way.
bool holds_in_place(const Fixed& fixed) {
  return !fixed.stiffness && fixed.method != FixMethod::penalty && fixed.value == Vec3{} &&
         fixed.table.empty();
}

/// Whether no block that is there as the analysis begins has an unknown left.
bool all_are_held(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
                  const FixedPoints& fixed, const PointsOfBlocks& points) {
  if (!std::all_of(model.fixed.begin(), model.fixed.end(), holds_in_place)) return false;
  for (Index b = 0; b < blocks.block_count(); ++b)
    if (is_there_at_first(model, blocks.stage[b]) && !is_held_whole(covers, fixed, points[b]))
      return false;
  return blocks.block_count() > 0;
}

/// [B] 1: no [[fixed]] holds any of it.
std::vector<std::uint8_t> unheld_blocks(const BlockArrays& blocks, const CoverArrays& covers,
                                        const FixedPoints& fixed) {
  std::vector<std::uint8_t> unheld(blocks.volume.size(), 1);
  for (const Index e : fixed.points.element)
    if (e != none) unheld[block_of(covers, e)] = 0;
  return unheld;
}

/// Elevations against gravity: faces that look down, and lie beyond which the rock goes on or at the bottom of all rock.
class Undersides {
 public:
  Undersides(const BlockArrays& blocks, const Vec3& gravity)
      : blocks_(blocks), down_(normalized(gravity)) {
    Real high = std::numeric_limits<Real>::infinity();
    for (const Vec3& v : blocks.vertex) {
      lowest_ = std::max(lowest_, dot(v, down_));
      high = std::min(high, dot(v, down_));
    }
    tolerance_ = 1e-6 * (lowest_ - high);
  }

  /// Whether a block has such a face.
  bool reach(Index block) const {
    for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f) {
      const FaceOrigin& origin = blocks_.origins[blocks_.face_origin[f]];
      if (origin.kind != FaceOrigin::Kind::solid_face || !looks_down(f)) continue;
      if (origin.continues || is_lowest(f)) return true;
    }
    return false;
  }

 private:
  bool looks_down(Index f) const {
    constexpr Real steep = 0.7071;  // faces within 45° of level
    return dot(blocks_.face_normal[f], down_) > steep;
  }

  bool is_lowest(Index f) const {
    const Index corner = blocks_.corner_begin[blocks_.loop_begin[f]];
    return dot(blocks_.vertex[blocks_.corner_vertex[corner]], down_) > lowest_ - tolerance_;
  }

  const BlockArrays& blocks_;
  Vec3 down_;
  Real lowest_ = -std::numeric_limits<Real>::infinity(), tolerance_ = 0;
};

}  // namespace

bool may_leave_rock_unheld(const Model& model) {
  const bool all_falls = model.fixed.empty() && model.analysis &&
                         model.analysis->has(AnalysisType::dynamic);  // another warning says so
  return model.cover && model.analysis && has_contact(model) && model.gravity != Vec3{} &&
         has_joints(model) && !all_falls &&
         std::any_of(model.solids.begin(), model.solids.end(), [](const Solid& solid) {
           return std::find(solid.continues.begin(), solid.continues.end(), true) !=
                  solid.continues.end();
         });
}

void warn_of_unheld_rock(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
                         const FixedPoints& fixed, Terminal& terminal) {
  if (!may_leave_rock_unheld(model)) return;
  constexpr std::size_t most = 5;
  const auto unheld = unheld_blocks(blocks, covers, fixed);
  const Undersides undersides(blocks, model.gravity);
  std::vector<Index> found;
  for (Index b = 0; b < blocks.block_count(); ++b)
    if (unheld[b] && !blocks.finite[b] && is_there_at_first(model, blocks.stage[b]) &&
        undersides.reach(b))
      found.push_back(b);
  if (found.empty()) return;
  std::stable_sort(found.begin(), found.end(),
                   [&](Index a, Index b) { return blocks.volume[a] > blocks.volume[b]; });
  std::string names;
  for (std::size_t i = 0; i < std::min(most, found.size()); ++i)
    names += fmt::format("{}{}", i == 0 ? "" : ", ", found[i] + 1);
  if (found.size() > most) names += fmt::format(" and {} more", found.size() - most);
  const bool one = found.size() == 1;
  Place place = model.fixed.empty() ? model.analysis->place : model.fixed.front().place;
  place.key = "fixed";
  terminal.warn(diagnostic_line(
      {place,
       fmt::format("holds no point of block{} {}, the rock of which goes on beyond the model: "
                   "nothing stops {} fall. Hold {}, as in where = {{block_at = [{:.5g}, {:.5g}, "
                   "{:.5g}]}}",
                   one ? "" : "s", names, one ? "its" : "their", one ? "it" : "them",
                   blocks.centroid[found[0]][0], blocks.centroid[found[0]][1],
                   blocks.centroid[found[0]][2])}));
}

bool may_hold_all(const Model& model) {
  return model.cover && model.cover->lattice == LatticeKind::block && model.analysis &&
         std::any_of(model.fixed.begin(), model.fixed.end(), [](const Fixed& fixed) {
           return !std::holds_alternative<BlockRegion>(fixed.where);
         });
}

void warn_of_held_rock(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
                       const FixedPoints& fixed, Terminal& terminal) {
  if (!model.analysis || !model.cover || model.cover->lattice != LatticeKind::block) return;
  const PointsOfBlocks points = points_of_blocks(blocks, covers, fixed);
  const bool all = all_are_held(model, blocks, covers, fixed, points);
  const Index block = most_of_rock(model, blocks);
  if (!all && (block == none || is_named(model, fixed, points[block]) ||
               !is_held_whole(covers, fixed, points[block])))
    return;
  const Real rock = std::accumulate(blocks.volume.begin(), blocks.volume.end(), Real{0});
  Place place = model.cover->place;
  place.key += ".lattice";
  terminal.warn(diagnostic_line(
      {place,
       fmt::format(
           "\"block\" gives {} one cover, and [[fixed]] holds all of its {} unknowns: it neither "
           "moves nor strains, {}. A lattice such as \"tet6\" with a cover.spacing lets it deform",
           all ? "each block"
               : fmt::format("block {}, {:.3g} % of the rock,", block + 1,
                             100 * blocks.volume[block] / rock),
           3 * covers.functions(),
           all ? "and nothing can move" : "and round an opening in it displacements are 0")}));
}

}  // namespace rockfold
