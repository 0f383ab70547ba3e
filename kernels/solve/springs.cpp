#include "kernels/solve/springs_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Inverts points → unknowns: unknowns ascending, entries of an unknown ascending.
void build_rows(const MaterialPoints& points, Index unknowns, Springs& springs) {
  std::vector<Index> begin(static_cast<std::size_t>(unknowns) + 1, 0);
  for (const Index p : points.unknown) ++begin[p + 1];
  std::vector<Index> row, row_begin{0};
  for (Index p = 0; p < unknowns; ++p) {
    if (begin[p + 1] > 0) {
      row.push_back(p);
      row_begin.push_back(row_begin.back() + begin[p + 1]);
    }
    begin[p + 1] += begin[p];
  }
  std::vector<Index> entry(points.unknown.size()), point(points.unknown.size());
  for (std::size_t n = 0; n < points.size(); ++n)
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
      entry[begin[points.unknown[i]]++] = i;
      point[i] = static_cast<Index>(n);
    }
  springs.entry_point = device::to_device("solve::spring_entry_point", point);
  springs.row = device::to_device("solve::spring_row", row);
  springs.row_begin = device::to_device("solve::spring_row_begin", row_begin);
  springs.row_entry = device::to_device("solve::spring_row_entry", entry);
}

Index points_of(const Springs& springs) {
  return springs.points.count;
}

}  // namespace

DevicePoints upload(const MaterialPoints& points) {
  return {static_cast<Index>(points.size()), device::to_device("solve::point_begin", points.begin),
          device::to_device("solve::point_unknown", points.unknown),
          device::to_device("solve::point_weight", points.weight)};
}

void interpolate(const DevicePoints& points, const Field& x, const Field& value) {
  device::for_each(
      "rockfold::solve::interpolate", points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) value(n, d) = interpolate_one(points, n, d, x);
      });
}

Springs build_springs(const FixedPoints& fixed, Index unknowns) {
  const std::size_t count = fixed.points.size();
  const Index n = static_cast<Index>(count);
  std::vector<Vec3> stiffness(count), augmented(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int d = 0; d < 3; ++d) {
      stiffness[i][d] = fixed.component[i][d] ? fixed.stiffness[i] : 0;
      augmented[i][d] = fixed.component[i][d] && fixed.augmented[i];
    }
  Springs springs;
  springs.points = upload(fixed.points);
  springs.given_stiffness = device::make_field("solve::given_stiffness", n);
  springs.stiffness = device::make_field("solve::stiffness", n);
  springs.augmented = device::make_field("solve::augmented", n);
  springs.multiplier = device::make_field("solve::multiplier", n);
  springs.target = device::make_field("solve::target", n);
  springs.force = device::make_field("solve::spring_force", n);
  springs.share = device::allocate<Real>("solve::share", fixed.points.unknown.size());
  device::copy_to_device(stiffness, springs.given_stiffness);
  device::copy_to_device(stiffness, springs.stiffness);
  device::copy_to_device(augmented, springs.augmented);
  device::copy_to_device(fixed.value, springs.target);
  build_rows(fixed.points, unknowns, springs);
  return springs;
}

void scatter(const Springs& springs, Real scale, const Field& value, const Field& y) {
  const auto row = springs.row, begin = springs.row_begin, entry = springs.row_entry;
  const auto weight = springs.points.weight;
  const auto point = springs.entry_point;
  device::for_each(
      "rockfold::solve::scatter", static_cast<Index>(row.extent(0)), KOKKOS_LAMBDA(const Index t) {
        Real sum[3] = {0, 0, 0};
        for (Index i = begin(t); i < begin(t + 1); ++i)
          for (int d = 0; d < 3; ++d) sum[d] += weight(entry(i)) * value(point(entry(i)), d);
        for (int d = 0; d < 3; ++d) y(row(t), d) += scale * sum[d];
      });
}

