// The operator in every lattice with covers of every order.
#include <cmath>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/solve/systems/spaces.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

using reference::Dense;

class EveryLattice : public testing::TestWithParam<Space> {};
class EveryLatticeOfCells : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(Operator, EveryLattice, testing::ValuesIn(spaces(true)), space_name);
INSTANTIATE_TEST_SUITE_P(Operator, EveryLatticeOfCells, testing::ValuesIn(spaces(false)),
                         space_name);

Real largest_entry(const Dense& a) {
  Real most = 0;
  for (const Real e : a.entry) most = std::max(most, std::abs(e));
  return most;
}

/// A box of two welded materials above another body, in few lattice cells turned about two axes.
SmallSystem few_cells(const Space& space) {
  SmallSystem s;
  Lattice lattice =
      reference::turned_lattice({0.41, 0.33, 0.57}, 1.7, 0.3, 0.2, {0.5, 0.5, 0.5}, 0.6);
  lattice.kind = space.kind;
  if (space.kind == LatticeKind::block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{0.5, 0.4, 0.6}, {0.5, 0.4, 0.1}};
  }
  s.covered = reference::cover_regions(
      lattice, {reference::box({0.05, 0.02, 0.33}, {0.4, 0.83, 0.95}, 0, 0, 0),
                reference::box({0.4, 0.02, 0.33}, {0.91, 0.83, 0.95}, 1, 0, 0),
                reference::box({0.05, 0.02, 0.08}, {0.91, 0.83, 0.33}, 0, 1, 1)});
  s.covered.arrays.order = space.order;
  s.materials = {{2000, 1e3, 0.25}, {3100, 4e3, 0.1}};
  return s;
}

TEST_P(EveryLattice, EqualsDenseAssemblyOnACutLattice) {
  const SmallSystem s = few_cells(GetParam());
  const auto x = reference::scattered(s.covers().unknown_count(), 7);
  const CoverSystem system = s.make();
  const Dense k = reference::assemble_stiffness(s.covers(), s.materials);
  const Dense m = reference::assemble_mass(s.covers(), s.materials);
  // Some hundred terms of the size of the largest entries, each summed over tens of elements.
  EXPECT_LE(reference::largest_difference(system.apply({1, 0, 0}, x), reference::multiply(k, x)),
            1e-12 * largest_entry(k));
  EXPECT_LE(reference::largest_difference(system.apply({0, 1, 0}, x), reference::multiply(m, x)),
            1e-12 * largest_entry(m));
}

TEST_P(EveryLattice, GivesATranslationExactlyNoForceOnACutLattice) {
  const SmallSystem s = cut_system(GetParam().kind, GetParam().order);
  std::vector<Vec3> far(s.covers().unknown_count());
  for (Index p = 0; p < s.covers().cover_count(); ++p) far[p] = {1e6 + 0.1, -3.7e5, 12.3};
  // Slivers of hexahedra take constants as they are, which leaves the rounding of 1e6 m times 4e3 Pa.
  const auto force = s.make().apply({1, 0, 0}, far);
  if (GetParam().kind == LatticeKind::hex8)
    EXPECT_LE(reference::largest(force), 1e-15 * 1e6 * 4e3);
  else
    EXPECT_EQ(reference::largest(force), 0);
  // The mass moved is that of the rock.
  const auto moved = s.make().apply({0, 1, 0}, far);
  Real sum = 0;
  for (Index p = 0; p < s.covers().cover_count(); ++p) sum += moved[p][2];
  const Real mass = 2000 * (1.05 * 1.28 * 1.17 + 1.95 * 1.28 * 0.43) + 3100 * 0.9 * 1.28 * 1.17;
  EXPECT_NEAR(sum / (12.3 * mass), 1, 1e-12);
}

TEST_P(EveryLatticeOfCells, StencilRowsEqualBlockRows) {
  const auto [kind, order] = GetParam();
  const SmallSystem s = uncut_system(5, 5, 4, kind, order);
  const SmallSystem t = with_block_rows_alone(s);
  const Index inner = 4 * 4 * 3;
  EXPECT_EQ(
      s.make().size().stencil_rows,
      kind == LatticeKind::tet24 ? inner + 4 * 5 * 4 + 5 * 4 * 4 + 5 * 5 * 3 + 5 * 5 * 4 : inner);
  EXPECT_EQ(t.make().size().stencil_rows, 0);
  const auto x = reference::scattered(s.covers().unknown_count(), 3);
  for (const SystemCoefficients& c :
       {SystemCoefficients{1, 0, 0}, SystemCoefficients{0, 1, 0}, SystemCoefficients{0.3, 2, 0}}) {
    const auto y = s.make().apply(c, x);
    EXPECT_LE(reference::largest_difference(y, t.make().apply(c, x)),
              1e-13 * reference::largest(y));
  }
}

TEST_P(EveryLatticeOfCells, GivesATranslationExactlyNoForceOnAnUncutLattice) {
  const SmallSystem s = uncut_system(6, 5, 4, GetParam().kind, GetParam().order);
  std::vector<Vec3> far(s.covers().unknown_count());
  for (Index p = 0; p < s.covers().cover_count(); ++p) far[p] = {1e6 + 0.1, -3.7e5, 12.3};
  EXPECT_EQ(reference::largest(s.make().apply({1, 0, 0}, far)), 0);
}

/// Constant covers on an uncut lattice of tetrahedra are the linear finite elements of that mesh.
TEST_P(EveryLatticeOfCells, EqualsDenseAssemblyOnAnUncutLattice) {
  const auto [kind, order] = GetParam();
  const SmallSystem s =
      order == 0 ? uncut_system(4, 3, 3, kind) : uncut_system(2, 1, 1, kind, order);
  const auto x = reference::scattered(s.covers().unknown_count(), 5);
  const Dense k = reference::assemble_stiffness(s.covers(), s.materials);
  EXPECT_LE(reference::largest_difference(s.make().apply({1, 0, 0}, x), reference::multiply(k, x)),
            1e-12 * largest_entry(k));
}

}  // namespace
}  // namespace rockfold
