// Which element holds a point.
#pragma once

#include "host/cover/cover.hpp"
#include "host/cover/lattice/piece_index.hpp"

namespace rockfold {

/// A part of the rock that holds a point: a part of a regular lattice cell, or a piece.
struct Holder {
  Index element = none;  ///< numbered as in CoverArrays
  Index other = none;    ///< of the second of two overlaid splits
  Index block = none;
  Index rock = none;          ///< cell of the complex
  Index lattice_cell = none;  ///< that it lies in: that of `element`, but for slivers
  int part = 0;               ///< of that lattice cell
  Real violation = 0;         ///< m, how far outside the point is; ≤ 0 inside

  bool found() const { return element != none; }
};

class Locator {
 public:
  explicit Locator(const Covering& covering);

  /// The part of the rock, or of one block, that holds x; of several (to 1e-9 of the model's size) that of the
  /// lowest block, then element. Not found if x is outside all rock by more than that.
  Holder find(const Vec3& x, Index block = none) const;

  /// The same for what must not be left to a sliver alone: a force would press it out of shape, the more the smaller it is. Instead, the
  /// nearest well filled element of the block, of its material and of a cover of the sliver's, up to a hundredth of the spacing away; its
  /// functions, continued, stand for the sliver's (Höllig, Reif & Wipper 2001 do the same with B-splines).
  Holder find_firm(const Vec3& x, Index block = none) const;
  /// That of x in the element and block of `own`.
  Holder firm_for(const Vec3& x, const Holder& own) const;

  /// The block's nearest to x, up to a hundredth of the spacing away.
  Holder nearest_of(const Vec3& x, Index block) const;

  /// That of a vertex of a block, which the block holds, but for the rounding of what is as thin as that. Of kind `block` a block of one material is one element: then nothing is
  /// searched, and only `element` is filled.
  Holder of_vertex(const Vec3& x, Index block, Slivers slivers) const;

  /// The element of the second of two overlaid splits that holds x where `holder` does; none if there is one split.
  Index find_other(const Vec3& x, const Holder& holder) const;

  /// Adds the point to `points` with its element's weights.
  void add(const Vec3& x, const Holder& holder, MaterialPoints& points) const;

 private:
  using Found = std::vector<Holder>;
  Found near(const Vec3& x, Real by = 0) const;
  Holder holding(const Vec3& x, Index block) const;
  template <class Accept>
  Holder nearest_within(const Vec3& x, Real reach, const Accept& accept) const;
  template <class Avoid>
  Index other_of(const Holder& holder, const Found& found, const Avoid& avoid) const;
  bool is_sliver(const Holder& holder) const;
  void try_regular(const Vec3& x, Index regular, Found& found) const;
  void try_element(const Vec3& x, Index element, Found& found) const;
  void try_piece(const Vec3& x, Index element, Index piece, Index lattice_cell, int part,
                 Found& found) const;
  Real outside(HalfSpaceId h, const Vec3& r) const;
  Real piece_violation(const Vec3& x, Index piece) const;

  const CoverArrays& covers_;
  const PieceIndex& index_;
  Real spacing_ = 0, cell_volume_ = 0;  // m, m³; the least of the lattice's edges
  Vec3 slack_{};                        // point_slack() in the lattice's edges
};

}  // namespace rockfold
