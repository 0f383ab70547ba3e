// Blocks that a joint pyramid and a tunnel make: Goodman & Shi (1985), chapter 8.
// docs/block_theory.md, "Tunnels".
//
// A block is the pyramid from its apex on, as far as the tunnel: seen along the axis, the angle
// between the pyramid's two outermost edges, cut off by the section. It is finite where both of them
// hit the tunnel; the maximum block is the one whose outermost edges just touch it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "host/keyblock/theory/theory_block.hpp"
#include "src/base/types.hpp"

namespace rockfold {

using Point2 = std::array<Real, 2>;

/// Axes of a tunnel and its section in them.
struct TunnelFrame {
  Vec3 axis{}, right{}, up{};   ///< unit, right × axis = up … looking along the axis
  std::vector<Point2> section;  ///< m, counter-clockwise, x along `right`, y along `up`

  Point2 flat(const Vec3& x) const;
  Vec3 lifted(const Point2& q) const;
};
TunnelFrame tunnel_frame(Real trend, Real plunge, std::vector<Point2> section);
/// Whether the section has no inward corner.
bool is_convex(const std::vector<Point2>& section);

/// One joint pyramid beside one tunnel.
class TunnelPyramid {
 public:
  /// `normals`: of the pyramid, outward. Nothing where the pyramid is empty or has no interior, or
  /// holds the axis (in either sense, to direction_tolerance): then no block is finite.
  static std::optional<TunnelPyramid> make(const TunnelFrame& frame, std::span<const Vec3> normals);

  /// Apex of the maximum block.
  const Point2& apex() const { return apex_; }
  TheoryShape maximum_block() const;
  /// The block with its apex there; nothing where it is not finite or has no volume. The section
  /// must be convex.
  std::optional<TheoryShape> block_at(const Point2& apex) const;
  /// The two outermost directions, first to last counter-clockwise.
  const std::array<Point2, 2>& sides() const { return sides_; }
  /// Least and greatest of side × (p) that an apex p of a finite block may have:
  /// sides()[0] × p ≥ limits()[0], sides()[1] × p ≤ limits()[1].
  const std::array<Real, 2>& limits() const { return limits_; }

 private:
  TunnelPyramid(const TunnelFrame& frame, std::span<const Vec3> normals)
      : frame_(&frame), normals_(normals.begin(), normals.end()) {}
  bool find_sides(std::span<const Vec3> edges);
  TheoryShape measure(const Point2& apex, const std::vector<Point2>& chain) const;
  void add_triangle(TheoryShape& shape, const Point2& u, const Point2& v) const;
  struct Fibre {
    Real length;
    std::size_t high, low;  ///< the faces at its ends
  };
  Fibre fibre(const Point2& q) const;

  const TunnelFrame* frame_;
  std::vector<Vec3> normals_;
  std::array<Point2, 2> sides_{};
  std::array<Real, 2> limits_{};
  std::array<std::size_t, 2> touch_{};  ///< section corners where the outermost edges touch
  std::vector<Point2> inner_;           ///< projected edges between the sides
  Point2 apex_{};
};

}  // namespace rockfold
