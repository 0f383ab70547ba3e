#include <algorithm>
#include <cmath>
#include <string>

#include "kernels/operator/sampled_elements_kernel.hpp"
#include "src/arrays/element_points.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/error.hpp"

namespace rockfold::solve {
namespace {

/// Elements whose functions are held at their points at one time: some megabytes.
constexpr Index samples_at_a_time = 64;
/// Bytes of elements' matrices that wait for the rows to gather them.
constexpr std::size_t matrix_bytes = 128'000'000;

template <class F>
void for_each_on_host(Index n, const F& f) {
  using Host = Kokkos::DefaultHostExecutionSpace;
  Kokkos::parallel_for(
      "rockfold::solve::sample",
      Kokkos::RangePolicy<Host, Kokkos::Schedule<Kokkos::Dynamic>, Kokkos::IndexType<Index>>(0, n),
      f);
}

/// Elements first ≤ e < first + count at their points; those of e begin at begin[e − first].
struct Samples {
  Index first = 0, count = 0;
  int width = 0;
  std::vector<std::int64_t> begin;  ///< [count+1]
  std::vector<Real> weight;         ///< [points] m³
  std::vector<Real> function;       ///< [points][4][width] values, then the components of gradients

  const Real* slope(std::int64_t point, int axis) const {
    return &function[(4 * point + 1 + axis) * width];
  }
};

bool finite(const FunctionValue& f) {
  return std::isfinite(f.value) && std::isfinite(f.gradient[0]) && std::isfinite(f.gradient[1]) &&
         std::isfinite(f.gradient[2]);
}

[[noreturn]] void refuse(const CoverArrays& covers, Index element, const Vec3& eta) {
  Vec3 x = covers.lattice.cell_centre(element_nodes(covers, element).cell);
  for (int d = 0; d < 3; ++d)
    for (int e = 0; e < 3; ++e) x[e] += eta[d] * covers.lattice.edge[d][e];
  throw Error(ErrorKind::analysis,
              "local series: found a value or gradient that is no finite number at (" +
                  std::to_string(x[0]) + ", " + std::to_string(x[1]) + ", " + std::to_string(x[2]) +
                  "), in manifold element " + std::to_string(element));
}

class Sampler {
 public:
  explicit Sampler(const CoverArrays& covers)
      : covers_(covers), points_(covers, sampling_degree(covers)), functions_(covers) {}

  int width() const { return functions_.width(); }

  Samples sample(Index first, Index last) const {
    Samples s;
    s.first = first;
    s.count = last - first;
    s.width = width();
    std::vector<std::vector<RockPoint>> point(s.count);
    for_each_on_host(s.count, [&](Index i) { points_.add_element(first + i, point[i]); });
    s.begin.push_back(0);
    for (const auto& of_element : point)
      s.begin.push_back(s.begin.back() + static_cast<std::int64_t>(of_element.size()));
    s.weight.resize(s.begin.back());
    s.function.resize(4 * s.begin.back() * s.width);
    std::vector<std::int64_t> bad(s.count, -1);
    for_each_on_host(s.count, [&](Index i) {
      const ElementNodes nodes = element_nodes(covers_, first + i);
      std::vector<FunctionValue> value(s.width);
      for (std::size_t p = 0; p < point[i].size(); ++p) {
        functions_.at(nodes, point[i][p].eta, value.data());
        const std::size_t at = s.begin[i] + p;
        s.weight[at] = point[i][p].weight;
        Real* to = &s.function[4 * at * s.width];
        for (int f = 0; f < s.width; ++f) {
          to[f] = value[f].value;
          for (int d = 0; d < 3; ++d) to[(1 + d) * s.width + f] = value[f].gradient[d];
        }
        if (bad[i] < 0 && !std::all_of(value.begin(), value.end(), finite))
          bad[i] = static_cast<std::int64_t>(p);
      }
    });
    for (Index i = 0; i < s.count; ++i)
      if (bad[i] >= 0) refuse(covers_, first + i, point[i][bad[i]].eta);
    return s;
  }

