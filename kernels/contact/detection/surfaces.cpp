#include <algorithm>
#include <limits>

#include "kernels/contact/detection/surfaces_kernel.hpp"
#include "src/base/vector.hpp"

namespace rockfold::contact {
namespace {

Vec3 area_vector(const SurfaceArrays& h, Index face) {
  using rockfold::operator-, rockfold::operator+=;
  const auto corner = [&](Index c) { return h.vertex[h.corner_vertex[c]]; };
  const Index begin = h.corner_begin[face];
  Vec3 sum{};
  for (Index c = begin + 1; c + 1 < h.corner_begin[face + 1]; ++c)
    sum += rockfold::cross(corner(c) - corner(begin), corner(c + 1) - corner(begin));
  return sum;
}

/// The vertices that bound a part; of a patch of a convex body's surface, with those of the faces that look another way.
std::vector<Index> vertices_about(const SurfaceArrays& h, Index part) {
  std::vector<Index> vertices(h.part_vertex.begin() + h.part_vertex_begin[part],
                              h.part_vertex.begin() + h.part_vertex_begin[part + 1]);
  if (h.part_far_begin.empty()) return vertices;
  for (Index i = h.part_far_begin[part]; i < h.part_far_begin[part + 1]; ++i) {
    const Index face = h.part_far_face[i];
    vertices.insert(vertices.end(), h.corner_vertex.begin() + h.corner_begin[face],
                    h.corner_vertex.begin() + h.corner_begin[face + 1]);
  }
  return vertices;
}

/// Surfaces::part_width.
std::vector<Real> widths(const SurfaceArrays& h) {
  std::vector<Real> width;
  for (Index p = 0; p < h.part_count(); ++p) {
    const std::vector<Index> vertices = vertices_about(h, p);
    Real least = std::numeric_limits<Real>::max();
    for (Index f = h.part_face_begin[p]; f < h.part_face_begin[p + 1]; ++f) {
      const Vec3 normal = area_vector(h, f);
      const Real area = rockfold::norm(normal);
      if (!(area > 0)) continue;
      Real low = std::numeric_limits<Real>::max(), high = -low;
      for (const Index v : vertices) {
        const Real along = rockfold::dot(normal, h.vertex[v]) / area;
        low = std::min(low, along);
        high = std::max(high, along);
      }
      least = std::min(least, high - low);
    }
    width.push_back(least);
  }
  return width;
}

}  // namespace

Surfaces upload(const SurfaceArrays& h) {
  using device::to_device;
  Surfaces s;
  s.parts = h.part_count();
  s.vertices = h.vertex_count();
  s.faces = h.face_count();
  s.shown_faces = h.part_face_begin.back();
  s.tolerance = h.tolerance;
  const std::vector<Real> width = widths(h);
  s.thinnest = width.empty() ? 0 : *std::min_element(width.begin(), width.end());
  s.part_width = to_device("contact::part_width", width);
  s.block_mass = to_device("contact::block_mass", h.block_mass);
  s.part_block = to_device("contact::part_block", h.part_block);
  s.part_vertex_begin = to_device("contact::part_vertex_begin", h.part_vertex_begin);
  s.part_vertex = to_device("contact::part_vertex", h.part_vertex);
  s.part_face_begin = to_device("contact::part_face_begin", h.part_face_begin);
  s.part_edge_begin = to_device("contact::part_edge_begin", h.part_edge_begin);
  s.part_far_begin =
      to_device("contact::part_far_begin",
                h.part_far_begin.empty() ? std::vector<Index>(s.parts + 1, 0) : h.part_far_begin);
  s.part_far_face = to_device("contact::part_far_face", h.part_far_face);
  s.corner_begin = to_device("contact::corner_begin", h.corner_begin);
  s.corner_vertex = to_device("contact::corner_vertex", h.corner_vertex);
  s.corner_side = to_device("contact::corner_side", h.corner_side);
  s.face_joint = to_device("contact::face_joint", h.face_joint);
  s.face_material = to_device("contact::face_material", h.face_material);
  s.face_centre =
      to_device("contact::face_centre",
                h.face_centre.empty() ? std::vector<Index>(s.faces, none) : h.face_centre);
  std::vector<Index> corner_face(h.corner_vertex.size());
  for (Index f = 0; f < s.faces; ++f)
    for (Index c = h.corner_begin[f]; c < h.corner_begin[f + 1]; ++c) corner_face[c] = f;
  s.corner_face = to_device("contact::corner_face", corner_face);
  s.edge_vertex = to_device("contact::edge_vertex", h.edge_vertex);
  s.edge_face = to_device("contact::edge_face", h.edge_face);
  s.edge_far = to_device("contact::edge_far", h.edge_far);
  return s;
}

Pose make_pose(const Surfaces& s) {
  return {device::make_field("contact::x", s.vertices),
          device::make_field("contact::normal", s.faces)};
}

void set_pose(const Surfaces& s, const Field& x, const Pose& pose) {
  if (x.data() != pose.x.data()) Kokkos::deep_copy(pose.x, x);
  device::for_each(
      "rockfold::contact::normals", s.faces,
      KOKKOS_LAMBDA(const Index f) {
        const Index begin = s.corner_begin(f);
        const Vector o = at(pose.x, s.corner_vertex(begin));
        Vector sum;
        Vector last = at(pose.x, s.corner_vertex(begin + 1)) - o;
        for (Index c = begin + 2; c < s.corner_begin(f + 1); ++c) {
          const Vector next = at(pose.x, s.corner_vertex(c)) - o;
          sum = sum + cross(last, next);
          last = next;
        }
        sum = unit(sum);
        pose.normal(f, 0) = sum.x;
        pose.normal(f, 1) = sum.y;
        pose.normal(f, 2) = sum.z;
      },
      8);
}

Real largest_length(const Field& field) {
  return device::largest(
      "rockfold::contact::largest_length", static_cast<Index>(field.extent(0)),
      KOKKOS_LAMBDA(const Index v) { return length(at(field, v)); });
}

Real largest_shift(const Field& one, const Field& two) {
  return device::largest(
      "rockfold::contact::shift", static_cast<Index>(one.extent(0)),
      KOKKOS_LAMBDA(const Index v) { return length(at(one, v) - at(two, v)); });
}

}  // namespace rockfold::contact
