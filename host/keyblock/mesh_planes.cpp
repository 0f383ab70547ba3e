#include "host/keyblock/mesh_planes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <tuple>
#include <utility>

#include "host/cut/bodies/union_find.hpp"
#include "host/keyblock/face_shape.hpp"
#include "host/keyblock/mean_planes.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// A connected part of a mesh on a body.
struct Piece {
  Vec3 vector_area{};  ///< m², Σ A n
  Real area = 0;       ///< m²
  Vec3 centre{};       ///< m, of the area
};

/// Facets of one mesh on one body, parted into planes.
class MeshOnBody {
 public:
  MeshOnBody(const BlockArrays& blocks, Real flatness, std::span<const Index> faces,
             std::span<const Real> area)
      : blocks_(blocks),
        flatness_(flatness),
        faces_(faces),
        area_(area),
        touching_(static_cast<Index>(faces.size())) {}

  std::vector<Vec3> normals() {
    join_touching();
    join_pieces();
    const std::vector<Index> part = touching_.components();
    std::vector<std::vector<std::size_t>> of_part(at(*std::max_element(part.begin(), part.end())) +
                                                  1);
    for (std::size_t k = 0; k < part.size(); ++k) of_part[at(part[k])].push_back(k);
    std::vector<Vec3> normals(faces_.size());
    for (const auto& members : of_part) {
      std::vector<SurfaceFacet> facets;
      for (const std::size_t k : members) facets.push_back({normal(k), area_[k]});
      const auto means = mean_plane_normals(facets, flatness_);
      for (std::size_t m = 0; m < members.size(); ++m) normals[members[m]] = means[m];
    }
    return normals;
  }

 private:
  const Vec3& normal(std::size_t k) const { return blocks_.face_normal[at(faces_[k])]; }

  /// Facets with a corner in common.
  void join_touching() {
    std::vector<std::pair<Vec3, Index>> corners;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      const Index begin = blocks_.loop_begin[at(faces_[k])],
                  end = blocks_.loop_begin[at(faces_[k]) + 1];
      for (Index c = blocks_.corner_begin[at(begin)]; c < blocks_.corner_begin[at(end)]; ++c)
        corners.emplace_back(blocks_.vertex[at(blocks_.corner_vertex[at(c)])],
                             static_cast<Index>(k));
    }
    std::sort(corners.begin(), corners.end());
    for (std::size_t i = 1; i < corners.size(); ++i)
      if (corners[i].first == corners[i - 1].first)
        touching_.join(corners[i].second, corners[i - 1].second);
  }

  /// A body with a gap in it shows one surface in several pieces: those whose centres lie in one plane with both. Specks, as where
  /// another joint crosses, begin no plane: they go with the largest piece.
  void join_pieces() {
    const std::vector<Index> piece_of = touching_.components();
    if (*std::max_element(piece_of.begin(), piece_of.end()) == 0) return;
    std::map<Index, Piece> pieces;
    std::vector<Index> first;
    Real area = 0;
    for (std::size_t k = 0; k < faces_.size(); ++k) {
      const auto [found, fresh] = pieces.try_emplace(piece_of[k]);
      if (fresh) first.push_back(static_cast<Index>(k));
      Piece& piece = found->second;
      piece.vector_area += area_[k] * normal(k);
      piece.area += area_[k];
      area += area_[k];
      piece.centre += area_[k] * face_centre(blocks_, faces_[k]);
    }
    for (auto& [number, piece] : pieces) piece.centre = (1 / piece.area) * piece.centre;
    for (auto a = pieces.begin(); a != pieces.end(); ++a)
      for (auto b = std::next(a); b != pieces.end(); ++b)
        if (is_one_plane(a->second, b->second))
          touching_.join(first[at(a->first)], first[at(b->first)]);
    const auto size = [](const auto& piece) {
      return std::tie(piece.second.area, piece.second.centre);
    };
    const auto largest =
        std::max_element(pieces.begin(), pieces.end(),
                         [&](const auto& a, const auto& b) { return size(a) < size(b); });
    for (const auto& [number, piece] : pieces)
      if (piece.area < least_plane_share * area)
        touching_.join(first[at(number)], first[at(largest->first)]);
  }

  bool is_one_plane(const Piece& a, const Piece& b) const {
    const Real angle = flatness_ * std::numbers::pi / 180;
    const Vec3 sum = a.vector_area + b.vector_area, apart = b.centre - a.centre;
    const auto is_along = [&](const Vec3& v) {
      return dot(v, sum) >= std::cos(angle) * norm(v) * norm(sum);
    };
    return is_along(a.vector_area) && is_along(b.vector_area) &&
           std::abs(dot(apart, sum)) <= std::sin(angle) * norm(apart) * norm(sum);
  }

  const BlockArrays& blocks_;
  Real flatness_;
  std::span<const Index> faces_;
  std::span<const Real> area_;
  UnionFind touching_;
};

}  // namespace

MeshPlanes::MeshPlanes(const BlockArrays& blocks, const Model& model) : blocks_(blocks) {
  std::map<std::string, Real> of_mesh;
  for (const JointMesh& mesh : model.joint_meshes) of_mesh[mesh.name] = mesh.flatness;
  bool any = false;
  for (const FaceOrigin& origin : blocks.origins) {
    const auto mesh = of_mesh.find(origin.name);
    flatness_.emplace_back();
    if (origin.kind != FaceOrigin::Kind::joint || mesh == of_mesh.end()) continue;
    flatness_.back() = mesh->second;
    any = any || mesh->second > 0;
  }
  if (!any || !has_polygons(blocks)) return;
  std::vector<Vec3> normal = blocks.face_normal;
  constexpr std::int64_t chunk = 64;
  parallel_for(blocks.block_count(), chunk, [&](std::int64_t b) {
    const auto block = static_cast<std::size_t>(b);
    std::vector<Index> faces;
    for (Index f = blocks.face_begin[block]; f < blocks.face_begin[block + 1]; ++f)
      if (flatness(f)) faces.push_back(f);
    std::vector<Real> area;
    for (const Index f : faces) area.push_back(blocks.face_area[at(f)]);
    const std::vector<Vec3> means = normals(faces, area);
    for (std::size_t k = 0; k < faces.size(); ++k) normal[at(faces[k])] = means[k];
  });
  normal_ = std::move(normal);
}

std::vector<Vec3> MeshPlanes::normals(std::span<const Index> faces,
                                      std::span<const Real> area) const {
  std::vector<Vec3> normals;
  std::map<Index, std::vector<std::size_t>> of_mesh;  // by origin
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Vec3& own = blocks_.face_normal[at(faces[k])];
    normals.push_back(own);
    // A face that rounded to nothing has neither an area nor a direction.
    if (flatness(faces[k]) && area[k] > 0 && std::abs(norm(own) - 1) < 1e-6)
      of_mesh[blocks_.face_origin[at(faces[k])]].push_back(k);
  }
  for (const auto& [origin, members] : of_mesh) {
    std::vector<Index> facets;
    std::vector<Real> areas;
    for (const std::size_t k : members) facets.push_back(faces[k]), areas.push_back(area[k]);
    const auto means = MeshOnBody(blocks_, *flatness_[at(origin)], facets, areas).normals();
    for (std::size_t k = 0; k < members.size(); ++k) normals[members[k]] = means[k];
  }
  return normals;
}

}  // namespace rockfold
