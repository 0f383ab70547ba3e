#include <cstring>
#include <stdexcept>

#include "kernels/contact/contact_kernel.hpp"

namespace rockfold::contact {

namespace {

template <class T>
void copy(const Array<T>& from, Array<T>& to, const char* label, Index count) {
  device::grow(to, label, count);
  const std::pair<Index, Index> part(0, count);
  Kokkos::deep_copy(Kokkos::subview(to, part), Kokkos::subview(from, part));
}

void copy(const Field& from, Field& to) {
  if (to.extent(0) != from.extent(0))
    to = device::make_field("contact::kept", static_cast<Index>(from.extent(0)));
  Kokkos::deep_copy(to, from);
}

class Writer {
 public:
  template <class T>
  void value(const T& v) {
    const auto* from = reinterpret_cast<const std::byte*>(&v);
    bytes_.insert(bytes_.end(), from, from + sizeof v);
  }
  template <class T>
  void array(const Array<T>& a, Index count) {
    const auto host =
        device::to_host(Array<T>(Kokkos::subview(a, std::pair<Index, Index>(0, count))));
    value(count);
    for (const T& v : host) value(v);
  }
  void field(const Field& f) {
    for (const Vec3& v : device::copy_to_host(f)) value(v);
  }
  void set(const PointSet& s) {
    array(s.pairs.a, s.pairs.count);
    array(s.pairs.b, s.pairs.count);
    array(s.plane, s.pairs.count);
    array(s.point_begin, s.pairs.count + 1);
    array(s.point, s.count);
    field(s.found_at);
  }
  std::vector<std::byte> take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

class Reader {
 public:
  explicit Reader(std::span<const std::byte> bytes) : bytes_(bytes) {}

  template <class T>
  T value() {
    T v;
    if (bytes_.size() < sizeof v) throw std::invalid_argument("the bytes of contacts end early");
    std::memcpy(&v, bytes_.data(), sizeof v);
    bytes_ = bytes_.subspan(sizeof v);
    return v;
  }
  template <class T>
  Array<T> array(const char* label, Index& count) {
    count = value<Index>();
    if (count < 0 || bytes_.size() / sizeof(T) < static_cast<std::size_t>(count))
      throw std::invalid_argument("the bytes of contacts end early");
    std::vector<T> host(count);
    for (T& v : host) v = value<T>();
    return device::to_device(label, host);
  }
  void field(const Field& f) {
    std::vector<Vec3> host(f.extent(0));
    for (Vec3& v : host) v = value<Vec3>();
    device::copy_to_device(host, f);
  }
  PointSet set(Index vertices) {
    PointSet s;
    Index other = 0;
    s.pairs.a = array<Index>("contact::pair_a", s.pairs.count);
    s.pairs.b = array<Index>("contact::pair_b", other);
    s.plane = array<Plane>("contact::plane", other);
    s.point_begin = array<Index>("contact::point_begin", other);
    s.point = array<ContactPoint>("contact::point", s.count);
    s.found_at = device::make_field("contact::found_at", vertices);
    field(s.found_at);
    return s;
  }
  bool is_at_end() const { return bytes_.empty(); }

 private:
  std::span<const std::byte> bytes_;
};

}  // namespace

void copy(const PointSet& from, PointSet& to) {
  to.pairs = from.pairs;
  to.count = from.count;
  to.detection = from.detection;
  copy(from.plane, to.plane, "contact::plane", from.pairs.count);
  copy(from.point_begin, to.point_begin, "contact::point_begin", from.pairs.count + 1);
  copy(from.point, to.point, "contact::point", from.count);
  copy(from.found_at, to.found_at);
}

void keep(const DeviceContacts& c, Accepted& kept) {
  kept.started = c.started;
  if (!c.started) return;
  copy(c.before.x, kept.x);
  copy(c.speed_before, kept.speed);
  copy(c.sorted_at, kept.sorted_at);
  kept.candidates = c.candidates;
  copy(c.accepted, kept.points);
}

void restore(DeviceContacts& c, const Accepted& kept) {
  c.started = kept.started;
  c.detected = false;
  if (!c.started) return;
  copy(kept.speed, c.speed_before);
  copy(kept.sorted_at, c.sorted_at);
  c.candidates = kept.candidates;
  copy(kept.points, c.accepted);
  set_pose(c.surfaces, kept.x, c.before);
}

std::vector<std::byte> bytes(const DeviceContacts& c) {
  Writer out;
  out.value(c.surfaces.vertices);
  out.value(static_cast<Index>(c.started));
  out.array(c.met, static_cast<Index>(c.met.extent(0)));
  if (!c.started) return out.take();
  out.field(c.before.x);
  out.field(c.speed_before);
  out.field(c.sorted_at);
  out.array(c.candidates.a, c.candidates.count);
  out.array(c.candidates.b, c.candidates.count);
  out.set(c.accepted);
  return out.take();
}

void restore(DeviceContacts& c, std::span<const std::byte> from) {
  Reader in(from);
  if (in.value<Index>() != c.surfaces.vertices)
    throw std::invalid_argument("the bytes are those of other contacts");
  c.started = in.value<Index>() != 0;
  Index met = 0;
  c.met = in.array<std::uint8_t>("contact::met", met);
  c.detected = false;
  if (c.started) {
    in.field(c.before.x);
    in.field(c.speed_before);
    in.field(c.sorted_at);
    c.candidates.a = in.array<Index>("contact::pair_a", c.candidates.count);
    c.candidates.b = in.array<Index>("contact::pair_b", c.candidates.count);
    c.accepted = in.set(c.surfaces.vertices);
    c.accepted.detection = ++c.detections;
    set_pose(c.surfaces, c.before.x, c.before);
  }
  if (!in.is_at_end()) throw std::invalid_argument("the bytes are those of other contacts");
}

}  // namespace rockfold::contact
