// Bodies that touch along edges alone: houses of cards against statics.
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

constexpr Real degree = std::numbers::pi / 180;

std::string number(Real x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.12f", x);
  return text;
}

std::string point(const std::array<Real, 3>& p, Real turn) {
  const Real c = std::cos(turn), s = std::sin(turn);
  return "[" + number(c * p[0] - s * p[1]) + ", " + number(s * p[0] + c * p[1]) + ", " +
         number(p[2]) + "]";
}

struct Cards {
  Real angle;                ///< degrees, of the cards' lower edges' plane to the floor
  std::string scheme;        ///< of the second step
  bool right_first = false;  ///< the order of the solids
  Real turn = 0;             ///< rad, of all about the upright axis
  Real end = 0.5;            ///< s
};

/// A card of 3 × 1 × 0.1 m; sign −1: the left one.
std::string card(const Cards& cards, int sign) {
  const Real c = std::cos(cards.angle * degree), s = std::sin(cards.angle * degree);
  const auto at = [&](Real x, Real z) { return point({sign * x, 0, z}, cards.turn); };
  return std::string("[[solid]]\nname = '") + (sign < 0 ? "left" : "right") +
         "'\nshape = 'prism'\nbase = [" + at(3 * c, 0) + ", " + at(0, 3 * s) + ", " +
         at(0.1 * s, 3 * s + 0.1 * c) + ", " + at(3 * c + 0.1 * s, 0.1 * c) +
         "]\nextrude = " + point({0, 1, 0}, cards.turn) + "\n";
}

std::string monitor(const Cards& cards, int sign) {
  const Real c = std::cos(cards.angle * degree), s = std::sin(cards.angle * degree);
  return "[[monitor]]\nname = '" + std::string(sign < 0 ? "left" : "right") +
         "'\npoint = " + point({sign * (1.5 * c + 0.05 * s), 0.5, 1.5 * s + 0.05 * c}, cards.turn) +
         "\n";
}

/// Friction tan⁻¹ ½; what weighs on them first without inertia, then is let go.
std::string house_of(const Cards& cards) {
  const std::string left = card(cards, -1), right = card(cards, 1);
  return "gravity = [0, 0, -9.81]\n[[material]]\ndensity = 2600\nyoung_modulus = 3e10\n"
         "poisson_ratio = 0.25\n[[joint_material]]\nname = 'rough'\nfriction_angle = 26.565051177\n"
         "[[solid]]\nname = 'floor'\nshape = 'box'\nmin = [-6, -6, -1]\nmax = [6, 6, 0]\n" +
         (cards.right_first ? right + left : left + right) +
         "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {block_at = [-5.5, 0, -0.5]}\n"
         "[[step]]\ntype = 'quasi_static'\ntime_step = 0.01\nsteps = 20\n"
         "[[step]]\ntype = 'dynamic'\nscheme = '" +
         cards.scheme + "'\ntime_step = 0.005\nend_time = " + number(cards.end) + "\n" +
         monitor(cards, -1) + monitor(cards, 1);
}

/// Of the cards' middles at the end, left and right, in the house's own directions.
std::array<Vec3, 2> ways(const Cards& cards) {
  const RunResult run = run_model(house_of(cards)).result;
  std::array<Vec3, 2> found;
  for (int k = 0; k < 2; ++k) {
    const Vec3 u = run.monitors[k].displacement.back();
    const Real c = std::cos(cards.turn), s = std::sin(cards.turn);
    found[k] = {c * u[0] + s * u[1], c * u[1] - s * u[0], u[2]};
  }
  return found;
}

/// Moments about the top edge, at height h over the feet x from it: tan φ ≥ (x − x_middle)/h = ½ cot θ − 1/60, so that the
/// house stands from 44.06° on.
void expect_stand(const std::string& scheme, const std::vector<Real>& angles) {
  for (const Real angle : angles) {
    SCOPED_TRACE(angle);
    for (const Vec3& u : ways({angle, scheme})) EXPECT_LT(norm(u), 1e-4);
  }
}

TEST(HouseOfCards, StandsWhereStaticsSaysSo) {
  expect_stand("implicit", {45.06, 50.06, 70.0});
}

TEST(HouseOfCards, StandsByExplicitSteps) {
  expect_stand("explicit", {45.06, 60.0});
}

void expect_mirror_images(const std::array<Vec3, 2>& way) {
  const Vec3 mirrored{-way[1][0], way[1][1], way[1][2]};
  EXPECT_LT(norm(way[0] - mirrored), 1e-6 * norm(way[0]));
}

/// `alike`: share of the way by which the same house, its cards in the other order and turned, may come elsewhere.
void expect_slide(const std::string& scheme, Real alike) {
  const auto way = ways({42.06, scheme});
  EXPECT_GT(norm(way[0]), 0.05);
  expect_mirror_images(way);
  const auto turned = ways({42.06, scheme, true, 0.3});
  for (int k = 0; k < 2; ++k) EXPECT_LT(norm(turned[k] - way[k]), alike * norm(way[k]));
}

TEST(HouseOfCards, SlidesApartInMirrorImage) {
  expect_slide("implicit", 1e-4);
}

/// Rounding decides by which substep a point slips first.
TEST(HouseOfCards, SlidesApartInMirrorImageByExplicitSteps) {
  expect_slide("explicit", 1e-3);
}

}  // namespace
}  // namespace rockfold
