#include "tests/cover/plain_clipping.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold::test {

Real Polyhedron::volume() const {
  if (empty()) return 0;
  const Vec3 o = face[0][0];
  Real six = 0;
  for (const auto& f : face)
    for (std::size_t k = 1; k + 1 < f.size(); ++k)
      six += dot(f[0] - o, cross(f[k] - o, f[k + 1] - o));
  return six / 6;
}

std::vector<Vec3> Polyhedron::corners() const {
  std::vector<Vec3> all;
  for (const auto& f : face) all.insert(all.end(), f.begin(), f.end());
  return all;
}

Polyhedron part_of(const Lattice& lattice, Index cell, int part) {
  const CellPart& p = lattice.split(cell).part[part];
  std::vector<Vec3> x;
  for (int a = 0; a < p.nodes; ++a)
    x.push_back(lattice.node_position(lattice.cell_node(cell, p.node[a])));
  if (p.nodes == 8)
    return {{{x[0], x[4], x[6], x[2]},
             {x[1], x[3], x[7], x[5]},
             {x[0], x[1], x[5], x[4]},
             {x[2], x[6], x[7], x[3]},
             {x[0], x[2], x[3], x[1]},
             {x[4], x[5], x[7], x[6]}}};
  return {{{x[1], x[2], x[3]}, {x[0], x[3], x[2]}, {x[0], x[1], x[3]}, {x[0], x[2], x[1]}}};
}

namespace {

// The corners of the section in order about their middle, seen against the normal of what is cut away.
std::vector<Vec3> section(std::vector<Vec3> x, const Vec3& normal) {
  Vec3 middle{};
  for (const Vec3& p : x) middle += (1.0 / static_cast<Real>(x.size())) * p;
  Vec3 u = x[0] - middle;
  for (const Vec3& p : x)
    if (norm(p - middle) > norm(u)) u = p - middle;
  const Vec3 v = cross(normal, u);
  const auto angle = [&](const Vec3& p) {
    return std::atan2(dot(p - middle, v), dot(p - middle, u));
  };
  std::sort(x.begin(), x.end(), [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
  std::vector<Vec3> loop;
  for (const Vec3& p : x)
    if (loop.empty() || norm(p - loop.back()) > 1e-11) loop.push_back(p);
  while (loop.size() > 1 && norm(loop.back() - loop.front()) <= 1e-11) loop.pop_back();
  return loop;
}

}  // namespace

Polyhedron clip(const Polyhedron& polyhedron, const HalfSpace& h, Real slack) {
  const auto distance = [&](const Vec3& x) {
    const Real d = (dot(h.normal, x) - h.offset) / norm(h.normal);
    return std::abs(d) <= slack ? 0 : d;
  };
  bool outside = false, inside = false;
  for (const Vec3& x : polyhedron.corners()) outside |= distance(x) > 0, inside |= distance(x) < 0;
  if (!inside) return {};
  if (!outside) return polyhedron;
  Polyhedron result;
  std::vector<Vec3> cut;
  for (const auto& f : polyhedron.face) {
    std::vector<Vec3> kept;
    for (std::size_t k = 0; k < f.size(); ++k) {
      const Vec3 &a = f[k], &b = f[(k + 1) % f.size()];
      const Real da = distance(a), db = distance(b);
      if (da <= 0) kept.push_back(a);
      if (da == 0) cut.push_back(a);
      if (da * db < 0) {
        const Vec3 x = a + (da / (da - db)) * (b - a);
        kept.push_back(x);
        cut.push_back(x);
      }
    }
    if (std::any_of(f.begin(), f.end(), [&](const Vec3& x) { return distance(x) < 0; }))
      result.face.push_back(kept);
  }
  const auto cap = section(cut, h.normal);
  if (cap.size() >= 3) result.face.push_back(cap);
  return result;
}

Polyhedron clip(Polyhedron polyhedron, const std::vector<HalfSpace>& inside) {
  for (const HalfSpace& h : inside) {
    if (polyhedron.empty()) return {};
    polyhedron = clip(polyhedron, h);
  }
  return polyhedron;
}

}  // namespace rockfold::test
