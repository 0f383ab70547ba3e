// Lattices turned and shifted by next to nothing against the rock: elements, covers, faces and loads stay those of the aligned one.
#include <cmath>

#include <gtest/gtest.h>

#include "host/cover/points/free_faces.hpp"
#include "host/cover/points/loads.hpp"
#include "tests/cover/cover_rules.hpp"

namespace rockfold::test {
namespace {

constexpr Real degrees = 57.295779513082323;  // a radian

/// A box of 4 × 3 × 2 m, joints along the planes of a lattice of 1 m, one across it.
Model jointed_box(const Vec3& corner) {
  Model model = box_model(corner, corner + Vec3{4, 3, 2});
  add_joint(model, Vec3{1, 0, 0}, corner + Vec3{2, 0, 0});
  add_joint(model, Vec3{0, 0, 1}, corner + Vec3{0, 0, 1});
  add_joint(model, DipOrientation{63.1, 37}, corner + Vec3{1.3, 1.7, 0.6});
  return model;
}

CoverSpec lattice(LatticeKind kind, const Vec3& corner, Real turn, Real shift) {
  CoverSpec spec = spacing(1);
  spec.lattice = kind;
  spec.origin = corner + shift * Vec3{1, -0.7, 0.4};
  spec.directions = {{{turn * degrees, 35}, {90, turn * degrees}, {90, 90 + turn * degrees}}};
  return spec;
}

class Aligned : public testing::TestWithParam<LatticeKind> {};

INSTANTIATE_TEST_SUITE_P(Kinds, Aligned,
                         testing::Values(LatticeKind::tet5, LatticeKind::tet5_mixed,
                                         LatticeKind::tet6, LatticeKind::tet6_kuhn,
                                         LatticeKind::tet24, LatticeKind::hex8),
                         [](const auto& kind) {
                           std::string name = lattice_name(kind.param);
                           for (char& c : name)
                             if (c == ' ') c = '_';
                           return name;
                         });

struct Perturbed {
  Real turn, shift;
};

// The box is 5.4 m in size: nothing is as wide as 5e-9 m.
constexpr Perturbed all_below_the_width[] = {
    {1e-16, 0}, {1e-15, 0}, {3e-14, 0},     {1e-12, 0},     {1e-11, 0},
    {2e-10, 0}, {0, 1e-16}, {0, 1e-15},     {0, 4e-14},     {0, 1e-12},
    {0, 1e-10}, {0, 2e-9},  {1e-15, 1e-15}, {1e-13, 1e-11}, {1e-10, 1e-9}};

TEST_P(Aligned, LatticesTurnedByLessThanTheToleranceHaveItsElementsAndCovers) {
  for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{500000, 4200000, 300}})
    for (const JointTreatment joints : {JointTreatment::separate, JointTreatment::welded}) {
      CoverSpec straight = lattice(GetParam(), corner, 0, 0);
      straight.joints = joints;
      const Covered aligned = cover(jointed_box(corner), straight);
      for (const auto& [turn, shift] : all_below_the_width) {
        SCOPED_TRACE(testing::Message() << "turn " << turn << ", shift " << shift << ", at "
                                        << corner[0] << (joints == JointTreatment::welded));
        CoverSpec spec = lattice(GetParam(), corner, turn, shift);
        spec.joints = joints;
        const Covered c = cover(jointed_box(corner), spec);
        for (const std::string& fault : faults_of_covers(c)) ADD_FAILURE() << fault;
        EXPECT_EQ(c.arrays().element_count(), aligned.arrays().element_count());
        EXPECT_EQ(c.arrays().cover_count(), aligned.arrays().cover_count());
      }
    }
}

TEST_P(Aligned, LatticesTurnedByMoreLoseNothing) {
  for (int e = -9; e <= -3; ++e)
    for (const Perturbed& p : {Perturbed{std::pow(10., e), 0},
                               {0, 2 * std::pow(10., e)},
                               {3 * std::pow(10., e), 1e-7}}) {
      SCOPED_TRACE(testing::Message() << "turn " << p.turn << ", shift " << p.shift);
      const Vec3 corner{500000, 4200000, 300};
      CoverSpec spec = lattice(GetParam(), corner, p.turn, p.shift);
      spec.order = 1;
      for (const std::string& fault : faults_of_covers(cover(jointed_box(corner), spec)))
        ADD_FAILURE() << fault;
    }
}

/// Joints that make slivers: planes next to those of jointed_box.
TEST_P(Aligned, JointsThatMakeSliversAddNoElementsAndCovers) {
  const Vec3 corner{10, -20, 5};
  for (const Real off : {1e-9, 2e-9}) {
    const CoverSpec spec = lattice(GetParam(), corner, 0, 0);
    const Covered plain = cover(jointed_box(corner), spec);
    Model model = jointed_box(corner);
    add_joint(model, Vec3{1, 0, 0}, corner + Vec3{2 + off, 0, 0});
    add_joint(model, Vec3{0, 0, 1}, corner + Vec3{0, 0, 1 - off});
    add_joint(model, DipOrientation{63.1, 37}, corner + Vec3{1.3 + off, 1.7, 0.6});
    const Covered c = cover(model, spec);
    for (const std::string& fault : faults_of_covers(c)) ADD_FAILURE() << fault;
    EXPECT_EQ(c.blocks.arrays.block_count(), plain.blocks.arrays.block_count());
    EXPECT_EQ(c.arrays().element_count(), plain.arrays().element_count());
    EXPECT_EQ(c.arrays().cover_count(), plain.arrays().cover_count());
  }
}

