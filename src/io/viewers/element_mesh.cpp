#include "src/io/viewers/element_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

constexpr Real least_weight = 1e-9;  // of a node, or of a cover function: less moves nothing

/// What the rock is made of at a corner: neither stress nor strength goes on from one of these to another.
struct Rock {
  Index block = none, material = none;
  bool operator==(const Rock&) const = default;
};

/// Hands out one point for all corners of the same rock that are at the same place and move alike: those whose weights
/// that count belong to the same covers.
class PointTable {
 public:
  PointTable(ElementMesh& mesh, const CoverArrays& covers)
      : mesh_(mesh), covers_(covers), per_metre_(1e9 / norm(covers.lattice.edge[0])) {}

  /// The point of an element at `local`, m from the centre of its lattice cell.
  Index operator()(const ElementNodes& nodes, const Rock& rock, const Vec3& local) {
    const CellSplit& split = covers_.lattice.split(nodes.cell);
    const CellPart& part = split.part[nodes.part];
    const Vec3 eta = covers_.lattice.to_local(local);
    const Vec3 x = covers_.lattice.cell_centre(nodes.cell) + local;
    const auto weight = part_weights(part, eta);
    Key key;
    key.rock = rock;
    key.cover.fill(none);
    for (int d = 0; d < 3; ++d)
      key.place[d] = std::llround((x[d] - covers_.lattice.origin[d]) * per_metre_);
    for (int a = 0; a < part.nodes; ++a)
      if (std::abs(weight[a]) > least_weight) key.cover[a] = nodes.cover[a];
    std::sort(key.cover.begin(), key.cover.end());
    const auto [entry, is_new] = point_.try_emplace(key, static_cast<Index>(mesh_.point.size()));
    if (is_new) add(nodes, split, part, eta, weight, x);
    return entry->second;
  }

  /// Clears the table, where no corner to come can be one of those so far: a small table stays in the processor's caches.
  void forget() { point_ = {}; }

 private:
  struct Key {
    std::array<std::int64_t, 3> place;  ///< in 1e-9 of the lattice spacing
    std::array<Index, 8> cover;         ///< ascending
    Rock rock;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    std::size_t operator()(const Key& key) const {
      std::uint64_t sum = 0;
      const auto mix = [&](std::uint64_t word) {
        sum = (sum ^ word) * 0x9e3779b97f4a7c15u;
        sum ^= sum >> 29;
      };
      for (const std::int64_t word : key.place) mix(static_cast<std::uint64_t>(word));
      for (const Index word : key.cover) mix(static_cast<std::uint64_t>(word));
      mix(static_cast<std::uint64_t>(key.rock.block));
      mix(static_cast<std::uint64_t>(key.rock.material));
      return sum;
    }
  };

  void add(const ElementNodes& nodes, const CellSplit& split, const CellPart& part, const Vec3& eta,
           const std::array<Real, 8>& weight, const Vec3& x) {
    mesh_.point.push_back(x);
    for (int a = 0; a < part.nodes; ++a) {
      if (std::abs(weight[a]) <= least_weight) continue;
      const HalfSteps& at = split.node[part.node[a]];
      Vec3 xi;
      for (int d = 0; d < 3; ++d) xi[d] = eta[d] - (0.5 * at[d] - 0.5);
      const auto function = cover_functions(covers_, nodes.cover[a], xi);
      for (int k = 0; k < covers_.functions(); ++k) {
        const Real w = weight[a] * function[k];
        if (std::abs(w) <= least_weight) continue;
        mesh_.unknown.push_back(k * covers_.cover_count() + nodes.cover[a]);
        mesh_.weight.push_back(w);
      }
    }
    mesh_.begin.push_back(static_cast<Index>(mesh_.unknown.size()));
  }

