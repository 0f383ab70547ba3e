#include "host/contact/lattice_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "host/flatten/near_vertices.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// A corner in m and in units of the lattice's edges.
struct Corner {
  Vec3 x{}, xi{};
};
using Polygon = std::vector<Corner>;

/// cos 10°: faces whose normals are nearer to each other look the same way. As rock bends, one of two such faces does not count as what keeps
/// another block away from the other.
constexpr Real alike = 0.984807753012208;

/// Cuts one face by planes normal·ξ = offset of the lattice. Corners within the tolerance of a plane are on it.
class Knife {
 public:
  /// `inward`: the way into the rock in units of the edges; `tolerance`: a length in those units.
  Knife(const Vec3& inward, Real tolerance) : inward_(inward), tolerance_(tolerance) {}

  /// What lies where normal·ξ ≥ offset (Sutherland & Hodgman 1974). A polygon in the plane is on the side that has the rock.
  Polygon clip(const Polygon& p, const Vec3& normal, Real offset) const {
    const Real on = tolerance_ * norm(normal);
    std::vector<Real> height;
    for (const Corner& c : p) height.push_back(dot(normal, c.xi) - offset);
    const auto [low, high] = std::minmax_element(height.begin(), height.end());
    if (p.empty() || *high <= on)
      return !p.empty() && *low >= -on && dot(normal, inward_) > 0 ? p : Polygon{};
    if (*low >= -on) return p;
    Polygon kept;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const std::size_t next = (i + 1) % p.size();
      const Real a = height[i], b = height[next];
      if (a >= -on) kept.push_back(p[i]);
      if ((a > on && b < -on) || (a < -on && b > on))
        kept.push_back(between(p[i], p[next], a / (a - b)));
    }
    return kept;
  }

  /// visit(i, slab) for each slab i ≤ ξ_d ≤ i + 1 that the polygon meets.
  template <class Visit>
  void for_each_slab(const Polygon& p, int d, const Visit& visit) const {
    if (p.size() < 3) return;
    Real low = p[0].xi[d], high = low;
    for (const Corner& c : p) low = std::min(low, c.xi[d]), high = std::max(high, c.xi[d]);
    const auto first = static_cast<Index>(std::floor(low + tolerance_));
    const Index last = static_cast<Index>(std::ceil(high - tolerance_)) - 1;
    if (last < first) return visit(inward_[d] > 0 ? first : last, p);
    Vec3 axis{};
    axis[d] = 1;
    for (Index i = first; i <= last; ++i) {
      const Polygon above = i == first ? p : clip(p, axis, static_cast<Real>(i));
      const Polygon slab = i == last ? above : clip(above, -1.0 * axis, -static_cast<Real>(i + 1));
      if (slab.size() >= 3) visit(i, slab);
    }
  }

 private:
  static Corner between(const Corner& a, const Corner& b, Real t) {
    return {a.x + t * (b.x - a.x), a.xi + t * (b.xi - a.xi)};
  }

  Vec3 inward_;
  Real tolerance_;
};

/// A tetrahedron of a cell, in units of the edges from the cell's lower corner.
std::array<Vec3, 4> corners_of(const CellSplit& split, const CellPart& part) {
  std::array<Vec3, 4> x{};
  for (int a = 0; a < 4; ++a)
    for (int d = 0; d < 3; ++d) x[a][d] = 0.5 * split.node[part.node[a]][d];
  return x;
}

class Division {
 public:
  Division(const SurfaceArrays& blocks, const Lattice& lattice, bool curved)
      : in_(blocks), lattice_(lattice), curved_(curved) {
    Real shortest = norm(lattice.edge[0]);
    for (const Vec3& edge : lattice.edge) shortest = std::min(shortest, norm(edge));
    tolerance_ = in_.tolerance / shortest;
  }

  SurfaceArrays run() {
    out_.tolerance = in_.tolerance;
    out_.part_far_begin = {0};
    out_.block_mass = in_.block_mass;
    Index part = 0;
    for (Index b = 0; b < in_.block_count(); ++b) {
      const Index first = part;
      while (part < in_.part_count() && in_.part_block[part] == b) ++part;
      if (part > first) divide_block(b, first, part);
    }
    add_hull_faces();
    find_edges(out_, edges_);
    return std::move(out_);
  }

 private:
  using PartOfCell = std::pair<Index, int>;
  struct Face {
    Polygon polygon;
    Index whole;  ///< the face that it is a piece of
  };

