#include "src/check/held_rock.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <variant>
#include <vector>

#include <fmt/format.h>

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

bool names_block(const Model& model, Index condition) {
  return condition != none && std::holds_alternative<BlockRegion>(model.fixed[condition].where);
}

/// Whether what is held of a block leaves none of the functions of its cover.
bool is_held_whole(const Model& model, const CoverArrays& covers, const FixedPoints& fixed,
                   Index block) {
  const auto functions = static_cast<std::size_t>(covers.functions());
  std::array<std::vector<Row>, 3> rows;
  for (std::size_t n = 0; n < fixed.points.size(); ++n) {
    const Index e = fixed.points.element[n];
    if (e == none || block_of(covers, e) != block) continue;
    if (!fixed.condition.empty() && names_block(model, fixed.condition[n])) return false;
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

}  // namespace

bool may_hold_all(const Model& model) {
  return model.cover && model.cover->lattice == LatticeKind::block && model.analysis &&
         std::any_of(model.fixed.begin(), model.fixed.end(), [](const Fixed& fixed) {
           return !std::holds_alternative<BlockRegion>(fixed.where);
         });
}

void warn_of_held_rock(const Model& model, const BlockArrays& blocks, const CoverArrays& covers,
                       const FixedPoints& fixed, Terminal& terminal) {
  if (!may_hold_all(model)) return;
  const Index block = most_of_rock(model, blocks);
  if (block == none || !is_held_whole(model, covers, fixed, block)) return;
  const Real rock = std::accumulate(blocks.volume.begin(), blocks.volume.end(), Real{0});
  Place place = model.cover->place;
  place.key += ".lattice";
  terminal.warn(diagnostic_line(
      {place,
       fmt::format("\"block\" gives block {}, {:.3g} % of the rock, one cover, and [[fixed]] "
                   "holds all of its {} unknowns: it neither moves nor strains, and round an "
                   "opening in it displacements are 0. A lattice such as \"tet6\" with a "
                   "cover.spacing lets it deform",
                   block + 1, 100 * blocks.volume[block] / rock, 3 * covers.functions())}));
}

}  // namespace rockfold
