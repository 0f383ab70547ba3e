// Blocks built by hand for the tests of measures.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

constexpr Mat3 identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// A rotation whose rows are no axes.
inline Mat3 oblique() {
  const Vec3 x = normalized({2, -1, 0.7}), z = normalized(cross(x, {0.3, 1, 0.2}));
  return {x, cross(z, x), z};
}

inline Vec3 turned(const Mat3& m, const Vec3& x) {
  return x[0] * m[0] + x[1] * m[1] + x[2] * m[2];
}

/// Adds a block of one shell whose faces have one loop each (corners from 0, seen from outside).
inline void add_block(BlockArrays& out, const std::vector<Vec3>& points,
                      const std::vector<std::vector<Index>>& faces) {
  if (out.face_begin.empty())
    out.face_begin = out.vertex_begin = out.loop_begin = out.corner_begin = {0};
  const Index shift = out.vertex_begin.back();
  Real volume = 0;
  Vec3 centroid{};
  for (const auto& face : faces) {
    Vec3 area{};
    for (std::size_t i = 1; i + 1 < face.size(); ++i) {
      const Vec3 &p = points[face[0]], &q = points[face[i]], &r = points[face[i + 1]];
      area += 0.5 * cross(q - p, r - p);
      const Real v = dot(p - points[0], cross(q - points[0], r - points[0])) / 6;
      volume += v;
      centroid += (v / 4) * (points[0] + p + q + r);
    }
    for (const Index v : face) out.corner_vertex.push_back(shift + v);
    out.corner_begin.push_back(static_cast<Index>(out.corner_vertex.size()));
    out.loop_begin.push_back(static_cast<Index>(out.corner_begin.size()) - 1);
    out.face_area.push_back(norm(area));
    out.face_normal.push_back(normalized(area));
    out.face_origin.push_back(0);
    out.face_up.push_back(1);
    out.face_plane.push_back(static_cast<Index>(out.face_plane.size()));
  }
  out.vertex.insert(out.vertex.end(), points.begin(), points.end());
  out.vertex_begin.push_back(static_cast<Index>(out.vertex.size()));
  out.face_begin.push_back(static_cast<Index>(out.face_area.size()));
  out.volume.push_back(volume);
  out.centroid.push_back((1 / volume) * centroid);
  out.edge_count.push_back(static_cast<Index>(points.size() + faces.size()) - 2);
  out.shell_count.push_back(1);
  out.genus.push_back(0);
  out.convex.push_back(1);
  out.finite.push_back(1);
  out.material.push_back(none);
}

inline void add_box(BlockArrays& out, const Vec3& size, const Mat3& rotation, const Vec3& at) {
  std::vector<Vec3> points;
  for (int c = 0; c < 8; ++c)
    points.push_back(
        at + turned(rotation, {(c & 1) * size[0], (c >> 1 & 1) * size[1], (c >> 2) * size[2]}));
  add_block(out, points,
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
}

inline BlockArrays box_block(const Vec3& size, const Mat3& rotation, const Vec3& at) {
  BlockArrays out;
  add_box(out, size, rotation, at);
  return out;
}

/// Cubes of given volumes, exactly these.
inline BlockArrays cubes(const std::vector<Real>& volume) {
  BlockArrays out;
  for (const Real v : volume) {
    const Real edge = std::cbrt(v);
    add_box(out, {edge, edge, edge}, identity, {10.0 * static_cast<Real>(out.volume.size()), 0, 0});
    out.volume.back() = v;
  }
  return out;
}

/// A prism over a regular polygon of n corners.
inline BlockArrays prism_block(Index n, Real radius, Real height) {
  std::vector<Vec3> points;
  std::vector<std::vector<Index>> faces(2);
  for (const Real z : {0.0, height})
    for (Index i = 0; i < n; ++i) {
      const Real angle = 2 * std::numbers::pi * i / n;
      points.push_back({radius * std::cos(angle), radius * std::sin(angle), z});
    }
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    faces[0].push_back(n - 1 - i);
    faces[1].push_back(n + i);
    faces.push_back({i, next, n + next, n + i});
  }
  BlockArrays out;
  add_block(out, points, faces);
  return out;
}

}  // namespace rockfold::test
