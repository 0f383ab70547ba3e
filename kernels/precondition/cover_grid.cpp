#include <algorithm>
#include <cmath>

#include "kernels/precondition/chebyshev.hpp"
#include "kernels/precondition/cover_grid_kernel.hpp"
#include "src/system/coarse_points.hpp"

namespace rockfold::solve {
namespace {

/// Parts of at most so many covers are solved by their inverses.
Index small_part(int functions) {
  return functions > 4 ? 10 : 24;
}
/// The smoother: its degree, and the share of the largest eigenvalue down to which it works. Covers of order 2 have more that is
/// smooth to one function alone.
int smoothing_degree(int functions) {
  return functions > 4 ? 4 : 2;
}
Real smoothed_share(int functions) {
  return functions > 4 ? 1.0 / 16 : 1.0 / 6;
}

/// r −= q; d = old · d + share · B r; x += d. Where there is no q yet: x = d = share · B r.
void advance(const CoverLevel& level, bool first, Real old, Real share) {
  const CoverBlocks blocks = level.blocks;
  const Field x = level.x, r = level.r, d = level.d, q = level.q;
  device::for_each(
      "rockfold::solve::smooth_covers", blocks.covers,
      KOKKOS_LAMBDA(const Index p) {
        const int width = blocks.width();
        Real left[most_block_width], z[most_block_width];
        for (int e = 0; e < width; ++e) {
          const Index u = e / 3 * blocks.covers + p;
          left[e] = first ? r(u, e % 3) : r(u, e % 3) - q(u, e % 3);
        }
        precondition_cover(blocks, p, left, z);
        for (int e = 0; e < width; ++e) {
          const Index u = e / 3 * blocks.covers + p;
          const Real step = share * z[e] + (old != 0 ? old * d(u, e % 3) : 0);
          r(u, e % 3) = left[e];
          d(u, e % 3) = step;
          x(u, e % 3) = first ? step : x(u, e % 3) + step;
        }
      },
      level.blocks.width());
}

/// r −= q.
void subtract(const CoverLevel& level) {
  const Field r = level.r, q = level.q;
  device::for_each(
      "rockfold::solve::subtract_covers", static_cast<Index>(r.extent(0)),
      KOKKOS_LAMBDA(const Index u) {
        for (int d = 0; d < 3; ++d) r(u, d) -= q(u, d);
      });
}

/// y = y · share + x · factor.
void combine(const Field& y, Real share, Real factor, const Field& x) {
  device::for_each(
      "rockfold::solve::combine_fields", static_cast<Index>(y.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        for (int d = 0; d < 3; ++d) y(p, d) = (share == 0 ? 0 : share * y(p, d)) + factor * x(p, d);
      });
}

/// One W-cycle on the levels from `l` down.
class Cycle {
 public:
  Cycle(const CoverGrid& grid, const Apply& a) : grid_(grid), finest_(a) {}

  /// q = A d.
  void multiply(std::size_t l) const {
    const CoverLevel& level = grid_.levels[l];
    if (l == 0) return finest_(level.d, level.q);
    apply(level.a, level.d, level.q);
    apply_terms(level.terms, level.d, level.q);
    if (grid_.contacts.any()) add_contacts(grid_.contacts.level[l], 1, level.d, level.q);
  }

  /// x from r, which is used up.
  void run(std::size_t l) const {
    const CoverLevel& level = grid_.levels[l];
    const int functions = level.blocks.functions;
    if (l + 1 == grid_.levels.size()) {
      if (grid_.contacts.any())
        solve_coarsest(grid_.contacts.coarsest, functions, level.r, level.x);
      else if (grid_.coarsest.any())
        solve_parts(grid_.coarsest, functions, level.r, level.x);
      else
        smooth(l, true, coarsest_degree, coarsest_share);
      return;
    }
    const CoverLevel& coarse = grid_.levels[l + 1];
    smooth(l, true, smoothing_degree(functions), smoothed_share(functions));
    multiply(l);
    subtract(level);
    restrict_functions(coarse.from, functions, level.r, coarse.r);
    run_twice(l + 1);
    add_correction(coarse.from, functions, coarse.x, level.d, level.x);
    smooth(l, false, smoothing_degree(functions), smoothed_share(functions));
  }

 private:
  /// x from r, and what that leaves of r once more: errors that a single cycle leaves would add up over the levels.
  void run_twice(std::size_t l) const {
    if (l + 1 == grid_.levels.size()) return run(l);
    const CoverLevel& level = grid_.levels[l];
    Kokkos::deep_copy(level.load, level.r);
    run(l);
    Kokkos::deep_copy(level.first, level.x);
    Kokkos::deep_copy(level.d, level.x);
    multiply(l);
    Kokkos::deep_copy(level.r, level.load);
    subtract(level);
    run(l);
    combine(level.x, 1, 1, level.first);
  }

