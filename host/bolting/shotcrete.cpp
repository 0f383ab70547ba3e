#include "host/bolting/shotcrete.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

bool is_sprayed(const FaceOrigin& origin, const std::vector<WallFaces>& walls) {
  if (origin.kind == FaceOrigin::Kind::joint || origin.continues) return false;
  const bool excavation = origin.kind == FaceOrigin::Kind::excavation;
  return std::any_of(walls.begin(), walls.end(), [&](const WallFaces& wall) {
    return wall.excavation == excavation && wall.owner == origin.solid &&
           std::find(wall.faces.begin(), wall.faces.end(), origin.solid_face) != wall.faces.end();
  });
}

}  // namespace

ShotcreteCover::ShotcreteCover(const BlockArrays& blocks, const Shotcrete& shotcrete)
    : blocks_(blocks), strength_(shotcrete.shear_strength * shotcrete.thickness) {
  if (shotcrete.adhesion_strength)
    strength_ = std::min(strength_, *shotcrete.adhesion_strength * shotcrete.bond_width);
  for (const FaceOrigin& origin : blocks.origins)
    sprayed_.push_back(is_sprayed(origin, shotcrete.on));
}

ShotcreteHold ShotcreteCover::hold(Index block) const {
  // Each edge once, with the normal of its face; none where two sprayed faces share it.
  std::map<std::pair<Index, Index>, Index> edges;
  for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f) {
    if (!sprayed_[blocks_.face_origin[f]]) continue;
    for (Index loop = blocks_.loop_begin[f]; loop < blocks_.loop_begin[f + 1]; ++loop) {
      const Index first = blocks_.corner_begin[loop], end = blocks_.corner_begin[loop + 1];
      for (Index c = first, before = end - 1; c < end; before = c++) {
        const auto key = std::minmax(blocks_.corner_vertex[c], blocks_.corner_vertex[before]);
        const auto [entry, added] = edges.emplace(key, f);
        if (!added) entry->second = none;
      }
    }
  }
  ShotcreteHold result;
  for (const auto& [ends, face] : edges) {
    if (face == none) continue;
    const Real length = norm(blocks_.vertex[ends.second] - blocks_.vertex[ends.first]);
    result.edge += length;
    result.force -= (strength_ * length) * blocks_.face_normal[face];
  }
  return result;
}

}  // namespace rockfold
