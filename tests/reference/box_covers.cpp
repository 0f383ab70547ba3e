#include "tests/reference/box_covers.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::reference {
namespace {

using Polygon = std::vector<Vec3>;
/// A convex polyhedron: faces counter-clockwise seen from outside.
using Solid = std::vector<Polygon>;

Polygon clip_polygon(const Polygon& polygon, const HalfSpace& h, std::vector<Vec3>& cut) {
  Polygon kept;
  auto side = [&](const Vec3& x) { return dot(h.normal, x) - h.offset; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real sa = side(a), sb = side(b);
    if (sa <= 0) kept.push_back(a);
    if (sa == 0) cut.push_back(a);
    if ((sa < 0 && sb > 0) || (sa > 0 && sb < 0)) {
      const Vec3 x = a + (sa / (sa - sb)) * (b - a);
      kept.push_back(x);
      cut.push_back(x);
    }
  }
  return kept.size() >= 3 ? kept : Polygon{};
}

/// The cap: the cut's points around their centre, counter-clockwise about the plane's normal.
Polygon cap(std::vector<Vec3> points, const Vec3& normal) {
  if (points.size() < 3) return {};
  Vec3 centre{};
  for (const Vec3& x : points) centre += (1.0 / points.size()) * x;
  Vec3 u = points[0] - centre;
  for (const Vec3& x : points)
    if (norm(x - centre) > norm(u)) u = x - centre;
  if (norm(u) == 0) return {};
  const Vec3 e = normalized(u), f = cross(normalized(normal), e);
  auto angle = [&](const Vec3& x) { return std::atan2(dot(x - centre, f), dot(x - centre, e)); };
  std::sort(points.begin(), points.end(),
            [&](const Vec3& a, const Vec3& b) { return angle(a) < angle(b); });
  Polygon loop;
  for (const Vec3& x : points)
    if (loop.empty() || norm(x - loop.back()) > 1e-14 * norm(u)) loop.push_back(x);
  return loop.size() >= 3 ? loop : Polygon{};
}

Solid clip(const Solid& solid, const HalfSpace& h) {
  Solid result;
  std::vector<Vec3> cut;
  bool outside = false;
  for (const Polygon& face : solid)
    for (const Vec3& x : face) outside = outside || dot(h.normal, x) > h.offset;
  if (!outside) return solid;
  for (const Polygon& face : solid) {
    Polygon kept = clip_polygon(face, h, cut);
    if (!kept.empty()) result.push_back(std::move(kept));
  }
  if (result.empty()) return result;
  Polygon lid = cap(std::move(cut), h.normal);
  if (!lid.empty()) result.push_back(std::move(lid));
  return result;
}

Real volume(const Solid& solid) {
  if (solid.empty()) return 0;
  const Vec3 o = solid[0][0];
  Real sum = 0;
  for (const Polygon& face : solid)
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      sum += dot(face[0] - o, cross(face[i] - o, face[i + 1] - o)) / 6;
  return sum;
}

Solid tetrahedron(const std::array<Vec3, 4>& v) {
  // Counter-clockwise from outside for a positive tetrahedron.
  return {{v[0], v[2], v[1]}, {v[0], v[1], v[3]}, {v[0], v[3], v[2]}, {v[1], v[2], v[3]}};
}

Vec3 node_place(const Lattice& lattice, Index cell, int node) {
  return lattice.node_position(lattice.cell_node(cell, node));
}

std::array<Vec3, 8> cell_corners(const Lattice& lattice, Index cell) {
  std::array<Vec3, 8> x{};
  for (int c = 0; c < 8; ++c) x[c] = node_place(lattice, cell, c);
  return x;
}

Solid whole_part(const Lattice& lattice, Index cell, const CellPart& part) {
  std::array<Vec3, 8> v{};
  for (int a = 0; a < part.nodes; ++a) v[a] = node_place(lattice, cell, part.node[a]);
  if (part.nodes == 4) return tetrahedron({v[0], v[1], v[2], v[3]});
  const auto quad = [&](int a, int b, int c, int d) { return Polygon{v[a], v[b], v[c], v[d]}; };
  return {quad(0, 4, 6, 2), quad(1, 3, 7, 5), quad(0, 1, 5, 4),
          quad(2, 6, 7, 3), quad(0, 2, 3, 1), quad(4, 5, 7, 6)};
}

/// A cube that no region reaches out of.
Solid everything() {
  Lattice lattice;
  lattice.kind = LatticeKind::hex8;
  lattice.edge = {{{2e3, 0, 0}, {0, 2e3, 0}, {0, 0, 2e3}}};
  lattice.origin = {-1e3, -1e3, -1e3};
  lattice.cells = {1, 1, 1};
  return whole_part(lattice, 0, cell_split(LatticeKind::hex8).part.front());
}

bool holds(const Region& region, const std::array<Vec3, 8>& x) {
  return std::all_of(x.begin(), x.end(), [&](const Vec3& v) {
    return std::all_of(region.planes.begin(), region.planes.end(),
                       [&](const HalfSpace& h) { return dot(h.normal, v) <= h.offset; });
  });
}

void add_piece(CoverArrays& covers, const Solid& solid, const Vec3& centre, Index block) {
  covers.piece_block.push_back(block);
  for (const Polygon& face : solid) {
    const Index first = static_cast<Index>(covers.vertex_xyz.size() / 3);
    for (const Vec3& x : face)
      for (int d = 0; d < 3; ++d) covers.vertex_xyz.push_back(x[d] - centre[d]);
    for (std::size_t i = 1; i + 1 < face.size(); ++i)
      for (std::size_t k : {std::size_t{0}, i, i + 1})
        covers.triangle_vertex.push_back(first + static_cast<Index>(k));
  }
  covers.triangle_begin.push_back(static_cast<Index>(covers.triangle_vertex.size() / 3));
  covers.vertex_begin.push_back(static_cast<Index>(covers.vertex_xyz.size() / 3));
}

/// Builds everything but cover ids, for which it stores (node, body) pairs first.
class Builder {
 public:
  Builder(const Lattice& lattice, const std::vector<Region>& regions, Real least)
      : regions_(regions), least_(least) {
    CoverArrays& a = result_.arrays;
    a.lattice = lattice;
    a.piece_begin = a.triangle_begin = a.vertex_begin = {0};
  }

