// Slivers about a key block: joints that miss its edges and corners by rounding, and joints nearly in its faces. None of their faces
// is a half-space of block theory, so that the block moves as without them.
#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/keyblock/models/half_space_block.hpp"

namespace rockfold {
namespace {

using test::add_joint;
using test::model_with_joints;
using test::radians;
using test::upward;

/// A removable tetrahedron: the joints F1 … are its faces in the rock, `corner` is where three of its faces meet.
struct Wedge {
  Model model;
  Real size = 0;             ///< m, the diagonal of the rock's box
  Vec3 inside{};             ///< m, a point of it
  std::vector<Vec3> corner;  ///< m
};

Vec3 meeting(const Vec3& a, const Vec3& pa, const Vec3& b, const Vec3& pb, const Vec3& c,
             const Vec3& pc) {
  return test::meeting_point({a, pa}, {b, pb}, {c, pc});
}

// Three joints that dip 60 meet 2 m above a roof: the wedge falls.
Wedge roof_wedge() {
  Wedge w;
  w.model = model_with_joints(20);
  Solid rock = test::box_solid("rock", {0, 0, 0}, {20, 20, 10});
  rock.continues = {true, true, true, true, false, true};
  w.model.solids.push_back(rock);
  w.size = std::sqrt(900.0);
  const Vec3 apex{10.1, 9.7, 2}, up{0, 0, 1};
  Vec3 n[3];
  for (int j = 0; j < 3; ++j) {
    n[j] = upward(60, 30 + 120 * j);
    add_joint(w.model, n[j], apex);
  }
  w.corner = {apex};
  for (int j = 0; j < 3; ++j) w.corner.push_back(meeting(n[j], apex, n[(j + 1) % 3], apex, up, {}));
  w.inside = 0.25 * (w.corner[0] + w.corner[1] + w.corner[2] + w.corner[3]);
  return w;
}

// 3DEC's wedge in a slope: it slides on J1 40/130 and J2 60/220; the face dips 70 to 160, the top is at 10 m.
Wedge slope_wedge() {
  Wedge w;
  w.model = model_with_joints(20);
  const Vec3 face = upward(70, 160), up{0, 0, 1}, n1 = upward(40, 130), n2 = upward(60, 220);
  Solid rock = test::convex_solid("rock", {{face, {}},
                                           {up, {0, 0, 10}},
                                           {{1, 0, 0}, {40, 0, 0}},
                                           {{-1, 0, 0}, {-40, 0, 0}},
                                           {{0, 1, 0}, {0, 60, 0}},
                                           {{0, 0, -1}, {0, 0, -20}}});
  rock.continues = {false, false, true, true, true, true};
  w.model.solids.push_back(rock);
  const Real down =
      upward(70, 160)[2] * 20 + upward(70, 160)[0] * 40;  // the face's foot is at y = −this/0.883
  w.size = norm(Vec3{80, 60 - down / upward(70, 160)[1], 30});
  add_joint(w.model, n1, {});
  add_joint(w.model, n2, {});
  const Vec3 top{0, 0, 10};
  w.corner = {Vec3{}, meeting(n1, {}, n2, {}, up, top), meeting(n1, {}, face, {}, up, top),
              meeting(n2, {}, face, {}, up, top)};
  w.inside = 0.25 * (w.corner[0] + w.corner[1] + w.corner[2] + w.corner[3]);
  return w;
}

struct Found {
  BlockClass block_class{};
  Keyblock key;
  Real volume = 0;
};

// The block that fills the wedge but for slivers.
Found find(const Wedge& w, const Model& model) {
  const BlockArrays a = test::cut(model).arrays;
  const KeyblockReport report = find_keyblocks(a, model);
  Found found;
  Index block = none;
  for (Index b = 0; b < a.block_count(); ++b)
    if (norm(a.centroid[b] - w.inside) < 1e-6) block = b;
  if (block == none) {
    ADD_FAILURE() << "no block in the wedge's place";
    return found;
  }
  found.block_class = report.block_class[block];
  found.volume = a.volume[block];
  for (const Keyblock& k : report.keyblocks)
    if (k.members == std::vector<Index>{block}) found.key = k;
  return found;
}

// A face that is off by up to `off` m moves volumes by its area, and areas by its perimeter, times that.
void expect_alike(const Found& found, const Found& plain, Real off) {
  const Real area = plain.key.free_area;
  EXPECT_EQ(found.block_class, plain.block_class);
  EXPECT_NEAR(found.volume, plain.volume, 2 * off * area + 1e-12);
  const Keyblock &k = found.key, &p = plain.key;
  ASSERT_NE(k.block, none);
  EXPECT_EQ(k.mode, p.mode);
  EXPECT_EQ(k.batch, p.batch);
  EXPECT_EQ(k.planes.size(), p.planes.size());
  EXPECT_LT(norm(k.direction - p.direction), 1e-7);
  if (std::isnan(p.factor_of_safety)) {
    EXPECT_TRUE(std::isnan(k.factor_of_safety));
  } else {
    EXPECT_NEAR(k.factor_of_safety, p.factor_of_safety, 1e-7);
  }
  EXPECT_NEAR(k.weight, p.weight, 1e-6 * p.weight);
  EXPECT_NEAR(k.sliding_force, p.sliding_force, 1e-6 * p.weight);
  EXPECT_NEAR(k.free_area, p.free_area, 10 * off * std::sqrt(area) + 1e-12);
  EXPECT_NEAR(k.support_force, p.support_force, 1e-6 * p.weight);
}

const Real misses[] = {0, 1e-13, -1e-13, 1e-12, -1e-12, 1e-11, -1e-11};
const Real gaps[] = {1e-13, 1e-12, 1e-11, 1.01e-10, 3e-10, 9e-10};  // of joints beside faces

class KeyblockAmongSlivers : public testing::TestWithParam<bool> {
 protected:
  const Wedge w = GetParam() ? roof_wedge() : slope_wedge();
  const Found plain = find(w, w.model);

