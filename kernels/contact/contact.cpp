#include "kernels/contact/contact.hpp"

#include <utility>

#include "kernels/contact/contact_kernel.hpp"

namespace rockfold {

namespace contact {

DeviceContacts make_contacts(const SurfaceArrays& surfaces, const ContactOptions& options) {
  DeviceContacts c;
  c.surfaces = upload(surfaces);
  c.options = options;
  c.laws = device::to_device("contact::laws", options.laws);
  const std::size_t laws = options.laws.size() + 1;
  c.law_of_pair =
      device::to_device("contact::law_of_pair", options.law_of_pair.empty()
                                                    ? std::vector<std::int16_t>(laws * laws, 0)
                                                    : options.law_of_pair);
  c.met = Array<std::uint8_t>("contact::met", c.law_of_pair.extent(0));
  c.before = make_pose(c.surfaces);
  c.now = make_pose(c.surfaces);
  c.speed_before = device::make_field("contact::speed_before", c.surfaces.vertices);
  c.sorted_at = device::make_field("contact::sorted_at", c.surfaces.vertices);
  for (PointSet* set : {&c.accepted, &c.current})
    set->found_at = device::make_field("contact::found_at", c.surfaces.vertices);
  c.broad = make_broad_phase(c.surfaces);
  c.total = device::allocate<Real>("contact::total", 4);
  return c;
}

namespace {

Index count_points(const PointSet& set, Contact state) {
  const auto point = set.point;
  Index n = 0;
  Kokkos::parallel_reduce(
      "rockfold::contact::count_points", device::Range(0, set.count),
      KOKKOS_LAMBDA(const Index i, Index& sum) { sum += point(i).memory.state == state ? 1 : 0; },
      n);
  return n;
}

Real largest_penetration(const PointSet& set, const Field& x) {
  const auto point = set.point;
  return device::largest(
      "rockfold::contact::largest_penetration", set.count, KOKKOS_LAMBDA(const Index i) {
        const ContactPoint& p = point(i);
        return -(dot(to_vector(p.normal), between(p, x)) + p.offset);
      });
}

}  // namespace

ContactCount count_states(const DeviceContacts& c) {
  const PointSet& set = c.detected ? c.current : c.accepted;
  const auto x = c.detected ? c.now.x : c.before.x;
  ContactCount count;
  count.open = count_points(set, Contact::open);
  count.stick = count_points(set, Contact::stick);
  count.slide = count_points(set, Contact::slide);
  count.largest_penetration = largest_penetration(set, x);
  return count;
}

std::vector<ContactPoint> points(const DeviceContacts& c) {
  const PointSet& set = c.detected ? c.current : c.accepted;
  std::vector<ContactPoint> all;
  if (set.count > 0) all = device::to_host(set.point);
  all.resize(set.count);
  return all;
}

std::vector<std::uint8_t> surfaces_that_met(const DeviceContacts& c) {
  return device::to_host(c.met);
}

}  // namespace contact

struct Contacts::Data {
  contact::DeviceContacts device;
};

namespace {

using device::Field;

Field to_field(const std::vector<Vec3>& host) {
  Field f = device::make_field("contact::given", static_cast<Index>(host.size()));
  device::copy_to_device(host, f);
  return f;
}

contact::Motion to_motion(const std::vector<Vec3>& x, const std::vector<Vec3>& v, Real dt,
                          Real speed_by_gap) {
  const Field place = to_field(x);
  return {place, v.empty() ? place : to_field(v), v.empty() ? 0 : speed_by_gap, dt};
}

}  // namespace

Contacts::Contacts(const SurfaceArrays& surfaces, const ContactOptions& options)
    : data_(new Data{contact::make_contacts(surfaces, options)}) {}
Contacts::~Contacts() = default;
Contacts::Contacts(Contacts&&) noexcept = default;
Contacts& Contacts::operator=(Contacts&&) noexcept = default;

DetectReport Contacts::detect(const std::vector<Vec3>& x) {
  return contact::detect(data_->device, to_field(x));
}

Contacts::Forces Contacts::evaluate(const std::vector<Vec3>& x, const std::vector<Vec3>& v, Real dt,
                                    Real speed_by_gap) const {
  const Index n = data_->device.current.count;
  const Field force = device::make_field("contact::force", n);
  const contact::Tangents tangent("rockfold::contact::tangent", n);
  Forces out;
  out.energy = contact::evaluate(data_->device, to_motion(x, v, dt, speed_by_gap), force, tangent);
  out.force = device::copy_to_host(force);
  const auto host = Kokkos::create_mirror_view(tangent);
  Kokkos::deep_copy(host, tangent);
  out.tangent.resize(n);
  for (Index c = 0; c < n; ++c)
    for (int k = 0; k < 9; ++k) out.tangent[c][k / 3][k % 3] = host(c, k);
  return out;
}

void Contacts::accept(const std::vector<Vec3>& x, const std::vector<Vec3>& v, Real dt,
                      Real speed_by_gap) {
  contact::accept(data_->device, to_motion(x, v, dt, speed_by_gap));
}

std::vector<ContactPoint> Contacts::points() const {
  return contact::points(data_->device);
}

ContactCount Contacts::count() const {
  return contact::count_states(data_->device);
}
std::vector<std::byte> Contacts::bytes() const {
  return contact::bytes(data_->device);
}
void Contacts::restore(std::span<const std::byte> from) {
  contact::restore(data_->device, from);
}

}  // namespace rockfold
