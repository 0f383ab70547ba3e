// [[water]] in joints: which of them is in a joint, how deep below its level a point lies, and by which law the pressure falls
// towards where the joint drains. docs/block_theory.md, "Water".
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/face_shape.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// The entry that names the joint, else the one that names none; null without either.
const Water* water_of(const std::vector<Water>& waters, const std::string& joint);

/// Pa of water that no edge drains; gravity is not zero unless the pressure is the same everywhere.
LinearPressure linear_pressure(const Water& water, const Vec3& gravity);

/// The law that is given, or follows from `drains`: a constant pressure does not drain unless that is asked for, a level does.
WaterLaw law_of(const Water& water);

/// Whether the pressure falls towards free faces.
inline bool is_drained(const Water& water) {
  return law_of(water) != WaterLaw::hydrostatic;
}

}  // namespace rockfold
