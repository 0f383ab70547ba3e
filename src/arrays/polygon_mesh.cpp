#include "src/arrays/polygon_mesh.hpp"

#include "src/base/vector.hpp"

namespace rockfold {

bool is_convex(Loop loop, const std::vector<Vec3>& points, const Vec3& normal) {
  const std::size_t n = loop.size();
  if (n < 3) return false;
  Vec3 in = points[loop[0]] - points[loop[n - 1]];
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 out = points[loop[i + 1 < n ? i + 1 : 0]] - points[loop[i]];
    const Vec3 turned = cross(in, out);
    if (out == Vec3{}) return false;
    if (dot(turned, normal) < -1e-9 * norm(in) * norm(out)) return false;
    if (dot(in, out) < 0 && dot(turned, normal) <= 0) return false;  // turns back on itself
    in = out;
  }
  return true;
}

}  // namespace rockfold
