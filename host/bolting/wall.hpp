// A wall of the cut rock, unrolled: the free faces that bolts are drilled from, and a sheet to lay grids on.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "host/box_tree.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// A flat part of a wall, as it lies on the sheet: the point (u, v) is at origin + (u − u0)·along_u + (v − v0)·along_v.
struct WallStrip {
  Vec3 origin{};                 ///< m
  Vec3 along_u{}, along_v{};     ///< unit
  Vec3 across{};                 ///< unit: bolts look for the face along it, both ways
  std::array<Real, 2> u{}, v{};  ///< m, its extent on the sheet
  Real reach = 0;                ///< m, how far a face may be from the strip's plane
  Index side = none;             ///< its faces' number, or none: any
  /// Planes that bound it besides, where a tunnel bends: point, and normal along v.
  std::array<Vec3, 2> end_point{}, end_normal{};
};

/// A rectangle of the sheet that carries one grid.
struct WallPanel {
  std::string name;              ///< "tunnel", "rock.xmin"
  std::array<Real, 2> u{}, v{};  ///< m
  bool around = false;           ///< u runs round an axis, 0 at the crown; v along it
  std::vector<Index> strips;
};

/// Faces of blocks that stay and are free, on the named faces of a solid or an excavation.
///
/// Tunnels, cylinders and prisms are unrolled as seen from outside: v runs along the path from its start, u to the right
/// of it, 0 at the crown. Plane faces are panels side by side, as seen from the opening: u level to the right, v up the
/// dip. Surfaces of triangles are projected on the mean plane of those that look the same way.
class Wall {
 public:
  /// Throws Error(model) at `place` where no free face of the cut rock lies on the wall.
  Wall(const BlockArrays& blocks, const Model& model, const WallFaces& faces, const Place& place);

  struct Hit {
    Index face = none;
    Vec3 point{};  ///< m
  };
  /// The free face at a point of the sheet, if there is one. Corners of a section and bends are on the sheet, whatever the
  /// last digit of u and v: they belong to the edge to the right of them, and to the straight after them. A point on
  /// a joint is on the face to the right of it and up; one on the sheet's rim is moved inside by 1e-6 of its width.
  std::optional<Hit> at(const WallPanel& panel, Real u, Real v) const;
  /// A point of a face, on the sheet.
  std::array<Real, 2> on_sheet(std::size_t face_number, const Vec3& point) const;

  /// The number of the face that a point lies on, to a thousandth of the model's size.
  std::optional<std::size_t> face_at(const Vec3& point) const;

  const std::vector<WallPanel>& panels() const { return panels_; }
  const std::vector<Index>& faces() const { return faces_; }
  Index strip_of(std::size_t face_number) const { return strip_of_face_[face_number]; }
  const WallStrip& strip(Index s) const { return strips_[s]; }
  Real area() const { return area_; }

 private:
  void lay_sides(const Shape& shape, const std::string& name);
  void lay_planes(const Shape& shape, const std::string& owner);
  void lay_surfaces(const std::string& name);
  void add_panel_for(const std::vector<std::size_t>& members, const Vec3& normal, Real reach,
                     std::string name);

  std::optional<Real> u_on(const WallPanel& panel, const WallStrip& strip, Real u) const;
  bool between_ends(const WallPanel& panel, const WallStrip& strip, const Vec3& point) const;
  std::optional<Hit> face_of(const WallPanel& panel, Index s, const Vec3& point) const;

  const BlockArrays& blocks_;
  Real size_ = 0;                     ///< m, of the model
  std::vector<Index> faces_;          ///< of blocks, ascending
  std::vector<Index> side_of_face_;   ///< [faces_] which face of the wall's shape it lies on
  std::vector<Index> strip_of_face_;  ///< into strips_
  std::vector<WallStrip> strips_;
  std::vector<WallPanel> panels_;
  BoxTree tree_;
  Real area_ = 0;  ///< m²
};

}  // namespace rockfold
