// A model turned about the origin: geometry and every load.
#pragma once

#include <variant>

#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold::test {

/// The whole model turned about the origin: geometry and every load.
inline void turn(BlockArrays& blocks, Model& model, const Vec3& axis, Real angle) {
  const auto turned = [&](const Vec3& x) { return rotated(x, axis, angle); };
  for (auto* vectors : {&blocks.face_normal, &blocks.vertex, &blocks.centroid})
    for (Vec3& x : *vectors) x = turned(x);
  model.gravity = turned(model.gravity);
  model.support->seismic_coefficient = turned(model.support->seismic_coefficient);
  if (auto& direction = model.support->support_direction) *direction = turned(*direction);
  for (SpotBolt& bolt : model.bolts) {
    bolt.collar = turned(bolt.collar);
    bolt.direction = turned(bolt.direction);
  }
  for (PointLoad& load : model.point_loads) {
    load.point = turned(load.point);
    load.force = turned(load.force);
  }
  for (Water& water : model.waters)
    if (auto* table = std::get_if<WaterTable>(&water.level))
      *table = {turned(table->point), turned(table->normal)};
  // Q σ Qᵀ of xx yy zz xy yz zx.
  auto& [xx, yy, zz, xy, yz, zx] = model.initial_stress.at;
  Mat3 half{{turned({xx, xy, zx}), turned({xy, yy, yz}), turned({zx, yz, zz})}};  // (Q σ)ᵀ
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < i; ++k) std::swap(half[i][k], half[k][i]);
  const Vec3 x = turned(half[0]), y = turned(half[1]), z = turned(half[2]);
  model.initial_stress.at = {x[0], y[1], z[2], x[1], y[2], z[0]};
}

}  // namespace rockfold::test
