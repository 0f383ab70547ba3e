// In-situ stress on joints round openings: support.stress = "elastic".
#include "src/app/joint_stress.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "host/keyblock/face_shape.hpp"
#include "host/keyblock/keyblock.hpp"
#include "src/base/vector.hpp"
#include "src/model/read/read_model.hpp"
#include "src/space/stress_on_plane.hpp"

namespace rockfold {
namespace {

/// Rock of 24 m × 3 m × 24 m, jointed parallel to y and across.
std::string rock(const std::string& stress, const std::string& openings) {
  return R"(
[[material]]
density = 2700
young_modulus = 30e9
poisson_ratio = 0.25
[[joint_material]]
friction_angle = 35
normal_stiffness = 10e9
shear_stiffness = 5e9
[[solid]]
name = "rock"
shape = "box"
min = [-12, 0, -12]
max = [12, 3, 12]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
[[joint_set]]
dip = 30
dip_direction = 90
spacing = 1
[[joint_set]]
dip = 60
dip_direction = 270
spacing = 1
[[joint_set]]
name = "across"
dip = 90
dip_direction = 0
spacing = 1
[support]
[initial_stress]
)" + stress +
         openings;
}

const std::string uneven = "value = [[-10e6, 0, 0], [0, -3.75e6, 0], [0, 0, -5e6]]\n";
const std::string deep =
    "value = [[-10e6, 0, 1e6], [0, -5e6, 0], [1e6, 0, -8e6]]\nreference_z = 5\n"
    "gradient = [[-1e4, 0, 0], [0, -1e4, 0], [0, 0, -2.7e4]]\n";

/// A circular tunnel of 2 m (by the mapping radius of its 64 sides).
std::string tunnel(const std::string& as) {
  return fmt::format(
      "{}\nname = 'tunnel'\nshape = 'cylinder'\nradius = 2.00158918\nsides = 64\n"
      "axis = [[0, -1, 0], [0, 4, 0]]\n",
      as);
}
const std::string excavated = "[[excavation]]", subtracted = "[[solid]]\noperation = 'subtract'";

struct Jointed {
  Model model;
  BlockArrays blocks;
  JointStressReport stress;

