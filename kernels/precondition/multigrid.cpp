#include <algorithm>
#include <cmath>

#include "kernels/device/sums_kernel.hpp"
#include "kernels/precondition/chebyshev.hpp"
#include "kernels/precondition/multigrid_kernel.hpp"
#include "src/system/coarse_points.hpp"

namespace rockfold::solve {
namespace {

using device::Sums;

/// Parts of at most so many covers are solved densely.
constexpr Index small_part = 64;
/// The smoother works on eigenvalues from the largest down to this share of it.
constexpr Real smoothed_share = 1.0 / 6;

/// d = x = share · B r.
void first_step(const GridLevel& level, Real share) {
  const auto r = level.r, x = level.x, d = level.d;
  const auto b = level.inverse;
  const float s = static_cast<float>(share);
  device::for_each(
      "rockfold::solve::first_step", level.a.rows, KOKKOS_LAMBDA(const Index p) {
        const float u = r(p, 0), v = r(p, 1), w = r(p, 2);
        const float z[3] = {b(p, 0) * u + b(p, 3) * v + b(p, 5) * w,
                            b(p, 3) * u + b(p, 1) * v + b(p, 4) * w,
                            b(p, 5) * u + b(p, 4) * v + b(p, 2) * w};
        for (int i = 0; i < 3; ++i) {
          d(p, i) = s * z[i];
          x(p, i) = s * z[i];
        }
      });
}

void restrict_residual(const Interpolation& p, const SingleField& fine, const SingleField& coarse) {
  const auto begin = p.child_begin, child = p.child;
  device::for_each(
      "rockfold::solve::restrict", static_cast<Index>(coarse.extent(0)),
      KOKKOS_LAMBDA(const Index q) {
        float sum[3] = {0, 0, 0};
        for (Index k = begin(q); k < begin(q + 1); ++k)
          for (int i = 0; i < 3; ++i) sum[i] += p.child_weight(k) * fine(child(k), i);
        for (int i = 0; i < 3; ++i) coarse(q, i) = sum[i];
      });
}

/// d = P coarse; x += d.
void add_correction(const Interpolation& p, const SingleField& coarse, const SingleField& d,
                    const SingleField& x) {
  const auto begin = p.parent_begin, parent = p.parent;
  device::for_each(
      "rockfold::solve::prolong", static_cast<Index>(d.extent(0)), KOKKOS_LAMBDA(const Index q) {
        float sum[3] = {0, 0, 0};
        for (Index k = begin(q); k < begin(q + 1); ++k)
          for (int i = 0; i < 3; ++i) sum[i] += coarse(parent(k), i);
        for (int i = 0; i < 3; ++i) {
          sum[i] *= p.parent_weight(q);
          d(q, i) = sum[i];
          x(q, i) += sum[i];
        }
      });
}

/// x from r on the last level.
void solve_coarsest(const Multigrid& grid) {
  const GridLevel& level = grid.levels.back();
  if (grid.contacts.any()) {
    solve_coarsest(grid.contacts.coarsest, 1, level.r, level.x);
    return;
  }
  if (grid.coarsest.any()) {
    solve_parts(grid.coarsest, level.r, level.x);
    return;
  }
  Chebyshev polynomial(level.largest, coarsest_share);
  first_step(level, polynomial.first());
  SingleField now = level.d, next = level.step;
  for (int k = 1; k < coarsest_degree; ++k) {
    polynomial.next();
    smooth(level.a, level.inverse, static_cast<float>(polynomial.old_share()),
           static_cast<float>(polynomial.new_share()), now, level.r, level.x, next);
    std::swap(now, next);
  }
}

/// x from r, which is used up.
void cycle(const Multigrid& grid, std::size_t l) {
  if (l + 1 == grid.levels.size()) {
    solve_coarsest(grid);
    return;
  }
  const GridLevel& level = grid.levels[l];
  const GridLevel& coarse = grid.levels[l + 1];
  Chebyshev polynomial(level.largest, smoothed_share);
  first_step(level, polynomial.first());
  polynomial.next();
  const float old_share = static_cast<float>(polynomial.old_share()),
              new_share = static_cast<float>(polynomial.new_share());
  smooth(level.a, level.inverse, old_share, new_share, level.d, level.r, level.x, level.step);
  subtract_product(level.a, level.step, level.r);
  restrict_residual(coarse.from, level.r, coarse.r);
  cycle(grid, l + 1);
  add_correction(coarse.from, coarse.x, level.d, level.x);
  smooth(level.a, level.inverse, 0, static_cast<float>(polynomial.first()), level.d, level.r,
         level.x, level.step);
  smooth(level.a, level.inverse, old_share, new_share, level.step, level.r, level.x, level.d);
}

/// Numbers without pattern in r.
void scatter_residual(const GridLevel& level) {
  const auto r = level.r;
  device::for_each(
      "rockfold::solve::scatter_residual", level.a.rows, KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) {
          std::uint32_t h = 3 * static_cast<std::uint32_t>(p) + i + 1;
          h = (h ^ h >> 16) * 0x45d9f3bU;
          h = (h ^ h >> 16) * 0x45d9f3bU;
          r(p, i) = static_cast<float>((h ^ h >> 16) & 0xffff) / 32768.0F - 1;
        }
      });
}

