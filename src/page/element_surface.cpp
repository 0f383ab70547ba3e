#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "src/base/vector.hpp"
#include "src/io/result_reader.hpp"
#include "src/page/page_surface.hpp"

namespace rockfold {

namespace {

using hdf5::File;

constexpr Real on_plane =
    1e-6;  // of the model's size: vertices of elements are rounded to single precision
constexpr Real same_side = 0.9;      // cosine: a triangle on a face has its normal
constexpr Real distinct = 1 - 1e-6;  // cosine between faces that meet in an edge to be drawn
const std::string grid = "/VTKHDF/Elements/";

struct Triangle {
  Index block = none;
  std::array<Index, 3> vertex{};
  std::array<Index, 3> sorted() const {
    std::array<Index, 3> ends = vertex;
    std::sort(ends.begin(), ends.end());
    return ends;
  }
};

/// The faces of tetrahedra that no other tetrahedron of the block has, turned outward, by block.
std::vector<Triangle> outer_faces(const std::vector<Index>& corner, const std::vector<Index>& block,
                                  const std::vector<Vec3>& point) {
  constexpr int face[4][4] = {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}};
  std::vector<Triangle> all;
  all.reserve(corner.size());
  for (std::size_t t = 0; 4 * t + 3 < corner.size(); ++t)
    for (const auto& f : face) {
      Triangle triangle{block[t] - 1,
                        {corner[4 * t + f[0]], corner[4 * t + f[1]], corner[4 * t + f[2]]}};
      const auto& [a, b, c] = triangle.vertex;
      const Vec3 normal = cross(point[b] - point[a], point[c] - point[a]);
      if (dot(normal, point[corner[4 * t + f[3]]] - point[a]) > 0)
        std::swap(triangle.vertex[1], triangle.vertex[2]);
      all.push_back(triangle);
    }
  std::sort(all.begin(), all.end(), [](const Triangle& x, const Triangle& y) {
    return std::pair(x.block, x.sorted()) < std::pair(y.block, y.sorted());
  });
  const auto same = [](const Triangle& x, const Triangle& y) {
    return x.block == y.block && x.sorted() == y.sorted();
  };
  std::vector<Triangle> outer;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!(i > 0 && same(all[i], all[i - 1])) && !(i + 1 < all.size() && same(all[i], all[i + 1])))
      outer.push_back(all[i]);
  return outer;
}

struct Face {
  Vec3 normal, point;
  Index origin;
};

/// The faces of all blocks with their planes, and where those of each block begin.
struct Faces {
  std::vector<Face> list;
  std::vector<Index> begin;  // [B+1]
  Real tolerance = 0;        // m
};

Faces read_faces(const File& file) {
  const std::string blocks = "/rockfold/blocks/";
  Faces faces;
  const std::vector<Vec3> normal = read_points(file, blocks + "face_normal");
  const std::vector<Vec3> vertex = read_points(file, blocks + "vertex");
  faces.begin = read_begins(file, blocks + "face_begin", normal.size());
  const std::vector<Index> at = read_indices(file, blocks + "corner_vertex", 0, vertex.size());
  const std::vector<Index> corner = read_indices(file, blocks + "corner_begin", 0, at.size() + 1);
  const std::vector<Index> loop = read_indices(file, blocks + "loop_begin", 0, corner.size() + 1);
  const std::vector<Index> origin = read_indices(
      file, blocks + "face_origin", none, file.read_integers("/rockfold/origins/kind").size());
  for (std::size_t f = 0; f < normal.size(); ++f)
    faces.list.push_back({normal[f], vertex.at(at.at(corner.at(loop.at(f)))), origin.at(f)});
  Real size = 0;
  for (const Vec3& v : vertex)
    for (int d = 0; d < 3; ++d) size = std::max(size, std::abs(v[d] - vertex[0][d]));
  faces.tolerance = on_plane * size;
  return faces;
}

/// The triangles of one block that lie on its faces, and which of their sides are its edges.
class BlockSkin {
 public:
  BlockSkin(const Faces& faces, Index block, const std::vector<Vec3>& point)
      : faces_(faces), block_(block), point_(point) {}