  /// From x = 0, or from what d has just added to x.
  void smooth(std::size_t l, bool first, int degree, Real share) const {
    const CoverLevel& level = grid_.levels[l];
    Chebyshev polynomial(level.largest, share);
    if (!first) multiply(l);
    advance(level, first, 0, polynomial.first());
    for (int k = 1; k < degree; ++k) {
      polynomial.next();
      multiply(l);
      advance(level, false, polynomial.old_share(), polynomial.new_share());
    }
  }

  const CoverGrid& grid_;
  const Apply& finest_;
};

/// Numbers without pattern.
void scatter(const Field& to) {
  device::for_each(
      "rockfold::solve::scatter_numbers", static_cast<Index>(to.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          std::uint32_t h = 3 * static_cast<std::uint32_t>(p) + i + 1;
          h = (h ^ h >> 16) * 0x45d9f3bU;
          h = (h ^ h >> 16) * 0x45d9f3bU;
          to(p, i) = static_cast<Real>((h ^ h >> 16) & 0xffff) / 32768 - 1;
        }
      });
}

/// x = B r.
void precondition_blocks(const CoverLevel& level) {
  const CoverBlocks blocks = level.blocks;
  const Field x = level.x, r = level.r;
  device::for_each(
      "rockfold::solve::precondition_covers", blocks.covers, KOKKOS_LAMBDA(const Index p) {
        Real of[most_block_width], z[most_block_width];
        for (int e = 0; e < blocks.width(); ++e) of[e] = r(e / 3 * blocks.covers + p, e % 3);
        precondition_cover(blocks, p, of, z);
        for (int e = 0; e < blocks.width(); ++e) x(e / 3 * blocks.covers + p, e % 3) = z[e];
      });
}

/// Conjugate gradients on D⁻¹A of a level, for estimate_largest_eigenvalue. They start from A x: what A does not resist (covers' functions are
/// dependent) would otherwise soon be all there is of the directions, and end the search with less than a third of the eigenvalue.
class CoverGradients {
 public:
  CoverGradients(const Cycle& cycle, const CoverLevel& level, std::size_t l, const KrylovWork& work)
      : cycle_(cycle), level_(level), l_(l), work_(work) {}

  Real begin() {
    scatter(level_.r);
    precondition_blocks(level_);
    Kokkos::deep_copy(level_.d, level_.x);
    cycle_.multiply(l_);
    Kokkos::deep_copy(level_.r, level_.q);
    precondition_blocks(level_);
    Kokkos::deep_copy(level_.d, level_.x);
    return dot(work_, level_.r, level_.x);
  }
  Real curvature() {
    cycle_.multiply(l_);
    return dot(work_, level_.d, level_.q);
  }
  Real advance(Real alpha) {
    combine(level_.r, 1, -alpha, level_.q);
    precondition_blocks(level_);
    return dot(work_, level_.r, level_.x);
  }
  void turn(Real beta) { combine(level_.d, beta, 1, level_.x); }

 private:
  const Cycle& cycle_;
  const CoverLevel& level_;
  std::size_t l_;
  const KrylovWork& work_;
};

/// [entries][3] finer place − coarser place in cells of the lattice; `half`: half an edge of the finer level in cells.
std::vector<Real> parent_steps(const std::vector<HalfPlace>& fine, const CoarseCovers& coarse,
                               Real half) {
  std::vector<Real> step;
  for (std::size_t p = 0; p < fine.size(); ++p)
    for (Index q = coarse.parent_begin[p]; q < coarse.parent_begin[p + 1]; ++q)
      for (int d = 0; d < 3; ++d)
        step.push_back(half * (fine[p][d] - 2 * coarse.place[coarse.parent[q]][d]));
  return step;
}

CoverTransfer make_transfer(const CoarseCovers& coarse, const std::vector<Real>& step,
                            bool quadratic) {
  std::vector<Index> begin(coarse.place.size() + 1, 0), child(coarse.parent.size());
  std::vector<Real> weight(child.size()), child_step(step.size());
  for (const Index q : coarse.parent) ++begin[q + 1];
  for (std::size_t q = 0; q < coarse.place.size(); ++q) begin[q + 1] += begin[q];
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for (std::size_t p = 0; p + 1 < coarse.parent_begin.size(); ++p)
    for (Index k = coarse.parent_begin[p]; k < coarse.parent_begin[p + 1]; ++k) {
      const std::size_t at = end[coarse.parent[k]]++;
      child[at] = static_cast<Index>(p);
      weight[at] = coarse.weight[k];
      for (int d = 0; d < 3; ++d)
        child_step[3 * at + d] = step[3 * static_cast<std::size_t>(k) + d];
    }
  using device::to_device;
  return {to_device("solve::cover_parent_begin", coarse.parent_begin),
          to_device("solve::cover_parent", coarse.parent),
          to_device("solve::cover_child_begin", begin),
          to_device("solve::cover_child", child),
          to_device("solve::cover_parent_weight",
                    std::vector<Real>(coarse.weight.begin(), coarse.weight.end())),
          to_device("solve::cover_child_weight", weight),
          to_device("solve::cover_parent_step", step),
          to_device("solve::cover_child_step", child_step),
          quadratic};
}

void allocate_level(CoverLevel& level, Index covers, int functions) {
  for (Field* f : {&level.x, &level.r, &level.d, &level.q})
    *f = device::make_field("solve::cover_level", covers * functions);
}

void make_coarse_level(CoverLevel& level, const CoarseCovers& coarse, int functions,
                       const MaterialPoints& points) {
  const Index covers = coarse.count();
  allocate_level(level, covers, functions);
  level.load = device::make_field("solve::cover_level_load", covers * functions);
  level.first = device::make_field("solve::cover_level_first", covers * functions);
  static_cast<PointRows&>(level.terms) = make_point_rows(points, covers * functions);
  level.blocks = make_cover_blocks(covers, functions);
  level.a = {covers,
             functions,
             device::to_device("solve::cover_begin", coarse.column_begin),
             device::to_device("solve::cover_column", coarse.column),
             {}};
}

}  // namespace

