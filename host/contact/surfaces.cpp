#include "host/contact/surfaces.hpp"

#include <algorithm>
#include <numeric>
#include <span>
#include <utility>

#include "host/cut/cells/complex.hpp"
#include "host/flatten/face_polygons.hpp"
#include "host/flatten/near_vertices.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// A convex polygon of a cell's boundary, counter-clockwise seen from outside.
struct CellPolygon {
  Index cell = none, face = none;  ///< local face
  Index origin = none;             ///< into the origins
  std::vector<Vec3> corners;       ///< m, about the table's centre
};

std::vector<Vec3> corners_of(const Polygon& polygon, bool backwards) {
  std::vector<Vec3> corners;
  for (const Vertex& v : polygon.corner) corners.push_back(v.x);
  if (backwards) std::reverse(corners.begin(), corners.end());
  return corners;
}

/// What bounds the cells of blocks that are not convex, by cell.
class CellPolygons {
 public:
  CellPolygons(const Complex& complex, const BlockArrays& blocks)
      : complex_(complex), blocks_(blocks) {
    for (const Fragment& f : complex.fragments) add(f);
    for (const FreePart& f : complex.free_parts)
      if (f.gap == none && wanted(f.cell))
        polygons_.push_back({f.cell, f.face, f.origin,
                             corners_of(complex.polygon_of(f), lies_above(f.cell, f.face))});
    for (const Beam& b : complex.beams) add(b);
    std::stable_sort(polygons_.begin(), polygons_.end(),
                     [](const CellPolygon& a, const CellPolygon& b) { return a.cell < b.cell; });
  }

  /// Those of a cell.
  std::span<const CellPolygon> of(Index cell) const {
    const auto [begin, end] = std::equal_range(
        polygons_.begin(), polygons_.end(), CellPolygon{cell, none, none, {}},
        [](const CellPolygon& a, const CellPolygon& b) { return a.cell < b.cell; });
    return {begin, end};
  }

 private:
  bool wanted(Index cell) const {
    return complex_.is_sliver[cell] == 0 && blocks_.convex[complex_.cell_block[cell]] == 0;
  }
  bool lies_above(Index cell, Index face) const {
    return is_above(complex_.cells[cell].faces[face].inside);
  }

  void add(const Fragment& f) {
    if (complex_.cell_block[f.cell[0]] == complex_.cell_block[f.cell[1]] ||
        complex_.touches_sliver(f))
      return;  // inside a block; or what beams stand for
    for (int side = 0; side < 2; ++side)
      if (wanted(f.cell[side]))
        polygons_.push_back(
            {f.cell[side], f.face[side], f.joint, corners_of(complex_.polygon_of(f), side == 1)});
  }

  void add(const Beam& b) {
    if (b.narrow || !wanted(b.cell[0])) return;
    const bool ends = b.cell[1] == none;
    if (!ends && complex_.cell_block[b.cell[0]] == complex_.cell_block[b.cell[1]]) return;
    polygons_.push_back({b.cell[0], b.face[0], ends ? b.origin : b.joint, b.polygon});
  }

  const Complex& complex_;
  const BlockArrays& blocks_;
  std::vector<CellPolygon> polygons_;
};

class Builder {
 public:
  Builder(const Complex& complex, const BlockArrays& blocks, const FaceMaterials& materials)
      : complex_(complex),
        blocks_(blocks),
        materials_(materials),
        polygons_(face_polygons(blocks)),
        cell_polygons_(complex, blocks) {}

  SurfaceArrays run() {
    out_.tolerance = complex_.planes.width_tolerance();
    for (Index b = 0; b < blocks_.block_count(); ++b)
      goes_on_the_way_ |= blocks_.stage[b] != 0 && complex_.block_is_analysed[b] != 0;
    out_.block_mass = blocks_.mass;
    std::vector<Index> cell(complex_.cells.size());
    std::iota(cell.begin(), cell.end(), 0);
    std::stable_sort(cell.begin(), cell.end(), [&](Index a, Index b) {
      return complex_.cell_block[a] < complex_.cell_block[b];
    });
    std::size_t next = 0;
    Index polygon = 0;
    for (Index b = 0; b < blocks_.block_count(); ++b) {
      const Index last_polygon = polygons_before(blocks_.face_begin[b + 1], polygon);
      const std::size_t first = next;
      while (next < cell.size() && complex_.cell_block[cell[next]] == b) ++next;
      if (complex_.block_is_analysed[b] != 0)
        add_block(b, polygon, last_polygon, std::span(cell).subspan(first, next - first));
      polygon = last_polygon;
    }
    add_hulls();
    find_edges(out_);
    return std::move(out_);
  }

 private:
  /// The first polygon, from `from` on, of face `face` or a later one.
  Index polygons_before(Index face, Index from) const {
    while (from < polygons_.size() && polygons_.polygon_face[from] < face) ++from;
    return from;
  }

  /// Of its polygons [begin, end), or of its cells.
  void add_block(Index b, Index begin, Index end, std::span<const Index> cells) {
    if (blocks_.convex[b] != 0)
      add_convex(b, begin, end, complex_.zone(cells.front()).solid);
    else
      add_cells(b, cells);
  }

  /// `solid`: that it is of; a block of several is one rock.
  void add_convex(Index b, Index begin, Index end, Index solid) {
    const Index shift = out_.vertex_count() - blocks_.vertex_begin[b];
    for (Index v = blocks_.vertex_begin[b]; v < blocks_.vertex_begin[b + 1]; ++v) {
      out_.part_vertex.push_back(out_.vertex_count());
      out_.vertex.push_back(blocks_.vertex[v]);
      out_.vertex_block.push_back(b);
    }
    for (Index p = begin; p < end; ++p) {
      for (const Index v : polygons_.polygon(p)) out_.corner_vertex.push_back(v + shift);
      end_face(blocks_.face_origin[polygons_.polygon_face[p]], solid);
    }
    end_part(b);
  }