  void divide_block(Index b, Index first, Index last) {
    VertexMerger merger(in_.tolerance);
    const Index shift = out_.vertex_count();
    const Vec3 centre = in_.vertex[in_.part_vertex[in_.part_vertex_begin[first]]];
    for (Index p = first; p < last; ++p) {
      std::map<PartOfCell, std::vector<Face>> parts;
      for (Index f = in_.part_face_begin[p]; f < in_.part_face_begin[p + 1]; ++f)
        divide_face(f, parts);
      const Index before = out_.part_count();
      for (const auto& [at, faces] : parts) add_part(b, faces, centre, shift, merger);
      add_bounds(p, before, [&](Index v) { return shift + merger.add(in_.vertex[v] - centre); });
    }
    for (const Vec3& x : merger.vertices()) {
      out_.vertex.push_back(x + centre);
      out_.vertex_block.push_back(b);
    }
  }

  void divide_face(Index f, std::map<PartOfCell, std::vector<Face>>& parts) const {
    Polygon whole;
    for (Index c = in_.corner_begin[f]; c < in_.corner_begin[f + 1]; ++c) {
      const Vec3 x = in_.vertex[in_.corner_vertex[c]];
      whole.push_back({x, lattice_.to_local(x - lattice_.origin)});
    }
    const Knife knife(lattice_.to_local(-1.0 * normal(f)), tolerance_);
    const auto keep = [&](Index cell, int part, const Polygon& polygon) {
      if (polygon.size() >= 3) parts[{cell, part}].push_back({polygon, f});
    };
    knife.for_each_slab(whole, 0, [&](Index i, const Polygon& slab) {
      knife.for_each_slab(slab, 1, [&](Index j, const Polygon& rod) {
        knife.for_each_slab(rod, 2, [&](Index k, const Polygon& polygon) {
          divide_in_cell({i, j, k}, polygon, knife, keep);
        });
      });
    });
  }

  template <class Keep>
  void divide_in_cell(const std::array<Index, 3>& ijk, const Polygon& polygon, const Knife& knife,
                      const Keep& keep) const {
    const Index cell = lattice_.cell_index(ijk[0], ijk[1], ijk[2]);
    if (lattice_.kind == LatticeKind::hex8) return keep(cell, 0, polygon);
    const CellSplit& split = lattice_.split(cell);
    const Vec3 corner{Real(ijk[0]), Real(ijk[1]), Real(ijk[2])};
    for (int t = 0; t < split.first_split_parts(); ++t) {
      const std::array<Vec3, 4> x = corners_of(split, split.part[t]);
      Polygon left = polygon;
      for (int a = 0; a < 4 && left.size() >= 3; ++a) {
        const Vec3 &p = x[(a + 1) % 4], &q = x[(a + 2) % 4], &r = x[(a + 3) % 4];
        Vec3 n = cross(q - p, r - p);
        if (dot(n, x[a] - p) < 0) n = -1.0 * n;
        left = knife.clip(left, n, dot(n, corner + p));
      }
      keep(cell, t, left);
    }
  }

  void add_part(Index b, const std::vector<Face>& faces, const Vec3& centre, Index shift,
                VertexMerger& merger) {
    std::vector<Index> hull;
    for (const Face& face : faces) {
      std::vector<Index> corners;
      for (const Corner& c : face.polygon) {
        const Index v = shift + merger.add(c.x - centre);
        if (corners.empty() || corners.back() != v) corners.push_back(v);
      }
      while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
      if (corners.size() < 3) continue;
      hull.insert(hull.end(), corners.begin(), corners.end());
      if (!curved_ || in_.face_joint[face.whole] == none) {
        add_face(corners, face.whole, none);
        continue;
      }
      for_each_triangle(corners, shift, merger, [&](const std::vector<Index>& t) {
        Vec3 middle{};
        for (const Index v : t) middle += (1.0 / 3) * merger.vertices()[v - shift];
        add_face(t, face.whole, shift + merger.add(middle));
      });
    }
    if (hull.empty()) return;
    std::sort(hull.begin(), hull.end());
    hull.erase(std::unique(hull.begin(), hull.end()), hull.end());
    out_.part_vertex.insert(out_.part_vertex.end(), hull.begin(), hull.end());
    out_.part_vertex_begin.push_back(static_cast<Index>(out_.part_vertex.size()));
    out_.part_face_begin.push_back(out_.face_count());
    out_.part_block.push_back(b);
  }

  void add_face(const std::vector<Index>& corners, Index whole, Index centre) {
    out_.corner_vertex.insert(out_.corner_vertex.end(), corners.begin(), corners.end());
    out_.corner_begin.push_back(static_cast<Index>(out_.corner_vertex.size()));
    out_.face_joint.push_back(in_.face_joint[whole]);
    out_.face_material.push_back(in_.face_material[whole]);
    out_.face_centre.push_back(centre);
    whole_.push_back(whole);
  }

