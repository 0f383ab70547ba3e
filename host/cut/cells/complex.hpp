// The complex of convex cells that a model is cut into: the one data structure behind blocks, covers and interfaces.
#pragma once

#include <map>
#include <memory>
#include <new>
#include <tuple>
#include <utility>
#include <vector>

#include "host/cut/cells/convex_cell.hpp"
#include "host/cut/cells/patch.hpp"
#include "host/cut/cells/polygon.hpp"
#include "host/exact/plane_table.hpp"
#include "src/arrays/block_arrays.hpp"

namespace rockfold {

/// For arrays that are filled on all threads at once, each page by the thread that first writes to it: resize() leaves new
/// elements unwritten. For types that may be copied byte by byte.
template <class T>
struct UnwrittenAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = UnwrittenAllocator<U>;
  };
  void construct(T*) {}
  template <class... Args>
  void construct(T* at, Args&&... args) {
    ::new (static_cast<void*>(at)) T(std::forward<Args>(args)...);
  }
};
template <class T>
using UnwrittenVector = std::vector<T, UnwrittenAllocator<T>>;

/// Convex cells in flat arrays; face and vertex numbers are local to their cell.
class CellStore {
 public:
  Index size() const { return static_cast<Index>(face_begin_.size()) - 1; }
  CellView operator[](Index cell) const;
  void append(const CellView& cell);
  /// Keeps the first `count` cells.
  void truncate(Index count);
  /// The chosen cells of several stores, one store after another, copied on all threads.
  /// chosen[s] lists cells of *stores[s], ascending.
  static CellStore join(const std::vector<const CellStore*>& stores,
                        const std::vector<std::vector<Index>>& chosen);
  /// Faces of all cells before this one: cell c's face f has the global number face_begin(c) + f.
  std::int64_t face_begin(Index cell) const { return face_begin_[cell]; }

 private:
  UnwrittenVector<Vertex> vertices_;
  UnwrittenVector<ConvexCell::Face> faces_;
  UnwrittenVector<ConvexCell::Corner> corners_;
  std::vector<std::int64_t> vertex_begin_{0}, face_begin_{0}, corner_begin_{0};
};

/// A convex area shared by two cells on one plane. Real where a joint or the boundary of an excavation lies there,
/// virtual (glue) where none does.
struct Fragment {
  Index cell[2] = {none, none};  ///< below and above the plane
  Index face[2] = {none, none};  ///< local face of each
  Index joint = none;            ///< into Complex::origins; none = virtual: the cells are one body
  Index instance = none;  ///< JointPatch::instance of the joint; none = virtual or no joint's
  Index polygon = none;   ///< into Complex::polygons; none = the whole face of both cells
  Real area = 0;          ///< m²
  bool narrow = false;    ///< glue narrower than the tolerance: it joins nothing
  bool dead_end = false;  ///< of a joint that has one block on both sides
};

/// A convex part of a cell's face with no rock on the other side.
struct FreePart {
  Index cell = none;
  Index face = none;     ///< local
  Index origin = none;   ///< into Complex::origins
  Index polygon = none;  ///< into Complex::polygons; none = the whole face
  Real area = 0;         ///< m²
  Index gap =
      none;  ///< none = nothing behind; else a void narrower than the tolerance: beams tell what is
};

/// What a face of a wide cell meets straight through slivers: cells, or voids, narrower than the tolerance. A beam that no
/// joint crosses joins its two cells; else it is their interface. Each is there twice, once from either cell.
struct Beam {
  Index cell[2] = {none,
                   none};  ///< where it starts and ends; cell[1] = none: it ends where rock does
  Index face[2] = {none, none};  ///< local face of each
  Index start =
      none;  ///< 2·fragment + side of cell[0] in it; none = at a free part before a narrow void
  Index joint =
      none;  ///< into Complex::origins, the first that it crosses; none = the cells are one body
  Index instance = none;  ///< JointPatch::instance of that joint
  Index origin =
      none;  ///< into Complex::origins: the free face where it ends, if it reaches no cell
  std::vector<Vec3>
      polygon;  ///< m about the table's centre, on the first cell's face, counter-clockwise from outside
  Real area = 0;                 ///< m²
  bool narrow = false;           ///< about as narrow as the tolerance: nothing is shown by it
  std::vector<Index> fragments;  ///< of joints, that it crosses
  std::vector<Index> slivers;    ///< cells of rock that it passes
};

