// Large kinematics: forces of finite strain (kernels/finite), their tangent in the rows of the operator.
#include "kernels/device/sums_kernel.hpp"
#include "kernels/finite/deformation_kernel.hpp"
#include "kernels/finite/strain_kernel.hpp"
#include "kernels/time/forces/deformation_kernel.hpp"
#include "kernels/time/forces/initial_stress_kernel.hpp"
#include "kernels/time/forces/stress_kernel.hpp"

namespace rockfold::motion {
namespace {

class FiniteStrain : public Deformation {
 public:
  FiniteStrain(const MotionSetup& setup, const solve::ConstrainedSystem& system)
      : op_(system.op),
        body_(finite::make_deformation(setup.covers, setup.moments, setup.materials,
                                       setup.initial_stress)),
        elements_(solve::make_element_table(setup.covers, setup.moments, setup.materials)),
        before_(make_stress_before(setup)),
        partial_(
            device::allocate<Real>("motion::strain_partial", device::chunk_count(body_.elements))),
        sums_("rockfold::motion::strain_sums", 1),
        rounding_(finite::rounding_force(body_, partial_, sums_)) {
    if (setup.covers.sampled()) sampled_ = std::make_unique<CoverArrays>(setup.covers);
  }

  bool linear() const override { return false; }

  void begin_step(const Field& d, const finite::ForceRule& rule) override {
    finite::deform(body_, d);
    finite::keep(body_);
    rule_ = rule;
    stiffened_ = 1;
  }
  void carry_rate(const Field& velocity, Real of_velocity, const Field& acceleration,
                  Real of_acceleration) override {
    finite::carry_rate(body_, velocity, of_velocity, acceleration, of_acceleration);
    rule_.carries = true;
  }
  void stiffen(const Array<Real>& viscosity, Real factor) override {
    rule_.stiffening = viscosity;
    rule_.of_stiffening = factor;
    const Real most = device::largest(
        "rockfold::motion::largest_viscosity", body_.elements,
        KOKKOS_LAMBDA(const Index e) { return viscosity(e); });
    stiffened_ = 1 + 2 * factor * most;
  }
  Real viscous_work(const Field& d, Real viscosity) const override {
    finite::deform(body_, d);
    return finite::viscous_work(body_, viscosity, rule_.stiffening, partial_, sums_);
  }
  void force(const Field& d, const Field& f) const override {
    finite::deform(body_, d);
    finite::internal_forces(body_, rule_, f);
  }
  void linearise(const Field& d) override {
    finite::deform(body_, d);
    finite::assemble_tangent(body_, rule_, op_.block);
  }
  void drop_geometric_stiffness() override {
    finite::ForceRule rule = rule_;
    rule.geometric = false;
    finite::assemble_tangent(body_, rule, op_.block);
  }
  void turn(const Field& x) const override {
    if (rule_.middle) finite::turn_from_middle(body_, x);
  }
  const finite::Deformation* finite_strain() const override { return &body_; }
  Index inverted(const Field& d, Real least) const override {
    finite::deform(body_, d);
    return finite::first_inverted(body_, least);
  }
  Real rounding(const Field& d) const override {
    return stiffened_ * rounding_ * finite::largest_terms(body_, d);
  }

  void apply(const solve::Combination& c, const Field& x, const Field& y) const override {
    solve::apply(op_, c, x, y);
  }
  void diagonal(const solve::Combination& c, const solve::Blocks& d) const override {
    solve::diagonal_blocks(op_, c, d);
  }
  Real energy(const Field& d) const override {
    finite::deform(body_, d);
    return finite::strain_energy(body_, partial_, sums_);
  }
  void element_stress(const Field& d, const Array<Real>& stress) const override {
    finite::deform(body_, d);
    finite::mean_stress(body_, stress);
  }
  void point_stress(const Field& d, const TrackedPoints::Data& at) const override {
    const solve::ElementTable table = elements_;
    const StressBefore before = before_;
    const auto element = at.element;
    const auto local = at.local;
    const auto stress = at.stress;
    const solve::PointSlopes slopes = sampled_slopes_at(sampled_.get(), at);
    device::for_each(
        "rockfold::motion::large_point_stress", at.points.count, KOKKOS_LAMBDA(const Index n) {
          const Index e = element(n);
          const Real x[3] = {local(n, 0), local(n, 1), local(n, 2)};
          Real h[3][3], strain[6], s[6] = {0, 0, 0, 0, 0, 0};
          gradient_at(table, d, e, x, slopes.at(n), h);
          finite::green_strain(&h[0][0], strain);
          finite::add_elastic_stress(table.elastic(table.material(e)), 1, strain, s);
          if (before.any()) add_stress_before(before, before.cell_z(e) + x[2], s);
          finite::cauchy_stress(&h[0][0], s, &stress(6 * static_cast<std::size_t>(n)));
        });
  }

 private:
  solve::Operator op_;  // the same arrays as the system's
  finite::Deformation body_;
  finite::ForceRule rule_;
  solve::ElementTable elements_;
  StressBefore before_;
  Array<Real> partial_, sums_;
  Real rounding_;       ///< N, at terms of H of size 1
  Real stiffened_ = 1;  ///< of the rock's stiffness, the most that an element of this step has
  std::unique_ptr<const CoverArrays> sampled_;  // where elements differ in their functions
};

}  // namespace

std::unique_ptr<Deformation> make_finite_strain(const MotionSetup& setup,
                                                const solve::ConstrainedSystem& system) {
  return std::make_unique<FiniteStrain>(setup, system);
}

}  // namespace rockfold::motion