  void expect_alike_with(const Vec3& normal, const Vec3& point) const {
    Model model = w.model;
    add_joint(model, normal, point);
    expect_alike(find(w, model), plain, 1e-9 * w.size);
  }
};

TEST_P(KeyblockAmongSlivers, MovesAsClosedFormsSay) {
  EXPECT_EQ(plain.block_class, BlockClass::key);
  const Vec3 &o = w.corner[0], a = w.corner[1] - o, b = w.corner[2] - o, c = w.corner[3] - o;
  EXPECT_NEAR(plain.volume, std::abs(dot(a, cross(b, c))) / 6, 1e-9);
  EXPECT_EQ(plain.key.mode, GetParam() ? SlidingMode::lifting : SlidingMode::two_planes);
  if (GetParam()) {
    EXPECT_TRUE(std::isnan(plain.key.factor_of_safety));
  } else {
    EXPECT_NEAR(plain.key.factor_of_safety, std::tan(radians(20)) / std::tan(radians(33.3572)),
                1e-5);
  }
}

// A plane through an edge that else leaves the wedge on one side, and misses the edge by so much in or out.
TEST_P(KeyblockAmongSlivers, MovesAlikeWithJointsAlongItsEdges) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      for (const Real miss : misses) {
        SCOPED_TRACE(testing::Message() << "edge " << i << j << ", miss " << miss);
        const Vec3 along = w.corner[j] - w.corner[i],
                   out = 0.5 * (w.corner[i] + w.corner[j]) - w.inside;
        const Vec3 normal = normalized(out - (dot(out, along) / dot(along, along)) * along);
        expect_alike_with(normal, w.corner[i] + miss * w.size * normal);
      }
}

TEST_P(KeyblockAmongSlivers, MovesAlikeWithJointsThroughItsCorners) {
  for (int i = 0; i < 4; ++i)
    for (const Real miss : misses) {
      SCOPED_TRACE(testing::Message() << "corner " << i << ", miss " << miss);
      const Vec3 normal = normalized(w.corner[i] - w.inside);
      expect_alike_with(normal, w.corner[i] + miss * w.size * normal);
    }
}

// Joints beside each of the faces, free ones among them, inside the wedge and outside; parallel, and turned by a tenth as much.
TEST_P(KeyblockAmongSlivers, MovesAlikeWithJointsNearlyInItsFaces) {
  for (int i = 0; i < 4; ++i)
    for (const Real gap : gaps)
      for (const Real side : {-1.0, 1.0})
        for (const bool turned : {false, true}) {
          SCOPED_TRACE(testing::Message()
                       << "face " << i << ", gap " << side * gap << (turned ? ", turned" : ""));
          const Vec3 &a = w.corner[(i + 1) % 4], &b = w.corner[(i + 2) % 4],
                     &c = w.corner[(i + 3) % 4];
          Vec3 normal = normalized(cross(b - a, c - a));
          if (dot(normal, w.corner[i] - a) > 0) normal = -normal;
          const Vec3 point = (1.0 / 3) * (a + b + c) + side * gap * w.size * normal;
          if (turned) normal += 0.1 * gap * normalized(b - a);
          expect_alike_with(normal, point);
        }
}

INSTANTIATE_TEST_SUITE_P(, KeyblockAmongSlivers, testing::Bool(),
                         [](const auto& test) { return test.param ? "Roof" : "Slope"; });

}  // namespace
}  // namespace rockfold
