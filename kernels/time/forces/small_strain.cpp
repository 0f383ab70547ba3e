// Small strain: f = K d + f0, f0 that of the initial stress.
#include <cmath>
#include <limits>

#include "kernels/device/sums_kernel.hpp"
#include "kernels/time/forces/deformation_kernel.hpp"
#include "kernels/time/forces/initial_stress_kernel.hpp"
#include "kernels/time/forces/stress_kernel.hpp"

namespace rockfold::motion {
namespace {

constexpr solve::Combination stiffness_only{1, 0};

/// N/m: the largest entry on K's diagonal.
Real largest_stiffness(const solve::Operator& op) {
  const solve::Blocks block("rockfold::motion::stiffness_diagonal", op.unknowns);
  solve::diagonal_blocks(op, stiffness_only, block);
  return device::largest(
      "rockfold::motion::largest_stiffness", op.unknowns, KOKKOS_LAMBDA(const Index p) {
        return device::math::fmax(block(p, 0), device::math::fmax(block(p, 1), block(p, 2)));
      });
}

void find_middle(const Field& start, const Field& end, const Field& middle) {
  device::for_each(
      "rockfold::motion::middle", static_cast<Index>(middle.extent(0)),
      KOKKOS_LAMBDA(const Index p) {
        for (int i = 0; i < 3; ++i) middle(p, i) = 0.5 * (start(p, i) + end(p, i));
      });
}

class SmallStrain : public Deformation {
 public:
  SmallStrain(const MotionSetup& setup, const solve::ConstrainedSystem& system)
      : op_(system.op),
        sums_(system.work),
        elements_(solve::make_element_table(setup.covers, setup.moments, setup.materials)),
        before_(make_stress_before(setup)),
        work_(device::make_field("motion::small_strain", setup.covers.unknown_count())),
        stiffest_(largest_stiffness(system.op)) {
    if (setup.covers.sampled()) {
      sampled_ = std::make_unique<CoverArrays>(setup.covers);
      elements_.mean_slope = solve::sampled_mean_slopes(setup.covers);
    }
    if (!before_.any()) return;
    initial_ = device::make_field("motion::initial_force", setup.covers.unknown_count());
    device::copy_to_device(initial_stress_force(setup.covers, setup.moments, setup.initial_stress),
                           initial_);
  }

  bool linear() const override { return true; }
  void linearise(const Field& /*d*/) override {}

  void begin_step(const Field& d, const finite::ForceRule& rule) override {
    middle_ = rule.middle;
    if (!middle_) return;
    if (start_.extent(0) == 0) start_ = device::make_field("motion::start_of_step", op_.unknowns);
    Kokkos::deep_copy(start_, d);
  }

  void force(const Field& d, const Field& f) const override {
    if (middle_) find_middle(start_, d, work_);
    solve::apply(op_, stiffness_only, middle_ ? work_ : d, f);
    if (!before_.any()) return;
    const auto initial = initial_;
    device::for_each(
        "rockfold::motion::initial_force", static_cast<Index>(f.extent(0)),
        KOKKOS_LAMBDA(const Index p) {
          for (int i = 0; i < 3; ++i) f(p, i) += initial(p, i);
        });
  }

  void apply(const solve::Combination& c, const Field& x, const Field& y) const override {
    solve::apply(op_, c, x, y);
  }
  void diagonal(const solve::Combination& c, const solve::Blocks& d) const override {
    solve::diagonal_blocks(op_, c, d);
  }

  Real energy(const Field& d) const override {
    solve::apply(op_, stiffness_only, d, work_);
    Real sum = 0.5 * solve::dot(sums_, d, work_);
    if (before_.any()) sum += solve::dot(sums_, d, initial_);
    return sum;
  }

  Real rounding(const Field& d) const override {
    constexpr Real terms = 8;  // whose roundings add up in a row
    return terms * std::numeric_limits<Real>::epsilon() * stiffest_ *
           std::sqrt(solve::dot(sums_, d, d));
  }

  void element_stress(const Field& d, const Array<Real>& stress) const override {
    const solve::ElementTable table = elements_;
    const StressBefore before = before_;
    const bool any = before.any();
    device::for_each(
        "rockfold::motion::element_stress", table.count(), KOKKOS_LAMBDA(const Index e) {
          Real* s = &stress(6 * static_cast<std::size_t>(e));
          stress_of_element(table, d, e, s);
          if (any) add_stress_before(before, before.centroid_z(e), s);
        });
  }

  void point_stress(const Field& d, const TrackedPoints::Data& at) const override {
    const solve::ElementTable table = elements_;
    const StressBefore before = before_;
    const bool any = before.any();
    const auto element = at.element;
    const auto local = at.local;
    const auto stress = at.stress;
    const solve::PointSlopes slopes = sampled_slopes_at(sampled_.get(), at);
    device::for_each(
        "rockfold::motion::point_stress", at.points.count, KOKKOS_LAMBDA(const Index n) {
          Real* s = &stress(6 * static_cast<std::size_t>(n));
          const Real x[3] = {local(n, 0), local(n, 1), local(n, 2)};
          stress_at(table, d, element(n), x, slopes.at(n), s);
          if (any) add_stress_before(before, before.cell_z(element(n)) + x[2], s);
        });
  }

 private:
  solve::Operator op_;  // the same arrays as the system's
  solve::KrylovWork sums_;
  solve::ElementTable elements_;
  StressBefore before_;
  Field initial_;  // f0
  Field start_;    // of the step, where forces are taken in its middle
  bool middle_ = false;
  Field work_;
  std::unique_ptr<const CoverArrays> sampled_;  // where elements differ in their functions
  Real stiffest_;                               ///< N/m
};

}  // namespace

std::unique_ptr<Deformation> make_small_strain(const MotionSetup& setup,
                                               const solve::ConstrainedSystem& system) {
  return std::make_unique<SmallStrain>(setup, system);
}

}  // namespace rockfold::motion
