// Rock turned and shifted by tiny amounts against the lattice: nothing of it is lost.
#include <algorithm>
#include <cmath>
#include <ostream>
#include <string>

#include <gtest/gtest.h>

#include "host/cover/points/locate.hpp"
#include "host/cover/points/surface_split.hpp"
#include "tests/cover/covers.hpp"

namespace rockfold::test {
namespace {

struct Placed {
  Vec3 size, axis;
  Real angle = 0, shift = 0;

  // Rodrigues' rotation about the origin, then the shift.
  Vec3 at(const Vec3& x) const {
    const Vec3 k = (1 / norm(axis)) * axis;
    return std::cos(angle) * x + std::sin(angle) * cross(k, x) +
           ((1 - std::cos(angle)) * dot(k, x)) * k + shift * Vec3{1, -0.7, 0.4};
  }
};

Model turned_box(const Placed& p) {
  Solid solid = box_solid("rock", {0, 0, 0}, {1, 1, 1});
  const Vec3& s = p.size;
  PrismShape prism;
  prism.base = {p.at({0, 0, 0}), p.at({s[0], 0, 0}), p.at({s[0], s[1], 0}), p.at({0, s[1], 0})};
  prism.extrude = p.at({0, 0, s[2]}) - p.at({0, 0, 0});
  solid.shape = prism;
  Model model;
  model.solids.push_back(solid);
  return model;
}

// What the elements' pieces have of the block's volume, of its surface and of points inside it.
void expect_all(const Placed& p, const CoverSpec& spec) {
  const Covered c = cover(turned_box(p), spec);
  const Complex& complex = *c.blocks.cutting.complex;
  Real volume = 0;
  for (const CellMoments& m : complex.moments) volume += m.volume;
  // Planes that differ by less than 1e-10 are one.
  const Real identified = std::max(p.angle, p.shift) < 5e-10 ? 3e-10 : 0;
  const CoverArrays& a = c.arrays();
  const Real share = cell_split(spec.lattice).share;  // 1/2 where two splits are overlaid
  Real found = a.regular_count() * lattice_cell_volume(a);
  for (Index q = 0; q < a.piece_count(); ++q) found += share * piece_volume(a, q);
  EXPECT_NEAR(found, volume, (1e-12 + identified) * volume);

  SurfaceSplitter splitter(complex, c.covering);
  for (const FreePart& f : complex.free_parts) {
    Real area = 0;
    splitter.split(complex.polygon_of(f), f.cell, f.face,
                   [&](const Holder&, const Polygon& q) { area += polygon_moments(q).area; });
    EXPECT_NEAR(share * area, f.area, 1e-9 * f.area)
        << "free part " << (&f - complex.free_parts.data());
  }

  const Locator locator(c.covering);
  int missing = 0;
  for (int i = 1; i < 8; ++i)
    for (int j = 1; j < 8; ++j)
      for (int k = 1; k < 8; ++k)
        if (!locator.find(p.at({p.size[0] * i / 8., p.size[1] * j / 8., p.size[2] * k / 8.}))
                 .found())
          ++missing;
  EXPECT_EQ(missing, 0) << "points inside the rock";
}

class NearLattice : public testing::TestWithParam<LatticeKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, NearLattice,
                         testing::Values(LatticeKind::tet5, LatticeKind::tet5_mixed,
                                         LatticeKind::tet6, LatticeKind::tet24, LatticeKind::hex8),
                         [](const auto& kind) {
                           std::string name = lattice_name(kind.param);
                           std::replace(name.begin(), name.end(), ' ', '_');
                           return name;
                         });

void sweep(LatticeKind kind, const Vec3& size, Real h) {
  CoverSpec spec = spacing(h);
  spec.lattice = kind;
  spec.origin = Vec3{0, 0, 0};
  const Vec3 axes[] = {{0, 0, 1}, {1, 1, 0}, {1, 2, 3}, {-3, 1, 2}};
  for (const Vec3& axis : axes)
    for (int e = -15; e <= -5; ++e)
      for (const Real digit : {1., 2.6}) {
        const Placed p{size, axis, digit * std::pow(10., e), 0};
        SCOPED_TRACE(testing::Message() << "turn " << p.angle << " about " << axis[0] << " "
                                        << axis[1] << " " << axis[2]);
        EXPECT_NO_THROW(expect_all(p, spec));
      }
  for (int e = -12; e <= -3; ++e)
    for (const Real digit : {1., 2.6, 5.}) {
      const Placed p{size, {0, 0, 1}, 0, digit * std::pow(10., e)};
      SCOPED_TRACE(testing::Message() << "shift " << p.shift);
      EXPECT_NO_THROW(expect_all(p, spec));
      const Placed both{size, {1, 2, 3}, 0.3 * p.shift, p.shift};
      EXPECT_NO_THROW(expect_all(both, spec)) << "and turn";
    }
}

TEST_P(NearLattice, KeepsAllOfAColumn) {
  sweep(GetParam(), {1, 1, 2}, 1);
}
TEST_P(NearLattice, KeepsAllOfAColumnInFineCells) {
  sweep(GetParam(), {1, 1, 2}, 0.5);
}
TEST_P(NearLattice, KeepsAllOfAPlate) {
  sweep(GetParam(), {2, 1, 0.02}, 0.5);
}

}  // namespace
}  // namespace rockfold::test
