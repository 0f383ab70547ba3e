// A step taken again from a restored state, by another Motion, gives the same bits.
#include <random>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/reference/sanitized.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

using Random = std::mt19937;

Real between(Random& random, Real low, Real high) {
  return low + (high - low) * std::uniform_real_distribution<Real>(0, 1)(random);
}
int pick(Random& random, int count) {
  return static_cast<int>(random() % static_cast<unsigned>(count));
}

/// A small block on or off a lattice, thrown, falling, or held at one end.
struct RandomMotion {
  explicit RandomMotion(unsigned seed) : random(seed), rock(make_rock(random)) {
    const int held = pick(random, 4);
    if (held > 0)
      rock.hold([](const Vec3& x) { return x[2] < 0.1; }, between(random, 1e6, 1e8), held == 2);
    setup = std::make_unique<MotionSetup>(rock.setup());
    setup->solver.tolerance = 1e-9;
    setup->gravity = {between(random, -3, 3), 0, -9.81};
    setup->large = pick(random, 2) == 0;
    setup->dynamic_ratio = pick(random, 4) == 0 ? 0 : pick(random, 3) == 0 ? 0.9 : 1;
    if (pick(random, 2) == 0) setup->damping = {between(random, 0, 5), between(random, 0, 1e-3)};
    if (pick(random, 4) == 0) setup->beta = 0.3, setup->gamma = 0.6;
    if (pick(random, 2) == 0) {
      setup->loads = forces_at(rock, {{0.5, 0.4, 1.4}}, {{between(random, -1e4, 1e4), 0, 0}});
      setup->loads.tables = {{{0, 0.05}, {{1, 0, 0}, {-1, 0, 0}}}};
      setup->loads.table = {0};
    }
    dt = between(random, 1e-3, 2e-2);
    steps = 2 + pick(random, pick(random, 5) == 0 ? 26 : 10);
    saved_at = pick(random, steps);
  }

  static Rock make_rock(Random& random) {
    Lattice lattice = reference::turned_lattice({0.11, -0.23, 0.37}, between(random, 0.6, 1.1),
                                                between(random, 0, 0.5), between(random, 0, 0.5),
                                                {0.5, 0.4, 0.75}, 1.2);
    const LatticeKind kinds[] = {LatticeKind::tet6, LatticeKind::hex8, LatticeKind::tet5};
    lattice.kind = kinds[pick(random, 3)];
    reference::CoveredRegions made =
        reference::cover_regions(lattice, {reference::box({0, 0, 0}, {1, 0.8, 1.5})});
    made.arrays.order = pick(random, 2);
    return Rock(std::move(made));
  }

  Random random;
  Rock rock;
  std::unique_ptr<MotionSetup> setup;
  Real dt = 0;
  int steps = 0, saved_at = 0;
};

/// To the end, or to the first step that does not converge.
std::vector<std::byte> go_on(Motion& motion, const RandomMotion& m) {
  for (int step = m.saved_at; step < m.steps; ++step)
    if (!motion.step(m.dt).converged) break;
  return motion.bytes();
}

TEST(State, RestoredInAnotherMotionGoesOnToTheSameBits) {
  const unsigned count = reference::cases(30u, 8u);
  unsigned moved = 0;
  for (unsigned seed = 0; seed < count; ++seed) {
    SCOPED_TRACE(seed);
    const RandomMotion m(seed);
    Motion first(*m.setup);
    if (!first.start(m.dt).converged) continue;
    bool converged = true;
    for (int step = 0; step < m.saved_at && converged; ++step)
      converged = first.step(m.dt).converged;
    if (!converged) continue;
    ++moved;
    const std::vector<std::byte> saved = first.bytes();
    Motion second(*m.setup);
    second.restore(saved);
    EXPECT_EQ(second.bytes(), saved);
    const std::vector<std::byte> end = go_on(first, m);
    EXPECT_EQ(go_on(second, m), end);
    EXPECT_NE(end, saved);
    // And by the motion that has gone on itself, from bytes and from its own copy, as divided steps do.
    first.restore(saved);
    first.save();
    EXPECT_EQ(go_on(first, m), end);
    first.restore();
    EXPECT_EQ(first.bytes(), saved);
    EXPECT_EQ(go_on(first, m), end);
  }
  EXPECT_GE(moved, count - count / 20);
}

TEST(State, OfAnotherModelIsRefused) {
  const RandomMotion one(1), other(2);
  const Motion from(*one.setup);
  Motion to(*other.setup);
  std::vector<std::byte> bytes = from.bytes();
  EXPECT_THROW(to.restore(bytes), std::invalid_argument);
  Motion back(*one.setup);
  back.restore(bytes);
  bytes.pop_back();
  EXPECT_THROW(back.restore(bytes), std::invalid_argument);
}

}  // namespace
}  // namespace rockfold
