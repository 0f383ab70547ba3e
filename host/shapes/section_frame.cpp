#include "host/shapes/section_frame.hpp"

#include <cmath>

#include "src/base/vector.hpp"

namespace rockfold {

SectionFrame section_frame(const Vec3& direction) {
  constexpr Real vertical = 1e-10;  // directions closer than that are one
  const Vec3 t = normalized(direction);
  const Real horizontal = std::hypot(t[0], t[1]);
  SectionFrame frame;
  frame.right =
      horizontal <= vertical ? Vec3{1, 0, 0} : Vec3{t[1] / horizontal, -t[0] / horizontal, 0};
  // A level tunnel's up is exactly the z axis.
  frame.up = t[2] == 0 ? Vec3{0, 0, 1} : normalized(cross(frame.right, t));
  return frame;
}

}  // namespace rockfold
