#include "src/io/element_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Hands out one point for all corners that are at the same place and move alike: those whose weights
/// that count belong to the same covers.
class PointTable {
 public:
  PointTable(ElementMesh& mesh, const Lattice& lattice)
      : mesh_(mesh), origin_(lattice.origin), per_metre_(1e9 / norm(lattice.edge[0])) {}

  Index operator()(const Vec3& x, const std::array<Index, 4>& cover,
                   const std::array<Real, 4>& weight) {
    const auto next = static_cast<Index>(mesh_.point.size());
    const auto [entry, is_new] = point_.try_emplace(key(x, cover, weight), next);
    if (is_new) {
      mesh_.point.push_back(x);
      mesh_.cover.push_back(cover);
      mesh_.weight.push_back(weight);
    }
    return entry->second;
  }

 private:
  /// Place in 1e-9 of the lattice spacing, and the covers in ascending order.
  using Key = std::array<std::int64_t, 7>;
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t sum = 0;
      for (const std::int64_t word : key)
        sum = (sum ^ static_cast<std::uint64_t>(word)) * 0x9e3779b97f4a7c15u, sum ^= sum >> 29;
      return sum;
    }
  };

  Key key(const Vec3& x, const std::array<Index, 4>& cover,
          const std::array<Real, 4>& weight) const {
    Key key{};
    for (int d = 0; d < 3; ++d) key[d] = std::llround((x[d] - origin_[d]) * per_metre_);
    for (int a = 0; a < 4; ++a) key[3 + a] = std::abs(weight[a]) > 1e-9 ? cover[a] : none;
    std::sort(key.begin() + 3, key.end());
    return key;
  }

  ElementMesh& mesh_;
  Vec3 origin_;
  Real per_metre_;
  std::unordered_map<Key, Index, Hash> point_;
};

void add_tetrahedron(ElementMesh& mesh, const std::array<Index, 4>& corners, Index element,
                     Index block, Index material) {
  mesh.tetrahedron.push_back(corners);
  mesh.element.push_back(element);
  mesh.block.push_back(block);
  mesh.material.push_back(material);
}

void add_regular_cells(ElementMesh& mesh, const CoverArrays& covers, PointTable& point) {
  const Lattice& lattice = covers.lattice;
  const auto node_point = [&](Index cover) {
    const Vec3 x = lattice.node_position(lattice.node_ijk(covers.cover_node[cover]));
    return point(x, {cover, cover, cover, cover}, {1, 0, 0, 0});
  };
  for (Index r = 0; r < covers.regular_count(); ++r) {
    std::array<Index, 8> of_cell;
    for (int c = 0; c < 8; ++c) of_cell[c] = node_point(covers.regular_cover[8 * r + c]);
    for (Index t = 0; t < 6; ++t) {
      std::array<Index, 4> corners;
      for (int a = 0; a < 4; ++a) corners[a] = of_cell[tet6_corner[t][a]];
      add_tetrahedron(mesh, corners, 6 * r + t, covers.regular_block[r],
                      covers.regular_material[r]);
    }
  }
}

/// Whether a corner lies in the plane of a triangle, but for rounding: then the two make no
/// tetrahedron.
bool coplanar(const Vec3& corner, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a), to_a = a - corner;
  return dot(to_a, normal) <= 1e-9 * norm(to_a) * norm(normal);
}

/// A piece is convex, so the triangles of the faces away from its first vertex make tetrahedra with it.
void add_piece(ElementMesh& mesh, const CoverArrays& covers, Index element, Index piece,
               const TetrahedronWeights& weights, PointTable& point) {
  const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[element]);
  const Index first = covers.vertex_begin[piece];
  std::array<Index, 4> cover;
  for (int a = 0; a < 4; ++a) cover[a] = covers.element_cover[4 * element + a];
  std::vector<Index> of_vertex;
  for (Index v = first; v < covers.vertex_begin[piece + 1]; ++v) {
    const Real* xyz = &covers.vertex_xyz[3 * v];
    const Vec3 x{xyz[0], xyz[1], xyz[2]};
    of_vertex.push_back(point(centre + x, cover, weights(covers.element_part[element], x)));
  }
  for (Index t = covers.triangle_begin[piece]; t < covers.triangle_begin[piece + 1]; ++t) {
    std::array<Index, 4> corners{of_vertex[0]};
    for (int i = 0; i < 3; ++i)
      corners[i + 1] = of_vertex[covers.triangle_vertex[3 * t + i] - first];
    if (coplanar(mesh.point[corners[0]], mesh.point[corners[1]], mesh.point[corners[2]],
                 mesh.point[corners[3]]))
      continue;
    add_tetrahedron(mesh, corners, 6 * covers.regular_count() + element, covers.piece_block[piece],
                    covers.element_material[element]);
  }
}

}  // namespace

TetrahedronWeights::TetrahedronWeights(const Lattice& lattice) {
  const Mat3& e = lattice.edge;
  const Real volume = dot(e[0], cross(e[1], e[2]));
  for (int d = 0; d < 3; ++d) to_cell_[d] = (1 / volume) * cross(e[(d + 1) % 3], e[(d + 2) % 3]);
}

std::array<Real, 4> TetrahedronWeights::operator()(int tet, const Vec3& from_centre) const {
  Vec3 u;  // place in the unit cell
  for (int d = 0; d < 3; ++d) u[d] = 0.5 + dot(to_cell_[d], from_centre);
  const auto corner = [&](int a) {
    const int c = tet6_corner[tet][a];
    return Vec3{Real(c & 1), Real(c >> 1 & 1), Real(c >> 2 & 1)};
  };
  const Vec3 a = corner(1) - corner(0), b = corner(2) - corner(0), c = corner(3) - corner(0),
             x = u - corner(0);
  const Real volume = dot(a, cross(b, c));
  const Real w1 = dot(x, cross(b, c)) / volume, w2 = dot(a, cross(x, c)) / volume,
             w3 = dot(a, cross(b, x)) / volume;
  return {1 - w1 - w2 - w3, w1, w2, w3};
}

ElementMesh make_element_mesh(const CoverArrays& covers) {
  ElementMesh mesh;
  PointTable point(mesh, covers.lattice);
  add_regular_cells(mesh, covers, point);
  const TetrahedronWeights weights(covers.lattice);
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      add_piece(mesh, covers, e, q, weights, point);
  return mesh;
}

std::vector<std::array<float, 3>> interpolate(const ElementMesh& mesh,
                                              const std::vector<Vec3>& of_cover) {
  std::vector<std::array<float, 3>> values(mesh.cover.size());
  for (std::size_t k = 0; k < values.size(); ++k) {
    Vec3 sum{};
    for (int a = 0; a < 4; ++a) sum += mesh.weight[k][a] * of_cover[mesh.cover[k][a]];
    for (int d = 0; d < 3; ++d) values[k][d] = static_cast<float>(sum[d]);
  }
  return values;
}

}  // namespace rockfold
