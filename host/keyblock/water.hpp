// [[water]] in joints as a pressure that changes linearly.
#pragma once

#include <string>
#include <vector>

#include "host/keyblock/face_shape.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// The entry that names the joint, else the one that names none; null without either.
const Water* water_of(const std::vector<Water>& waters, const std::string& joint);

/// Pa; gravity is not zero unless the pressure is the same everywhere.
LinearPressure linear_pressure(const Water& water, const Vec3& gravity);

}  // namespace rockfold
