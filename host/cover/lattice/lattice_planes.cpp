#include "host/cover/lattice/lattice_planes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/exact/plane_exact.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// In units of the spacing; only adds lattice cells that turn out empty.
constexpr Real slack = 1e-7;

// Spacings and normals in the order of the lattice's axes. Right-handed, whatever the order in which the families are given.
struct Frame {
  std::array<Vec3, 3> normal;
  Vec3 spacing;
};

Frame frame_of(const CoverSpec& cover) {
  Frame f;
  for (int d = 0; d < 3; ++d) {
    f.normal[d] = upward_normal(cover.directions[2 - d]);
    f.spacing[d] = cover.spacing[2 - d];
  }
  if (dot(cross(f.normal[0], f.normal[1]), f.normal[2]) < 0) f.normal[2] = -f.normal[2];
  return f;
}

[[noreturn]] void refuse(const CoverSpec& cover, const char* key, const std::string& why) {
  throw Error(ErrorKind::model, why,
              Place{cover.place.file, cover.place.line, cover.place.column, key});
}

// `low`, `high`: of the rock, in cells from the lattice's origin.
void check_extent(const CoverSpec& cover, const Vec3& low, const Vec3& high) {
  constexpr Real farthest = 1e9;  // cells
  // Linear functions are differences of constants to rounding; curved ones are lost beside them in rock that is small.
  const bool linear = cover.order == 0 && cover.lattice != LatticeKind::hex8;
  const Real smallest = linear ? 1e-9 : 1e-3;
  const Real spacing = cover.spacing[0];
  const Real away = std::max({norm(low), norm(high)});
  Real nodes = cover.lattice == LatticeKind::tet24 ? 5 : 1, extent = 0;
  for (int d = 0; d < 3; ++d) {
    nodes *= std::ceil(high[d] + slack) - std::floor(low[d] - slack) + 1;
    extent = std::max(extent, high[d] - low[d]);
  }
  if (nodes > std::numeric_limits<Index>::max())
    refuse(cover, "cover.spacing",
           fmt::format("found {:g} m, which makes {:.3g} lattice nodes; use a larger spacing "
                       "(at most 2.1e9 nodes)",
                       spacing, nodes));
  if (away > farthest)
    refuse(
        cover, cover.origin ? "cover.origin" : "cover.spacing",
        fmt::format("the rock lies {:.3g} cells of {:g} m from the lattice's origin; at most "
                    "{:g} can be told apart: {}",
                    away, spacing, farthest,
                    cover.origin ? "choose an origin nearer to the rock" : "use a larger spacing"));
  if (extent < smallest)
    refuse(cover, "cover.spacing",
           fmt::format("found {:g} m, {:.2g} times the extent of the rock; in elements more than "
                       "{:g} times as large as their rock its strain is lost to rounding: use a "
                       "smaller spacing",
                       spacing, 1 / extent, 1 / smallest));
}

}  // namespace

Real lattice_cell_volume(const CoverSpec& cover) {
  const Frame f = frame_of(cover);
  return f.spacing[0] * f.spacing[1] * f.spacing[2] /
         dot(f.normal[0], cross(f.normal[1], f.normal[2]));
}

LatticePlanes::LatticePlanes(const CoverSpec& cover, const std::vector<Vec3>& bounds,
                             PlaneTable& planes)
    : table_(cover.lattice),
      node_(cover.origin.value_or(planes.centre())),
      centre_(planes.centre()) {
  const Frame frame = frame_of(cover);
  normal_ = frame.normal;
  spacing_ = frame.spacing;
  Vec3 low = coordinates(bounds.front()), high = low;
  for (const Vec3& x : bounds) {
    const Vec3 xi = coordinates(x);
    for (int d = 0; d < 3; ++d)
      low[d] = std::min(low[d], xi[d]), high[d] = std::max(high[d], xi[d]);
  }
  check_extent(cover, low, high);
  lattice_.kind = cover.lattice;
  const Real span = dot(normal_[0], cross(normal_[1], normal_[2]));
  lattice_.origin = node_;
  for (int d = 0; d < 3; ++d) {
    first_[d] = static_cast<Index>(std::floor(low[d] - slack));
    lattice_.cells[d] = static_cast<Index>(std::ceil(high[d] + slack)) - first_[d];
    lattice_.edge[d] = (spacing_[d] / span) * cross(normal_[(d + 1) % 3], normal_[(d + 2) % 3]);
    lattice_.origin += static_cast<Real>(first_[d]) * lattice_.edge[d];
  }
  // Whatever rock there is, cells about the given origin have the same form.
  lattice_.odd_origin =
      cover.lattice == LatticeKind::tet5 && ((first_[0] + first_[1] + first_[2]) & 1) != 0;
  add_planes(planes);
}

