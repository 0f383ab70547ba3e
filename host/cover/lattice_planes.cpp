#include "host/cover/lattice_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/exact/plane_exact.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// In units of the spacing; only adds lattice cells that turn out empty.
constexpr Real slack = 1e-7;

std::array<int, 3> corner_ijk(int corner) {
  return {corner & 1, corner >> 1 & 1, corner >> 2 & 1};
}

int dot(const std::array<int, 3>& a, const std::array<int, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

}  // namespace

LatticePlanes::LatticePlanes(const CoverSpec& cover, const std::vector<Vec3>& bounds,
                             PlaneTable& planes)
    : spacing_(cover.spacing),
      node_(cover.origin.value_or(planes.centre())),
      centre_(planes.centre()) {
  for (int d = 0; d < 3; ++d) normal_[d] = upward_normal(cover.directions[2 - d]);
  // Right-handed, whatever the order in which the families are given.
  if (rockfold::dot(cross(normal_[0], normal_[1]), normal_[2]) < 0) normal_[2] = -normal_[2];

  Vec3 low = coordinates(bounds.front()), high = low;
  for (const Vec3& x : bounds) {
    const Vec3 xi = coordinates(x);
    for (int d = 0; d < 3; ++d)
      low[d] = std::min(low[d], xi[d]), high[d] = std::max(high[d], xi[d]);
  }
  Real nodes = 1;
  for (int d = 0; d < 3; ++d) nodes *= std::ceil(high[d] + slack) - std::floor(low[d] - slack) + 1;
  if (nodes > std::numeric_limits<Index>::max() || std::max({norm(low), norm(high)}) > 1e9)
    throw Error(ErrorKind::model,
                fmt::format("found {} m, which makes {:.3g} lattice nodes; use a larger spacing "
                            "(at most 2.1e9 nodes)",
                            spacing_, nodes),
                Place{cover.place.file, cover.place.line, cover.place.column, "cover.spacing"});
  for (int d = 0; d < 3; ++d) {
    first_[d] = static_cast<Index>(std::floor(low[d] - slack));
    lattice_.cells[d] = static_cast<Index>(std::ceil(high[d] + slack)) - first_[d];
    lattice_.edge[d] = spacing_ * normal_[d];
  }
  lattice_.origin = node_;
  for (int d = 0; d < 3; ++d) lattice_.origin += static_cast<Real>(first_[d]) * lattice_.edge[d];
  find_facets();
  add_planes(planes);
}

// Lattice coordinates, counted from the given origin, of a point relative to the table's centre.
Vec3 LatticePlanes::coordinates(const Vec3& x) const {
  const Vec3 r = x + (centre_ - node_);
  Vec3 xi;
  for (int d = 0; d < 3; ++d) xi[d] = rockfold::dot(normal_[d], r) / spacing_;
  return xi;
}

LatticeBox LatticePlanes::range(std::span<const Vertex> vertices) const {
  Vec3 low = coordinates(vertices.front().x), high = low;
  for (const Vertex& v : vertices) {
    const Vec3 xi = coordinates(v.x);
    for (int d = 0; d < 3; ++d)
      low[d] = std::min(low[d], xi[d]), high[d] = std::max(high[d], xi[d]);
  }
  LatticeBox box;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = std::max<Index>(0, static_cast<Index>(std::floor(low[d] - slack)) - first_[d]);
    box.high[d] =
        std::min(lattice_.cells[d], static_cast<Index>(std::ceil(high[d] + slack)) - first_[d]);
  }
  return box;
}

HalfSpaceId LatticePlanes::facet(const std::array<Index, 3>& cell, int t, int a) const {
  const FacetPlane& f = facet_[t][a];
  const Family& family = families_[f.family];
  const Index value =
      family.c[0] * cell[0] + family.c[1] * cell[1] + family.c[2] * cell[2] + f.offset;
  const HalfSpaceId upper = family.upper[value - family.first];
  return f.above ? upper : upper ^ 1;
}

int LatticePlanes::family_of(const std::array<int, 3>& c) {
  for (std::size_t f = 0; f < families_.size(); ++f)
    if (families_[f].c == c) return static_cast<int>(f);
  families_.push_back({c, 0, {}});
  return static_cast<int>(families_.size()) - 1;
}

void LatticePlanes::find_facets() {
  families_ = {{{1, 0, 0}, 0, {}}, {{0, 1, 0}, 0, {}}, {{0, 0, 1}, 0, {}}};
  for (int t = 0; t < 6; ++t)
    for (int a = 0; a < 4; ++a) {
      std::array<int, 3> p[3];
      for (int i = 0, k = 0; i < 4; ++i)
        if (i != a) p[k++] = corner_ijk(tet6_corner[t][i]);
      std::array<int, 3> u, v;
      for (int d = 0; d < 3; ++d) u[d] = p[1][d] - p[0][d], v[d] = p[2][d] - p[0][d];
      std::array<int, 3> c{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                           u[0] * v[1] - u[1] * v[0]};
      const int divisor = std::gcd(std::gcd(c[0], c[1]), c[2]);
      const int first_nonzero = c[0] != 0 ? c[0] : c[1] != 0 ? c[1] : c[2];
      for (int& x : c) x /= first_nonzero < 0 ? -divisor : divisor;
      const int value = dot(c, p[0]);
      facet_[t][a] = {family_of(c), value, dot(c, corner_ijk(tet6_corner[t][a])) > value};
    }
}

void LatticePlanes::add_planes(PlaneTable& planes) {
  const ExactVec3 node = exact(node_);
  std::array<ExactVec3, 3> m;
  for (int d = 0; d < 3; ++d) m[d] = exact(normal_[d]);
  for (Family& family : families_) {
    Index low = 0, high = 0;
    for (int d = 0; d < 3; ++d) (family.c[d] < 0 ? low : high) += family.c[d] * lattice_.cells[d];
    family.first = low;
    ExactPlane plane{{0, 0, 0}, 0};
    Index shift = 0;  // of the lattice's first node against the given origin
    for (int d = 0; d < 3; ++d) {
      for (int e = 0; e < 3; ++e) plane.n[e] += family.c[d] * m[d][e];
      shift += family.c[d] * first_[d];
    }
    const Exact at_node = rockfold::dot(plane.n, node);
    for (Index v = low; v <= high; ++v) {
      plane.d = at_node + Exact(shift + v) * Exact(spacing_);
      family.upper.push_back(planes.find_or_add(plane));
    }
  }
}

}  // namespace rockfold