CoverGrid make_cover_grid(const CoverArrays& covers, const MaterialPoints& points) {
  CoverGrid grid;
  const int functions = covers.functions();
  const bool quadratic = covers.order == 2;
  const Index small = small_part(functions);
  const std::vector<CoarseCovers> coarse = coarsen_covers(covers, small);
  if (coarse.empty()) return grid;
  grid.levels.resize(coarse.size() + 1);
  allocate_level(grid.levels[0], covers.cover_count(), functions);
  std::vector<HalfPlace> place = half_places(covers);
  MaterialPoints seen = points;
  Real half = 0.5;
  for (std::size_t l = 0; l < coarse.size(); ++l, half *= 2) {
    const std::vector<Real> step = parent_steps(place, coarse[l], half);
    seen = coarsen_points(seen, coarse[l], quadratic ? step : std::vector<Real>{});
    make_coarse_level(grid.levels[l + 1], coarse[l], functions, seen);
    grid.levels[l + 1].from = make_transfer(coarse[l], step, quadratic);
    grid.parents.push_back({coarse[l].parent_begin, coarse[l].parent, coarse[l].count()});
    place = coarse[l].place;
  }
  if (largest_part(coarse.back()) <= small)
    grid.coarsest = make_cover_parts(connected_parts(coarse.back()), functions);
  return grid;
}

namespace {

/// Of contacts, on all levels; those of the finest are needed for the others' alone.
void set_contacts(CoverGrid& grid, const PointTerms& contacts) {
  const CoverBlocks& finest = grid.levels[0].blocks;
  if (!grid.contacts.found)
    find_rows(grid.contacts, contacts, finest.covers, finest.functions, grid.parents);
  if (!grid.contacts.any()) return;
  sum_points(grid.contacts.level[0], contacts);
  for (std::size_t l = 1; l < grid.levels.size(); ++l)
    multiply(grid.contacts.level[l - 1], grid.levels[l].from, grid.contacts.level[l]);
}

}  // namespace

void set_values(CoverGrid& grid, const Apply& a, const KrylovWork& work, const Operator& op,
                const CoverBlocks& blocks, const PointTerms& terms, const PointTerms& contacts,
                const Combination& c) {
  grid.levels[0].blocks = blocks;
  set_contacts(grid, contacts);
  for (std::size_t l = 1; l < grid.levels.size(); ++l) {
    CoverLevel& level = grid.levels[l];
    if (level.a.value.extent(0) == 0)  // not before they are needed
      level.a.value = device::allocate<Real>(
          "solve::cover_value", level.a.column.extent(0) * level.a.width() * level.a.width());
    level.terms.tangent = terms.tangent;
    level.terms.force = terms.force;
    if (l == 1)
      multiply(op, c, level.from, level.a);
    else
      multiply(grid.levels[l - 1].a, level.from, level.a);
    set_values(level.blocks, level.a, level.terms, grid.contacts.level[l]);
  }
  const bool solved = grid.coarsest.any() || grid.contacts.any();
  const CoverLevel& last = grid.levels.back();
  if (grid.contacts.any())
    factorise(grid.contacts.coarsest, last.a, last.terms, grid.contacts.level.back());
  else if (solved)
    invert_parts(last.a, last.terms, grid.coarsest);
  const Cycle cycle(grid, a);
  for (std::size_t l = 0; l + (solved ? 1 : 0) < grid.levels.size(); ++l) {
    CoverGradients gradients(cycle, grid.levels[l], l, work);
    grid.levels[l].largest = estimate_largest_eigenvalue(gradients);
  }
}

void precondition(const CoverGrid& grid, const Apply& a, const Field& r, const Field& z) {
  Kokkos::deep_copy(grid.levels[0].r, r);
  Cycle(grid, a).run(0);
  Kokkos::deep_copy(z, grid.levels[0].x);
}

}  // namespace rockfold::solve
