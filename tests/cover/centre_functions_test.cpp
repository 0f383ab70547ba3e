// Cover functions about the rock that a cover holds (host/cover/centre_functions.hpp).
#include <gtest/gtest.h>

#include "src/space/shape_functions.hpp"
#include "tests/cover/covers.hpp"

namespace rockfold {
namespace {

using test::cover;

/// A box of 3 m × 2 m × 1 m that a lattice node lies in.
test::Covered covered_box(Real spacing, int order, LatticeKind kind = LatticeKind::tet6) {
  CoverSpec spec = test::spacing(spacing);
  spec.order = order;
  spec.lattice = kind;
  spec.origin = Vec3{1.1, 0.7, 0.3};
  return cover(test::box_model({0, 0, 0}, {3, 2, 1}), spec);
}

TEST(CentredFunctions, AreOfTheSizeOfOneInAllTheRockOfTheirCover) {
  for (const auto kind : {LatticeKind::tet5, LatticeKind::tet24, LatticeKind::hex8})
    for (const Real spacing : {4.0, 40.0, 2000.0}) {
      const test::Covered box = covered_box(spacing, 2, kind);
      const CoverArrays& a = box.arrays();
      ASSERT_EQ(a.middle.size(), a.cover_node.size());
      Real most = 0;
      for (Index e = 0; e < a.cut_count(); ++e)
        for (Index v = a.vertex_begin[a.piece_begin[e]]; v < a.vertex_begin[a.piece_begin[e + 1]];
             ++v)
          for (int n = 0; n < a.nodes_per_part(); ++n) {
            const Index p = a.element_cover[a.nodes_per_part() * e + n];
            const Vec3 x = a.lattice.cell_centre(a.element_cell[e]) + test::vertex(a, v);
            const auto m = cover_functions(
                a, p, a.lattice.to_local(x - a.lattice.node_position(a.cover_node[p])));
            for (int k = 0; k < 10; ++k) most = std::max(most, std::abs(m[k]));
            EXPECT_LE(norm(x - function_origin(a, p)), 0.5 * std::sqrt(14) * (1 + 1e-9));
          }
      EXPECT_NEAR(most, 1, 1e-9);
    }
}

TEST(CentredFunctions, AreThoseAboutNodesInRockWiderThanACell) {
  EXPECT_TRUE(covered_box(2.9, 2).arrays().middle.empty());
  EXPECT_TRUE(covered_box(0.4, 1).arrays().middle.empty());
  EXPECT_TRUE(covered_box(4, 0).arrays().middle.empty());
}

}  // namespace
}  // namespace rockfold