  /// Triangles from the corner that is lowest in a direction which is nobody's own: on both sides of a joint the same.
  template <class Visit>
  void for_each_triangle(std::vector<Index> corners, Index shift, const VertexMerger& merger,
                         const Visit& visit) const {
    constexpr Vec3 direction{0.5377, 0.6180, 0.5736};
    const auto height = [&](Index v) { return dot(direction, merger.vertices()[v - shift]); };
    std::rotate(corners.begin(),
                std::min_element(corners.begin(), corners.end(),
                                 [&](Index a, Index b) { return height(a) < height(b); }),
                corners.end());
    for (std::size_t i = 1; i + 1 < corners.size(); ++i)
      visit({corners[0], corners[i], corners[i + 1]});
  }

  /// Gives each part from `first` on, all of convex part p, what bounds that where it looks another way than all of its own.
  /// `number`: of a vertex of the blocks.
  template <class Number>
  void add_bounds(Index p, Index first, const Number& number) {
    if (first == out_.part_count()) return;
    const auto& begin = in_.has_hull(p) ? in_.part_hull_begin : in_.part_face_begin;
    const Index shift = static_cast<Index>(hull_faces_.size()) - begin[p];
    for (Index f = begin[p]; f < begin[p + 1]; ++f) {
      hull_faces_.emplace_back();
      for (Index c = in_.corner_begin[f]; c < in_.corner_begin[f + 1]; ++c)
        hull_faces_.back().push_back(number(in_.corner_vertex[c]));
    }
    std::vector<PartEdge> edges;  // of a convex block, patches have all that is near them
    for (Index e = in_.part_edge_begin[p]; in_.has_hull(p) && e < in_.part_edge_begin[p + 1]; ++e)
      edges.push_back({none,
                       {number(in_.edge_vertex[2 * e]), number(in_.edge_vertex[2 * e + 1])},
                       {shift + in_.edge_face[2 * e], shift + in_.edge_face[2 * e + 1]}});
    for (Index part = first; part < out_.part_count(); ++part) {
      std::vector<std::uint8_t> far;
      for (Index f = begin[p]; f < begin[p + 1]; ++f) {
        far.push_back(looks_another_way(part, f) ? 1 : 0);
        if (far.back() != 0) out_.part_far_face.push_back(shift + f);
      }
      out_.part_far_begin.push_back(static_cast<Index>(out_.part_far_face.size()));
      for (PartEdge e : edges) {
        e.part = part;
        e.far = far[e.face[0] - shift - begin[p]] & far[e.face[1] - shift - begin[p]];
        edges_.push_back(e);
      }
    }
  }

  bool looks_another_way(Index part, Index f) const {
    const Vec3 n = normal(f);
    for (Index g = out_.part_face_begin[part]; g < out_.part_face_begin[part + 1]; ++g)
      if (dot(normal(whole_[g]), n) > alike) return false;
    return true;
  }

  /// Numbers them after the faces of all parts.
  void add_hull_faces() {
    const Index shift = out_.face_count();
    for (const std::vector<Index>& corners : hull_faces_) add_hull_face(corners, out_);
    out_.face_centre.resize(out_.face_count(), none);
    for (Index& f : out_.part_far_face) f += shift;
    for (PartEdge& e : edges_)
      for (Index& f : e.face) f += shift;
  }

  /// The unit outward normal of a face of the blocks.
  Vec3 normal(Index f) const {
    const Index begin = in_.corner_begin[f];
    const Vec3 o = in_.vertex[in_.corner_vertex[begin]];
    Vec3 sum{};
    for (Index c = begin + 1; c + 1 < in_.corner_begin[f + 1]; ++c)
      sum += cross(in_.vertex[in_.corner_vertex[c]] - o, in_.vertex[in_.corner_vertex[c + 1]] - o);
    return normalized(sum);
  }

  const SurfaceArrays& in_;
  const Lattice& lattice_;
  bool curved_;
  Real tolerance_;  ///< that of the surfaces in units of the lattice's shortest edge
  SurfaceArrays out_;
  std::vector<Index> whole_;                    ///< [F] of out_, into the faces of in_
  std::vector<std::vector<Index>> hull_faces_;  ///< corners of each
  std::vector<PartEdge> edges_;                 ///< of what the parts are patches of
};

}  // namespace

SurfaceArrays divide_surfaces(const SurfaceArrays& blocks, const Lattice& lattice, bool curved) {
  return Division(blocks, lattice, curved).run();
}

SurfaceArrays contact_surfaces(const Cutting& cutting, const BlockArrays& blocks,
                               const CoverArrays& covers, const FaceMaterials& materials) {
  SurfaceArrays surfaces = contact_surfaces(cutting, blocks, materials);
  const LatticeKind kind = covers.lattice.kind;
  if (kind == LatticeKind::block) return surfaces;
  return divide_surfaces(surfaces, covers.lattice,
                         kind == LatticeKind::hex8 || covers.functions() > 1);
}

}  // namespace rockfold
