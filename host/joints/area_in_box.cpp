#include "host/joints/area_in_box.hpp"

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// The part with sign·(x_axis − at) ≤ 0 (Sutherland and Hodgman, 1974). What is concave may come out with edges that run
// back on themselves: they enclose no area.
void clip(std::vector<Vec3>& polygon, std::vector<Vec3>& scratch, int axis, Real at, Real sign) {
  scratch.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Real from = sign * (a[axis] - at), to = sign * (b[axis] - at);
    if (from <= 0) scratch.push_back(a);
    if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
      scratch.push_back(a + (from / (from - to)) * (b - a));
      scratch.back()[axis] = at;
    }
  }
  polygon.swap(scratch);
}

std::vector<Vec3> part_in_box(std::vector<Vec3> polygon, const Extent& box) {
  std::vector<Vec3> scratch;
  for (int axis = 0; axis < 3 && !polygon.empty(); ++axis) {
    clip(polygon, scratch, axis, box.min[axis], -1);
    clip(polygon, scratch, axis, box.max[axis], 1);
  }
  return polygon;
}

// Twice the area, along the normal.
Vec3 twice_area(const std::vector<Vec3>& polygon) {
  Vec3 sum{};
  for (std::size_t i = 2; i < polygon.size(); ++i)
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return sum;
}

}  // namespace

Real area_in_box(const std::vector<Vec3>& polygon, const Extent& box) {
  return 0.5 * norm(twice_area(part_in_box(polygon, box)));
}

}  // namespace rockfold