Vec3 linear(const Vec3& x) {
  return {1 + 2 * x[0] - x[1] + 0.5 * x[2], -3 + x[0] + 4 * x[2], 0.25 * x[1] - x[2]};
}

/// Two solids with a gap far below the width: one body, through which a linear field goes on.
TEST_P(Aligned, SolidsWithAGapBelowTheWidthAreOneBodyForTheCovers) {
  for (const Real gap : {1e-12, 1e-10, 1e-9})
    for (const Real turn : {0., 1e-12, 1e-10, 1e-7, 1e-4}) {
      SCOPED_TRACE(testing::Message() << "gap " << gap << ", turn " << turn);
      const CoverSpec spec = lattice(GetParam(), {0, 0, 0}, turn, 0);
      const Covered whole = cover(box_model({0, 0, 0}, {4, 3, 2}), spec);
      Model model = box_model({0, 0, 0}, {2, 3, 2});
      model.solids.push_back(box_solid("other", {2 + 5 * gap, 0, 0}, {4, 3, 2}));
      const Covered c = cover(model, spec);
      ASSERT_EQ(c.blocks.arrays.block_count(), 1);
      for (const std::string& fault : faults_of_covers(c)) ADD_FAILURE() << fault;
      if (turn < 1e-9) {
        EXPECT_EQ(c.arrays().cover_count(), whole.arrays().cover_count());
        EXPECT_EQ(c.arrays().element_count(), whole.arrays().element_count());
      }
      std::vector<Vec3> x;
      for (const Real at : {1.9, 2.0, 2 + 5 * gap, 2.1})
        for (const Real y : {0.3, 1.0, 2.2}) x.push_back({at, y, 0.7});
      const MaterialPoints points = locate_points(c.covering, x);
      for (std::size_t n = 0; n < x.size(); ++n) {
        ASSERT_NE(points.element[n], none);
        Vec3 u{};
        for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
          u += points.weight[i] *
               linear(c.arrays().lattice.node_position(
                   c.arrays().cover_node[points.unknown[i] % c.arrays().cover_count()]));
        EXPECT_LE(norm(u - linear(x[n])), 1e-12);
      }
    }
}

/// Force and moment of a pressure on top of the box.
TEST_P(Aligned, LoadsAndRowsOfFixedFacesAreThoseOfTheAlignedLattice) {
  const Vec3 corner{3, -2, 5};
  Model model = jointed_box(corner);
  Traction pressure;
  pressure.where = PlaneRegion{corner + Vec3{0, 0, 2}, {0, 0, 1}, 1e-6};
  pressure.value = {1000, 0, 0};
  pressure.pressure = true;
  model.tractions.push_back(pressure);
  Fixed fixed;
  fixed.where = PlaneRegion{corner, {0, 0, 1}, 1e-6};
  fixed.components = {true, true, true};
  model.fixed.push_back(fixed);
  std::size_t rows_aligned = 0;
  for (const Perturbed& p : {Perturbed{0, 0},
                             {1e-15, 0},
                             {1e-12, 0},
                             {1e-10, 1e-10},
                             {0, 1e-15},
                             {0, 1e-9},
                             {1e-7, 1e-8}}) {
    SCOPED_TRACE(testing::Message() << "turn " << p.turn << ", shift " << p.shift);
    const Covered c = cover(model, lattice(GetParam(), corner, p.turn, p.shift));
    const LoadPoints loads = load_points(c.blocks.cutting, c.covering, c.model);
    Vec3 force{}, moment{};
    for (std::size_t n = 0; n < loads.points.size(); ++n) {
      force += loads.force[n];
      Vec3 x{};
      for (Index i = loads.points.begin[n]; i < loads.points.begin[n + 1]; ++i)
        x += loads.points.weight[i] *
             (c.arrays().lattice.node_position(c.arrays().cover_node[loads.points.unknown[i]]) -
              corner);
      moment += cross(x, loads.force[n]);
    }
    EXPECT_LE(norm(force - Vec3{0, 0, -12000}), 1e-6);
    EXPECT_LE(norm(moment - cross(Vec3{2, 1.5, 2}, Vec3{0, 0, -12000})), 1e-3);
    const std::size_t rows = fixed_points(c.blocks.cutting, c.covering, c.model).points.size();
    if (rows_aligned == 0) rows_aligned = rows;
    EXPECT_TRUE(rows == rows_aligned || p.turn > 1e-9) << rows << " rows, not " << rows_aligned;
  }
}

}  // namespace
}  // namespace rockfold::test
