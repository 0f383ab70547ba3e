// Water in the joints of rock in motion: its pressure as points on the faces of both sides.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "host/cover/cover.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// [[water]] and support.water_pressure on the areas that blocks share when the joints are cut. Both sides of an area have the same pressure: that of
/// block theory on the smaller of the two faces, whose edges let the water out; of two alike that of the smaller block.
class JointWater {
 public:
  /// Covering::pieces must still be there; `blocks` and `model` must live as long.
  JointWater(const Cutting& cutting, const Covering& covering, const BlockArrays& blocks,
             const Model& model);

  /// What of a block lies on one joint and looks one way.
  struct Side {
    Index block = none, origin = none;  ///< into BlockArrays
    Vec3 outward{};                     ///< unit, of its first area
    Real area = 0;                      ///< m²
    const Water* water = nullptr;       ///< null: support.water_pressure
  };
  const std::vector<Side>& sides() const { return sides_; }
  /// Into sides(), or none.
  Index side_of(Index block, Index origin, const Vec3& outward) const;

  bool any() const { return !sides_.empty(); }
  /// Whether it stands otherwise at some time after t.
  bool changes_after(Real t) const;
  /// Points that integrate the pressure at time t times the functions of the elements exactly.
  LoadPoints at(Real t, const CoverArrays& covers) const;

 private:
  struct Area {
    std::vector<Vec3> corner;  ///< m
    Vec3 outward{};            ///< of the rock it lies on
    Index element = none, side = none;
    Index face = none;  ///< into faces_
  };
  void add(std::vector<Vec3> corner, const Vec3& outward, Index block, Index origin, Index element,
           Index face);

  const BlockArrays& blocks_;
  const Model& model_;
  std::vector<Area> areas_;
  std::vector<Index> gone_;   ///< [B] 1: excavated before anything moves
  std::vector<Index> faces_;  ///< of blocks, whose pressures count
  std::map<Index, Index> number_of_face_;
  std::vector<Side> sides_;
  std::map<std::pair<Index, Index>, std::vector<Index>> sides_of_;  ///< of block and origin
};

}  // namespace rockfold