  CoveredRegions build() {
    const Lattice& lattice = result_.arrays.lattice;
    if (lattice.kind == LatticeKind::block) add_blocks();
    for (Index cell = 0; cell < lattice.cells[0] * lattice.cells[1] * lattice.cells[2]; ++cell)
      add_cell(cell);
    number_covers();
    return std::move(result_);
  }

 private:
  void add_cell(Index cell) {
    CoverArrays& a = result_.arrays;
    const auto x = cell_corners(a.lattice, cell);
    for (const Region& region : regions_)
      if (holds(region, x)) {
        a.regular_cell.push_back(cell);
        a.regular_material.push_back(region.material);
        a.regular_block.push_back(region.block);
        for (int c = 0; c < a.nodes_per_cell(); ++c)
          regular_keys_.emplace_back(a.lattice.cell_node(cell, c), region.body);
        return;
      }
    for (int t = 0; t < a.parts_per_cell(); ++t)
      add_part(cell, t, whole_part(a.lattice, cell, a.lattice.split(cell).part[t]));
  }

  void add_part(Index cell, int t, const Solid& whole) {
    const Real least = least_ * volume(whole) * (whole.size() == 4 ? 6 : 1);
    std::map<std::pair<Index, Index>, std::vector<std::pair<Solid, Index>>> elements;
    for (const Region& region : regions_) {
      Solid part = whole;
      for (const HalfSpace& h : region.planes) part = clip(part, h);
      if (volume(part) > least)
        elements[{region.body, region.material}].emplace_back(part, region.block);
    }
    for (const auto& [key, pieces] : elements) add_element(cell, t, key.first, key.second, pieces);
  }

