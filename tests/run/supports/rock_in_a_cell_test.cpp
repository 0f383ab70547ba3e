// Rock that is smaller than a lattice cell: its covers' functions are about its own middles, and answers do not lose their digits.
#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// A quarter turn about z.
Vec3 turned(const Vec3& x) {
  return {x[1], -x[0], x[2]};
}
std::string text(const Vec3& x) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x[0], x[1], x[2]);
}

struct Case {
  const char* lattice;
  int order;
  const char* analysis;
  Real widest;  ///< m, spacing: trilinear weights add powers of rock size over spacing of their own
};

constexpr const char* small_static = "type = 'static'\nkinematics = 'small'";
constexpr const char* large_static = "type = 'static'\nkinematics = 'large'";

std::string name_of(const testing::TestParamInfo<Case>& info) {
  return fmt::format("{}_order{}_{}", info.param.lattice, info.param.order,
                     info.param.analysis == small_static ? "small" : "large");
}

const std::string rock = R"(
[[material]]
density = 2500
young_modulus = 1e9
poisson_ratio = 0.25
[[solid]]
name = "r"
shape = "prism"
)";

std::string on_corners() {
  std::string held;
  for (const Vec3& x : {Vec3{0.1, 0.1, 0}, Vec3{0.9, 0.2, 0}, Vec3{0.2, 0.7, 0}})
    held += fmt::format("[[fixed]]\nwhere = {{point = {}}}\nmethod = 'penalty'\nstiffness = 1e10\n",
                        text(x));
  return held;
}
const std::string on_its_base = "[[fixed]]\nwhere = {face = 'r.cap0'}\nmethod = 'lagrange'\n";

/// An oblique prism of 1 m, pulled at a corner and stressed before, amid a tetrahedron or a cell.
std::string prism_in_an_element(const Case& c, const std::string& held, Real spacing) {
  const Vec3 origin = Vec3{0.5, 0.5, 0.5} - spacing * Vec3{0.75, 0.5, 0.25};
  std::string model = rock + fmt::format(R"(
base = [[0, 0, 0], [1, 0.1, 0], [0.9, 0.9, 0], [0.1, 0.8, 0]]
extrude = [0.1, -0.1, 0.8]
[cover]
lattice = "{}"
order = {}
spacing = {}
origin = {}
[initial_stress]
value = [[1e3, 2e3, 0], [2e3, -1e3, 0], [0, 0, -3e3]]
reference_z = 0.3
gradient = [[-2e3, 0, 0], [0, 1e3, 0], [0, 0, -4e3]]
[[point_load]]
point = [0.9, 0.7, 0.7]
force = [2e4, -1e4, 3e4]
[[monitor]]
point = [0.4, 0.3, 0.7]
[[monitor]]
point = [0.9, 0.7, 0.1]
[analysis]
{}
)",
                                         c.lattice, c.order, spacing, text(origin), c.analysis);
  return model + held;
}

class RockInAnElement : public testing::TestWithParam<Case> {};
INSTANTIATE_TEST_SUITE_P(Curved, RockInAnElement,
                         testing::Values(Case{"tet6_kuhn", 1, small_static, 600},
                                         Case{"tet6_kuhn", 2, small_static, 600},
                                         Case{"tet6_kuhn", 1, large_static, 600},
                                         Case{"tet6_kuhn", 2, large_static, 600},
                                         Case{"hex8", 1, small_static, 30},
                                         Case{"hex8", 2, small_static, 30}),
                         name_of);

/// There the covers' functions span the same polynomials whatever the spacing. Under large kinematics forces are known to the rounding of
/// I + ∂u/∂x.
TEST_P(RockInAnElement, MovesAndIsStressedAlikeWhateverTheSpacing) {
  const Real tolerance = GetParam().analysis == small_static ? 1e-6 : 1e-3;
  const ModelAnswer near = run_model(prism_in_an_element(GetParam(), on_corners(), 8));
  for (const Real spacing : {20.0, GetParam().widest}) {
    SCOPED_TRACE(spacing);
    const ModelAnswer wide = run_model(prism_in_an_element(GetParam(), on_corners(), spacing));
    for (int m = 0; m < 2; ++m) {
      const auto &a = near.result.monitors[m], &b = wide.result.monitors[m];
      const Vec3 u = a.displacement.back();
      EXPECT_LE(norm(b.displacement.back() - u), tolerance * norm(u));
      for (int k = 0; k < 6; ++k)
        EXPECT_NEAR(b.stress.back()[k], a.stress.back()[k],
                    10 * tolerance * std::abs(a.stress.back()[2]));
    }
    const BlockMotion &a = near.result.blocks[0], &b = wide.result.blocks[0];
    EXPECT_LE(norm(b.displacement - a.displacement), tolerance * norm(a.displacement));
    EXPECT_LE(norm(b.rotation - a.rotation), tolerance * norm(a.rotation));
    EXPECT_NEAR(b.volume, a.volume, 1e-9 * a.volume);
    const Vec3 moment = near.result.conditions[0].moment;
    EXPECT_LE(norm(wide.result.conditions[0].moment - moment), tolerance * norm(moment));
  }
}

