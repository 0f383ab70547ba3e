// Models and rock for the tests of placing.
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "host/joints/place_joints_exact.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold::test {

inline std::vector<Vec3> box_corners(const Vec3& min, const Vec3& max) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back({i & 1 ? max[0] : min[0], i & 2 ? max[1] : min[1], i & 4 ? max[2] : min[2]});
  return corners;
}

inline RockBounds box_rock(const Vec3& min, const Vec3& max) {
  return {box_corners(min, max), {box_corners(min, max)}};
}

/// Of a planar polygon.
inline Real area(const std::vector<Vec3>& polygon) {
  Vec3 twice{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * norm(twice);
}

/// Fails unless placing is refused with `part` in the message at a key that holds `key`.
inline void expect_refusal(const Model& model, const RockBounds& rock, const std::string& part,
                           const std::string& key) {
  try {
    place_joints(model, rock);
    ADD_FAILURE() << "placed, where \"" << part << "\" was expected";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    EXPECT_NE(error.diagnostics().front().place.key.find(key), std::string::npos)
        << error.diagnostics().front().place.key;
  }
}

}  // namespace rockfold::test
