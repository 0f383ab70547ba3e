// A single degree of freedom.
#pragma once

#include <gtest/gtest.h>

#include "tests/time/rock.hpp"

namespace rockfold {

/// A block on springs that share its mass node by node, so that it moves as one whatever its stiffness: one mode, ω² = Σk / m.
struct Oscillator {
  Rock rock = whole_box({2, 2, 2}, 0.5);
  Real omega = 20;

  Oscillator() {
    rock.materials = {{2000, 1e7, 0.2}};
    const Real mass = 2000;
    rock.hold([](const Vec3&) { return true; }, 1, false);
    std::vector<Vec3> ones(rock.covers().cover_node.size(), Vec3{1, 1, 1});
    const auto share =
        CoverSystem(rock.covers(), rock.moments, rock.materials).apply({0, 1, 0}, ones);
    Real sum = 0;
    for (std::size_t n = 0; n < rock.fixed.points.size(); ++n) {
      for (int a = 0; a < 4; ++a)
        if (rock.fixed.points.weight[rock.fixed.points.begin[n] + a] > 0.5)
          rock.fixed.stiffness[n] =
              omega * omega * share[rock.fixed.points.unknown[rock.fixed.points.begin[n] + a]][0];
      sum += rock.fixed.stiffness[n];
    }
    EXPECT_NEAR(sum, omega * omega * mass, 1e-9 * sum);
  }
  /// In place, with v = (1, 0, 0).
  Motion start(Real dt) const { return start(dt, rock.setup()); }
  Motion start(Real dt, const MotionSetup& setup) const {
    Motion motion(setup);
    StateArrays state;
    state.displacement.resize(rock.covers().cover_node.size());
    state.velocity.assign(state.displacement.size(), Vec3{1, 0, 0});
    motion.set_motion(state);
    EXPECT_TRUE(motion.start(dt).converged);
    return motion;
  }
};

}  // namespace rockfold