  /// One cell for each body.
  void add_blocks() {
    CoverArrays& a = result_.arrays;
    for (Index body = 0; body < static_cast<Index>(a.lattice.block_origin.size()); ++body) {
      std::map<Index, std::vector<std::pair<Solid, Index>>> elements;
      for (const Region& region : regions_) {
        if (region.body != body) continue;
        Solid solid = everything();
        for (const HalfSpace& h : region.planes) solid = clip(solid, h);
        elements[region.material].emplace_back(solid, region.block);
      }
      for (const auto& [material, pieces] : elements) add_element(body, 0, body, material, pieces);
    }
  }

  void add_element(Index cell, int t, Index body, Index material,
                   const std::vector<std::pair<Solid, Index>>& pieces) {
    CoverArrays& a = result_.arrays;
    a.element_cell.push_back(cell);
    a.element_part.push_back(static_cast<std::uint8_t>(t));
    a.element_material.push_back(material);
    result_.element_body.push_back(body);
    const CellPart& part = a.lattice.split(cell).part[t];
    for (int k = 0; k < part.nodes; ++k)
      element_keys_.emplace_back(a.lattice.cell_node(cell, part.node[k]), body);
    for (const auto& [solid, block] : pieces)
      add_piece(a, solid, a.lattice.cell_centre(cell), block);
    a.piece_begin.push_back(a.piece_count());
  }

  void number_covers() {
    std::map<std::pair<Index, Index>, Index> ids;
    for (const auto& key : regular_keys_) ids[key] = 0;
    for (const auto& key : element_keys_) ids[key] = 0;
    CoverArrays& a = result_.arrays;
    for (auto& [key, id] : ids) {
      id = static_cast<Index>(a.cover_node.size());
      a.cover_node.push_back(key.first);
      result_.cover_body.push_back(key.second);
    }
    for (const auto& key : regular_keys_) a.regular_cover.push_back(ids[key]);
    for (const auto& key : element_keys_) a.element_cover.push_back(ids[key]);
  }

  const std::vector<Region>& regions_;
  Real least_;
  CoveredRegions result_;
  std::vector<std::pair<Index, Index>> regular_keys_, element_keys_;
};

/// Elements by (cell, part, body).
std::map<std::tuple<Index, int, Index>, Index> index_elements(const CoveredRegions& covered) {
  const CoverArrays& a = covered.arrays;
  std::map<std::tuple<Index, int, Index>, Index> elements;
  const int parts = a.parts_per_cell(), nodes = a.nodes_per_cell();
  for (Index r = 0; r < a.regular_count(); ++r)
    for (int t = 0; t < parts; ++t)
      elements[{a.regular_cell[r], t, covered.cover_body[a.regular_cover[nodes * r]]}] =
          parts * r + t;
  for (Index e = 0; e < a.cut_count(); ++e)
    elements[{a.element_cell[e], a.element_part[e], covered.element_body[e]}] =
        parts * a.regular_count() + e;
  return elements;
}

}  // namespace

Region box(const Vec3& low, const Vec3& high, Index material, Index block, Index body) {
  Region region{{}, material, block, body};
  for (int d = 0; d < 3; ++d) {
    Vec3 axis{};
    axis[d] = 1;
    region.planes.push_back({axis, high[d]});
    region.planes.push_back({-axis, -low[d]});
  }
  return region;
}

