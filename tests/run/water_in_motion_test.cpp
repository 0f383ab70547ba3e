// Water in joints presses while blocks move, as block theory has it while they do not.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "host/keyblock/keyblock.hpp"
#include "src/base/error.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, density = 2500, degree = std::numbers::pi / 180;

std::string number(Real x) {
  return std::to_string(x);
}

const std::string rock =
    "[[material]]\ndensity = 2500\nyoung_modulus = 1e10\npoisson_ratio = 0.25\n"
    "[[joint_material]]\nname = 'bed'\nfriction_angle = 35\n";

/// A box of 2 × 2 × 1 m on a plane that stands for one of 30°, on water: what [[water]] says beside the joint.
struct OnPlane {
  std::string water, cover = "lattice = 'block'",
                     steps = "[analysis]\ntype = 'dynamic'\ntime_step = 0.005\nend_time = 0.5\n",
                     material = "";

  std::string model() const {
    return "gravity = [4.905, 0, -8.495709211126]\n" + rock +
           "[[solid]]\nname = 'plane'\nshape = 'box'\nmin = [-1, -1, -1]\nmax = [7, 3, 0]\n"
           "[[solid]]\nname = 'box'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [2, 2, 1]\n"
           "interface = 'bed'\n[cover]\n" +
           cover + "\n[[fixed]]\nwhere = {face = 'plane.zmin'}\n" +
           "[[water]]\njoints = ['box.interface']\n" + water + "\n" + steps +
           "[output]\nevery = 0\n[[monitor]]\nname = 'middle'\npoint = [1, 1, 0.5]\n";
  }
};

/// m, that it slides in t s from rest under a pressure of so many Pa on what of its base still lies on that of the plane, where the joint was: a length
/// of 2 m, less what it has slid. ü = A − B u/2.
Real slide(Real pressure, Real t) {
  const Real mu = std::tan(35 * degree), by_water = mu * pressure / density;
  const Real start = gravity * (std::sin(30 * degree) - mu * std::cos(30 * degree)) + by_water;
  const Real rate = std::sqrt(0.5 * by_water);
  return start / (rate * rate) * (1 - std::cos(rate * t));
}

Real way(const std::string& model) {
  return run_model(model).result.monitors[0].displacement.back()[0];
}

TEST(WaterInMotion, LeavesTheJointWhatTheRockPressesBeyondIt) {
  const Real slid = slide(12e3, 0.5);
  ASSERT_GT(slid, 0.25);
  for (const std::string scheme : {"implicit", "explicit"}) {
    SCOPED_TRACE(scheme);
    EXPECT_NEAR(way(OnPlane{.water = "pressure = 12e3",
                            .steps = "[analysis]\ntype = 'dynamic'\ntime_step = 0.005\n"
                                     "end_time = 0.5\nscheme = '" +
                                     scheme + "'\n"}
                        .model()) /
                    slid,
                1, 1e-2);
  }
  EXPECT_NEAR(
      way(OnPlane{.water = "pressure = 12e3", .cover = "lattice = 'hex8'\nspacing = 1"}.model()) /
          slid,
      1, 1e-2);
}

/// Resting first, by a few quasi-static steps.
const std::string settled =
    "[[step]]\ntype = 'quasi_static'\ntime_step = 0.05\nsteps = 5\n"
    "[[step]]\ntype = 'dynamic'\ntime_step = 0.01\nend_time = 0.6\nreset_displacement = true\n";

TEST(WaterInMotion, IsAShareOfItsPressure) {
  EXPECT_EQ(way(OnPlane{.water = "pressure = 24e3\nfactor = 0.5"}.model()),
            way(OnPlane{.water = "pressure = 12e3"}.model()));
}

TEST(WaterInMotion, LetsGoAtThePressureOfLimitEquilibrium) {
  const Real limit =
      density * gravity * (std::cos(30 * degree) - std::sin(30 * degree) / std::tan(35 * degree));
  const auto at = [&](Real share) {
    return way(OnPlane{.water = "pressure = " + number(share * limit), .steps = settled}.model());
  };
  EXPECT_LT(at(0.99), 1e-5);
  EXPECT_GT(at(1.01), 1e-3);
}

