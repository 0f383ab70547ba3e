// A convex cell and the one operation of the program's topology: splitting it by a plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "host/exact/plane_table.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// A convex polyhedron bounded by half-spaces. Each face's loop runs counter-clockwise seen from outside.
/// Example: a tetrahedron has 4 vertices, 4 faces of 3 corners each, 12 corners.
struct ConvexCell {
  struct Face {
    HalfSpaceId inside = none;  ///< the half-space that holds the cell
    std::int32_t begin = 0;     ///< first corner
    std::int32_t count = 0;     ///< corners
  };
  struct Corner {
    std::int32_t vertex;    ///< into `vertices`
    HalfSpaceId neighbour;  ///< `inside` of the face across the edge from this corner to the next
  };
  std::vector<Vertex> vertices;
  std::vector<Face> faces;
  std::vector<Corner> corners;

  void clear() {
    vertices.clear();
    faces.clear();
    corners.clear();
  }
};

/// A cell's arrays wherever they are stored; indices as in ConvexCell.
struct CellView {
  std::span<const Vertex> vertices;
  std::span<const ConvexCell::Face> faces;
  std::span<const ConvexCell::Corner> corners;

  CellView(std::span<const Vertex> v, std::span<const ConvexCell::Face> f,
           std::span<const ConvexCell::Corner> c)
      : vertices(v), faces(f), corners(c) {}
  CellView(const ConvexCell& cell)  // NOLINT(google-explicit-constructor): a view of it
      : vertices(cell.vertices), faces(cell.faces), corners(cell.corners) {}
};

/// A ball that holds the cell: most planes miss it, which one product shows.
struct BoundingBall {
  Vec3 centre{};
  Real radius = 0;
};
BoundingBall bounding_ball(const CellView& cell);

/// Where a cell lies with respect to a plane.
enum class CellSide : std::int8_t { below = -1, split = 0, above = 1 };

struct Polygon;  // polygon.hpp

/// Splits cells; keeps its workspace between calls so that nothing allocates once it has grown.
class CellSplitter {
 public:
  explicit CellSplitter(const PlaneTable& planes) : planes_(planes) {}

  /// Finds the side of each vertex; `split` if some lie strictly above and some strictly below.
  CellSide classify(const CellView& cell, Index plane);

  /// After classify() returned `split`: the polygon in which the plane cuts the cell. O(corners).
  void section(const CellView& cell, Index plane, Polygon& section);

  /// After classify() returned `split`: writes the two parts. Either pointer may be null. O(corners).
  void split(const CellView& cell, Index plane, ConvexCell* below, ConvexCell* above);

 private:
  struct CutEdge {
    std::int32_t low, high;  // vertices of the edge, low < high
    std::int32_t vertex;     // the new vertex, numbered after the cell's own
  };
  void make_cut_vertices(const CellView& cell, Index plane);
  std::int32_t find_cut_vertex(std::int32_t u, std::int32_t v) const;
  void write_part(const CellView& cell, HalfSpaceId inside, ConvexCell& part);
  void write_face(const CellView& cell, const ConvexCell::Face& face, HalfSpaceId inside,
                  ConvexCell& part);
  template <class Visit>
  void for_each_in_cap(const Visit& visit) const;
  void write_cap(HalfSpaceId inside, ConvexCell& part);
  std::int32_t part_vertex(const CellView& cell, std::int32_t vertex, HalfSpaceId inside,
                           ConvexCell& part);

  const PlaneTable& planes_;
  std::vector<std::int8_t> side_;  // of each vertex
  bool has_cut_vertices_ = false;  // since the last classify()
  std::vector<CutEdge> cut_edges_;
  std::vector<Vertex> cut_vertices_;
  std::vector<std::int32_t> renumbered_;  // vertex → vertex of the part being written
  struct CapEdge {
    std::int32_t from,
        to;  // in the face's sense; vertices of the part, or of the cell and the new ones
    HalfSpaceId face;
  };
  std::vector<CapEdge> cap_edges_;
};

/// Volume and first moment of a convex cell.
struct CellMoments {
  Real volume = 0;  ///< m³
  Vec3 first{};     ///< ∫x dV about the table's centre, m⁴
};
/// In exact arithmetic where doubles might lose more than 1e-9 of the volume.
CellMoments cell_moments(const CellView& cell, const PlaneTable& planes);

/// In doubles: the volume off by some 1e-15·L of the surface, and not below 0.
struct RoundedMeasure {
  CellMoments moments;
  Real area = 0;              ///< m², of the surface
  bool loses_digits = false;  ///< the volume may be off by more than 1e-9 of it
};
RoundedMeasure measure_in_doubles(const CellView& cell);

/// The part of a cell inside all of the half-spaces. Empty if nothing is left.
ConvexCell clip(const PlaneTable& planes, const CellView& cell,
                const std::vector<HalfSpaceId>& inside);

/// The cell inside all of the half-spaces, by clipping a cube of half-width `reach` about the table's centre, whose six
/// planes are added to the table first. Empty if nothing is left.
ConvexCell clip_cube(PlaneTable& planes, Real reach, const std::vector<HalfSpaceId>& inside);

/// The six planes of an axis-aligned box, positions relative to the table's centre: xmin xmax ymin ymax zmin zmax.
ConvexCell make_box(PlaneTable& planes, const Vec3& min, const Vec3& max);

}  // namespace rockfold
