#include "host/stability/rigid_mass.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

void add_corners(const ContactArea& area, Index contact, std::vector<ForcePoint>& points) {
  for (const Vec3& x : area.corner) points.push_back({contact, x, 0});
}

/// Between the mean of the corners and each edge.
void add_triangles(const ContactArea& area, Index contact, std::vector<ForcePoint>& points) {
  const std::size_t count = area.corner.size();
  Vec3 middle{};
  for (const Vec3& x : area.corner) middle += (1 / static_cast<Real>(count)) * x;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 &a = area.corner[i], &b = area.corner[(i + 1) % count];
    points.push_back(
        {contact, (1.0 / 3) * (middle + a + b), 0.5 * norm(cross(a - middle, b - middle))});
  }
}

}  // namespace

std::vector<ForcePoint> force_points(const RigidMass& mass) {
  std::vector<ForcePoint> points;
  for (std::size_t c = 0; c < mass.contacts.size(); ++c) {
    const ContactArea& area = mass.contacts[c];
    add_corners(area, static_cast<Index>(c), points);
    if (area.cohesion > 0 || area.tension > 0) add_triangles(area, static_cast<Index>(c), points);
  }
  return points;
}

}  // namespace rockfold
