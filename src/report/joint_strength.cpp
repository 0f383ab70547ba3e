#include "src/report/joint_strength.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace rockfold {
namespace {

Real residual_angle(const JointMaterial& material) {
  return material.residual_friction_angle.value_or(material.friction_angle);
}

std::string loss_of(const JointMaterial& m) {
  std::vector<std::string> parts;
  if (m.residual_cohesion < m.cohesion)
    parts.push_back(fmt::format("cohesion {:.4g} kPa, then {:.4g}", m.cohesion / 1e3,
                                m.residual_cohesion / 1e3));
  if (residual_angle(m) < m.friction_angle)
    parts.push_back(
        fmt::format("friction {:.4g} deg, then {:.4g}", m.friction_angle, residual_angle(m)));
  return fmt::format("{} ({})", m.name, fmt::join(parts, "; "));
}

}  // namespace

bool loses_strength(const JointMaterial& material) {
  return material.residual_cohesion < material.cohesion ||
         residual_angle(material) < material.friction_angle;
}

std::vector<const JointMaterial*> materials_that_lose_strength(const Model& model,
                                                               const BlockArrays& blocks) {
  std::set<Index> used;
  for (const FaceOrigin& origin : blocks.origins) used.insert(origin.joint_material);
  std::vector<const JointMaterial*> found;
  for (const Index m : used)
    if (m != none && loses_strength(model.joint_materials[static_cast<std::size_t>(m)]))
      found.push_back(&model.joint_materials[static_cast<std::size_t>(m)]);
  return found;
}

std::string strength_loss_text(const std::vector<const JointMaterial*>& materials) {
  std::vector<std::string> texts;
  for (const JointMaterial* material : materials) texts.push_back(loss_of(*material));
  return fmt::format("{}", fmt::join(texts, ", "));
}

bool any_residual_factor(const KeyblockReport& report) {
  const auto weaker = [](const Keyblock& key) {
    return key.residual_factor_of_safety < key.factor_of_safety;
  };
  return std::any_of(report.keyblocks.begin(), report.keyblocks.end(), weaker) ||
         std::any_of(report.stable.begin(), report.stable.end(), weaker);
}

}  // namespace rockfold