 private:
  const CoverArrays& covers_;
  const ElementPoints points_;
  const ElementFunctions functions_;
};

/// Matrices of consecutive elements: of each the lower half, [f][10][g ≤ f], entries by their numbers.
struct Matrices {
  Index first = 0, count = 0;
  int width = 0;
  Array<Real> entry;

  static std::size_t half(int width) { return static_cast<std::size_t>(width) * (width + 1) / 2; }
  KOKKOS_INLINE_FUNCTION Real* row(Index e, int f) const {
    const std::size_t size = static_cast<std::size_t>(width) * (width + 1) / 2;
    return &entry(entry_size * (size * (e - first) + static_cast<std::size_t>(f) * (f + 1) / 2));
  }
  KOKKOS_INLINE_FUNCTION bool holds(Index e) const { return e >= first && e < first + count; }
  /// entry[10] = K_fg, M_fg.
  KOKKOS_INLINE_FUNCTION void load(Index e, int f, int g, Real* to) const {
    const bool lower = g <= f;
    const int size = (lower ? f : g) + 1;
    const Real* from = lower ? row(e, f) + g : row(e, g) + f;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) to[3 * i + j] = from[size * (lower ? 3 * i + j : 3 * j + i)];
    to[9] = from[9 * size];
  }
};

KOKKOS_INLINE_FUNCTION void add_scaled(int size, Real factor, const Real* x, Real* sum) {
  for (int g = 0; g < size; ++g) sum[g] += factor * x[g];
}

/// Σ over the points of weight · (∂_i φ_f ∂_j φ_g, φ_f φ_g), then stiffness and mass of the element's material.
void integrate(const Samples& s, const ElementTable& table, const Matrices& to) {
  const auto begin = device::to_device("solve::sample_begin", s.begin);
  const auto weight = device::to_device("solve::sample_weight", s.weight);
  const auto function = device::to_device("solve::sample_function", s.function);
  const int width = s.width;
  const Index first = s.first;
  // Few and long: worth the other threads, however few.
  Kokkos::parallel_for(
      "rockfold::solve::integrate_samples", device::Range(0, s.count * width),
      KOKKOS_LAMBDA(const Index i) {
        const Index e = first + i / width;
        const int f = i % width, size = f + 1;
        Real* row = to.row(e, f);
        for (int m = 0; m < entry_size * size; ++m) row[m] = 0;
        for (std::int64_t p = begin(i / width); p < begin(i / width + 1); ++p) {
          const Real* at = &function(4 * static_cast<std::size_t>(width) * p);
          for (int d = 0; d < 3; ++d)
            for (int j = 0; j < 3; ++j)
              add_scaled(size, weight(p) * at[(1 + d) * width + f], at + (1 + j) * width,
                         row + (3 * d + j) * size);
          add_scaled(size, weight(p) * at[f], at, row + 9 * size);
        }
        const Elastic m = table.elastic(table.material(e));
        for (int g = 0; g < size; ++g) {
          Real entry[entry_size];
          for (int k = 0; k < entry_size; ++k) entry[k] = row[k * size + g];
          elastic_entry(m, entry);
          for (int k = 0; k < entry_size; ++k) row[k * size + g] = entry[k];
        }
      });
}

/// What the elements at hand have for a row.
struct Gather {
  ElementTable table;
  Matrices from;

