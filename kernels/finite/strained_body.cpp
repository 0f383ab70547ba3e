#include "kernels/finite/strained_body.hpp"

#include "kernels/device/sums_kernel.hpp"
#include "kernels/finite/deformation_kernel.hpp"
#include "kernels/integrate/moments.hpp"

namespace rockfold {

struct StrainedBody::Data {
  finite::Deformation body;
  device::Field field;
  device::Array<Real> partial, sums;
};

StrainedBody::StrainedBody(const CoverArrays& covers, const std::vector<ElasticMaterial>& materials,
                           const InitialStress& initial)
    : data_(new Data{
          finite::make_deformation(covers, piece_moments(covers), materials, initial),
          device::make_field("finite::field", covers.unknown_count()),
          device::allocate<Real>("finite::partial", device::chunk_count(covers.element_count())),
          device::Array<Real>("rockfold::finite::sums", 1)}) {}
StrainedBody::~StrainedBody() = default;
StrainedBody::StrainedBody(StrainedBody&&) noexcept = default;
StrainedBody& StrainedBody::operator=(StrainedBody&&) noexcept = default;

void StrainedBody::deform(const std::vector<Vec3>& displacement) {
  device::copy_to_device(displacement, data_->field);
  finite::deform(data_->body, data_->field);
}

void StrainedBody::keep() {
  finite::keep(data_->body);
}

std::vector<Vec3> StrainedBody::forces(bool middle, Real viscosity) const {
  finite::internal_forces(data_->body, {middle, viscosity}, data_->field);
  return device::copy_to_host(data_->field);
}

Real StrainedBody::strain_energy() const {
  return finite::strain_energy(data_->body, data_->partial, data_->sums);
}

std::vector<std::array<Real, 6>> StrainedBody::element_stress() const {
  const auto means =
      device::allocate<Real>("finite::stress", 6 * static_cast<std::size_t>(data_->body.elements));
  finite::mean_stress(data_->body, means);
  const std::vector<Real> flat = device::to_host(means);
  std::vector<std::array<Real, 6>> stress(flat.size() / 6);
  for (std::size_t i = 0; i < flat.size(); ++i) stress[i / 6][i % 6] = flat[i];
  return stress;
}

Real StrainedBody::volume() const {
  Real sum = 0;
  for (const Real w : device::to_host(data_->body.weight)) sum += w;
  return sum;
}

}  // namespace rockfold
