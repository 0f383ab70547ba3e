#include "host/keyblock/water/water.hpp"

#include <algorithm>
#include <variant>

#include "src/base/vector.hpp"
#include "src/model/joint_name.hpp"

namespace rockfold {

const Water* water_of(const std::vector<Water>& waters, const std::string& joint) {
  const Water* for_all = nullptr;
  for (const Water& water : waters) {
    if (water.joints.empty()) for_all = &water;
    if (std::any_of(water.joints.begin(), water.joints.end(),
                    [&](const std::string& given) { return is_joint_of(joint, given); }))
      return &water;
  }
  return for_all;
}

LinearPressure linear_pressure(const Water& water, const Vec3& gravity) {
  if (const auto* constant = std::get_if<WaterPressure>(&water.level))
    return {.at_origin = water.factor * constant->value, .gradient = {}};
  const Real weight = water.factor * water.density * norm(gravity);
  const Vec3 up = -normalized(gravity);
  if (const auto* head = std::get_if<WaterHead>(&water.level))
    return {.at_origin = weight * head->elevation, .gradient = -weight * up};
  const auto& table = std::get<WaterTable>(water.level);
  const Real rise = weight / dot(table.normal, up);  // per m along the normal, below the table
  return {.at_origin = rise * dot(table.point, table.normal), .gradient = -rise * table.normal};
}

WaterLaw law_of(const Water& water) {
  if (water.law) return *water.law;
  const bool drains = water.drains.value_or(!std::holds_alternative<WaterPressure>(water.level));
  return drains ? WaterLaw::mid_height : WaterLaw::hydrostatic;
}

}  // namespace rockfold
