// Blocks under initial stress, in balance before anything moves: held all round, they lie still.
#include <string>

#include <gtest/gtest.h>

#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

/// A joint that ends in rock has no contact between its sides: under the stress in the rock they would pass through each other. The lattice's
/// nodes lie in the held faces.
TEST(StressedBlocks, LieStillBesideJointsThatEndInRock) {
  const Real pressure = 10e6, stiffness = 10e9;
  for (const char* cover : {"lattice = 'tet6'\nspacing = 1", "lattice = 'tet6_kuhn'\nspacing = 1",
                            "lattice = 'tet6'\norder = 1\nspacing = 2"})
    for (const char* crack :
         {"radius = 1.7\ndip = 75\ndip_direction = 171\npoint = [2.1, 1.9, 2.2]",
          "radius = 1.9\ndip = 39\ndip_direction = 11\npoint = [3.1, 2.2, 3]"}) {
      const ModelAnswer answer = run_model(
          std::string("gravity = [0, 0, 0]\n[[material]]\ndensity = 2500\nyoung_modulus = 1e9\n"
                      "poisson_ratio = 0.25\n[[joint_material]]\nname = 'j'\nfriction_angle = 45\n"
                      "normal_stiffness = 1e10\nshear_stiffness = 1e10\n[[solid]]\nname = 'rock'\n"
                      "shape = 'box'\nmin = [0, 0, 0]\nmax = [4, 4, 4]\n[[joint]]\nname = 'J'\n"
                      "dip = 11\ndip_direction = 40\npoint = [2.1, 1.9, 1.1]\n[[joint]]\n"
                      "name = 'crack'\n") +
          crack +
          "\n[initial_stress]\nvalue = [[-1e7, 0, 0], [0, -1e7, 0], [0, 0, -1e7]]\n[cover]\n" +
          cover +
          "\n[[fixed]]\nwhere = {face = 'rock.xmin'}\n[[fixed]]\nwhere = {face = 'rock.xmax'}\n"
          "[[fixed]]\nwhere = {face = 'rock.ymin'}\n[[fixed]]\nwhere = {face = 'rock.ymax'}\n"
          "[[fixed]]\nwhere = {face = 'rock.zmin'}\n[[fixed]]\nwhere = {face = 'rock.zmax'}\n"
          "[[monitor]]\nname = 'top'\npoint = [2, 2, 2.5]\n"
          "[analysis]\ntype = 'quasi_static'\ntime_step = 0.1\nsteps = 2\n");
      EXPECT_LT(answer.result.largest_displacement.length, 1e-6 * pressure / stiffness)
          << cover << crack;
      EXPECT_EQ(answer.result.contacts.slide, 0) << cover << crack;
    }
}

}  // namespace
}  // namespace rockfold