  ElementMesh& mesh_;
  const CoverArrays& covers_;
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

/// The point at each node of a regular cell.
std::vector<Index> node_points(const CoverArrays& covers, Index r, PointTable& point) {
  const Lattice& lattice = covers.lattice;
  const CellSplit& split = lattice.split(covers.regular_cell[r]);
  const Rock rock{covers.regular_block[r], covers.regular_material[r]};
  std::vector<Index> points(split.node.size(), none);
  for (int t = 0; t < split.part_count(); ++t)
    for (int a = 0; a < split.part[t].nodes; ++a) {
      const std::size_t n = static_cast<unsigned char>(split.part[t].node[a]);
      if (points[n] != none) continue;
      Vec3 local{};
      for (int d = 0; d < 3; ++d) local += (0.5 * split.node[n][d] - 0.5) * lattice.edge[d];
      points[n] = point(element_nodes(covers, covers.parts_per_cell() * r + t), rock, local);
    }
  return points;
}

void add_regular_cell(ElementMesh& mesh, const CoverArrays& covers, Index r, PointTable& point) {
  const std::vector<Index> points = node_points(covers, r, point);
  // A hexahedron is drawn as the six tetrahedra that fit those of its neighbours.
  const bool hexahedron = covers.nodes_per_part() == 8;
  const CellSplit& drawn = hexahedron ? cell_split(LatticeKind::tet6_kuhn)
                                      : covers.lattice.split(covers.regular_cell[r]);
  for (int t = 0; t < drawn.first_split_parts(); ++t) {
    std::array<Index, 4> corners;
    for (int a = 0; a < 4; ++a) corners[a] = points[drawn.part[t].node[a]];
    add_tetrahedron(mesh, corners, covers.parts_per_cell() * r + (hexahedron ? 0 : t),
                    covers.regular_block[r], covers.regular_material[r]);
  }
}

/// Whether a corner lies in the plane of a triangle, but for rounding: then the two make no
/// tetrahedron.
bool coplanar(const Vec3& corner, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 normal = cross(b - a, c - a), to_a = a - corner;
  return dot(to_a, normal) <= 1e-9 * norm(to_a) * norm(normal);
}

/// A piece is convex, so the triangles of the faces away from its first vertex make tetrahedra with it.
void add_piece(ElementMesh& mesh, const CoverArrays& covers, Index cut, Index piece,
               PointTable& point) {
  const Index first = covers.vertex_begin[piece],
              element = covers.parts_per_cell() * covers.regular_count() + cut;
  const ElementNodes nodes = element_nodes(covers, element);
  const Rock rock{covers.piece_block[piece], covers.element_material[cut]};
  std::vector<Index> of_vertex;
  for (Index v = first; v < covers.vertex_begin[piece + 1]; ++v) {
    const Real* xyz = &covers.vertex_xyz[3 * v];
    of_vertex.push_back(point(nodes, rock, {xyz[0], xyz[1], xyz[2]}));
  }
  for (Index t = covers.triangle_begin[piece]; t < covers.triangle_begin[piece + 1]; ++t) {
    std::array<Index, 4> corners{of_vertex[0]};
    for (int i = 0; i < 3; ++i)
      corners[i + 1] = of_vertex[covers.triangle_vertex[3 * t + i] - first];
    if (coplanar(mesh.point[corners[0]], mesh.point[corners[1]], mesh.point[corners[2]],
                 mesh.point[corners[3]]))
      continue;
    add_tetrahedron(mesh, corners, element, rock.block, rock.material);
  }
}

}  // namespace

ElementMesh make_element_mesh(const CoverArrays& covers) {
  ElementMesh mesh;
  PointTable point(mesh, covers);
  for (Index r = 0; r < covers.regular_count(); ++r) add_regular_cell(mesh, covers, r, point);
  const int drawn = covers.first_split_parts();
  const bool blocks = covers.lattice.kind == LatticeKind::block;
  for (Index e = 0; e < covers.cut_count(); ++e) {
    if (covers.element_part[e] >= drawn) continue;
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      add_piece(mesh, covers, e, q, point);
    if (blocks) point.forget();  // each element has a block or a material of its own
  }
  return mesh;
}

std::vector<std::array<float, 3>> interpolate(const ElementMesh& mesh,
                                              const std::vector<Vec3>& of_unknown) {
  std::vector<std::array<float, 3>> values(mesh.point_count());
  for (std::size_t k = 0; k < values.size(); ++k) {
    Vec3 sum{};
    for (Index i = mesh.begin[k]; i < mesh.begin[k + 1]; ++i)
      sum += mesh.weight[i] * of_unknown[mesh.unknown[i]];
    for (int d = 0; d < 3; ++d) values[k][d] = static_cast<float>(sum[d]);
  }
  return values;
}

}  // namespace rockfold
