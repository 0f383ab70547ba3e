// The thesis' numbers of manifold elements and of their vertices and faces (Table 4-1, Table 4-2, Fig. 4-7; case 0.1).
#include <gtest/gtest.h>

#include "tests/cover/covers.hpp"

namespace rockfold::test {
namespace {

struct PlateCase {
  Real spacing;
  Index elements;
  std::int64_t vertices;
};

class ThesisPlate : public testing::TestWithParam<PlateCase> {};

TEST_P(ThesisPlate, HasTheElementsAndVerticesOfTable41) {
  const PlateCase& c = GetParam();
  const Covered plate = cover(box_model({-1, -1, -0.05}, {1, 1, 0.05}), spacing(c.spacing));
  EXPECT_EQ(plate.arrays().element_count(), c.elements);
  EXPECT_EQ(plate.arrays().element_vertices, c.vertices);
  // 3,706 and more volumes of up to 1e-3 m³, each right to some 1e-16 of the cell's coordinates squared.
  EXPECT_NEAR(total_volume(plate.arrays()), 0.4, 1e-13);
}

INSTANTIATE_TEST_SUITE_P(Spacings, ThesisPlate,
                         testing::Values(PlateCase{0.52, 190, 1156}, PlateCase{0.32, 684, 3812},
                                         PlateCase{0.22, 1104, 6116}, PlateCase{0.12, 3706, 20184},
                                         PlateCase{0.08, 8100, 44282},
                                         PlateCase{0.05, 19200, 76800}));

TEST(ThesisCover, RotatedBy30DegreesAboutTheVerticalHas608Elements) {
  CoverSpec spec = spacing(0.31);
  spec.directions = {{{0, 0}, {90, 30}, {90, 120}}};
  const Covered plate = cover(box_model({-1, -1, -0.05}, {1, 1, 0.05}), spec);
  EXPECT_EQ(plate.arrays().element_count(), 608);
  EXPECT_NEAR(total_volume(plate.arrays()), 0.4, 1e-13);
}

TEST(ThesisCover, OfTheFallingCubeHas328Elements1502FacesAnd1670Vertices) {
  for (const Real s : {0.401, 0.45, 0.499}) {
    const Covered cube = cover(box_model({0, 0, 0}, {1, 1, 1}), spacing(s));
    EXPECT_EQ(cube.arrays().element_count(), 328) << s;
    EXPECT_EQ(cube.arrays().element_faces, 1502) << s;
    EXPECT_EQ(cube.arrays().element_vertices, 1670) << s;
  }
}

}  // namespace
}  // namespace rockfold::test
