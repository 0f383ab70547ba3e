#include "kernels/operator/springs_kernel.hpp"

namespace rockfold::solve {
namespace {

/// Stiffness of augmented points over what resists them. That of points which one cover moves alone stands in the
/// blocks of the preconditioner, so that it may be high, and the multipliers have little to do.
constexpr Real stiffness_alone = 1e4, stiffness_shared = 10;
/// Penalty springs stiffer than this, over what multipliers need, get a compliance with a multiplier.
constexpr Real far_stiffer = 4;

Index points_of(const Springs& springs) {
  return springs.points.count;
}

}  // namespace

Springs build_springs(const FixedPoints& fixed, const std::vector<Vec3>& eliminated,
                      Index unknowns) {
  const std::size_t count = fixed.points.size();
  const Index n = static_cast<Index>(count);
  std::vector<Vec3> stiffness(count), augmented(count);
  for (std::size_t i = 0; i < count; ++i)
    for (int d = 0; d < 3; ++d) {
      stiffness[i][d] = fixed.component[i][d] ? fixed.stiffness[i] : 0;
      augmented[i][d] = fixed.component[i][d] && fixed.enforce[i] != Enforce::penalty;
    }
  Springs springs;
  static_cast<PointRows&>(springs) = make_point_rows(fixed.points, unknowns);
  springs.given_stiffness = device::make_field("solve::given_stiffness", n);
  springs.stiffness = device::make_field("solve::stiffness", n);
  springs.augmented = device::make_field("solve::augmented", n);
  springs.eliminated = device::make_field("solve::eliminated", n);
  springs.by_multiplier = device::make_field("solve::by_multiplier", n);
  springs.compliance = device::make_field("solve::compliance", n);
  springs.multiplier = device::make_field("solve::multiplier", n);
  springs.target = device::make_field("solve::target", n);
  springs.force = device::make_field("solve::spring_force", n);
  springs.motion_ratio = device::to_device("solve::motion_ratio", fixed.motion_ratio.empty()
                                                                      ? std::vector<Real>(count, 1)
                                                                      : fixed.motion_ratio);
  springs.share = device::allocate<Real>("solve::share", fixed.points.unknown.size());
  device::copy_to_device(stiffness, springs.given_stiffness);
  device::copy_to_device(stiffness, springs.stiffness);
  device::copy_to_device(augmented, springs.augmented);
  device::copy_to_device(augmented, springs.by_multiplier);
  device::copy_to_device(eliminated, springs.eliminated);
  device::copy_to_device(fixed.value, springs.target);
  return springs;
}

void set_tangents(const Springs& springs, Real factor, const PointTerms& terms, Index first) {
  if (!springs.any()) return;
  const auto stiffness = springs.stiffness;
  const auto tangent = terms.tangent;
  device::for_each(
      "rockfold::solve::spring_tangents", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int m = 0; m < 6; ++m) tangent(first + n, m) = m < 3 ? factor * stiffness(n, m) : 0;
      });
}

void add_spring_load(const Springs& springs, Real factor, const Field& prescribed, const Field& b) {
  if (!springs.any()) return;
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::spring_load", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          s.force(n, d) = factor * s.stiffness(n, d) * prescribed(n, d) - s.multiplier(n, d);
      });
  scatter(springs, 1, springs.force, b);
}

void choose_spring_stiffness(const Springs& springs, Real factor, Index covers, const Blocks& block,
                             bool compliant) {
  if (!springs.any()) return;
  const Springs s = springs;
  // A cover shares its diagonal (mean of x, y, z) among the points that it moves alone by their squared weights.
  device::for_each(
      "rockfold::solve::share_diagonal", static_cast<Index>(springs.row.extent(0)),
      KOKKOS_LAMBDA(const Index t) {
        const Index begin = s.row_begin(t), end = s.row_begin(t + 1), p = s.row(t);
        Real squares = 0;
        for (Index i = begin; i < end; ++i) {
          const Real w = s.row_weight(i);
          squares += w * w;
        }
        const Real mean = (block(p, 0) + block(p, 1) + block(p, 2)) / 3;
        for (Index i = begin; i < end; ++i) {
          const Real w = s.row_weight(i);
          s.share(s.row_entry(i)) = squares > 0 ? w * w / squares * mean : 0;
        }
      });
  device::for_each(
      "rockfold::solve::choose_stiffness", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        Real held = 0, yields = 0;  // N/m, m/N
        bool of_one_cover = true;
        for (Index i = s.points.begin(n); i < s.points.begin(n + 1); ++i) {
          const Index p = s.points.unknown(i);
          const Real w = s.points.weight(i), mean = (block(p, 0) + block(p, 1) + block(p, 2)) / 3;
          held += s.share(i);
          if (mean > 0) yields += w * w / mean;
          of_one_cover = of_one_cover && p % covers == s.points.unknown(s.points.begin(n)) % covers;
        }
        const Real wanted = (of_one_cover ? stiffness_alone : stiffness_shared) * held / factor;
        const Real resisted = yields > 0 ? stiffness_shared / (yields * factor) : 0;
        for (int d = 0; d < 3; ++d) {
          const Real given = s.given_stiffness(n, d);
          const bool augmented = s.augmented(n, d) > 0;
          const bool made_compliant = !augmented && compliant && !of_one_cover && resisted > 0 &&
                                      given > far_stiffer * resisted;
          s.stiffness(n, d) = augmented && wanted > given ? wanted
                              : made_compliant            ? resisted
                                                          : given;
          s.compliance(n, d) = made_compliant ? 1 / (factor * (given - resisted)) : 0;
          const bool eliminated = s.eliminated(n, d) > 0;
          s.by_multiplier(n, d) = !eliminated && (augmented || made_compliant) ? 1 : 0;
          if (s.by_multiplier(n, d) == 0 && !eliminated) s.multiplier(n, d) = 0;
        }
      });
}

Real multiplier_change(const Springs& springs, Real factor, const Field& x, const Field& prescribed,
                       const Field& change) {
  const Springs s = springs;
  return device::largest(
      "rockfold::solve::multiplier_change", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        Real worst = 0;
        for (int d = 0; d < 3; ++d) {
          change(n, d) = 0;
          if (!(s.by_multiplier(n, d) > 0)) continue;
          const Real gap = interpolate_one(s.points, n, d, x) - prescribed(n, d) -
                           s.compliance(n, d) * s.multiplier(n, d);
          change(n, d) = device::math::sqrt(factor * s.stiffness(n, d)) * gap;
          worst = device::math::fmax(worst, s.motion_ratio(n) * device::math::fabs(gap));
        }
        return worst;
      });
}

void scale_by_stiffness(const Springs& springs, Real factor, Real power, const Field& values) {
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::scale_by_stiffness", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d)
          if (s.by_multiplier(n, d) > 0)
            values(n, d) *= device::math::pow(factor * s.stiffness(n, d), power);
      });
}

void spring_reactions(const Springs& springs, Real factor, const Field& x, const Field& prescribed,
                      const Field& reaction) {
  const Springs s = springs;
  device::for_each(
      "rockfold::solve::reactions", points_of(springs), KOKKOS_LAMBDA(const Index n) {
        for (int d = 0; d < 3; ++d) {
          const Real gap = interpolate_one(s.points, n, d, x) - prescribed(n, d);
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
