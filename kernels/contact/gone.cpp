// Rock that is excavated on the way: its parts lose their pairs and points.
#include "kernels/contact/term_kernel.hpp"

namespace rockfold::contact {

namespace {

template <class T>
std::vector<T> first_of(const Array<T>& array, Index count) {
  return device::to_host(Array<T>(Kokkos::subview(array, std::pair<Index, Index>(0, count))));
}

/// Pairs of parts that are both still there, by their old places; `pairs` keeps them alone.
std::vector<Index> keep_pairs(const std::vector<std::uint8_t>& gone, Pairs& pairs) {
  const std::vector<Index> a = first_of(pairs.a, pairs.count), b = first_of(pairs.b, pairs.count);
  std::vector<Index> kept, kept_a, kept_b;
  for (Index i = 0; i < pairs.count; ++i) {
    if (gone[a[i]] != 0 || gone[b[i]] != 0) continue;
    kept.push_back(i);
    kept_a.push_back(a[i]);
    kept_b.push_back(b[i]);
  }
  pairs.count = static_cast<Index>(kept.size());
  pairs.a = device::to_device("contact::pair_a", kept_a);
  pairs.b = device::to_device("contact::pair_b", kept_b);
  return kept;
}

void keep_points(const std::vector<std::uint8_t>& gone, PointSet& set) {
  const std::vector<Plane> plane = first_of(set.plane, set.pairs.count);
  const std::vector<Index> begin = first_of(set.point_begin, set.pairs.count + 1);
  const std::vector<ContactPoint> point = first_of(set.point, set.count);
  std::vector<Plane> kept_plane;
  std::vector<Index> kept_begin{0};
  std::vector<ContactPoint> kept_point;
  for (const Index pair : keep_pairs(gone, set.pairs)) {
    kept_plane.push_back(plane[pair]);
    kept_point.insert(kept_point.end(), point.begin() + begin[pair],
                      point.begin() + begin[pair + 1]);
    kept_begin.push_back(static_cast<Index>(kept_point.size()));
  }
  set.plane = device::to_device("contact::plane", kept_plane);
  set.point_begin = device::to_device("contact::point_begin", kept_begin);
  set.point = device::to_device("contact::point", kept_point);
  set.count = static_cast<Index>(kept_point.size());
}

}  // namespace

void set_gone(const DeviceContacts& c, const std::vector<std::uint8_t>& block) {
  std::vector<std::uint8_t> part;
  for (const Index b : device::to_host(c.surfaces.part_block)) part.push_back(block[b]);
  Kokkos::deep_copy(c.broad.gone, device::to_device("contact::gone", part));
}

void forget_gone(DeviceContacts& c, const Field& x) {
  const std::vector<std::uint8_t> part = device::to_host(c.broad.gone);
  keep_pairs(part, c.candidates);
  keep_points(part, c.accepted);
  c.accepted.detection = ++c.detections;
  c.detected = false;
  set_pose(c.surfaces, x, c.before);
  const Surfaces s = c.surfaces;
  const auto gone = c.broad.gone;
  const Field speed = c.speed_before;
  device::for_each(
      "rockfold::contact::stop_gone", s.parts, KOKKOS_LAMBDA(const Index p) {
        if (gone(p) == 0) return;
        for (Index i = s.part_vertex_begin(p); i < s.part_vertex_begin(p + 1); ++i)
          for (int d = 0; d < 3; ++d) speed(s.part_vertex(i), d) = 0;
      });
}

void keep_wall_forces(ContactTerm& term) {
  const PointSet set = term.contacts.current;
  const auto gone = term.contacts.broad.gone;
  const Field force = term.force;
  device::for_each(
      "rockfold::contact::keep_wall_forces", set.pairs.count, KOKKOS_LAMBDA(const Index pair) {
        if (gone(set.pairs.a(pair)) != gone(set.pairs.b(pair))) return;
        for (Index c = set.point_begin(pair); c < set.point_begin(pair + 1); ++c)
          for (int d = 0; d < 3; ++d) force(c, d) = 0;
      });
}

}  // namespace rockfold::contact
