#include "tests/reference/convex_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "src/base/vector.hpp"

namespace rockfold::reference {

namespace {

using Polygon = std::vector<Vec3>;

Vec3 times(const Mat3& m, const Vec3& x) {
  return {dot(m[0], x), dot(m[1], x), dot(m[2], x)};
}

Vec3 normal_of(const ConvexBody& b, const std::vector<Index>& face) {
  Vec3 sum{};
  for (std::size_t i = 1; i + 1 < face.size(); ++i)
    sum += cross(b.vertex[face[i]] - b.vertex[face[0]], b.vertex[face[i + 1]] - b.vertex[face[0]]);
  return normalized(sum);
}

Real highest(const ConvexBody& b, const Vec3& n) {
  Real most = -std::numeric_limits<Real>::infinity();
  for (const Vec3& x : b.vertex) most = std::max(most, dot(n, x));
  return most;
}

/// The part of a polygon on the positive side of a plane (Sutherland & Hodgman).
Polygon keep_above(const Polygon& polygon, const Vec3& n, Real offset) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Real hp = dot(n, p) - offset, hq = dot(n, q) - offset;
    if (hp >= 0) out.push_back(p);
    if ((hp < 0) != (hq < 0)) out.push_back(p + (hp / (hp - hq)) * (q - p));
  }
  return out;
}

/// A linear function's integral and that of its square over a triangle, from its corner values.
void add_triangle(Real area, Real f, Real g, Real h, Shadow& to) {
  to.area += area;
  to.gap += area * (f + g + h) / 3;
  to.squared += area / 6 * (f * f + g * g + h * h + f * g + g * h + h * f);
}

void add_faces(const ConvexBody& a, const std::vector<Index>& fa, const ConvexBody& b,
               const std::vector<Index>& fb, const Vec3& n, Shadow& to) {
  const Vec3 na = normal_of(a, fa), nb = normal_of(b, fb);
  if (dot(na, n) > -1e-6 || dot(nb, n) < 1e-6) return;
  Polygon polygon;  // of a, cut by upright planes over b's sides
  for (const Index v : fa) polygon.push_back(a.vertex[v]);
  for (std::size_t i = 0; i < fb.size() && polygon.size() > 2; ++i) {
    const Vec3 &p = b.vertex[fb[i]], &q = b.vertex[fb[(i + 1) % fb.size()]];
    const Vec3 inward = cross(n, q - p);
    polygon = keep_above(polygon, inward, dot(inward, p));
  }
  if (polygon.size() < 3) return;
  const auto gap = [&](const Vec3& x) {  // down to b's plane along n
    return dot(nb, x - b.vertex[fb[0]]) / dot(nb, n);
  };
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Real area = -0.5 * dot(n, cross(polygon[i] - polygon[0], polygon[i + 1] - polygon[0]));
    add_triangle(area, gap(polygon[0]), gap(polygon[i]), gap(polygon[i + 1]), to);
  }
}

}  // namespace

ConvexBody box_body(const Vec3& low, const Vec3& high) {
  ConvexBody b;
  for (int i = 0; i < 8; ++i)
    b.vertex.push_back(
        {i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]});
  b.face = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return b;
}

ConvexBody prism_body(int n, Real radius, Real height) {
  ConvexBody b;
  std::vector<Index> bottom, top;
  for (int i = 0; i < n; ++i) {
    const Real t = 2 * std::acos(-1.0) * i / n;
    b.vertex.push_back({radius * std::cos(t), radius * std::sin(t), -height / 2});
    b.vertex.push_back({radius * std::cos(t), radius * std::sin(t), height / 2});
    bottom.insert(bottom.begin(), 2 * i);
    top.push_back(2 * i + 1);
    const int j = (i + 1) % n;
    b.face.push_back({2 * i, 2 * j, 2 * j + 1, 2 * i + 1});
  }
  b.face.push_back(bottom);
  b.face.push_back(top);
  return b;
}

ConvexBody tetrahedron_body(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  ConvexBody t{{a, b, c, d}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  if (dot(cross(b - a, c - a), d - a) < 0) std::swap(t.vertex[0], t.vertex[1]);
  return t;
}

ConvexBody hull_body(const std::vector<Vec3>& points) {
  ConvexBody b;
  b.vertex = points;
  const auto n = static_cast<Index>(points.size());
  std::vector<bool> used(n, false);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      for (Index k = 0; k < n; ++k) {
        if (i >= j || i >= k || j == k) continue;  // each triangle once in either sense
        const Vec3 m = cross(points[j] - points[i], points[k] - points[i]);
        bool outside = false;
        for (Index l = 0; l < n; ++l)
          outside = outside || (l != i && l != j && l != k && dot(m, points[l] - points[i]) > 0);
        if (outside) continue;
        b.face.push_back({i, j, k});
        used[i] = used[j] = used[k] = true;
      }
  std::vector<Index> number(n, none);  // without the points inside
  b.vertex.clear();
  for (Index i = 0; i < n; ++i)
    if (used[i]) {
      number[i] = static_cast<Index>(b.vertex.size());
      b.vertex.push_back(points[i]);
    }
  for (auto& f : b.face)
    for (Index& v : f) v = number[v];
  return b;
}

Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<Real> normal;
  return normalized({normal(random), normal(random), normal(random)});
}

