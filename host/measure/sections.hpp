// Plane sections through the cut rock: their area and the traces of joints on them.
#pragma once

#include <array>
#include <tuple>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

struct Complex;
struct Fragment;

/// A section perpendicular to an axis.
struct SectionMeasure {
  int axis = 0;                    ///< 0 x, 1 y, 2 z
  Real position = 0;               ///< m, coordinate on that axis
  Real area = 0;                   ///< m² of rock
  std::vector<Real> trace_length;  ///< [origins of the complex] m
  std::vector<Index> trace_count;  ///< [origins] distinct joints that leave a trace
};

/// Which placed joint a fragment belongs to, unique over all origins; where the cutting does not tell, its plane stands
/// for it.
struct JointInstance {
  Index origin = none;
  std::int64_t number = 0;
  bool operator==(const JointInstance&) const = default;
  bool operator<(const JointInstance& other) const {
    return std::tie(origin, number) < std::tie(other.origin, other.number);
  }
};

/// Sections x, y, z through a point (m, model coordinates), each moved by a millionth of the model's size so that it holds
/// no joint. O(cells + fragments).
std::array<SectionMeasure, 3> measure_sections(const Complex& complex, const Vec3& centre);

/// The joint of a fragment of kind joint; origin none for any other.
JointInstance joint_instance(const Complex& complex, const Fragment& fragment);

/// Each joint once, in order.
void keep_distinct(std::vector<JointInstance>& joints);

}  // namespace rockfold
