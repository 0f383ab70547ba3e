// What the device is asked for in an explicit step, as Kokkos tells its tools: two kernels a tick of the blocks, and a number back a period.
#include <cstdint>
#include <string>

#include <gtest/gtest.h>

#include "kernels/device/launches.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// 6 × 6 × 2 cubes on a floor, which stay where they are.
std::string cubes(const std::string& normal_stiffness) {
  std::string text =
      "gravity = [0, 0, -9.81]\n[[material]]\ndensity = 2500\nyoung_modulus = 1e10\n"
      "poisson_ratio = 0.25\n[[joint_material]]\nname = 'clean'\nfriction_angle = 30\n"
      "normal_stiffness = " +
      normal_stiffness +
      "\n[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, -1]\nmax = [6, 6, 2]\n"
      "[cover]\nlattice = 'block'\n"
      "[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
      "[analysis]\ntype = 'dynamic'\nscheme = 'explicit'\ntime_step = 0.01\nsteps = 3\n";
  const auto cut = [&](const char* name, const char* dip, const char* direction) {
    text += "[[joint_set]]\nname = '" + std::string(name) + "'\ndip = " + dip +
            "\ndip_direction = " + direction + "\nspacing = 1\norigin = [0, 0, 0]\n";
  };
  cut("level", "0", "0");
  cut("east", "90", "90");
  cut("north", "90", "0");
  return text;
}

struct Counted {
  device::Launches launches;
  std::int64_t periods = 0;
};

Counted run_counted(const std::string& normal_stiffness) {
  const device::LaunchCounter counter;
  const RunResult run = run_model(cubes(normal_stiffness)).result;
  return {counter.seen(), run.by_substeps.at(0).substeps};
}

TEST(ExplicitSteps, AskTheDeviceForTwoKernelsATickAndOneNumberAPeriod) {
  const Counted few = run_counted("1e8"), many = run_counted("1e10");
  const auto more = [&](const std::string& label) {
    return many.launches.count(label) - few.launches.count(label);
  };
  const std::int64_t ticks = more("rockfold::motion::tick"), periods = many.periods - few.periods;
  ASSERT_GT(periods, 50);
  ASSERT_GE(ticks, periods);
  for (const auto& [name, count] : many.launches.kernels) {
    if (name == "rockfold::motion::tick") continue;
    const bool forces = name == "rockfold::contact::advance",
               looks = name == "rockfold::contact::largest_shift";
    EXPECT_LE(more(name), forces ? ticks : looks ? periods : 0) << name << " of " << count;
  }
  EXPECT_LE(many.launches.copies - few.launches.copies, periods);
}

}  // namespace
}  // namespace rockfold