ConvexBody random_body(std::mt19937& random, Real size) {
  std::uniform_real_distribution<Real> unit(0, 1);
  ConvexBody b;
  const Real kind = unit(random);
  if (kind < 0.3) {
    const Vec3 half{size * (0.3 + unit(random)), size * (0.3 + unit(random)),
                    size * (0.3 + unit(random))};
    b = box_body(-half, half);
  } else if (kind < 0.6) {
    b = prism_body(3 + static_cast<int>(5 * unit(random)), size * (0.4 + unit(random)),
                   size * (0.4 + 2 * unit(random)));
  } else {
    std::vector<Vec3> points(kind < 0.8 ? 4 : 9);
    for (Vec3& p : points) p = size * (0.7 + 0.6 * unit(random)) * random_direction(random);
    b = kind < 0.8 ? tetrahedron_body(points[0], points[1], points[2], points[3])
                   : hull_body(points);
  }
  move(b, turn(random_direction(random), 6 * unit(random)), {}, {});
  return b;
}

Mat3 turn(const Vec3& n, Real angle) {
  const Real c = std::cos(angle), s = std::sin(angle);
  Mat3 r{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r[i][j] = (1 - c) * n[i] * n[j] + (i == j ? c : 0);
  r[0][1] -= s * n[2], r[1][0] += s * n[2];
  r[1][2] -= s * n[0], r[2][1] += s * n[0];
  r[2][0] -= s * n[1], r[0][2] += s * n[1];
  return r;
}

void move(ConvexBody& body, const Mat3& by, const Vec3& about, const Vec3& along) {
  for (Vec3& x : body.vertex) x = times(by, x - about) + about + along;
}

void shift(ConvexBody& body, const Vec3& by) {
  for (Vec3& x : body.vertex) x += by;
}

SurfaceArrays surfaces_of(const std::vector<ConvexBody>& bodies,
                          const std::vector<std::vector<Index>>& joint) {
  SurfaceArrays s;
  s.tolerance = 1e-9;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Index first = s.vertex_count();
    s.block_mass.push_back(1000);
    s.part_block.push_back(static_cast<Index>(b));
    for (const Vec3& x : bodies[b].vertex) {
      s.part_vertex.push_back(s.vertex_count());
      s.vertex.push_back(x);
      s.vertex_block.push_back(static_cast<Index>(b));
    }
    for (std::size_t f = 0; f < bodies[b].face.size(); ++f) {
      for (const Index v : bodies[b].face[f]) s.corner_vertex.push_back(first + v);
      s.corner_begin.push_back(static_cast<Index>(s.corner_vertex.size()));
      s.face_joint.push_back(joint.empty() ? none : joint[b][f]);
      s.face_material.push_back(s.face_joint.back() == none ? none : 0);
    }
    s.part_vertex_begin.push_back(static_cast<Index>(s.part_vertex.size()));
    s.part_face_begin.push_back(s.face_count());
  }
  find_edges(s);
  return s;
}

std::vector<Vec3> places_of(const std::vector<ConvexBody>& bodies) {
  std::vector<Vec3> all;
  for (const ConvexBody& b : bodies) all.insert(all.end(), b.vertex.begin(), b.vertex.end());
  return all;
}

Separation separation(const ConvexBody& a, const ConvexBody& b) {
  Separation best{-std::numeric_limits<Real>::infinity(), {}};
  const auto attempt = [&](const Vec3& n) {
    const Real gap = -highest(a, -n) - highest(b, n);
    if (gap > best.gap) best = {gap, n};
  };
  for (const auto& f : a.face) attempt(-normal_of(a, f));
  for (const auto& f : b.face) attempt(normal_of(b, f));
  for (const auto& fa : a.face)
    for (std::size_t i = 0; i < fa.size(); ++i)
      for (const auto& fb : b.face)
        for (std::size_t j = 0; j < fb.size(); ++j) {
          // each edge once: the other face has it in the other sense
          if (fa[i] > fa[(i + 1) % fa.size()] || fb[j] > fb[(j + 1) % fb.size()]) continue;
          const Vec3 ea = a.vertex[fa[(i + 1) % fa.size()]] - a.vertex[fa[i]];
          const Vec3 eb = b.vertex[fb[(j + 1) % fb.size()]] - b.vertex[fb[j]];
          const Vec3 n = cross(ea, eb);
          if (norm(n) < 1e-9 * norm(ea) * norm(eb)) continue;
          attempt(normalized(n));
          attempt(-normalized(n));
        }
  return best;
}

Shadow shadow(const ConvexBody& a, const ConvexBody& b, const Vec3& n) {
  Shadow s;
  for (const auto& fa : a.face)
    for (const auto& fb : b.face) add_faces(a, fa, b, fb, n, s);
  return s;
}

}  // namespace rockfold::reference
