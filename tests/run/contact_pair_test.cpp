// The law belongs to the two surfaces that touch, wherever they have come to.
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, degree = std::numbers::pi / 180;

std::string joint_material(const std::string& name, Real friction_angle) {
  return "[[joint_material]]\nname = '" + name +
         "'\nfriction_angle = " + std::to_string(friction_angle) + "\n";
}

std::string box(const std::string& name, const std::string& low, const std::string& high,
                const std::string& interface) {
  return "[[solid]]\nname = '" + name + "'\nshape = 'box'\nmin = " + low + "\nmax = " + high +
         (interface.empty() ? "\n" : "\ninterface = '" + interface + "'\n");
}

/// Cubes on a plane that stands for one of 30°, with what is behind, for 1.2 s.
std::string on_plane(const std::string& materials, const std::vector<std::string>& interfaces,
                     const std::string& more = "") {
  std::string text =
      "gravity = [4.905, 0, -8.495709211126]\n[[material]]\ndensity = 2600\n"
      "young_modulus = 3e10\npoisson_ratio = 0.25\n" +
      materials + box("plane", "[-2, -1, -1]", "[9, 9, 0]", "");
  for (std::size_t i = 0; i < interfaces.size(); ++i) {
    const std::string y = std::to_string(3 * i), beyond = std::to_string(3 * i + 1),
                      middle = std::to_string(3 * i) + ".5";
    text += box("cube" + std::to_string(i), "[0, " + y + ", 0]", "[1, " + beyond + ", 1]",
                interfaces[i]) +
            "[[monitor]]\nname = '" + std::to_string(i) + "'\npoint = [0.5, " + middle + ", 0.5]\n";
  }
  return text +
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [-1, 0, -0.5]}\n"
         "[analysis]\ntype = 'dynamic'\ntime_step = 0.01\nend_time = 1.2\n" +
         more;
}

/// m, in 1.2 s.
Real slide(Real friction_angle) {
  const Real a =
      gravity * (std::sin(30 * degree) - std::cos(30 * degree) * std::tan(friction_angle * degree));
  return 0.5 * a * 1.44;
}

void expect_slides(const std::string& model, const std::vector<Real>& friction_angles) {
  const RunResult run = run_model(model).result;
  ASSERT_EQ(run.monitors.size(), friction_angles.size());
  for (std::size_t i = 0; i < friction_angles.size(); ++i)
    EXPECT_NEAR(run.monitors[i].displacement.back()[0] / slide(friction_angles[i]), 1, 5e-3) << i;
}

TEST(ContactPairs, KeepTheMaterialOfASurfaceOffItsFirstFootprint) {
  const std::string ten = joint_material("ten", 10), twenty = joint_material("twenty", 20),
                    more = joint_material("more", 25);
  const std::vector<std::string> interfaces = {"ten", "twenty", "more"};
  expect_slides(on_plane(ten + twenty + more, interfaces), {10, 20, 25});
  expect_slides(on_plane(more + twenty + ten, interfaces), {10, 20, 25});
}

TEST(ContactPairs, GiveWhatTheModelSaysOfTwoMaterialsOrTheWeakerOne) {
  const std::string materials = joint_material("ten", 10) + joint_material("twenty", 20);
  const std::string beyond =
      "[[solid]]\nname = 'slab'\nshape = 'box'\nmin = [1.2, -1, -1]\n"
      "max = [9, 9, 0]\ninterface = 'ten'\n"
      "[[fixed]]\nwhere = {block_at = [5, 0, -0.5]}\n";
  // From 0.2 m on the cube slides on the slab, of ten degrees.
  const auto way = [&](const std::string& pair) {
    const RunResult run = run_model(on_plane(materials, {"twenty"}, beyond + pair)).result;
    return run.monitors[0].displacement.back()[0];
  };
  const std::string says = "[[contact_pair]]\nbetween = ['ten', 'twenty']\nmaterial = 'twenty'\n",
                    of_solid =
                        "[[contact_pair]]\nbetween = ['slab', 'twenty']\nmaterial = 'twenty'\n";
  const Real weaker = way("");
  EXPECT_GT(weaker, 1.05 * slide(20));
  EXPECT_LT(weaker, slide(10));
  EXPECT_NEAR(way(says) / slide(20), 1, 2e-2);
  EXPECT_NEAR(way(of_solid) / slide(20), 1, 2e-2);
}

/// The plane has a surface of its own, and the joint under a cube is that of both from the start.
TEST(ContactPairs, CountBetweenTwoInterfacesFromTheStart) {
  const std::string materials =
      joint_material("ten", 10) + joint_material("twenty", 20) + joint_material("more", 25);
  const auto with_ground = [&](const std::string& ground, const std::string& pair) {
    std::string model = on_plane(materials, {"ten", "twenty", "more"}, pair);
    const std::string plane = "max = [9, 9, 0]\n";
    return model.replace(model.find(plane), plane.size(), plane + "interface = '" + ground + "'\n");
  };
  expect_slides(with_ground("twenty", ""), {10, 20, 20});
  expect_slides(with_ground("ten", ""), {10, 10, 10});
  const std::string says =
      "[[contact_pair]]\nbetween = ['ten', 'twenty']\nmaterial = 'more'\n"
      "[[contact_pair]]\nbetween = ['cube2', 'plane']\nmaterial = 'ten'\n";
  expect_slides(with_ground("twenty", says), {25, 20, 10});
}

}  // namespace
}  // namespace rockfold