Lattice turned_lattice(const Vec3& node, Real spacing, Real about_z, Real about_x,
                       const Vec3& centre, Real radius) {
  const Real c = std::cos(about_z), s = std::sin(about_z);
  const Real cx = std::cos(about_x), sx = std::sin(about_x);
  auto turn = [&](const Vec3& v) {
    const Vec3 z{c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
    return Vec3{z[0], cx * z[1] - sx * z[2], sx * z[1] + cx * z[2]};
  };
  Lattice lattice;
  lattice.edge = {turn({spacing, 0, 0}), turn({0, spacing, 0}), turn({0, 0, spacing})};
  lattice.origin = node;
  for (int d = 0; d < 3; ++d) {
    const Vec3 unit = normalized(lattice.edge[d]);
    const Real middle = dot(centre - node, unit) / spacing;
    const Index first = static_cast<Index>(std::floor(middle - radius / spacing));
    const Index last = static_cast<Index>(std::ceil(middle + radius / spacing));
    lattice.origin += Real(first) * lattice.edge[d];
    lattice.cells[d] = last - first;
  }
  return lattice;
}

CoveredRegions cover_regions(const Lattice& lattice, const std::vector<Region>& regions,
                             Real least_volume) {
  return Builder(lattice, regions, least_volume).build();
}

MaterialPoints locate(const CoveredRegions& covered, const std::vector<Vec3>& points, Index body) {
  const CoverArrays& a = covered.arrays;
  const auto elements = index_elements(covered);
  const bool overlaid = a.lattice.kind == LatticeKind::tet5_mixed;
  MaterialPoints located;
  for (const Vec3& x : points) {
    Index found[2] = {none, none};  // in each of two overlaid splits
    for (const auto& [key, element] : elements) {
      const auto& [cell, t, of_body] = key;
      Index& mine = found[overlaid && t >= 5 ? 1 : 0];
      if (mine != none || of_body != body) continue;
      const Vec3 eta = a.lattice.to_local(x - a.lattice.cell_centre(cell));
      const CellPart& part = a.lattice.split(cell).part[t];
      const auto weight = part_weights(part, eta);
      bool inside = *std::min_element(weight.begin(), weight.begin() + part.nodes) > -1e-9;
      if (a.lattice.kind != LatticeKind::block)
        for (const Real c : eta) inside = inside && std::abs(c) < 0.5 + 1e-9;
      if (inside) mine = element;
    }
    if (found[0] == none) throw std::runtime_error("a point lies outside the body");
    add_material_point(a, x, found[0], located, found[1]);
  }
  return located;
}

std::vector<Vec3> corner_points(const CoveredRegions& covered,
                                const std::function<bool(const Vec3&)>& wanted) {
  const CoverArrays& a = covered.arrays;
  std::map<std::array<long long, 3>, Vec3> places;  // rounded: one place, one point
  auto offer = [&](const Vec3& x) {
    if (!wanted(x)) return;
    std::array<long long, 3> key{};
    for (int d = 0; d < 3; ++d) key[d] = std::llround(x[d] * 1e9);
    places.emplace(key, x);
  };
  for (Index r = 0; r < a.regular_count(); ++r)
    for (const Vec3& x : cell_corners(a.lattice, a.regular_cell[r])) offer(x);
  for (Index e = 0; e < a.cut_count(); ++e)
    for (Index v = a.vertex_begin[a.piece_begin[e]]; v < a.vertex_begin[a.piece_begin[e + 1]]; ++v)
      offer(a.lattice.cell_centre(a.element_cell[e]) +
            Vec3{a.vertex_xyz[3 * v], a.vertex_xyz[3 * v + 1], a.vertex_xyz[3 * v + 2]});
  std::vector<Vec3> result;
  for (const auto& [key, x] : places) result.push_back(x);
  return result;
}

FixedPoints fix(const CoveredRegions& covered, const std::vector<Vec3>& points,
                const std::function<Vec3(const Vec3&)>& value, Real stiffness, bool augmented,
                Index body) {
  FixedPoints fixed;
  fixed.points = locate(covered, points, body);
  for (const Vec3& x : points) {
    fixed.component.push_back({1, 1, 1});
    fixed.value.push_back(value(x));
    fixed.stiffness.push_back(stiffness);
    fixed.enforce.push_back(augmented ? Enforce::held : Enforce::penalty);
  }
  return fixed;
}

std::vector<Vec3> sample_at_nodes(const CoverArrays& covers,
                                  const std::function<Vec3(const Vec3&)>& field) {
  std::vector<Vec3> values;
  for (Index node : covers.cover_node) values.push_back(field(covers.lattice.node_position(node)));
  values.resize(covers.unknown_count());
  return values;
}

}  // namespace rockfold::reference