LatticePlanes::LatticePlanes(Lattice blocks)
    : table_(LatticeKind::block), lattice_(std::move(blocks)) {}

// Lattice coordinates, counted from the given origin, of a point relative to the table's centre.
Vec3 LatticePlanes::coordinates(const Vec3& x) const {
  const Vec3 r = x + (centre_ - node_);
  Vec3 xi;
  for (int d = 0; d < 3; ++d) xi[d] = dot(normal_[d], r) / spacing_[d];
  return xi;
}

LatticeBox LatticePlanes::range(std::span<const Vertex> vertices) const {
  Vec3 low = coordinates(vertices.front().x), high = low;
  for (const Vertex& v : vertices) {
    const Vec3 xi = coordinates(v.x);
    for (int d = 0; d < 3; ++d)
      low[d] = std::min(low[d], xi[d]), high[d] = std::max(high[d], xi[d]);
  }
  const auto cell = [&](Real x, int d) {  // points may lie far outside
    return static_cast<Index>(std::clamp<Real>(x - first_[d], 0, lattice_.cells[d]));
  };
  LatticeBox box;
  for (int d = 0; d < 3; ++d) {
    box.low[d] = cell(std::floor(low[d] - slack), d);
    box.high[d] = cell(std::ceil(high[d] + slack), d);
  }
  return box;
}

HalfSpaceId LatticePlanes::upper(const std::array<Index, 3>& cell, const SplitPlane& plane) const {
  const auto& c = table_.family[plane.family];
  const Family& family = families_[plane.family];
  const Index value = c[0] * cell[0] + c[1] * cell[1] + c[2] * cell[2] + plane.offset;
  return family.upper[(value - family.first) / family.step];
}

int LatticePlanes::part_at(const PartTree& tree, const Vec3& eta) const {
  int child = tree.root;
  while (child >= 0) {
    const PartTree::Branch& branch = tree.branch[child];
    const auto& c = table_.family[branch.plane.family];
    Real at = -branch.plane.offset;
    for (int d = 0; d < 3; ++d) at += c[d] * (eta[d] + 0.5);
    child = at > 0 ? branch.above : branch.below;
  }
  return ~child;
}

// The plane Σ c_d n_d·(x − node)/s_d = v, times one of the spacings.
void LatticePlanes::add_planes(PlaneTable& planes) {
  const ExactVec3 node = exact(node_);
  for (std::size_t f = 0; f < table_.family.size(); ++f) {
    const auto& c = table_.family[f];
    Family family;
    Index low = 0, high = 0, shift = 0;  // shift: of the lattice's first node against the given one
    Real unit = 0;
    ExactPlane plane{{0, 0, 0}, 0};
    for (int d = 0; d < 3; ++d) {
      if (c[d] == 0) continue;
      (c[d] < 0 ? low : high) += c[d] * lattice_.cells[d];
      shift += c[d] * first_[d];
      if (unit == 0) unit = spacing_[d];
      const Exact share = Exact(c[d]) * (exact(unit) / exact(spacing_[d]));
      const ExactVec3 normal = exact(normal_[d]);
      for (int e = 0; e < 3; ++e) plane.n[e] += share * normal[e];
    }
    family.step = table_.every_other[f] ? 2 : 1;
    family.first = low;
    if (family.step == 2 && ((low & 1) != 0) != lattice_.odd_origin) ++family.first;
    const Exact at_node = rockfold::dot(plane.n, node);
    for (Index v = family.first; v <= high; v += family.step) {
      plane.d = at_node + Exact(shift + v) * exact(unit);
      family.upper.push_back(planes.find_or_add(plane));
    }
    families_.push_back(std::move(family));
  }
}

}  // namespace rockfold