  void add_cells(Index b, std::span<const Index> cells) {
    VertexMerger merger(out_.tolerance);
    const Index first = out_.vertex_count();
    for (const Index c : cells) {
      if (complex_.is_sliver[c] != 0) continue;
      std::vector<Index> corners;
      for (const Vertex& v : complex_.cells[c].vertices) corners.push_back(first + merger.add(v.x));
      std::sort(corners.begin(), corners.end());
      corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
      out_.part_vertex.insert(out_.part_vertex.end(), corners.begin(), corners.end());
      std::vector<bool> shown(complex_.cells[c].faces.size(), false);
      for (const CellPolygon& p : cell_polygons_.of(c))
        if (add_polygon(p, first, merger)) shown[p.face] = true;
      note_hull(complex_.cells[c], shown, first, merger);
      end_part(b);
    }
    for (const Vec3& x : merger.vertices()) {
      out_.vertex.push_back(x + complex_.planes.centre());
      out_.vertex_block.push_back(b);
    }
  }

  /// The vertices of a polygon without those that became one with their neighbours.
  static std::vector<Index> merged(const std::vector<Vec3>& polygon, Index first,
                                   VertexMerger& merger) {
    std::vector<Index> corners;
    for (const Vec3& x : polygon) {
      const Index v = first + merger.add(x);
      if (corners.empty() || corners.back() != v) corners.push_back(v);
    }
    while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
    return corners;
  }

  /// Whether three corners are left.
  bool add_polygon(const CellPolygon& p, Index first, VertexMerger& merger) {
    const std::vector<Index> corners = merged(p.corners, first, merger);
    if (corners.size() < 3) return false;
    out_.corner_vertex.insert(out_.corner_vertex.end(), corners.begin(), corners.end());
    end_face(p.origin, complex_.zone(p.cell).solid);
    return true;
  }

  /// The faces of a part's cell; far are those on which it shows nothing.
  void note_hull(const CellView& cell, const std::vector<bool>& shown, Index first,
                 VertexMerger& merger) {
    for (std::size_t f = 0; f < cell.faces.size(); ++f) {
      std::vector<Vec3> polygon;
      for (Index c = 0; c < cell.faces[f].count; ++c)
        polygon.push_back(cell.vertices[cell.corners[cell.faces[f].begin + c].vertex].x);
      const std::vector<Index> corners = merged(polygon, first, merger);
      if (corners.size() >= 3) hull_faces_.push_back({out_.part_count(), corners, !shown[f]});
    }
  }

  void add_hulls() {
    std::size_t next = 0;
    for (Index p = 0; p < out_.part_count(); ++p) {
      out_.part_hull_begin.push_back(out_.face_count());
      out_.part_far_begin.push_back(static_cast<Index>(out_.part_far_face.size()));
      for (; next < hull_faces_.size() && hull_faces_[next].part == p; ++next) {
        if (hull_faces_[next].far) out_.part_far_face.push_back(out_.face_count());
        add_hull_face(hull_faces_[next].corners, out_);
      }
    }
    out_.part_hull_begin.push_back(out_.face_count());
    out_.part_far_begin.push_back(static_cast<Index>(out_.part_far_face.size()));
  }

  void end_face(Index origin, Index solid) {
    out_.corner_begin.push_back(static_cast<Index>(out_.corner_vertex.size()));
    const bool joint = origin != none && blocks_.origins[origin].kind == FaceOrigin::Kind::joint;
    const bool wall = origin != none && goes_on_the_way_ &&
                      blocks_.origins[origin].kind == FaceOrigin::Kind::excavation;
    out_.face_joint.push_back(joint || wall ? origin : none);
    out_.face_material.push_back(joint  ? joint_surface(origin, solid)
                                 : wall ? materials_.intact
                                        : free_material(origin));
  }

  /// Of one side of a joint.
  Index joint_surface(Index origin, Index solid) const {
    const auto s = static_cast<std::size_t>(solid);
    const bool is_interface = origin >= complex_.first_interface;
    if (is_interface && s < materials_.of_interface.size() && materials_.of_interface[s] != none)
      return materials_.of_interface[s];
    return blocks_.origins[origin].joint_material;
  }

  Index free_material(Index origin) const {
    if (origin == none || blocks_.origins[origin].kind != FaceOrigin::Kind::solid_face) return none;
    const auto solid = static_cast<std::size_t>(blocks_.origins[origin].solid);
    return solid < materials_.of_solid.size() ? materials_.of_solid[solid] : none;
  }

  void end_part(Index b) {
    out_.part_block.push_back(b);
    out_.part_vertex_begin.push_back(static_cast<Index>(out_.part_vertex.size()));
    out_.part_face_begin.push_back(out_.face_count());
  }

  const Complex& complex_;
  const BlockArrays& blocks_;
  const FaceMaterials& materials_;
  const PolygonMesh polygons_;
  const CellPolygons cell_polygons_;
  bool goes_on_the_way_ = false;  ///< some rock
  struct HullFace {
    Index part;
    std::vector<Index> corners;
    bool far;
  };
  std::vector<HullFace> hull_faces_;  ///< of cells, by part
  SurfaceArrays out_;
};

}  // namespace

SurfaceArrays contact_surfaces(const Cutting& cutting, const BlockArrays& blocks,
                               const FaceMaterials& materials) {
  return Builder(*cutting.complex, blocks, materials).run();
}

}  // namespace rockfold
