#include "kernels/time/forces/stress_kernel.hpp"
#include "kernels/time/motion_kernel.hpp"

namespace rockfold {
namespace motion {

namespace {

using Stresses = std::vector<std::array<Real, 6>>;

Stresses fetch(const Array<Real>& flat) {
  Stresses result(flat.extent(0) / 6);
  Kokkos::deep_copy(
      device::Unmanaged<Real>(result.empty() ? nullptr : result.front().data(), flat.extent(0)),
      flat);
  return result;
}

device::Field upload_local(const MaterialPoints& points) {
  auto field = device::make_field("motion::local", static_cast<Index>(points.size()));
  device::copy_to_device(points.local, field);
  return field;
}

}  // namespace
}  // namespace motion

TrackedPoints::TrackedPoints(const MaterialPoints& points)
    : data_(new Data{solve::upload(points), device::to_device("motion::element", points.element),
                     motion::upload_local(points),
                     device::make_field("motion::value", static_cast<Index>(points.size())),
                     device::allocate<Real>("motion::stress", 6 * points.size())}) {}
TrackedPoints::~TrackedPoints() = default;
TrackedPoints::TrackedPoints(TrackedPoints&&) noexcept = default;
TrackedPoints& TrackedPoints::operator=(TrackedPoints&&) noexcept = default;

PointMotion Motion::at(const TrackedPoints& points) const {
  const auto& now = data_->now;
  const auto& at = points.data();
  auto value = [&](const device::Field& field) {
    solve::interpolate(at.points, field, at.value);
    return device::copy_to_host(at.value);
  };
  PointMotion motion{value(now.displacement), value(now.velocity), value(now.acceleration), {}};
  data_->rock->point_stress(now.displacement, at);
  motion.stress = motion::fetch(at.stress);
  return motion;
}

std::vector<std::array<Real, 6>> Motion::stress_at(const std::vector<Index>& element,
                                                   const std::vector<Vec3>& local) const {
  MaterialPoints points;
  points.element = element;
  points.local = local;
  points.begin.assign(element.size() + 1, 0);  // their displacement is not asked for
  const TrackedPoints at(points);
  data_->rock->point_stress(data_->now.displacement, at.data());
  return motion::fetch(at.data().stress);
}

std::vector<std::array<Real, 6>> Motion::element_stress() const {
  const auto stress = device::allocate<Real>("motion::element_stress",
                                             6 * static_cast<std::size_t>(data_->elements));
  data_->rock->element_stress(data_->now.displacement, stress);
  motion::Stresses result = motion::fetch(stress);
  for (std::size_t e = 0; e < data_->gone_element.size(); ++e)
    if (data_->gone_element[e] != 0) result[e] = {};
  return result;
}

}  // namespace rockfold
