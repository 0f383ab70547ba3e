#include "host/keyblock/theory/theory_block.hpp"

#include <cmath>
#include <numbers>

#include "host/joints/disc.hpp"
#include "host/keyblock/motions/least_support.hpp"
#include "host/keyblock/motions/single_block.hpp"
#include "host/keyblock/water/joint_pressure.hpp"
#include "host/keyblock/water/water.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// N, of the water in one joint of a block.
Real water_on(const TheorySet& set, const Vec3& outward, const TheoryShape& shape, std::size_t face,
              const TheoryLoads& loads) {
  if (!set.water) return loads.water_pressure * shape.joint_area[face];
  if (shape.joint_outline.empty())
    return linear_pressure(*set.water, loads.gravity).at_origin * shape.joint_area[face];
  const JointOutline& outline = shape.joint_outline[face];
  std::vector<Vec3> corners;
  for (const DrainedCorner& corner : outline.corners) corners.push_back(corner.at);
  return least_pressure_force({corners}, outward,
                              joint_pressures(*set.water, loads.gravity, outline))
      .force;
}

}  // namespace

std::vector<TheorySet> theory_sets(const Model& model) {
  std::vector<TheorySet> sets;
  for (const JointSet& set : model.joint_sets) {
    TheorySet found;
    found.name = set.name;
    found.upward = plane_frame(set.orientation).normal;
    found.water = water_of(model.waters, set.name);
    if (set.material != none) {
      const auto& joint = model.joint_materials[static_cast<std::size_t>(set.material)];
      found.friction = std::tan(joint.friction_angle * std::numbers::pi / 180);
      found.cohesion = joint.cohesion;
    }
    sets.push_back(found);
  }
  return sets;
}

TheoryLoads theory_loads(const Model& model) {
  const SupportSpec support = model.support.value_or(SupportSpec{});
  return {.density = model.materials[static_cast<std::size_t>(model.theory->material)].density,
          .gravity = model.gravity,
          .seismic = support.seismic_coefficient,
          .water_pressure = support.water_pressure,
          .target_safety = support.target_factor_of_safety};
}

std::vector<Vec3> upward_normals(const std::vector<TheorySet>& sets) {
  std::vector<Vec3> normals;
  for (const TheorySet& set : sets) normals.push_back(set.upward);
  return normals;
}

std::vector<std::size_t> sets_of(const std::string& code) {
  std::vector<std::size_t> sets;
  for (std::size_t i = 0; i < code.size(); ++i)
    if (code[i] != '2') sets.push_back(i);
  return sets;
}

TheoryBlock judge_theory_block(const std::vector<TheorySet>& sets, const std::string& code,
                               const TheoryShape& shape, const TheoryLoads& loads) {
  const auto normals = joint_pyramid(upward_normals(sets), code);
  const auto used = sets_of(code);
  TheoryBlock block;
  block.code = code;
  block.shape = shape;
  const Real mass = loads.density * shape.volume;
  block.weight = mass * norm(loads.gravity);
  std::vector<BlockFace> faces;
  for (std::size_t i = 0; i < normals.size(); ++i)
    faces.push_back({.normal = normals[i],
                     .area = shape.joint_area[i],
                     .contact_area = shape.joint_area[i],
                     .friction = sets[used[i]].friction,
                     .cohesion = sets[used[i]].cohesion,
                     .water = water_on(sets[used[i]], normals[i], shape, i, loads) * normals[i]});
  faces.push_back({.normal = {}, .area = shape.free_area});
  const auto verdict = judge_block(faces, mass * loads.gravity + block.weight * loads.seismic, 0);
  block.movement = verdict.movement;
  block.key = verdict.block_class == BlockClass::key;
  if (!block.movement) return block;
  for (Index& plane : block.movement->planes) {
    if (plane == none) continue;
    plane = verdict.planes[static_cast<std::size_t>(plane)].face;  // into the code's faces
    block.planes.push_back(sets[used[static_cast<std::size_t>(plane)]].name);
  }
  block.support_force = least_support(verdict.planes, *verdict.movement, loads.target_safety).force;
  block.support_pressure = shape.free_area > 0 ? block.support_force / shape.free_area : 0;
  return block;
}

std::vector<std::string> codes_of(std::size_t n, std::size_t digits) {
  std::vector<std::string> codes;
  const std::string all(n, '2');
  const auto extend = [&](auto&& self, std::string code, std::size_t from,
                          std::size_t left) -> void {
    if (left == 0) {
      codes.push_back(std::move(code));
      return;
    }
    for (std::size_t i = from; i + left <= n; ++i)
      for (const char side : {'0', '1'}) {
        code[i] = side;
        self(self, code, i + 1, left - 1);
        code[i] = '2';
      }
  };
  extend(extend, all, 0, digits);
  return codes;
}

}  // namespace rockfold
