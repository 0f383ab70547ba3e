#include "kernels/operator/springs_kernel.hpp"

namespace rockfold::solve {

Springs build_springs(const FixedPoints& fixed, Index unknowns) {
  const std::size_t count = fixed.points.size();
  const Index n = static_cast<Index>(count);
  std::vector<Vec3> stiffness(count), held(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int d = 0; d < 3; ++d) {
      const bool spring = fixed.enforce[i] == Enforce::penalty;
      stiffness[i][d] = fixed.component[i][d] && spring ? fixed.stiffness[i] : 0;
      held[i][d] = fixed.component[i][d] && !spring;
    }
  Springs springs;
  static_cast<PointRows&>(springs) = make_point_rows(fixed.points, unknowns);
  springs.stiffness = device::make_field("solve::stiffness", n);
  springs.held = device::make_field("solve::held", n);
  springs.tied = device::make_field("solve::tied", n);
  springs.tie = device::make_field("solve::tie", n);
  springs.multiplier = device::make_field("solve::multiplier", n);
  springs.target = device::make_field("solve::target", n);
  springs.force = device::make_field("solve::spring_force", n);
  springs.motion_ratio = device::to_device("solve::motion_ratio", fixed.motion_ratio.empty()
                                                                      ? std::vector<Real>(count, 1)
                                                                      : fixed.motion_ratio);
  device::copy_to_device(stiffness, springs.stiffness);
  device::copy_to_device(held, springs.held);
  device::copy_to_device(fixed.value, springs.target);
  return springs;
}

void set_tangents(const Springs& springs, const Field& stiffness, const PointTerms& terms) {
  if (!springs.any()) return;
  const Springs s = springs;
  const auto tangent = terms.tangent;
  device::for_each(
      "rockfold::solve::spring_tangents", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int m = 0; m < 6; ++m) tangent(n, m) = m < 3 ? stiffness(n, m) : 0;
      });
}

void apply_springs(const Springs& springs, const Field& stiffness, Real factor, const Field& x,
                   const Field& y) {
  if (!springs.any()) return;
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::spring_forces", s.points.count, KOKKOS_LAMBDA(const Index n) {
        Real u[3];
        interpolate_all(s.points, n, x, u);
        for (int d = 0; d < 3; ++d) s.force(n, d) = factor * stiffness(n, d) * u[d];
      });
  scatter(springs, 1, springs.force, y);
}

void add_spring_load(const Springs& springs, const Field& prescribed, const Field& b) {
  if (!springs.any()) return;
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::spring_load", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          s.force(n, d) = s.tied(n, d) > 0 ? 0 : s.tie(n, d) * prescribed(n, d);
      });
  scatter(springs, 1, springs.force, b);
}

Real largest_gap(const Springs& springs, bool held, Real factor, const Field& x,
                 const Field& prescribed) {
  const Springs s = springs;
  return device::largest(
      "rockfold::solve::largest_gap", s.points.count, KOKKOS_LAMBDA(const Index n) {
        Real worst = 0;
        for (int d = 0; d < 3; ++d) {
          if (!(s.tied(n, d) > 0) || (s.held(n, d) > 0) != held) continue;
          const Real gap = prescribed(n, d) + stretch_of_tied(s, n, d, factor) -
                           interpolate_one(s.points, n, d, x);
          worst = device::math::fmax(worst, s.motion_ratio(n) * device::math::fabs(gap));
        }
        return worst;
      });
}

void spring_reactions(const Springs& springs, const Field& x, const Field& prescribed,
                      const Field& reaction) {
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::reactions", s.points.count, KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          reaction(n, d) =
              s.tied(n, d) > 0
                  ? -s.multiplier(n, d)
                  : s.tie(n, d) * (prescribed(n, d) - interpolate_one(s.points, n, d, x));
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