  explicit Jointed(const std::string& text)
      : model(parse_model(text, "m.toml", {}, Purpose::support)) {
    Progress silent;
    blocks = flatten_blocks(cut_blocks(model, silent), model);
    stress = find_joint_stress(blocks, model, silent);
  }
  bool is_joint(Index face) const {
    return blocks.origins[blocks.face_origin[face]].kind == FaceOrigin::Kind::joint;
  }
  bool is_excavated(Index b) const { return !blocks.stage.empty() && blocks.stage[b] != 0; }
  template <class Visit>
  void each_joint_face(const Visit& visit) const {
    for (Index b = 0; b < blocks.block_count(); ++b)
      if (blocks.finite[b] != 0)
        for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
          if (is_joint(f)) visit(b, f);
  }
};

TEST(JointStress, OfRockWithoutOpeningsIsTheFarField) {
  const Jointed rocky(rock(deep, ""));
  EXPECT_TRUE(rocky.stress.stages.empty());
  const std::vector<Vec3>& found = rocky.stress.tractions.after(0);
  int faces = 0;
  rocky.each_joint_face([&](Index, Index f) {
    const Vec3 exact = traction_on(rocky.model.initial_stress, face_centre(rocky.blocks, f),
                                   rocky.blocks.face_normal[f]);
    EXPECT_LE(norm(found[f] - exact), 1e-9 * norm(exact));
    ++faces;
  });
  EXPECT_GT(faces, 1000);
}

/// Kirsch's solution for a radius of 2 m under the uneven stress.
Vec3 kirsch_traction(const Vec3& x, const Vec3& n) {
  const Real r = std::hypot(x[0], x[2]), angle = std::atan2(x[2], x[0]), q = 4 / (r * r);
  const Real mean = -7.5e6, half = -2.5e6, c2 = std::cos(2 * angle), s2 = std::sin(2 * angle);
  const Real rr = mean * (1 - q) + half * (1 - 4 * q + 3 * q * q) * c2;
  const Real tt = mean * (1 + q) - half * (1 + 3 * q * q) * c2;
  const Real rt = -half * (1 + 2 * q - 3 * q * q) * s2;
  const Vec3 out{std::cos(angle), 0, std::sin(angle)}, round{-out[2], 0, out[0]};
  return dot(n, out) * (rr * out + rt * round) + dot(n, round) * (rt * out + tt * round);
}

TEST(SlowJointStress, RoundACircularTunnelIsKirschs) {
  const Jointed rocky(rock(uneven, tunnel(excavated)));
  ASSERT_EQ(rocky.stress.stages.size(), 1u);
  EXPECT_DOUBLE_EQ(rocky.stress.stages[0].stage, 1);
  const std::vector<Vec3>& found = rocky.stress.tractions.after(1);
  int faces = 0;
  rocky.each_joint_face([&](Index b, Index f) {
    const Vec3& n = rocky.blocks.face_normal[f];
    const auto corner = outer_loop(rocky.blocks, f);
    const bool near = std::any_of(corner.begin(), corner.end(),
                                  [](const Vec3& x) { return std::hypot(x[0], x[2]) < 2.2; });
    if (std::abs(n[1]) > 0.5 || near || rocky.is_excavated(b) || corner.size() != 4) return;
    // The face's two sides across the tunnel are at two pairs of corners.
    const auto [low, high] = std::minmax_element(corner.begin(), corner.end());
    Vec3 mean{};
    constexpr int points = 100;
    for (int k = 0; k < points; ++k)
      mean += (1.0 / points) * kirsch_traction(*low + (k + 0.5) / points * (*high - *low), n);
    EXPECT_NEAR(dot(found[f], n), dot(mean, n), 0.05 * 10e6);
    ++faces;
  });
  EXPECT_GT(faces, 1000);
}

TEST(SlowJointStress, OfASubtractedSolidIsThatOfTheExcavation) {
  const Jointed dug(rock(uneven, tunnel(excavated))), missing(rock(uneven, tunnel(subtracted)));
  const auto sorted = [](const Jointed& rocky, Index stage) {
    std::vector<Real> list;
    rocky.each_joint_face([&](Index b, Index f) {
      if (!rocky.is_excavated(b))
        list.push_back(dot(rocky.stress.tractions.after(stage)[f], rocky.blocks.face_normal[f]));
    });
    std::sort(list.begin(), list.end());
    return list;
  };
  const auto a = sorted(dug, 1), b = sorted(missing, 0);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e3) << i;
}

TEST(SlowJointStress, FollowsTheStagesOfExcavation) {
  const Jointed rocky(rock(uneven, tunnel(excavated) + R"(
[[excavation]]
name = "drift"
stage = 2
shape = "box"
min = [5, -1, -1]
max = [7, 4, 1]
)"));
  ASSERT_EQ(rocky.stress.tractions.stage, (std::vector<Index>{0, 1, 2}));
  const auto& t = rocky.stress.tractions;
  Real before = 0, first = 0, second = 0;  // the largest changes beside the drift
  rocky.each_joint_face([&](Index b, Index f) {
    const Vec3 x = face_centre(rocky.blocks, f), n = rocky.blocks.face_normal[f];
    const bool beside = std::abs(x[0] - 8) < 1 && std::abs(x[2]) < 1;
    if (!beside || std::abs(n[1]) > 0.5 || rocky.is_excavated(b)) return;
    before = std::max(before, norm(t.after(0)[f] - traction_on(rocky.model.initial_stress, x, n)));
    first = std::max(first, norm(t.after(1)[f] - kirsch_traction(x, n)));
    second = std::max(second, norm(t.after(2)[f] - kirsch_traction(x, n)));
  });
  EXPECT_LT(before, 1e-3);
  EXPECT_LT(first, 0.01 * 10e6);  // the drift is not there yet
  EXPECT_GT(second, 0.3 * 10e6);
  EXPECT_EQ(&t.after(7), &t.of_face[2]);
}

TEST(SlowJointStress, WarnsWhereTheRockIsHeldNearTheOpening) {
  const auto warnings = [](const std::string& text) {
    const Jointed rocky(text);
    return joint_stress_warnings(rocky.blocks, rocky.model, &rocky.stress);
  };
  EXPECT_TRUE(warnings(rock(uneven, tunnel(excavated))).empty());
  std::string near = rock(uneven, tunnel(excavated));
  near.replace(near.find("max = [12,"), 10, "max = [5,");
  const auto found = warnings(near);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("rock.xmax (3"), std::string::npos) << found[0];
}

}  // namespace
}  // namespace rockfold