TEST(WaterInMotion, RisesOverTime) {
  const Real limit =
      density * gravity * (std::cos(30 * degree) - std::sin(30 * degree) / std::tan(35 * degree));
  // From nothing to twice the limit in 1.2 s: it slides from the half on, and ever faster: ∫∫ μ p'(t) / ρ.
  const std::string table = "pressure_table = [[0, 0], [1.2, " + number(2 * limit) + "]]";
  const std::string steps =
      "[[step]]\ntype = 'quasi_static'\ntime_step = 0.05\nsteps = 4\n"
      "[[step]]\ntype = 'dynamic'\ntime_step = 0.005\nend_time = 1.0\n";
  const Real rate = std::tan(35 * degree) * (2 * limit / 1.2) / density;
  EXPECT_NEAR(way(OnPlane{.water = table, .steps = steps}.model()) / (rate * std::pow(0.6, 3) / 6),
              1, 2e-2);
}

/// A lid of 4 m² and 4 m³ on level ground, and water that presses twice its weight.
TEST(WaterInMotion, StaysInAJointThatOpensOrDrains) {
  const auto rise = [](const std::string& more, const std::string& steps) {
    std::string model =
        OnPlane{.water = "pressure = 49050\n" + more, .steps = "[analysis]\n" + steps}.model();
    model.replace(0, model.find('\n'), "gravity = [0, 0, -9.81]");
    return run_model(model).result.monitors[0].displacement.back()[2];
  };
  // By its own weight, upward.
  EXPECT_NEAR(rise("", "type = 'dynamic'\ntime_step = 0.001\nend_time = 0.05\n"),
              0.5 * gravity * 0.05 * 0.05, 3e-4);
  // At half of the aperture half the pressure is left, which is its weight.
  EXPECT_NEAR(rise("when_open = 'drains'\naperture = 1e-3",
                   "type = 'quasi_static'\ntime_step = 0.002\nsteps = 400\n"),
              0.5e-3, 0.02e-3);
}

/// A slope of 60° of 10 m with a bed of 30° that daylights at its toe, and a crack 4 m behind the crest: Hoek & Bray's plane under water by mid-height.
std::string slope(Real head, const std::string& steps) {
  return "gravity = [0, 0, -9.81]\n" + rock +
         "[[solid]]\nname = 'rock'\nshape = 'prism'\n"
         "base = [[0, 0, -3], [20, 0, -3], [20, 0, 10], [5.7735026919, 0, 10], [0, 0, 0]]\nextrude "
         "= [0, 1, 0]\ncontinues = ['0', '1']\n"
         "[[joint]]\nname = 'bed'\ndip = 30\ndip_direction = 270\npoint = [0, 0, 0]\n"
         "[[joint]]\nname = 'crack'\ndip = 90\ndip_direction = 270\npoint = [10, 0, 0]\n"
         "[[water]]\nhead = " +
         number(head) +
         "\n[support]\nrotation = false\n[cover]\nlattice = 'block'\n"
         "[[fixed]]\nwhere = {block_at = [1, 0.5, -2]}\n[[fixed]]\nwhere = {block_at = [19, 0.5, "
         "9]}\n" +
         steps + "[output]\nevery = 0\n[[monitor]]\nname = 'block'\npoint = [6, 0.5, 8]\n";
}

/// That at which block theory says a factor of safety of one.
Real critical_head() {
  Real low = 0, high = 10;
  for (int k = 0; k < 40; ++k) {
    const Real head = 0.5 * (low + high);
    Model model = parse_model(slope(head, settled), "m.toml", {}, Purpose::run);
    Progress silent;
    const Cutting cutting = cut_blocks(model, silent);
    const KeyblockReport report = find_keyblocks(flatten_blocks(cutting, model), model);
    Real least = 1e9;
    for (const auto* list : {&report.keyblocks, &report.stable})
      for (const Keyblock& key : *list) least = std::min(least, key.factor_of_safety);
    (least < 1 ? high : low) = head;
  }
  return low;
}