  KOKKOS_INLINE_FUNCTION void add(const RowSink& sink, Index e, int a) const {
    if (!from.holds(e)) return;
    const int n = table.functions;
    for (int b = 0; b < table.parts.nodes; ++b) {
      const Index at = sink.find(table.cover(e, b));
      for (int l = 0; l < n; ++l) {
        Real entry[entry_size];
        from.load(e, a * n + sink.k, b * n + l, entry);
        sink.add(at, l, entry);
      }
    }
  }
  /// All parts of a regular cell at one of its nodes.
  KOKKOS_INLINE_FUNCTION void add_cell(const RowSink& sink, Index cell, int node) const {
    const PartTable& parts = table.parts;
    for (Index e = parts.parts * cell; e < parts.parts * (cell + 1); ++e)
      for (int a = 0; a < parts.nodes; ++a)
        if (parts.cell_node(table.part(e), a) == node) add(sink, e, a);
  }
};

void gather(const DeviceBlocks& block, const ElementTable& table, const Matrices& from) {
  const Gather gather{table, from};
  const Index whole = table.parts.parts * table.regular;
  const auto add_cell = KOKKOS_LAMBDA(const RowSink& sink, Index cell, int node) {
    gather.add_cell(sink, cell, node);
  };
  const auto add_cut = KOKKOS_LAMBDA(const RowSink& sink, Index cut, int a) {
    gather.add(sink, whole + cut, a);
  };
  fill_rows(block, table.parts.cell_nodes, table.parts.nodes, add_cell, add_cut);
}

}  // namespace

void assemble_sampled(const DeviceBlocks& block, const ElementTable& table,
                      const CoverArrays& covers) {
  const Sampler sampler(covers);
  Matrices matrices;
  matrices.width = sampler.width();
  const std::size_t each = entry_size * Matrices::half(matrices.width);
  const Index elements = covers.element_count();
  const Index most = std::min<Index>(
      elements,
      std::max(samples_at_a_time, static_cast<Index>(matrix_bytes / (sizeof(Real) * each))));
  matrices.entry = device::allocate<Real>("solve::element_matrices", each * most);
  for (; matrices.first < elements; matrices.first += matrices.count) {
    matrices.count = std::min(most, elements - matrices.first);
    const Index end = matrices.first + matrices.count;
    for (Index e = matrices.first; e < end; e += samples_at_a_time)
      integrate(sampler.sample(e, std::min(e + samples_at_a_time, end)), table, matrices);
    gather(block, table, matrices);
  }
  Kokkos::fence();
}

Array<Real> sampled_mean_slopes(const CoverArrays& covers) {
  const Sampler sampler(covers);
  const Index elements = covers.element_count();
  std::vector<Real> slopes;
  slopes.reserve(3 * static_cast<std::size_t>(sampler.width()) * elements);
  for (Index first = 0; first < elements; first += samples_at_a_time) {
    const Samples s = sampler.sample(first, std::min(first + samples_at_a_time, elements));
    for (Index i = 0; i < s.count; ++i) {
      std::vector<Real> sum(3 * s.width, 0.0);
      Real volume = 0;
      for (std::int64_t p = s.begin[i]; p < s.begin[i + 1]; ++p) {
        volume += s.weight[p];
        for (int f = 0; f < s.width; ++f)
          for (int d = 0; d < 3; ++d) sum[3 * f + d] += s.weight[p] * s.slope(p, d)[f];
      }
      for (const Real slope : sum) slopes.push_back(slope / volume);
    }
  }
  return device::to_device("solve::mean_slopes", slopes);
}

PointSlopes sampled_slopes(const CoverArrays& covers, const std::vector<Index>& element,
                           const std::vector<Vec3>& local) {
  if (!covers.sampled()) return {};
  const ElementFunctions functions(covers);
  const std::size_t width = functions.width();
  std::vector<Real> slopes(3 * width * element.size());
  for_each_on_host(static_cast<Index>(element.size()), [&](Index n) {
    std::vector<FunctionValue> f(width);
    functions.at(element_nodes(covers, element[n]), covers.lattice.to_local(local[n]), f.data());
    for (std::size_t i = 0; i < width; ++i)
      for (int d = 0; d < 3; ++d) slopes[3 * (width * n + i) + d] = f[i].gradient[d];
  });
  return {device::to_device("solve::point_slopes", slopes), 3 * width};
}

}  // namespace rockfold::solve