/// Conjugate gradients on D⁻¹A of a level, for estimate_largest_eigenvalue.
class LevelGradients {
 public:
  explicit LevelGradients(const GridLevel& level)
      : level_(level),
        partial_(device::allocate<Real>("solve::estimate", 2 * device::chunk_count(level.a.rows))),
        sums_("rockfold::solve::estimate_sums", 2) {}

  Real begin() {
    scatter_residual(level_);
    turn(0);
    return residual_energy();
  }
  Real curvature() {
    Kokkos::deep_copy(level_.step, 0.0F);
    subtract_product(level_.a, level_.d, level_.step);
    return direction_energy();
  }
  Real advance(Real alpha) {
    step_residual(alpha);
    return residual_energy();
  }

 private:
  KOKKOS_INLINE_FUNCTION static void inverse_row(const SingleInverse& b, const SingleField& r,
                                                 Index p, float* z) {
    const float u = r(p, 0), v = r(p, 1), w = r(p, 2);
    z[0] = b(p, 0) * u + b(p, 3) * v + b(p, 5) * w;
    z[1] = b(p, 3) * u + b(p, 1) * v + b(p, 4) * w;
    z[2] = b(p, 5) * u + b(p, 4) * v + b(p, 2) * w;
  }

 public:  // nvcc: lambdas in private members are not allowed
  /// r · B r.
  Real residual_energy() {
    const auto r = level_.r;
    const auto b = level_.inverse;
    const auto sums = sums_;
    device::sum_then<1>(
        "rockfold::solve::estimate_energy", level_.a.rows, partial_,
        KOKKOS_LAMBDA(const Index p, Sums<1>& sum) {
          float z[3];
          inverse_row(b, r, p, z);
          for (int i = 0; i < 3; ++i) sum.value[0] += Real(r(p, i)) * z[i];
        },
        KOKKOS_LAMBDA(const Sums<1>& sum) { sums(0) = sum.value[0]; });
    return device::to_host(sums_)[0];
  }
  /// d · A d; step holds −A d.
  Real direction_energy() {
    const auto d = level_.d, step = level_.step;
    const auto sums = sums_;
    device::sum_then<1>(
        "rockfold::solve::estimate_direction", level_.a.rows, partial_,
        KOKKOS_LAMBDA(const Index p, Sums<1>& sum) {
          for (int i = 0; i < 3; ++i) sum.value[0] -= Real(d(p, i)) * step(p, i);
        },
        KOKKOS_LAMBDA(const Sums<1>& sum) { sums(0) = sum.value[0]; });
    return device::to_host(sums_)[0];
  }
  /// r −= α A d.
  void step_residual(Real alpha) {
    const auto r = level_.r, step = level_.step;
    const float share = static_cast<float>(alpha);
    device::for_each(
        "rockfold::solve::estimate_step", level_.a.rows, KOKKOS_LAMBDA(const Index p) {
          for (int i = 0; i < 3; ++i) r(p, i) += share * step(p, i);
        });
  }
  /// d = B r + β d.
  void turn(Real beta) {
    const auto r = level_.r, d = level_.d;
    const auto b = level_.inverse;
    const float share = static_cast<float>(beta);
    device::for_each(
        "rockfold::solve::estimate_turn", level_.a.rows, KOKKOS_LAMBDA(const Index p) {
          float z[3];
          inverse_row(b, r, p, z);
          for (int i = 0; i < 3; ++i) d(p, i) = share == 0 ? z[i] : z[i] + share * d(p, i);
        });
  }

 private:
  const GridLevel& level_;
  Array<Real> partial_, sums_;
};

void allocate_fields(GridLevel& level, Index rows) {
  level.x = SingleField("rockfold::solve::level_x", rows);
  level.r = SingleField("rockfold::solve::level_r", rows);
  level.inverse = SingleInverse("rockfold::solve::level_inverse", rows);
}

void allocate_steps(GridLevel& level, Index rows) {
  level.d = SingleField("rockfold::solve::level_d", rows);
  level.step = SingleField("rockfold::solve::level_step", rows);
}

/// In memory of `lent`, which stays its owner's: two numbers in single precision for one in double.
void borrow_steps(GridLevel& level, const Field& lent) {
  const std::size_t rows = lent.extent(0);
  auto* memory = reinterpret_cast<float*>(lent.data());
  level.d = SingleField(memory, rows);
  level.step = SingleField(memory + 3 * rows, rows);
}