/// A convex part of a shape, or a shape with one closed surface.
struct Body {
  enum class Role : std::uint8_t { solid, excavation, merge };
  Role role = Role::solid;
  Index owner = none;  ///< into Model::solids, excavations or merges
  std::vector<HalfSpaceId>
      inside;  ///< a convex body is their intersection; empty: a closed surface
  Index facet_begin = 0, facet_end = 0;  ///< into Complex::facets
  Box box;
};

/// What a cell lies in; the same for all cells that joints cut from one cell.
struct Zone {
  Index solid = none;         ///< the solid whose rock it is
  Index stage = 0;            ///< at which it is excavated; 0 = it stays
  std::vector<Index> within;  ///< solids named by joints' `within` whose shapes hold it, ascending
  std::vector<Index> merges;  ///< merge regions that hold it, ascending
  bool operator==(const Zone&) const = default;
  bool operator<(const Zone& o) const {
    return std::tie(solid, stage, within, merges) < std::tie(o.solid, o.stage, o.within, o.merges);
  }
};

struct Complex {
  explicit Complex(PlaneTable table) : planes(std::move(table)) {}

  PlaneTable planes;
  /// Joints, faces of solids, of excavations, interfaces, then what lies on faces of several solids.
  std::vector<FaceOrigin> origins;
  std::vector<bool> adds_solid;  ///< [solids] block operation '+', else '−'
  std::vector<Body> bodies;      ///< of the solids in their order, of excavations, of merge regions
  std::vector<Facet> facets;     ///< of all bodies
  std::vector<JointPatch> joints;  ///< by plane in the order of precedence
  Index first_interface = none;    ///< into origins: joints between solids are those from here on
  /// Of these joints. Kinds of solids are few: those of one have the same interface, and the same is said of them in pairs.
  struct Interfaces {
    std::vector<Index> kind;                   ///< [solids]
    std::vector<std::vector<Index>> material;  ///< [kinds][kinds] joint material; none = welded
    std::vector<std::uint8_t> given;           ///< [solids] 1: it has an interface
    std::map<std::pair<Index, Index>, Index> origin;  ///< into origins, of solid and material
  } interfaces;
  ByPlane facets_by_plane, joints_by_plane;

  CellStore cells;  ///< rock only
  std::vector<Zone> zones;
  std::vector<Index> cell_zone;      ///< [cells] into zones
  std::vector<Index> cell_block;     ///< [cells] blocks ordered by centroid
  std::vector<CellMoments> moments;  ///< [cells]
  std::vector<std::uint8_t>
      is_sliver;  ///< [cells] narrower than the tolerance: part of a block, never one
  /// [cells] slivers that other blocks, or free faces, show through: what is on their two sides is the surface, not they.
  std::vector<std::uint8_t> is_hidden;
  Index block_count = 0;
  std::vector<Index> block_stage;               ///< [blocks] at which it is excavated; 0 = it stays
  std::vector<std::uint8_t> block_is_analysed;  ///< [blocks] 1: it is there as an analysis begins

  std::vector<Fragment> fragments;   ///< ordered by plane
  std::vector<FreePart> free_parts;  ///< ordered by plane
  std::vector<Polygon> polygons;     ///< of the fragments and free parts that are no whole face
  std::vector<Beam> beams;           ///< ordered by where they start

  const Zone& zone(Index cell) const { return zones[cell_zone[cell]]; }
  /// Whether the block of a cell is there as an analysis begins.
  bool is_analysed(Index cell) const { return block_is_analysed[cell_block[cell]] != 0; }
  bool touches_hidden(const Fragment& f) const {
    return is_hidden[f.cell[0]] != 0 || is_hidden[f.cell[1]] != 0;
  }
  bool touches_sliver(const Fragment& f) const {
    return is_sliver[f.cell[0]] != 0 || is_sliver[f.cell[1]] != 0;
  }
  Polygon polygon_of(const Fragment& f) const;
  Polygon polygon_of(const FreePart& f) const;
};

}  // namespace rockfold
