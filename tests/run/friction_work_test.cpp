// What friction takes is μ N s, whatever areas grow or shrink as blocks slide.
#include <cmath>
#include <numbers>
#include <string>

#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real gravity = 9.81, degree = std::numbers::pi / 180;

/// A cube on a floor that stands for a slope of 40°, of 25° of friction. The floor begins at x = `from`: what overhangs it comes onto it.
RunResult slide(Real from, const std::string& scheme, Real time_step) {
  const auto number = [](Real x) { return std::to_string(x); };
  return run_model("gravity = [" + number(gravity * std::sin(40 * degree)) + ", 0, " +
                   number(-gravity * std::cos(40 * degree)) +
                   "]\n[[material]]\ndensity = 2600\nyoung_modulus = 3e10\npoisson_ratio = 0.25\n"
                   "[[joint_material]]\nname = 'face'\nfriction_angle = 25\n"
                   "[[solid]]\nname = 'floor'\nshape = 'box'\nmin = [" +
                   number(from) +
                   ", -1, -1]\nmax = [9, 2, 0]\n"
                   "[[solid]]\nname = 'cube'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n"
                   "interface = 'face'\n[cover]\nlattice = 'block'\n"
                   "[[fixed]]\nwhere = {block_at = [8, 0, -0.5]}\n"
                   "[analysis]\ntype = 'dynamic'\nend_time = 1\nscheme = '" +
                   scheme + "'\ntime_step = " + number(time_step) +
                   "\n[[monitor]]\nname = 'cube'\npoint = [0.5, 0.5, 0.5]\n")
      .result;
}

TEST(FrictionWork, IsThatOfTheNormalForceAlongTheWay) {
  const Real normal = 2600 * gravity * std::cos(40 * degree);
  for (const Real from : {-1.0, 0.1, 0.4})
    for (const std::string scheme : {"implicit", "explicit"})
      for (const Real time_step : {0.005, 0.001}) {
        SCOPED_TRACE(scheme + ", floor from " + std::to_string(from) + " m, steps of " +
                     std::to_string(time_step) + " s");
        const RunResult run = slide(from, scheme, time_step);
        const Real way = run.monitors[0].displacement.back()[0],
                   work = std::tan(25 * degree) * normal * way;
        EXPECT_NEAR(run.energy.friction / work, 1, 1e-3);
        EXPECT_NEAR(run.energy.impact / work, 0, 1e-3);
      }
}

}  // namespace
}  // namespace rockfold
