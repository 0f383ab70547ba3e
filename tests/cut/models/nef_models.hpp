// Models for the Nef oracle. But for random_discs all coordinates are integers or halves, so that polygons lie exactly on their planes and both
// sides cut the same geometry.
#pragma once

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

/// The plane through `origin` along u and v, as a frame for polygons.
struct Frame {
  Vec3 origin, u, v;
  Vec3 operator()(Real a, Real b) const;
};

/// A joint whose corners are (a, b) in the frame; no corners: through-going.
void add_polygon(Model& model, const Frame& frame, const std::vector<std::array<Real, 2>>& corners);

/// A joint of three or more coplanar corners; its plane is that of the first three.
void add_corners(Model& model, const std::vector<Vec3>& corners);

/// 2 to 8 joints in a box of edge 16, now and then with other solids: oblique triangles, octagons, concave polygons,
/// planes, joints that end on others, closed tetrahedra, fans about a line.
Model random_finite_joints(unsigned seed);

/// 2 to 8 discs of 5 to 16 corners in a box, of any direction and place: nothing meets but in general position, so that it does
/// not matter that corners are off their planes by rounding.
Model random_discs(unsigned seed);

struct NamedModel {
  std::string name;
  Model model;
  bool one_origin_a_plane = true;  ///< else faces' counts differ from the oracle's: coplanar joints
};
std::ostream& operator<<(std::ostream& out, const NamedModel& m);

/// By hand, each for one way to go wrong.
const std::vector<NamedModel>& nasty_models();

}  // namespace rockfold::test
