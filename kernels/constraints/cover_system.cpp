#include "kernels/constraints/cover_system.hpp"

#include "kernels/constraints/constrained_system_kernel.hpp"
#include "kernels/operator/cover_vector_kernel.hpp"

namespace rockfold {

using device::Field;

CoverVector::CoverVector(Index covers)
    : data_(new Data{device::make_field("solve::cover_vector", covers)}) {}
CoverVector::CoverVector(const std::vector<Vec3>& values)
    : CoverVector(static_cast<Index>(values.size())) {
  set(values);
}
CoverVector::~CoverVector() = default;
CoverVector::CoverVector(CoverVector&&) noexcept = default;
CoverVector& CoverVector::operator=(CoverVector&&) noexcept = default;
void CoverVector::set(const std::vector<Vec3>& values) {
  device::copy_to_device(values, data_->field);
}
std::vector<Vec3> CoverVector::get() const {
  return device::copy_to_host(data_->field);
}

struct CoverSystem::Data {
  solve::ConstrainedSystem system;
};

CoverSystem::CoverSystem(const CoverArrays& covers, const PieceMoments& moments,
                         const std::vector<ElasticMaterial>& materials, const FixedPoints& fixed,
                         Preconditioner preconditioner, const MakeDirectSolver& direct)
    : data_(new Data{
          solve::make_constrained_system(covers, solve::build_operator(covers, moments, materials),
                                         fixed, preconditioner, direct)}) {}
CoverSystem::~CoverSystem() = default;
CoverSystem::CoverSystem(CoverSystem&&) noexcept = default;
CoverSystem& CoverSystem::operator=(CoverSystem&&) noexcept = default;

Index CoverSystem::covers() const {
  return data_->system.op.covers;
}

Index CoverSystem::unknowns() const {
  return data_->system.op.unknowns;
}

OperatorSize CoverSystem::size() const {
  const auto& op = data_->system.op;
  return {op.stencil_covers, op.block_covers, op.neighbours, op.functions};
}

void CoverSystem::apply(const SystemCoefficients& c, const CoverVector& x, CoverVector& y) const {
  const auto& system = data_->system;
  solve::apply(system.op, {c.stiffness, c.mass}, x.data().field, y.data().field);
  solve::apply_springs(system.springs, system.springs.stiffness, c.springs, x.data().field,
                       y.data().field);
  Kokkos::fence();
}

std::vector<Vec3> CoverSystem::apply(const SystemCoefficients& c,
                                     const std::vector<Vec3>& x) const {
  CoverVector in(x), out(unknowns());
  apply(c, in, out);
  return out.get();
}

void CoverSystem::set_contacts(const MaterialPoints& points, const std::vector<Mat3>& tangent) {
  auto& system = data_->system;
  system.contacts = solve::make_point_terms(points, system.op.unknowns);
  const auto host = Kokkos::create_mirror_view(system.contacts.tangent);
  for (std::size_t n = 0; n < tangent.size(); ++n)
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) host(n, solve::symmetric_entry(i, j)) = tangent[n][i][j];
  Kokkos::deep_copy(system.contacts.tangent, host);
  system.has_contacts = true;
  solve::contacts_changed(system);
}

SolveReport CoverSystem::solve(const SystemCoefficients& c, const std::vector<Vec3>& b,
                               std::vector<Vec3>& x, const SolveOptions& options) {
  CoverVector load(b), result(x);
  auto& system = data_->system;
  solve::set_combination(system, {c.stiffness, c.mass}, c.springs);
  solve::ConstraintOptions how;
  how.pcg.tolerance = options.tolerance;
  how.pcg.max_iterations = options.max_iterations;
  const SolveReport report = solve::solve_constrained(
      system, load.data().field, system.springs.target, result.data().field, Field(), how);
  x = result.get();
  return report;
}

std::vector<Vec3> CoverSystem::reactions(const std::vector<Vec3>& x) const {
  const auto& springs = data_->system.springs;
  CoverVector motion(x), force(springs.points.count);
  if (springs.any())
    solve::spring_reactions(springs, motion.data().field, springs.target, force.data().field);
  return data_->system.shares.share_out(force.get());
}

}  // namespace rockfold
