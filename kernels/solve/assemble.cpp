// Values of the operator: the constants of the lattice for stencil rows, and the blocks of all other rows, each
// integrated by the one thread that owns the row.
#include "kernels/solve/operator_kernel.hpp"

namespace rockfold::solve {
namespace {

/// A regular lattice cell of one material: for each pair of corners a block of 9 and a mass.
constexpr int cell_table_size = 8 * 8 * 10;

void fill_cell_table(const TetTable& tets, const Elastic& material, Real* table) {
  for (int t = 0; t < 6; ++t)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b) {
        Real* entry = table + 10 * (8 * tets.corner[t][a] + tets.corner[t][b]);
        add_stiffness(material, tets.volume, tets.gradient[t][a], tets.gradient[t][b], entry);
        // ∫ N_a N_b over a whole tetrahedron: V/20, twice that on the diagonal.
        entry[9] += material.density * tets.volume / 20 * (a == b ? 2 : 1);
      }
}

/// The rows of a cover in the midst of such cells: the sum over the eight cells around it.
void fill_stencil_table(const Real* cell, Real* table) {
  const auto offsets = stencil_offsets();
  Real* row_mass = table + 10 * half_neighbours;
  Real* diagonal = row_mass + 1;
  for (int a = 0; a < 8; ++a) {
    for (int k = 0; k < 10; ++k) diagonal[k] += cell[10 * (8 * a + a) + k];
    for (int b = 0; b < 8; ++b) {
      const Offset step{(b & 1) - (a & 1), (b >> 1 & 1) - (a >> 1 & 1), (b >> 2) - (a >> 2)};
      for (int o = 0; o < half_neighbours; ++o)
        if (offsets[o] == step)
          for (int k = 0; k < 10; ++k) table[10 * o + k] += cell[10 * (8 * a + b) + k];
    }
  }
  *row_mass = diagonal[9];
  for (int o = 0; o < half_neighbours; ++o) *row_mass += 2 * table[10 * o + 9];
}

struct Assembly {
  DeviceBlocks block;
  Array<TetTable> tets;
  Array<Elastic> elastic;
  Array<Real> cell_table;  ///< [materials][cell_table_size]
  Array<Real> moments;     ///< [E][10]
  Array<Index> regular_cover, regular_material, element_cover, element_material;
  Array<std::uint8_t> element_part;
};

/// Adds a block of 9 and a mass where row and column say.
KOKKOS_INLINE_FUNCTION void add_entry(const DeviceBlocks& block, Index slot, Index q,
                                      const Real* entry) {
  const int lane = slot % slice_lanes;
  const Index slice = slot / slice_lanes;
  if (q == block.row(slot)) {
    Real* d = &block.diagonal(7 * static_cast<std::size_t>(slot));
    const int at[6] = {0, 4, 8, 1, 5, 2};
    for (int k = 0; k < 6; ++k) d[k] += entry[at[k]];
    d[6] += entry[9];
    return;
  }
  const Index k =
      find_column(block, block.slice_begin(slice), block.slice_begin(slice + 1), lane, q);
  Real* v = &block.value(static_cast<std::size_t>(k) * 10 * slice_lanes + lane);
  for (int m = 0; m < 10; ++m) v[m * slice_lanes] += entry[m];
}

KOKKOS_INLINE_FUNCTION void add_cell(const Assembly& as, Index slot, Index cell, int corner) {
  const Real* table = &as.cell_table(as.regular_material(cell) * cell_table_size);
  for (int b = 0; b < 8; ++b) {
    const Real* entry = table + 10 * (8 * corner + b);
    if (entry[9] > 0) add_entry(as.block, slot, as.regular_cover(8 * cell + b), entry);
  }
}

KOKKOS_INLINE_FUNCTION void add_element(const Assembly& as, Index slot, Index e, int a) {
  const TetTable& tets = as.tets(0);
  const int t = as.element_part(e);
  const Elastic m = as.elastic(as.element_material(e));
  const Real* moments = &as.moments(10 * static_cast<std::size_t>(e));
  for (int b = 0; b < 4; ++b) {
    Real entry[10] = {};
    add_stiffness(m, moments[0], tets.gradient[t][a], tets.gradient[t][b], entry);
    entry[9] = mass_entry(m.density, moments, tets.constant[t][a], tets.gradient[t][a],
                          tets.constant[t][b], tets.gradient[t][b]);
    add_entry(as.block, slot, as.element_cover(4 * e + b), entry);
  }
}

void assemble_blocks(const Assembly& as, Index slots) {
  device::for_each(
      "rockfold::solve::assemble", slots, KOKKOS_LAMBDA(const Index slot) {
        for (Index s = as.block.source_begin(slot); s < as.block.source_begin(slot + 1); ++s) {
          const Source source = as.block.source(s);
          if (source >= 0)
            add_cell(as, slot, static_cast<Index>(source / 8), static_cast<int>(source % 8));
          else
            add_element(as, slot, static_cast<Index>((-1 - source) / 4),
                        static_cast<int>((-1 - source) % 4));
        }
      });
}

DeviceBlocks upload(const BlockRows& rows) {
  using device::to_device;
  DeviceBlocks block;
  block.row = to_device("solve::row", rows.row);
  block.slice_begin = to_device("solve::slice_begin", rows.slice_begin);
  block.column = to_device("solve::column", rows.column);
  block.source_begin = to_device("solve::source_begin", rows.source_begin);
  block.source = to_device("solve::source", rows.source);
  // These two are zero to start with.
  block.value = Array<Real>("rockfold::solve::value", 10 * rows.column.size());
  block.diagonal = Array<Real>("rockfold::solve::diagonal", 7 * rows.row.size());
  return block;
}

DeviceStencil upload(const StencilRuns& runs, const std::vector<Real>& table) {
  using device::to_device;
  return {to_device("solve::run_first", runs.first), to_device("solve::run_length", runs.length),
          to_device("solve::run_material", runs.material),
          to_device("solve::run_neighbour", runs.neighbour), to_device("solve::stencil", table)};
}

}  // namespace