  void add(const Triangle& triangle, PageSurface& out) {
    const Index face = face_of(triangle);
    if (face == none) return;  // inside: elements side by side, fanned differently
    out.corner_count.push_back(3);
    out.origin.push_back(static_cast<std::uint32_t>(std::max<Index>(0, faces_.list[face].origin)));
    for (int c = 0; c < 3; ++c) {
      const Index v = triangle.vertex[c];
      const auto [met, is_new] = local_.try_emplace(v, static_cast<std::uint32_t>(local_.size()));
      if (is_new) {
        out.point_row.push_back(v);
        out.point.push_back(point_[v]);
      }
      out.corner_point.push_back(met->second);
      out.corner_edge.push_back(is_edge(face, v, triangle.vertex[(c + 1) % 3]) ? 1 : 0);
    }
  }

 private:
  const std::vector<Index>& faces_at(Index v) {
    const auto [met, is_new] = faces_at_.try_emplace(v);
    if (is_new)
      for (Index f = faces_.begin[block_]; f < faces_.begin[block_ + 1]; ++f)
        if (std::abs(dot(faces_.list[f].normal, point_[v] - faces_.list[f].point)) <=
            faces_.tolerance)
          met->second.push_back(f);
    return met->second;
  }
  static bool holds(const std::vector<Index>& list, Index f) {
    return std::find(list.begin(), list.end(), f) != list.end();
  }
  Index face_of(const Triangle& triangle) {
    const auto& [a, b, c] = triangle.vertex;
    const Vec3 normal = cross(point_[b] - point_[a], point_[c] - point_[a]);
    const std::vector<Index> at_b = faces_at(b), at_c = faces_at(c);
    for (const Index f : faces_at(a))
      if (holds(at_b, f) && holds(at_c, f) &&
          dot(normal, faces_.list[f].normal) > same_side * norm(normal))
        return f;
    return none;
  }
  bool is_edge(Index face, Index a, Index b) {
    const std::vector<Index> at_b = faces_at(b);
    for (const Index f : faces_at(a))
      if (holds(at_b, f) &&
          std::abs(dot(faces_.list[f].normal, faces_.list[face].normal)) < distinct)
        return true;
    return false;
  }

  const Faces& faces_;
  Index block_;
  const std::vector<Vec3>& point_;
  std::map<Index, std::uint32_t> local_;
  std::map<Index, std::vector<Index>> faces_at_;
};

}  // namespace

bool has_element_surface(const File& file) {
  return file.exists("/rockfold/states") && file.exists(grid + "PointData/displacement") &&
         file.has_attribute("/rockfold/lattice", "kind") &&
         file.text_attribute("/rockfold/lattice", "kind") != "block";
}

PageSurface element_surface(const File& file, const PageSurface& coarse) {
  const std::vector<Vec3> point = read_points(file, grid + "Points");
  const std::vector<Index> corner = read_indices(file, grid + "Connectivity", 0, point.size());
  const Faces faces = read_faces(file);
  const std::vector<Index> of_tetrahedron =
      read_indices(file, grid + "CellData/block", 1, faces.begin.size());
  if (corner.size() != 4 * of_tetrahedron.size() ||
      *std::max_element(coarse.block.begin(), coarse.block.end()) + 1 >= std::ssize(faces.begin))
    throw std::out_of_range(grid);
  const std::vector<Triangle> outer = outer_faces(corner, of_tetrahedron, point);
  PageSurface out;
  out.grid = "Elements";
  out.block = coarse.block;
  out.point_begin = out.polygon_begin = {0};
  std::size_t next = 0;
  for (const Index block : coarse.block) {
    while (next < outer.size() && outer[next].block < block) ++next;
    BlockSkin skin(faces, block, point);
    for (; next < outer.size() && outer[next].block == block; ++next) skin.add(outer[next], out);
    out.point_begin.push_back(static_cast<Index>(out.point.size()));
    out.polygon_begin.push_back(static_cast<Index>(out.corner_count.size()));
  }
  return out;
}

}  // namespace rockfold
