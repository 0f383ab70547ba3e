#include "host/stability/layered_program.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/stability/factors.hpp"
#include "tests/stability/planar_mass.hpp"

namespace rockfold {
namespace {

using test::bound_of;
using test::PlanarMass;

/// Rows of layers on each other: what may be added to a row costs 1, and columns without cost reach one or two layers.
LinearProgram random_program(std::mt19937& random, const std::vector<Index>& layer) {
  std::uniform_real_distribution<Real> value(-1, 1), size(0.2, 3);
  const auto rows = static_cast<Index>(layer.size());
  std::vector<Real> right;
  for (Index r = 0; r < rows; ++r) right.push_back(value(random));
  LinearProgram program(right);
  for (Index r = 0; r < rows; ++r) {
    program.row_size.push_back(size(random));
    for (const Real sign : {1.0, -1.0}) {
      program.add_entry(r, sign);
      program.add_column(1, 1e9, 1);
    }
  }
  std::uniform_int_distribution<Index> any_row(0, rows - 1);
  for (Index c = 0; c < 3 * rows; ++c) {
    const Index first = any_row(random);
    for (Index r = first; r < std::min(rows, first + 4); ++r) program.add_entry(r, value(random));
    program.add_column(0, c % 3 == 0 ? 0.5 : 1e9, size(random));
  }
  return program;
}

TEST(LayeredProgram, CostsWhatItCostsAtOnce) {
  std::mt19937 random(7);
  std::vector<Index> layer;
  for (Index r = 0; r < 60; ++r) layer.push_back(r / 12);
  Real most = 0;
  for (int n = 0; n < 40; ++n) {
    const LinearProgram program = random_program(random, layer);
    const LinearSolution at_once = solve(program), layered = solve_in_layers(program, layer);
    EXPECT_NEAR(layered.cost, at_once.cost, 1e-8) << n;
    most = std::max(most, at_once.cost);
    std::vector<Real> left = program.right;
    for (Index c = 0; c < program.columns(); ++c)
      for (std::int32_t e = program.begin[c]; e < program.begin[c + 1]; ++e)
        left[program.row[e]] -= layered.x[c] * program.value[e];
    for (const Real l : left) EXPECT_NEAR(l, 0, 1e-7);
  }
  EXPECT_GT(most, 0.1);  // some cannot be balanced
}

TEST(LayeredProgram, LayersMayComeInAnyOrder) {
  std::mt19937 random(8);
  std::vector<Index> layer;
  for (Index r = 0; r < 60; ++r) layer.push_back((r * 7) % 5);
  const LinearProgram program = random_program(random, layer);
  EXPECT_NEAR(solve_in_layers(program, layer).cost, solve(program).cost, 1e-8);
}

TEST(LayeredProgram, BoundOfATowerOfManyLayersIsThatOfItsLowestJoint) {
  // 250 slabs of 1 m by 0.02 m, shaken with 0.1 g: no slab topples, all slide on the lowest joint first, which bears the most.
  const Real friction = 0.6, cohesion = 5e3, pull = 0.1, unit_weight = 25e3;
  PlanarMass tower(unit_weight, pull);
  constexpr Index slabs = 250;
  const Real height = 0.02;
  for (Index k = 0; k < slabs; ++k) {
    const Real z = k * height;
    tower.add_block({{0, z}, {1, z}, {1, z + height}, {0, z + height}});
    tower.add_contact(k, k - 1, {0, z}, {1, z}, friction, cohesion);
  }
  const Real weight = unit_weight * slabs * height;
  const Real expected = (friction * weight + cohesion) / (pull * weight);
  EXPECT_NEAR(bound_of(tower.mass()).factor, expected, 1e-5 * expected);
}

}  // namespace
}  // namespace rockfold