Array<Real> element_moments(const CoverArrays& covers, const PieceMoments& moments) {
  std::vector<Real> sums(10 * covers.element_cell.size(), 0.0);
  for (Index e = 0; e < covers.cut_count(); ++e) {
    Real* sum = &sums[10 * static_cast<std::size_t>(e)];
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
      sum[0] += moments.volume[q];
      for (int d = 0; d < 3; ++d) sum[1 + d] += moments.first[q][d];
      for (int d = 0; d < 6; ++d) sum[4 + d] += moments.second[q][d];
    }
  }
  return device::to_device("solve::element_moments", sums);
}

Operator build_operator(const CoverArrays& covers, const PieceMoments& moments,
                        const std::vector<ElasticMaterial>& materials, bool stencils) {
  const TetTable tets = make_tet_table(covers.lattice);
  const std::vector<Elastic> elastic = make_elastic(materials);
  std::vector<Real> cell_table(cell_table_size * materials.size(), 0.0);
  std::vector<Real> stencil_table(DeviceStencil::table_size * materials.size(), 0.0);
  for (std::size_t m = 0; m < materials.size(); ++m) {
    fill_cell_table(tets, elastic[m], &cell_table[cell_table_size * m]);
    fill_stencil_table(&cell_table[cell_table_size * m],
                       &stencil_table[DeviceStencil::table_size * m]);
  }

  const Rows rows = sort_rows(covers, slice_lanes, stencils);
  Operator op;
  op.covers = covers.cover_count();
  op.stencil_rows = rows.stencil_rows;
  op.block_rows = rows.block_rows;
  op.block_entries = rows.block_entries;
  op.stencil = upload(rows.stencil, stencil_table);
  op.block = upload(rows.block);

  using device::to_device;
  assemble_blocks(
      {op.block, to_device("solve::tets", std::vector<TetTable>{tets}),
       to_device("solve::elastic", elastic), to_device("solve::cell", cell_table),
       element_moments(covers, moments), to_device("solve::regular_cover", covers.regular_cover),
       to_device("solve::regular_material", covers.regular_material),
       to_device("solve::element_cover", covers.element_cover),
       to_device("solve::element_material", covers.element_material),
       to_device("solve::element_part", covers.element_part)},
      static_cast<Index>(rows.block.row.size()));
  Kokkos::fence();
  return op;
}

}  // namespace rockfold::solve
