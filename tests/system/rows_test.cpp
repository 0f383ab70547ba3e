// Which rows share values.
#include "src/system/rows.hpp"

#include <map>
#include <tuple>

#include <gtest/gtest.h>

#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

constexpr int lanes = 8;

/// Whole cells of two materials, one above the other.
CoverArrays layered_rock(LatticeKind kind) {
  CoverArrays covers = uncut_system(11, 12, 8, kind).covers();
  for (std::size_t r = 0; r < covers.regular_cell.size(); ++r)
    covers.regular_material[r] = covers.lattice.cell_ijk(covers.regular_cell[r])[2] < 3 ? 0 : 1;
  return covers;
}

/// What a row's values follow from, found by lattice places alone: of each cell at the row's node where it lies and its material; and
/// where the neighbour of each column lies.
using Surroundings = std::pair<std::map<std::array<Index, 3>, std::tuple<Index, int>>,
                               std::vector<std::array<Index, 3>>>;

Surroundings surroundings(const CoverArrays& covers, const solve::BlockRows& rows, Index slot) {
  const auto place = [&](Index cover) { return covers.lattice.node_ijk(covers.cover_node[cover]); };
  const auto from = place(rows.row[slot]);
  const auto step = [&](const std::array<Index, 3>& to) {
    return std::array<Index, 3>{to[0] - from[0], to[1] - from[1], to[2] - from[2]};
  };
  Surroundings found;
  const int nodes = covers.nodes_per_cell();
  for (Index i = rows.source_begin[slot]; i < rows.source_begin[slot + 1]; ++i) {
    const Index r = static_cast<Index>(rows.source[i] / nodes);
    const auto cell = covers.lattice.cell_ijk(covers.regular_cell[r]);
    const int parity = (cell[0] + cell[1] + cell[2]) % 2;  // what tet5 splits by
    found.first[step(cell)] = {covers.regular_material[r],
                               covers.lattice.kind == LatticeKind::tet5 ? parity : 0};
  }
  const Index slice = slot / lanes;
  for (Index k = rows.slice_begin[slice]; k < rows.slice_begin[slice + 1]; ++k)
    found.second.push_back(step(place(rows.column[k * lanes + slot % lanes])));
  return found;
}

TEST(Rows, ThatShareValuesHaveTheSameCellsAndNeighboursAroundThem) {
  for (const LatticeKind kind : {LatticeKind::tet5, LatticeKind::tet6, LatticeKind::hex8}) {
    SCOPED_TRACE(int(kind));
    const CoverArrays covers = layered_rock(kind);
    const solve::BlockRows rows = solve::sort_rows(covers, lanes).block;
    ASSERT_EQ(rows.value_begin.size(), static_cast<std::size_t>(rows.slice_count()));
    Index shared = 0;
    for (Index slice = 0; slice < rows.slice_count(); ++slice) {
      const Index owner = rows.owning[rows.owner[slice]];
      EXPECT_EQ(rows.value_begin[slice], rows.value_begin[owner]);
      if (owner == slice) continue;
      ++shared;
      const Surroundings expected = surroundings(covers, rows, owner * lanes);
      for (int l = 0; l < lanes; ++l) {
        EXPECT_EQ(surroundings(covers, rows, owner * lanes + l), expected);
        EXPECT_EQ(surroundings(covers, rows, slice * lanes + l), expected);
      }
    }
    EXPECT_GT(shared, rows.slice_count() / 4);
  }
}

TEST(Rows, OfWhichValuesMayChangeShareNone) {
  const solve::BlockRows rows =
      solve::sort_rows(layered_rock(LatticeKind::tet6), lanes, false).block;
  EXPECT_EQ(rows.owning.size(), static_cast<std::size_t>(rows.slice_count()));
  EXPECT_EQ(rows.value_columns, rows.slice_begin.back());
}

}  // namespace
}  // namespace rockfold
