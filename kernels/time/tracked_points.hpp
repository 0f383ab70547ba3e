// Material points whose motion is asked for again and again: monitors, block vertices.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

class TrackedPoints {
 public:
  explicit TrackedPoints(const MaterialPoints& points);
  ~TrackedPoints();
  TrackedPoints(TrackedPoints&&) noexcept;
  TrackedPoints& operator=(TrackedPoints&&) noexcept;

  struct Data;
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

/// [N] each, in the order of the points.
struct PointMotion {
  std::vector<Vec3> displacement;  ///< m
  std::vector<Vec3> velocity;      ///< m/s
  std::vector<Vec3> acceleration;  ///< m/s²
  std::vector<std::array<Real, 6>>
      stress;  ///< Pa, xx yy zz xy yz zx, of the element that holds the point
};

}  // namespace rockfold
