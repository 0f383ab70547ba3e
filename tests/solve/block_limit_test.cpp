// One block with a linear cover is a block of three-dimensional DDA: twelve unknowns, with the matrices that Shi gives
// (Shi 2001, Three dimensional discontinuous deformation analysis; u0 v0 w0, three rotations, six strains about a point).
#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

using Twelve = std::array<Real, 12>;

/// u of Shi's twelve at x − origin.
Vec3 shi_displacement(const Twelve& q, const Vec3& x) {
  return {q[0] + x[2] * q[4] - x[1] * q[5] + x[0] * q[6] + x[2] / 2 * q[10] + x[1] / 2 * q[11],
          q[1] - x[2] * q[3] + x[0] * q[5] + x[1] * q[7] + x[2] / 2 * q[9] + x[0] / 2 * q[11],
          q[2] + x[1] * q[3] - x[0] * q[4] + x[2] * q[8] + x[1] / 2 * q[9] + x[0] / 2 * q[10]};
}

Twelve unit(int i) {
  Twelve q{};
  q[i] = 1;
  return q;
}

/// The linear cover that moves alike: its constants, then its gradient along each edge.
std::vector<Vec3> cover_of(const Twelve& q, const Mat3& edge) {
  const Vec3 origin = shi_displacement(q, {0, 0, 0});
  std::vector<Vec3> d{origin};
  for (const Vec3& e : edge) d.push_back(shi_displacement(q, e) - origin);
  return d;
}

TEST(OneBlock, WithALinearCoverHasTheMatricesOfDiscontinuousDeformationAnalysis) {
  const Vec3 low{0.2, -0.3, 1.0}, high{2.2, 0.7, 1.5}, origin{1.0, 0.1, 1.3};
  SmallSystem s;
  Lattice lattice;
  lattice.kind = LatticeKind::block;
  lattice.edge = {{{2, 0, 0}, {0, 1, 0}, {0, 0, 0.5}}};
  lattice.block_origin = {origin};
  s.covered = reference::cover_regions(lattice, {reference::box(low, high)});
  s.covered.arrays.order = 1;
  const Real young = 3e4, nu = 0.2, density = 2600;
  s.materials = {{density, young, nu}};
  const CoverSystem system = s.make();
  ASSERT_EQ(system.unknowns(), 4);

  // Moments of the box about the origin in closed form.
  const Vec3 side = high - low, arm = 0.5 * (low + high) - origin;
  const Real volume = side[0] * side[1] * side[2];
  const auto second = [&](int a, int b) {
    return volume * (arm[a] * arm[b] + (a == b ? side[a] * side[a] / 12 : 0));
  };
  const auto product = [&](const std::vector<Vec3>& y, const std::vector<Vec3>& x) {
    Real sum = 0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += dot(x[k], y[k]);
    return sum;
  };
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) {
      const auto a = cover_of(unit(i), lattice.edge), b = cover_of(unit(j), lattice.edge);
      // Shi: V E/((1+ν)(1−2ν)) [1−ν ν ν …; (1−2ν)/2 …] on the strains, nothing on the rest.
      Real stiffness = 0;
      const Real factor = volume * young / ((1 + nu) * (1 - 2 * nu));
      if (i >= 6 && j >= 6 && i < 9 && j < 9) stiffness = factor * (i == j ? 1 - nu : nu);
      if (i >= 9 && i == j) stiffness = factor * (1 - 2 * nu) / 2;
      EXPECT_NEAR(product(a, system.apply({1, 0, 0}, b)), stiffness, 1e-12 * factor) << i << j;

      // ∫ ρ TᵀT dV with T linear: constants, first and second moments.
      Real mass = 0;
      const Vec3 o{0, 0, 0}, ti = shi_displacement(unit(i), o), tj = shi_displacement(unit(j), o);
      mass += volume * dot(ti, tj);
      for (int d = 0; d < 3; ++d) {
        Vec3 x{};
        x[d] = 1;
        const Vec3 gi = shi_displacement(unit(i), x) - ti, gj = shi_displacement(unit(j), x) - tj;
        mass += volume * arm[d] * (dot(gi, tj) + dot(ti, gj));
        for (int e = 0; e < 3; ++e) {
          Vec3 y{};
          y[e] = 1;
          mass += second(d, e) * dot(gi, shi_displacement(unit(j), y) - tj);
        }
      }
      EXPECT_NEAR(product(a, system.apply({0, 1, 0}, b)), density * mass, 1e-12 * density * volume)
          << i << j;
    }
}

}  // namespace
}  // namespace rockfold
