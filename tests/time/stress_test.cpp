// Stresses of elements and points in every lattice with covers of every order.
#include <gtest/gtest.h>

#include "kernels/time/motion.hpp"
#include "tests/solve/systems/polynomial_field.hpp"
#include "tests/solve/systems/represent.hpp"
#include "tests/solve/systems/spaces.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

class Stress : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, Stress, testing::ValuesIn(spaces(true)), space_name);

Rock box(const Space& space) {
  Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.6, 0.3, 0.2, {0.57, 0.5, 0.46}, 0.9);
  lattice.kind = space.kind;
  if (space.kind == LatticeKind::block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{0.5, 0.5, 0.4}};
  }
  auto covered =
      reference::cover_regions(lattice, {reference::box({0.05, 0.02, 0.03}, {1.1, 0.95, 0.9})});
  covered.arrays.order = space.order;
  return Rock(std::move(covered));
}

void expect_stress(const std::array<Real, 6>& found, const Mat3& s, const char* where) {
  const Real expected[6] = {s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[2][0]};
  Real largest = 0;
  for (const Real e : expected) largest = std::max(largest, std::abs(e));
  // Differences over elements of any size: rounding of the displacements over 1e-3 of a cell.
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(found[k], expected[k], 1e-9 * largest) << where << k;
}

TEST_P(Stress, OfAPolynomialIsExactAtPointsAndInTheMeanOfElements) {
  const auto [kind, order] = GetParam();
  const bool block = kind == LatticeKind::block;
  // Of order 0: linear; of order 1 on a block likewise.
  const PolynomialField field =
      PolynomialField::of_degree(order == 0 || (block && order == 1) ? 1 : 2);
  const Rock rock = box(GetParam());
  MotionSetup setup = rock.setup();
  Motion motion(setup);
  StateArrays state;
  state.displacement = represent(rock.covers(), field);
  state.velocity.resize(state.displacement.size());
  state.acceleration.resize(state.displacement.size());
  motion.set_motion(state);

  const std::vector<Vec3> points{{0.07, 0.9, 0.88}, {0.5, 0.5, 0.5}, {1.05, 0.03, 0.85}};
  const auto at = motion.at(rock.track(points));
  for (std::size_t n = 0; n < points.size(); ++n)
    expect_stress(at.stress[n], field.stress(rock.materials[0], points[n]), "point, ");

  // The stress is linear: its mean is that at the centroid.
  const auto stress = motion.element_stress();
  const CoverArrays& covers = rock.covers();
  const Index whole = covers.parts_per_cell() * covers.regular_count();
  ASSERT_EQ(stress.size(), static_cast<std::size_t>(covers.element_count()));
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const Index q = covers.piece_begin[e];
    const Vec3 centroid = covers.lattice.cell_centre(covers.element_cell[e]) +
                          (1 / rock.moments.volume[q]) * rock.moments.first[q];
    expect_stress(stress[whole + e], field.stress(rock.materials[0], centroid), "element, ");
  }
}

}  // namespace
}  // namespace rockfold
