#include "src/space/element_points.hpp"

#include <cmath>

#include "src/base/gauss.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

/// The volume that a flattened piece gets, in lattice cells: as its moments (kernels/integrate/moments_kernel.hpp).
constexpr Real volume_floor = 1e-20;

/// Six times its volume if d lies behind the triangle a b c.
Real six_volumes(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return dot(a - d, cross(b - d, c - d));
}

}  // namespace

ElementPoints::ElementPoints(const CoverArrays& covers, int degree)
    : covers_(covers),
      reciprocal_(covers.lattice.reciprocal()),
      cell_volume_(std::abs(
          dot(covers.lattice.edge[0], cross(covers.lattice.edge[1], covers.lattice.edge[2])))),
      share_(cell_split(covers.lattice.kind).share) {
  // ∫ f over the tetrahedron / volume = ∫∫∫ f 6 (1 − u)² (1 − v) du dv dw
  const int n = (degree + 2) / 2;
  const auto line = gauss_points(n);
  for (const auto& [u, by_u] : gauss_points(n, 2))
    for (const auto& [v, by_v] : gauss_points(n, 1))
      for (const auto& [w, by_w] : line) {
        const Real rest = 1 - u, left = rest * (1 - v);
        tetrahedron_.push_back({{u, rest * v, left * w, left * (1 - w)}, 6 * by_u * by_v * by_w});
      }
  for (const auto& [u, by_u] : line)
    for (const auto& [v, by_v] : line)
      for (const auto& [w, by_w] : line)
        hexahedron_.push_back({{u - 0.5, v - 0.5, w - 0.5}, by_u * by_v * by_w});
}

void ElementPoints::add_element(Index element, std::vector<RockPoint>& to) const {
  const Index whole = covers_.parts_per_cell() * covers_.regular_count();
  if (element < whole) {
    const ElementNodes nodes = element_nodes(covers_, element);
    const CellSplit& split = covers_.lattice.split(nodes.cell);
    return add_part(split, split.part[nodes.part], to);
  }
  const Index cut = element - whole;
  for (Index q = covers_.piece_begin[cut]; q < covers_.piece_begin[cut + 1]; ++q) add_piece(q, to);
}

void ElementPoints::add_part(const CellSplit& split, const CellPart& part,
                             std::vector<RockPoint>& to) const {
  if (part.nodes != 4) {
    for (const RockPoint& p : hexahedron_) to.push_back({p.eta, share_ * cell_volume_ * p.weight});
    return;
  }
  std::array<Vec3, 4> corner;
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d) corner[a][d] = 0.5 * split.node[part.node[a]][d] - 0.5;
  add_tetrahedron(
      corner, cell_volume_ * std::abs(six_volumes(corner[0], corner[1], corner[2], corner[3])) / 6,
      to);
}

void ElementPoints::add_piece(Index piece, std::vector<RockPoint>& to) const {
  const auto vertex = [&](Index v) {
    return Vec3{covers_.vertex_xyz[3 * v], covers_.vertex_xyz[3 * v + 1],
                covers_.vertex_xyz[3 * v + 2]};
  };
  const auto local = [&](const Vec3& x) {
    return Vec3{dot(reciprocal_[0], x), dot(reciprocal_[1], x), dot(reciprocal_[2], x)};
  };
  const Index begin = covers_.triangle_begin[piece], end = covers_.triangle_begin[piece + 1];
  const Vec3 apex = vertex(covers_.triangle_vertex[3 * begin]);
  Real total = 0;
  for (Index t = begin; t < end; ++t) {
    const Index* of = &covers_.triangle_vertex[3 * t];
    const Vec3 a = vertex(of[0]), b = vertex(of[1]), c = vertex(of[2]);
    const Real volume = six_volumes(a, b, c, apex) / 6;
    if (!(volume > 0)) continue;
    total += volume;
    add_tetrahedron({local(a), local(b), local(c), local(apex)}, volume, to);
  }
  if (total > volume_floor * cell_volume_) return;
  Vec3 mean{};
  for (Index t = begin; t < end; ++t)
    for (int i = 0; i < 3; ++i)
      mean += (1.0 / (3 * (end - begin))) * vertex(covers_.triangle_vertex[3 * t + i]);
  to.push_back({local(mean), share_ * volume_floor * cell_volume_});
}

void ElementPoints::add_tetrahedron(const std::array<Vec3, 4>& corner, Real volume,
                                    std::vector<RockPoint>& to) const {
  for (const Shared& p : tetrahedron_) {
    Vec3 eta{};
    for (int a = 0; a < 4; ++a) eta += p.at[a] * corner[a];
    to.push_back({eta, share_ * volume * p.weight});
  }
}

}  // namespace rockfold
