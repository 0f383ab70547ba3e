#include "src/run/records/nodal_stress.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/solve/systems/represent.hpp"
#include "tests/solve/systems/spaces.hpp"
#include "tests/time/rock.hpp"

namespace rockfold {
namespace {

constexpr Vec3 low{0.05, 0.02, 0.03}, middle{0.55, 0.02, 0.03}, high{1.1, 0.95, 0.9};

Lattice lattice_of(const Space& space) {
  Lattice lattice =
      reference::turned_lattice({0.11, -0.23, 0.37}, 0.3, 0.3, 0.2, {0.57, 0.5, 0.46}, 0.9);
  lattice.kind = space.kind;
  if (space.kind == LatticeKind::block) {
    lattice.cells = {0, 0, 0};
    lattice.block_origin = {{0.5, 0.5, 0.4}};
  }
  return lattice;
}

/// The left half of the box and the right one, of material and body as given.
Rock two_halves(Index material, Index body) {
  const Vec3 left_high{middle[0], high[1], high[2]};
  Rock rock(reference::cover_regions(
      lattice_of({LatticeKind::tet6, 0}),
      {reference::box(low, left_high), reference::box(middle, high, material, 1, body)}));
  rock.materials.push_back({2000, 3e8, 0.1});
  return rock;
}

std::vector<Stress> nodal_stress(const Rock& rock, const ElementMesh& mesh,
                                 std::vector<Vec3> displacement) {
  Motion motion(rock.setup());
  StateArrays state;
  state.velocity.resize(displacement.size());
  state.acceleration.resize(displacement.size());
  state.displacement = std::move(displacement);
  motion.set_motion(state);
  return average_nodal_stress(rock.covers(), mesh, motion);
}

void expect_stress(const Stress& found, const Mat3& s, Real factor = 1) {
  const Real expected[6] = {s[0][0], s[1][1], s[2][2], s[0][1], s[1][2], s[2][0]};
  Real largest = 0;
  for (const Real e : expected) largest = std::max(largest, std::abs(factor * e));
  for (int k = 0; k < 6; ++k) EXPECT_NEAR(found[k], factor * expected[k], 1e-8 * largest) << k;
}

class NodalStress : public testing::TestWithParam<Space> {};
INSTANTIATE_TEST_SUITE_P(EveryLattice, NodalStress, testing::ValuesIn(spaces(true)), space_name);

/// Constant stress with constant functions, linear with others: at the boundary too.
TEST_P(NodalStress, OfAPolynomialIsExact) {
  const auto [kind, order] = GetParam();
  const bool constant = order == 0 || (kind == LatticeKind::block && order == 1);
  const PolynomialField field = PolynomialField::of_degree(constant ? 1 : 2);
  auto covered = reference::cover_regions(lattice_of(GetParam()), {reference::box(low, high)});
  covered.arrays.order = order;
  const Rock rock(std::move(covered));
  const ElementMesh mesh = make_element_mesh(rock.covers());
  const auto stress = nodal_stress(rock, mesh, represent(rock.covers(), field));
  ASSERT_EQ(stress.size(), mesh.point_count());
  ASSERT_GT(stress.size(), 7u);
  std::vector<std::uint8_t> drawn(stress.size());
  for (const auto& corners : mesh.tetrahedron)
    for (const Index k : corners) drawn[k] = 1;
  for (std::size_t k = 0; k < stress.size(); ++k)
    if (drawn[k]) expect_stress(stress[k], field.stress(rock.materials[0], mesh.point[k]));
}

/// A kinked field: at the kink stands the mean, weighted by the volumes of the tetrahedra there, not by their number.
TEST(NodalStress, IsWeightedByVolume) {
  const Rock rock(
      reference::cover_regions(lattice_of({LatticeKind::tet6, 0}), {reference::box(low, high)}));
  const CoverArrays& covers = rock.covers();
  const ElementMesh mesh = make_element_mesh(covers);
  std::vector<Vec3> d(covers.unknown_count());
  for (Index p = 0; p < covers.cover_count(); ++p) {
    const Vec3 x = covers.lattice.node_position(covers.cover_node[p]);
    d[p] = {1e-3 * std::abs(x[0] - 0.6), 1e-3 * x[1] * x[2], 0};
  }
  Motion motion(rock.setup());
  StateArrays state{0, d, d, d};
  motion.set_motion(state);
  const auto nodal = average_nodal_stress(covers, mesh, motion);
  const auto elements = motion.element_stress();
  const auto uniform = average_nodal_stress(mesh, elements);
  std::vector<Real> sum(mesh.point_count()), weight(mesh.point_count());
  for (std::size_t t = 0; t < mesh.tetrahedron.size(); ++t) {
    const auto& c = mesh.tetrahedron[t];
    const Vec3 a = mesh.point[c[1]] - mesh.point[c[0]], b = mesh.point[c[2]] - mesh.point[c[0]],
               e = mesh.point[c[3]] - mesh.point[c[0]];
    const Real volume = dot(a, cross(b, e)) / 6;
    for (const Index k : c) {
      sum[k] += volume * elements[mesh.element[t]][0];
      weight[k] += volume;
    }
  }
  for (std::size_t k = 0; k < nodal.size(); ++k) {
    if (weight[k] == 0) continue;
    EXPECT_NEAR(nodal[k][0], sum[k] / weight[k], 1e-3);  // of 1e5
    EXPECT_NEAR(uniform[k][0], sum[k] / weight[k], 1e-3);
  }
}

/// Twice the strain on the other side of an open joint, or thrice the stiffness beyond a welded one: each side keeps its own stress.
TEST(NodalStress, KnowsWhereTheStressOfElementsIsUniform) {
  CoverArrays covers;
  InitialStress initial;
  EXPECT_TRUE(stress_is_uniform(covers, initial));
  initial.gradient[2] = -1;
  EXPECT_FALSE(stress_is_uniform(covers, initial));
  covers.lattice.kind = LatticeKind::hex8;
  EXPECT_FALSE(stress_is_uniform(covers, {}));
  covers.lattice.kind = LatticeKind::tet24;
  covers.order = 1;
  EXPECT_FALSE(stress_is_uniform(covers, {}));
}

TEST(NodalStress, IsNotAveragedAcrossJointsNorMaterials) {
  const PolynomialField field = PolynomialField::of_degree(1);
  for (const bool open : {true, false}) {
    const Rock rock = open ? two_halves(0, 1) : two_halves(1, 0);
    const ElementMesh mesh = make_element_mesh(rock.covers());
    std::vector<Vec3> d = represent(rock.covers(), field);
    for (Index p = 0; p < rock.covers().cover_count(); ++p)
      if (rock.covered.cover_body[p] == 1) d[p] = 2 * d[p];
    const auto stress = nodal_stress(rock, mesh, d);
    std::array<int, 2> at_joint{};
    for (std::size_t t = 0; t < mesh.tetrahedron.size(); ++t)
      for (const Index k : mesh.tetrahedron[t]) {
        const Index side = mesh.block[t];
        at_joint[side] += std::abs(mesh.point[k][0] - middle[0]) < 1e-9;
        expect_stress(stress[k], field.stress(rock.materials[open ? 0 : side], mesh.point[k]),
                      open && side == 1 ? 2 : 1);
      }
    EXPECT_GT(at_joint[0], 10);
    EXPECT_GT(at_joint[1], 10);
  }
}

}  // namespace
}  // namespace rockfold