/// However small the face is beside the spacing, it is held as far as the functions move it.
TEST_P(RockInAnElement, MovesAlikeOnAFaceWhateverTheSpacing) {
  const ModelAnswer near = run_model(prism_in_an_element(GetParam(), on_its_base, 4));
  const Vec3 u = near.result.monitors[0].displacement.back();
  for (const Real spacing : {16.0, 30.0}) {
    const ModelAnswer wide = run_model(prism_in_an_element(GetParam(), on_its_base, spacing));
    EXPECT_LE(norm(wide.result.monitors[0].displacement.back() - u), 1e-3 * norm(u)) << spacing;
    EXPECT_NEAR(wide.result.energy.strain, near.result.energy.strain,
                1e-3 * near.result.energy.strain);
  }
}

/// A prism on three points in several elements, or all of it a quarter turn on. In the order of the model's keys.
struct PrismOnPoints {
  const char* lattice;
  Real spacing;
  std::array<Vec3, 4> base;
  Vec3 extrude, origin;
  std::array<std::array<Real, 2>, 3> direction;
  std::array<Vec3, 3> held;
  Real stiffness;  ///< N/m, of each point
  Vec3 loaded, force, watched;
  Vec3 displacement;  ///< m, at `watched`, in 113-bit arithmetic from an assembly of its own
};

std::string model_of(const PrismOnPoints& p, bool turn) {
  const auto place = [&](const Vec3& x) { return text(turn ? turned(x) : x); };
  const auto direction = [&](int d) {
    return fmt::format("[{}, {}]", p.direction[d][0],
                       std::fmod(p.direction[d][1] + (turn ? 90 : 0), 360));
  };
  std::string model = "gravity = " + place({0, 0, -9.81}) + rock;
  model += fmt::format("base = [{}, {}, {}, {}]\nextrude = {}\n", place(p.base[0]),
                       place(p.base[1]), place(p.base[2]), place(p.base[3]), place(p.extrude));
  model += fmt::format(
      "[cover]\nlattice = '{}'\norder = 2\nspacing = {}\ndirections = [{}, {}, {}]\norigin = {}\n",
      p.lattice, p.spacing, direction(0), direction(1), direction(2), place(p.origin));
  for (const Vec3& x : p.held)
    model +=
        fmt::format("[[fixed]]\nwhere = {{point = {}}}\nmethod = 'penalty'\nstiffness = {:.17g}\n",
                    place(x), p.stiffness);
  model += fmt::format("[[point_load]]\npoint = {}\nforce = {}\n", place(p.loaded), place(p.force));
  model += fmt::format("[[monitor]]\npoint = {}\n[analysis]\n{}\n", place(p.watched), small_static);
  return model;
}

TEST(RockInACell, MovesAsInLongerArithmeticHoweverItIsTurned) {
  for (const PrismOnPoints& p :
       {PrismOnPoints{"tet5",
                      6,
                      {{{0, 0, 0}, {0.64, 0.0448, 0}, {0.7112, 0.89, 0}, {-0.1984, 0.712, 0}}},
                      {-0.084, 0.444, 1.2},
                      {-0.2171, 0.5804, 1.0393},
                      {{{16.7, 278.4}, {87.9, 70.9}, {82.4, 15.2}}},
                      {{{0.007, 0.019, 0.018}, {0.628, 0.062, 0.018}, {0.697, 0.882, 0.018}}},
                      7833077808853.58,
                      {0.048, 0.52, 0.96},
                      {-1711, -8013, 4560},
                      {0.601, 0.104, 0.06},
                      {-1.022856562237e-05, 3.776498502982e-06, -1.673104662609e-05}},
        PrismOnPoints{"hex8",
                      1.947,
                      {{{0, 0, 0}, {1.57, 0.5809, 0}, {1.6585, 1.77, 0}, {0.314, 1.416, 0}}},
                      {0.158, 0.2686, 0.79},
                      {0.0996, 1.4684, 0.1729},
                      {{{5.5, 132.0}, {84.3, 93.4}, {85.0, 354.6}}},
                      {{{0.029, 0.032, 0.012}, {1.552, 0.596, 0.012}, {1.638, 1.749, 0.012}}},
                      2357122190737.39,
                      {0.669, 1.441, 0.632},
                      {-8968, -5307, -3500},
                      {1.509, 0.63, 0.039},
                      {-2.503375515743e-05, 1.419155036810e-05, -3.399070604996e-05}}})
    for (const bool turn : {false, true}) {
      SCOPED_TRACE(fmt::format("{}{}", p.lattice, turn ? " turned" : ""));
      const ModelAnswer answer = run_model(model_of(p, turn));
      const Vec3 u = turn ? turned(p.displacement) : p.displacement;
      EXPECT_LE(norm(answer.result.monitors[0].displacement.back() - u), 1e-7 * norm(u));
      EXPECT_LE(answer.result.iterations.pcg, 10);
    }
}

}  // namespace
}  // namespace rockfold