TEST(WaterInMotion, MovesASlopeAtTheHeadOfBlockTheory) {
  const Real head = critical_head();
  ASSERT_GT(head, 3);
  ASSERT_LT(head, 9.9);
  const auto moves = [&](Real share) {
    const RunResult run = run_model(slope(share * head, settled)).result;
    const Vec3& u = run.monitors[0].displacement.back();
    return std::hypot(u[0], u[2]);
  };
  EXPECT_LT(moves(0.99), 1e-5);
  EXPECT_GT(moves(1.01), 5e-4);
}

TEST(WaterInMotion, MovesASlopeAsTheLevelRises) {
  const Real head = critical_head();
  // The head rises from a half to one and a half of the critical one within a second.
  const std::string over_time = [&] {
    std::string model =
        slope(head,
              "[[step]]\ntype = 'quasi_static'\ntime_step = 0.01\nsteps = 10\n[[step]]\n"
              "type = 'dynamic'\ntime_step = 0.01\nend_time = 0.9\n");
    const std::string key = "head = " + number(head);
    return model.replace(
        model.find(key), key.size(),
        "head_table = [[0, " + number(0.5 * head) + "], [1, " + number(1.5 * head) + "]]");
  }();
  const RunResult run = run_model(over_time).result;
  Real began = 0;
  const auto& monitor = run.monitors[0];
  for (std::size_t k = 0; k < monitor.time.size(); ++k)
    if (std::abs(monitor.velocity[k][0]) < 1e-3) began = monitor.time[k];
  EXPECT_NEAR(began, 0.5, 0.05);
}

/// The same question asked of both: k at which block theory has a factor of safety of one.
TEST(SeismicStep, MovesABlockAtTheCoefficientOfBlockTheory) {
  // Level ground of 35°: k = tan 35°.
  const auto moved = [](Real k, const std::string& steps) {
    std::string model =
        OnPlane{.water = "pressure = 0",
                .steps = "[support]\nseismic_coefficient = [" + number(k) +
                         ", 0, 0]\n[[step]]\ntype = 'quasi_static'\ntime_step = 0.05\nsteps = 5\n" +
                         steps}
            .model();
    model.replace(0, model.find('\n'), "gravity = [0, 0, -9.81]");
    return run_model(model).result.monitors[0].displacement.back()[0];
  };
  const Real mu = std::tan(35 * degree);
  const std::string slowly =
      "[[step]]\ntype = 'quasi_static'\ntime_step = 0.01\nsteps = 5\nseismic = true\n"
      "[[step]]\ntype = 'dynamic'\ntime_step = 0.01\nend_time = 0.5\nseismic = true\n";
  EXPECT_LT(std::abs(moved(0.99 * mu, slowly)), 1e-4);
  EXPECT_GT(moved(1.01 * mu, slowly), 5e-3);
  // By so much faster than friction brakes, then braked by it alone.
  const Real k = 1.2 * mu, fast = gravity * (k - mu), held = gravity * mu;
  const Real speed = fast * 0.4, whole = 0.5 * fast * 0.16 + 0.5 * speed * speed / held;
  const std::string for_a_time =
      "[[step]]\ntype = 'dynamic'\ntime_step = 0.005\nend_time = 0.4\nseismic = true\n"
      "reset_displacement = true\n[[step]]\ntype = 'dynamic'\ntime_step = 0.005\n"
      "end_time = 1.0\n";
  EXPECT_NEAR(moved(k, for_a_time) / whole, 1, 3e-2);
}

TEST(SeismicStep, NeedsACoefficient) {
  EXPECT_THROW(run_model(OnPlane{.water = "pressure = 0",
                                 .steps = "[[step]]\ntype = 'dynamic'\ntime_step = 0.01\n"
                                          "steps = 1\nseismic = true\n"}
                             .model()),
               Error);
}

}  // namespace
}  // namespace rockfold