void apply_springs(const Springs& springs, Real factor, const Field& x, const Field& y) {
  if (!springs.any()) return;
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::stretch", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          s.force(n, d) = s.stiffness(n, d) * interpolate_one(s.points, n, d, x);
      });
  scatter(springs, factor, springs.force, y);
}

void add_spring_load(const Springs& springs, Real factor, const Field& goal, const Field& b) {
  if (!springs.any()) return;
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::spring_load", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          s.force(n, d) = factor * s.stiffness(n, d) * goal(n, d) - s.multiplier(n, d);
      });
  scatter(springs, 1, springs.force, b);
}

void add_spring_diagonal(const Springs& springs, Real factor, const Blocks& block) {
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::spring_diagonal", static_cast<Index>(springs.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        for (Index i = s.row_begin(t); i < s.row_begin(t + 1); ++i) {
          const Real w = s.points.weight(s.row_entry(i));
          for (int d = 0; d < 3; ++d)
            block(s.row(t), d) += factor * w * w * s.stiffness(s.entry_point(s.row_entry(i)), d);
        }
      });
}

void stiffen_springs(const Springs& springs, Real factor, const Blocks& block) {
  if (!springs.any()) return;
  const Springs s = springs;
  // A cover shares its diagonal (mean of x, y, z) among its points by their squared weights.
  device::for_each(
      "rockfold::solve::share_diagonal", static_cast<Index>(springs.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        const Index begin = s.row_begin(t), end = s.row_begin(t + 1), p = s.row(t);
        Real squares = 0;
        for (Index i = begin; i < end; ++i) {
          const Real w = s.points.weight(s.row_entry(i));
          squares += w * w;
        }
        const Real mean = (block(p, 0) + block(p, 1) + block(p, 2)) / 3;
        for (Index i = begin; i < end; ++i) {
          const Real w = s.points.weight(s.row_entry(i));
          s.share(s.row_entry(i)) = squares > 0 ? w * w / squares * mean : 0;
        }
      });
  device::for_each(
      "rockfold::solve::stiffen", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        Real wanted = 0;
        for (Index i = s.points.begin(n); i < s.points.begin(n + 1); ++i)
          wanted += 10 / factor * s.share(i);
        for (int d = 0; d < 3; ++d) {
          const Real given = s.given_stiffness(n, d);
          s.stiffness(n, d) = s.augmented(n, d) > 0 && wanted > given ? wanted : given;
        }
      });
}

Real multiplier_change(const Springs& springs, Real factor, const Field& x, const Field& goal,
                       const Field& change) {
  const Springs s = springs;
  return device::largest(
      "rockfold::solve::multiplier_change", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        Real worst = 0;
        for (int d = 0; d < 3; ++d) {
          change(n, d) = 0;
          if (!(s.augmented(n, d) > 0)) continue;
          const Real gap = interpolate_one(s.points, n, d, x) - goal(n, d);
          change(n, d) = device::math::sqrt(factor * s.stiffness(n, d)) * gap;
          worst = device::math::fmax(worst, device::math::fabs(gap));
        }
        return worst;
      });
}

void scale_by_stiffness(const Springs& springs, Real factor, Real power, const Field& values) {
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::scale_by_stiffness", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          if (s.augmented(n, d) > 0)
            values(n, d) *= device::math::pow(factor * s.stiffness(n, d), power);
      });
}

void spring_reactions(const Springs& springs, Real factor, const Field& x, const Field& goal,
                      const Field& reaction) {
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::reactions", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          const Real gap = interpolate_one(s.points, n, d, x) - goal(n, d);
          reaction(n, d) = -s.multiplier(n, d) - factor * s.stiffness(n, d) * gap;
        }
      });
}

Real largest_entry(const Field& x) {
  return device::largest(
      "rockfold::solve::largest_entry", static_cast<Index>(x.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        using device::math::fabs;
        using device::math::fmax;
        return fmax(fabs(x(p, 0)), fmax(fabs(x(p, 1)), fabs(x(p, 2))));
      });
}

}  // namespace rockfold::solve
