// A block rebounds as a whole: with `restitution` times the speed of its mass centre, whatever the rock, the joint and the step.
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, density = 2600;

struct Fall {
  Real restitution = 0.8, young_modulus = 3e10;
  Real stiffness = 0;  ///< of the joint, in E/h; 0: the default, E/h here
  bool on_edge = false;
  std::string scheme = "explicit", lattice = "lattice = 'block'";
};

/// A cube of 1 m, 1 m above a floor that is held.
std::string model_of(const Fall& fall) {
  const Real half = std::sqrt(0.5), stiffness = fall.stiffness * fall.young_modulus;
  const auto number = [](Real x) { return std::to_string(x); };
  const std::string low = number(1), high = number(1 + 2 * half), middle = number(1 + half);
  const std::string cube =
      fall.on_edge ? "shape = 'prism'\nbase = [[0, -0.5, " + low + "], [" + number(half) +
                         ", -0.5, " + middle + "], [0, -0.5, " + high + "], [" + number(-half) +
                         ", -0.5, " + middle + "]]\nextrude = [0, 1, 0]\n"
                   : "shape = 'box'\nmin = [-0.5, -0.5, 1]\nmax = [0.5, 0.5, 2]\n";
  Real seconds = 1;  // in falls of 1 m
  for (int top = 1; top <= 6; ++top) seconds += 2 * std::pow(fall.restitution, top);
  return "gravity = [0, 0, -9.81]\n[[material]]\ndensity = 2600\npoisson_ratio = 0.25\n"
         "young_modulus = " +
         number(fall.young_modulus) + "\n[[joint_material]]\nname = 'face'\nfriction_angle = 30\n" +
         (stiffness > 0 ? "normal_stiffness = " + number(stiffness) +
                              "\nshear_stiffness = " + number(stiffness) + "\n"
                        : "") +
         "[[solid]]\nname = 'floor'\nshape = 'box'\nmin = [-2, -2, -1]\nmax = [2, 2, 0]\n"
         "[[solid]]\nname = 'cube'\n" +
         cube + "[contact]\nrestitution = " + number(fall.restitution) + "\n[cover]\n" +
         fall.lattice +
         "\n[[fixed]]\nwhere = {block_at = [1.5, 1.5, -0.5]}\n"
         "[analysis]\ntype = 'dynamic'\ntime_step = 0.002\nscheme = '" +
         fall.scheme + "'\nend_time = " + number(0.1 + seconds * std::sqrt(2 / gravity)) +
         "\n[output]\nevery = 0\n[[monitor]]\nname = 'centre'\npoint = [0, 0, " +
         (fall.on_edge ? middle : "1.5") + "]\n";
}

/// m, above the floor, of the lowest point of a rigid cube.
std::vector<Real> tops_of(const Fall& fall) {
  const RunResult run = run_model(model_of(fall)).result;
  std::vector<Real> height, tops;
  for (const Vec3& u : run.monitors[0].displacement) height.push_back(1 + u[2]);
  for (std::size_t i = 1; i + 1 < height.size(); ++i)
    if (height[i] >= height[i - 1] && height[i] > height[i + 1]) tops.push_back(height[i]);
  return tops;
}

/// By e² each time, as long as a fall is many times as high as the cube sinks into its joint at rest.
void expect_tops(const Fall& fall) {
  const Real k = (fall.stiffness > 0 ? fall.stiffness : 1) * fall.young_modulus;
  const Real least = 100 * density * gravity / k;
  const std::vector<Real> tops = tops_of(fall);
  for (int n = 0; n < 6; ++n) {
    const Real expected = std::pow(fall.restitution, 2 * (n + 1));
    if (expected < least || expected < 1e-3) break;
    ASSERT_LT(n, static_cast<int>(tops.size()));
    EXPECT_NEAR(tops[n] / expected, 1, 0.05) << "top " << n + 1;
  }
}

TEST(Rebound, FollowsRestitutionTopByTop) {
  for (const Real restitution : {0.3, 0.5, 0.8, 0.9}) {
    SCOPED_TRACE(restitution);
    expect_tops({.restitution = restitution});
  }
}

TEST(Rebound, DoesNotDependOnTheRock) {
  for (const Real modulus : {1e8, 1e9, 1e11}) {
    SCOPED_TRACE(modulus);
    expect_tops({.young_modulus = modulus});
  }
}

TEST(Rebound, DoesNotDependOnTheStiffnessOfTheJoint) {
  for (const Real stiffness : {0.1, 10.0}) {
    SCOPED_TRACE(stiffness);
    expect_tops({.stiffness = stiffness});
    expect_tops({.young_modulus = 1e10, .stiffness = stiffness, .on_edge = true});
  }
}

TEST(Rebound, IsTheSameByImplicitSteps) {
  expect_tops({.scheme = "implicit"});
  expect_tops({.stiffness = 10, .scheme = "implicit"});
  expect_tops({.on_edge = true, .scheme = "implicit"});
}

TEST(SlowRebound, IsTheSameOfABlockOfManyElements) {
  expect_tops({.scheme = "implicit", .lattice = "lattice = 'hex8'\nspacing = 0.5"});
}

TEST(Rebound, LosesNothingWhereRestitutionIsOne) {
  const std::vector<Real> tops = tops_of({.restitution = 1});
  ASSERT_GE(tops.size(), 5u);
  for (const Real top : tops) EXPECT_NEAR(top, 1, 0.02);
}

/// Without friction nothing of a plastic impact stays but rounding, which turns nothing.
TEST(Rebound, OfASmoothBlockIsNoneAtRestitutionZero) {
  std::string model = model_of({.restitution = 0, .scheme = "implicit"});
  const std::string until = "end_time = ";
  const std::size_t number = model.find(until) + until.size();
  model.replace(number, model.find('\n', number) - number, "2");
  const std::string friction = "friction_angle = 30";
  model.replace(model.find(friction), friction.size(), "friction_angle = 0");
  for (const Real size : {1.0, 0.1}) {
    SCOPED_TRACE(size);
    if (size < 1) {
      const std::string box = "min = [-0.5, -0.5, 1]\nmax = [0.5, 0.5, 2]";
      model.replace(model.find(box), box.size(),
                    "min = [-0.05, -0.05, 1]\nmax = [0.05, 0.05, 1.1]");
      model.replace(model.find("point = [0, 0, 1.5]"), 19, "point = [0, 0, 1.05]");
    }
    const RunResult run = run_model(model).result;
    EXPECT_LT(run.made.share(), 1e-2);
    EXPECT_NEAR(run.monitors[0].displacement.back()[2], -1, 2e-3);
    EXPECT_TRUE(run.rest->at_rest);
  }
}

}  // namespace
}  // namespace rockfold