/// The points with their weights of functions 0 alone: unknowns below `covers`.
MaterialPoints of_constants(const MaterialPoints& points, Index covers) {
  MaterialPoints result;
  result.element = points.element;
  for (std::size_t n = 0; n < points.size(); ++n) {
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
      if (points.unknown[i] < covers) {
        result.unknown.push_back(points.unknown[i]);
        result.weight.push_back(points.weight[i]);
      }
    result.begin.push_back(static_cast<Index>(result.unknown.size()));
  }
  return result;
}

}  // namespace

Multigrid make_multigrid(const CoverArrays& covers, const Operator& op,
                         const MaterialPoints& points, const Field& lent) {
  Multigrid grid;
  const std::vector<CoarseCovers> coarse = coarsen_covers(covers, small_part);
  if (coarse.empty()) return grid;
  grid.levels.resize(coarse.size() + 1);
  grid.lent = lent;
  allocate_fields(grid.levels[0], covers.cover_count());
  borrow_steps(grid.levels[0], lent);
  MaterialPoints seen = of_constants(points, covers.cover_count());
  grid.levels[0].points = make_point_rows(seen, covers.cover_count());
  std::vector<Index> classes = finest_classes(op);
  for (std::size_t l = 0; l < coarse.size(); ++l) {
    GridLevel& level = grid.levels[l + 1];
    allocate_fields(level, coarse[l].count());
    allocate_steps(level, coarse[l].count());
    classes = coarse_classes(coarse[l], classes);
    level.structure = make_coarse_rows(coarse[l], classes);
    level.from = make_interpolation(coarse[l]);
    grid.parents.push_back({coarse[l].parent_begin, coarse[l].parent, coarse[l].count()});
    seen = coarsen_points(seen, coarse[l]);
    level.points = make_point_rows(seen, coarse[l].count());
  }
  if (largest_part(coarse.back()) <= small_part)
    grid.coarsest = make_dense_parts(connected_parts(coarse.back()));
  return grid;
}

void set_inverse(Multigrid& grid, const Blocks& inverse, Real scale) {
  grid.scale = scale;
  const auto to = grid.levels[0].inverse;
  device::for_each(
      "rockfold::solve::single_inverse", static_cast<Index>(to.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        // An element too small for single precision stays at rest.
        const Real most = 1e36;
        bool fits = true;
        for (int m = 0; m < 6; ++m) fits = fits && device::math::fabs(inverse(p, m) * scale) < most;
        for (int m = 0; m < 6; ++m)
          to(p, m) = fits ? static_cast<float>(inverse(p, m) * scale) : 0.0F;
      });
}

namespace {

/// Of contacts, on all levels.
void set_contacts(Multigrid& grid, const PointTerms& contacts) {
  if (!grid.contacts.found)
    find_rows(grid.contacts, contacts, grid.levels[0].a.rows, 1, grid.parents);
  if (!grid.contacts.any()) return;
  sum_points(grid.contacts.level[0], contacts, 1 / grid.scale);
  for (std::size_t l = 1; l < grid.levels.size(); ++l)
    multiply(grid.contacts.level[l - 1], grid.levels[l].from, grid.contacts.level[l]);
}

}  // namespace

void set_values(Multigrid& grid, const Operator& op, const PointTerms& terms,
                const PointTerms& contacts, const Combination& c) {
  grid.levels[0].a.rows = op.covers;
  set_contacts(grid, contacts);
  for (std::size_t l = 0; l < grid.levels.size(); ++l) {
    GridLevel& level = grid.levels[l];
    level.a = l == 0 ? finest_matrix(op, c, grid.scale)
                     : coarse_matrix(grid.levels[l - 1].a, level.from, level.structure);
    if (terms.any()) level.a.terms = level_terms(terms, level.points, grid.scale);
    level.a.contacts = grid.contacts.level[l];
    if (l > 0) invert_diagonal(level.a, level.inverse);
  }
  const bool solved = grid.coarsest.any() || grid.contacts.any();
  for (std::size_t l = 0; l + (solved ? 1 : 0) < grid.levels.size(); ++l) {
    LevelGradients gradients(grid.levels[l]);
    grid.levels[l].largest = estimate_largest_eigenvalue(gradients);
  }
  if (grid.contacts.any())
    factorise(grid.contacts.coarsest, grid.levels.back().a);
  else if (solved)
    invert_parts(grid.levels.back().a, grid.coarsest);
}

void precondition(const Multigrid& grid, const Field& r, const Array<Real>& squared_norm) {
  const auto to = grid.levels[0].r;
  device::for_each(
      "rockfold::solve::scale_residual", static_cast<Index>(r.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        const Real share = 1 / device::math::sqrt(squared_norm(0));
        for (int d = 0; d < 3; ++d) to(p, d) = static_cast<float>(share * r(p, d));
      });
  cycle(grid, 0);
}

}  // namespace rockfold::solve
