// Values of the operator: the constants of the lattice for stencil rows and whole cells, integrals for cut elements.
#include "kernels/operator/elements/assemble_kernel.hpp"
#include "kernels/operator/elements/shifted_function_kernel.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::solve {
namespace {

/// The matrices of a whole regular cell of one form and one material, [cell node][k][cell node][l] entries.
struct CellTable {
  int nodes = 0, functions = 0;
  std::vector<Real> entry;

  Real* at(int a, int k, int b, int l) {
    return &entry[entry_size *
                  (((static_cast<std::size_t>(a) * functions + k) * nodes + b) * functions + l)];
  }
};

/// The matrices of all whole parts of all materials, [materials][forms·parts][width][width] entries.
std::vector<Real> whole_parts(const ElementTable& table) {
  const PartTable parts = table.parts;
  const Index count = parts.forms * parts.parts, materials = table.elastic.extent(0);
  const std::size_t width = parts.width;
  const auto result =
      device::allocate<Real>("solve::whole_parts", entry_size * width * width * count * materials);
  const auto elastic = table.elastic;
  device::for_each(
      "rockfold::solve::whole_parts", materials * count * parts.width,
      KOKKOS_LAMBDA(const Index i) {
        const int f = i % parts.width, part = i / parts.width % count;
        const ElementRow row(parts, function_terms(parts, part, f), parts.whole(part));
        for (int g = 0; g < parts.width; ++g)
          row.couple(parts, function_terms(parts, part, g), elastic(i / parts.width / count),
                     &result((i * width + g) * entry_size));
      });
  return device::to_host(result);
}

/// `matrix`: of the form's first part.
CellTable make_cell_table(const LatticeFunctions& all, int form, const Real* matrix) {
  CellTable table{all.cell_nodes, all.functions, {}};
  table.entry.assign(static_cast<std::size_t>(entry_size) * all.cell_nodes * all.functions *
                         all.cell_nodes * all.functions,
                     0.0);
  const int n = all.functions, width = all.nodes * n;
  for (int t = form * all.parts; t < (form + 1) * all.parts; ++t)
    for (int f = 0; f < width; ++f)
      for (int g = 0; g < width; ++g, matrix += entry_size) {
        Real* to = table.at(all.part[t].node[f / n], f % n, all.part[t].node[g / n], g % n);
        for (int m = 0; m < entry_size; ++m) to[m] += matrix[m];
      }
  return table;
}

/// The rows of a cover of one class in the midst of such cells, as DeviceStencil wants them.
std::vector<Real> stencil_table(const NodeClass& nodes, LatticeKind kind,
                                std::vector<CellTable>& form) {
  const int n = form.front().functions;
  const std::size_t offsets = 1 + 2 * nodes.positive.size();
  const CellSplit& split = cell_split(kind);
  std::vector<Real> table(entry_size * n * n * offsets + n, 0.0);
  for (std::size_t o = 0; o < offsets; ++o)
    for (const auto& corner : nodes.cell)
      for (int b = 0; b < split.node_count(); ++b) {
        Offset step;
        for (int d = 0; d < 3; ++d) step[d] = split.node[b][d] - split.node[corner.node][d];
        Offset wanted{0, 0, 0};
        if (o > 0)
          for (int d = 0; d < 3; ++d)
            wanted[d] = (o % 2 == 1 ? 1 : -1) * nodes.positive[(o - 1) / 2][d];
        if (step != wanted) continue;
        for (int k = 0; k < n; ++k)
          for (int l = 0; l < n; ++l) {
            Real* to = &table[entry_size * ((k * offsets + o) * n + l)];
            const Real* from = form[corner.form].at(corner.node, k, b, l);
            for (int m = 0; m < entry_size; ++m) to[m] += from[m];
          }
      }
  for (int k = 0; k < n; ++k)
    for (std::size_t o = 0; o < offsets; ++o)
      table[table.size() - n + k] += table[entry_size * (k * offsets + o) * n + 9];
  return table;
}

/// All the constants of a lattice and its materials.
struct Constants {
  std::vector<Real> cell;  ///< [materials][forms] cell tables
  std::vector<Real> stencil;
  std::vector<Index> table_begin;  ///< [materials][classes]
  std::vector<Index> pairs;        ///< [classes]
};

Constants make_constants(const CoverArrays& covers, const ElementTable& table) {
  Constants made;
  const LatticeKind kind = covers.lattice.kind;
  const auto classes = node_classes(kind);
  for (const NodeClass& c : classes) made.pairs.push_back(c.pairs());
  if (covers.regular_count() == 0) return made;
  const LatticeFunctions functions = lattice_functions(covers);
  const std::vector<Real> whole = whole_parts(table);
  const std::size_t materials = table.elastic.extent(0), forms = functions.forms;
  const std::size_t size = whole.size() / (materials * forms);
  for (std::size_t material = 0; material < materials; ++material) {
    std::vector<CellTable> form;
    for (std::size_t i = 0; i < forms; ++i) {
      form.push_back(
          make_cell_table(functions, static_cast<int>(i), &whole[size * (material * forms + i)]));
      made.cell.insert(made.cell.end(), form.back().entry.begin(), form.back().entry.end());
    }
    for (const NodeClass& c : classes) {
      made.table_begin.push_back(static_cast<Index>(made.stencil.size()));
      const std::vector<Real> entries = stencil_table(c, kind, form);
      made.stencil.insert(made.stencil.end(), entries.begin(), entries.end());
    }
  }
  return made;
}

/// Whole cells by their tables, cut elements by their moments.
void assemble(const DeviceBlocks& block, const ElementTable& table, const Constants& constants) {
  const PartTable parts = table.parts;
  const auto cells = device::to_device("solve::cell", constants.cell);
  const int n = parts.functions;
  const auto add_cell = KOKKOS_LAMBDA(const RowSink& sink, Index cell, int a) {
    const std::size_t width = static_cast<std::size_t>(parts.cell_nodes) * n;
    const std::size_t which = table.regular_material(cell) * parts.forms + table.regular_form(cell);
    const Real* first = &cells(entry_size * width * (which * width + a * n));
    const Real* row = first + entry_size * width * sink.k;
    for (int b = 0; b < parts.cell_nodes; ++b) {
      const Real* entry = row + entry_size * n * b;
      // No part holds both nodes: ∫ N_a N_b > 0 where one does.
      if (!(first[entry_size * n * b + 9] > 0)) continue;
      const Index at = sink.find(table.regular_cover(cell * parts.cell_nodes + b));
      for (int l = 0; l < n; ++l) sink.add(at, l, entry + entry_size * l);
    }
  };
  const auto add_cut = KOKKOS_LAMBDA(const RowSink& sink, Index c, int a) {
    const Index e = parts.parts * table.regular + c;
    const int part = table.part(e);
    const Elastic m = table.elastic(table.material(e));
    const ElementRow row(parts, function_terms(parts, part, a * n + sink.k), table.moments(e));
    for (int b = 0; b < parts.nodes; ++b) {
      const Index at = sink.find(table.cover(e, b));
      for (int l = 0; l < n; ++l) {
        Real entry[entry_size];
        row.couple(parts, function_terms(parts, part, b * n + l), m, entry);
        sink.add(at, l, entry);
      }
    }
  };
  const auto add_amid = KOKKOS_LAMBDA(const RowSink& sink, Index c, int a) {
    const Index e = parts.parts * table.regular + c;
    const int part = table.part(e);
    const Elastic m = table.elastic(table.material(e));
    const Real* origin = &table.origin(3 * static_cast<std::size_t>(c));
    const ElementRow row(
        parts,
        ShiftedFunction(parts, part, a, sink.k, origin, table.argument(table.cover(e, a))).terms(),
        &table.amid_moment(static_cast<std::size_t>(c) * parts.moments));
    for (int b = 0; b < parts.nodes; ++b) {
      const Index at = sink.find(table.cover(e, b));
      const Argument of = table.argument(table.cover(e, b));
      for (int l = 0; l < n; ++l) {
        Real entry[entry_size];
        row.couple(parts, ShiftedFunction(parts, part, b, l, origin, of).terms(), m, entry);
        sink.add(at, l, entry);
      }
    }
  };
  if (table.amid_moment.extent(0) > 0)
    fill_rows(block, parts.cell_nodes, parts.nodes, add_cell, add_amid);
  else
    fill_rows(block, parts.cell_nodes, parts.nodes, add_cell, add_cut);
}

/// See DeviceBlocks::by_difference: rows whose own stiffness is below a coupling. With linear weights, whose slopes are all of one
/// size, the sum is as good as what it sums, and all rows work by differences.
void choose_differences(const DeviceBlocks& block, bool linear_weights) {
  if (linear_weights) return Kokkos::deep_copy(block.by_difference, 1.0);
  const auto trace = KOKKOS_LAMBDA(const Real* v) {
    return v[0] + v[4 * slice_lanes] + v[8 * slice_lanes];
  };
  device::for_each(
      "rockfold::solve::choose_differences", block.slots(), KOKKOS_LAMBDA(const Index slot) {
        const Index slice = slot / slice_lanes;
        const int lane = slot % slice_lanes;
        const Real own = trace(block.diagonals(slice, 0, 0) + lane);
        const Real* v = block.values(slice, 0, 0) + lane;
        Real largest = 0;
        for (Index at = block.slice_begin(slice); at < block.slice_begin(slice + 1); ++at) {
          largest = device::math::fmax(largest, device::math::fabs(trace(v)));
          v += entry_size * slice_lanes;
        }
        block.by_difference(slot) = own < largest ? 0 : 1;
      });
}

DeviceBlocks upload(const BlockRows& rows, int functions) {
  using device::to_device;
  DeviceBlocks block;
  block.functions = functions;
  block.row = to_device("solve::row", rows.row);
  block.slice_begin = to_device("solve::slice_begin", rows.slice_begin);
  block.column = to_device("solve::column", rows.column);
  block.value_begin = to_device("solve::value_begin", rows.value_begin);
  block.owner = to_device("solve::owner", rows.owner);
  block.owning = to_device("solve::owning", rows.owning);
  block.source_begin = to_device("solve::source_begin", rows.source_begin);
  block.source = to_device("solve::source", rows.source);
  // These two are zero to start with.
  const std::size_t each =
      static_cast<std::size_t>(entry_size) * functions * functions * rows.lanes;
  block.value = Array<Real>("rockfold::solve::value", each * rows.value_columns);
  block.diagonal = Array<Real>("rockfold::solve::diagonal", each * rows.owning.size());
  block.by_difference = device::allocate<Real>("solve::by_difference", rows.row.size());
  return block;
}

DeviceStencil upload(const StencilRuns& runs, const Constants& constants, int functions) {
  using device::to_device;
  DeviceStencil stencil;
  stencil.functions = functions;
  stencil.classes = static_cast<int>(constants.pairs.size());
  stencil.stride = runs.stride;
  stencil.first = to_device("solve::run_first", runs.first);
  stencil.length = to_device("solve::run_length", runs.length);
  stencil.material = to_device("solve::run_material", runs.material);
  stencil.node_class = to_device("solve::run_class", runs.node_class);
  stencil.neighbour_begin = to_device("solve::run_neighbour_begin", runs.neighbour_begin);
  stencil.neighbour = to_device("solve::run_neighbour", runs.neighbour);
  stencil.pairs = to_device("solve::class_pairs", constants.pairs);
  stencil.table_begin = to_device("solve::stencil_begin", constants.table_begin);
  stencil.table = to_device("solve::stencil", constants.stencil);
  return stencil;
}

}  // namespace

Operator build_operator(const CoverArrays& covers, const PieceMoments& moments,
                        const std::vector<ElasticMaterial>& materials, bool stencils) {
  const ElementTable table = make_element_table(covers, moments, materials);
  const Constants constants = make_constants(covers, table);
  const Rows rows = sort_rows(covers, slice_lanes, stencils);
  Operator op;
  op.covers = covers.cover_count();
  op.unknowns = covers.unknown_count();
  op.functions = covers.functions();
  op.stencil_covers = rows.stencil_covers;
  op.block_covers = rows.block_covers;
  op.neighbours = rows.neighbours;
  op.stencil = upload(rows.stencil, constants, op.functions);
  op.block = upload(rows.block, op.functions);
  assemble(op.block, table, constants);
  choose_differences(op.block, table.parts.weight_degree <= 1);
  Kokkos::fence();
  op.block.source_begin = {};
  op.block.source = {};
  return op;
}

}  // namespace rockfold::solve
