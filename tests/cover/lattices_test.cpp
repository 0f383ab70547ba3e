// Covers of every lattice, upright and oblique: their volumes, weights and numbers against plain clipping in double.
#include <cmath>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/space/shape_functions.hpp"
#include "tests/cover/covers.hpp"
#include "tests/cover/plain_clipping.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace rockfold::test {
namespace {

struct Kind {
  LatticeKind lattice;
  bool oblique;
};

std::ostream& operator<<(std::ostream& out, const Kind& kind) {
  return out << lattice_name(kind.lattice) << (kind.oblique ? " oblique" : "");
}

CoverSpec spec_of(const Kind& kind, Real h) {
  CoverSpec spec = spacing(h);
  spec.lattice = kind.lattice;
  if (kind.oblique) {
    spec.directions = {{{20, 40}, {75, 10}, {80, 120}}};
    spec.spacing = {h, 0.8 * h, 1.3 * h};
    spec.origin = Vec3{0.1, 0.2, 0.3};
  }
  return spec;
}

class EveryLattice : public testing::TestWithParam<Kind> {};

INSTANTIATE_TEST_SUITE_P(
    Kinds, EveryLattice,
    testing::Values(Kind{LatticeKind::tet5, false}, Kind{LatticeKind::tet5_mixed, false},
                    Kind{LatticeKind::tet6, false}, Kind{LatticeKind::tet6_kuhn, false},
                    Kind{LatticeKind::tet24, false}, Kind{LatticeKind::hex8, false},
                    Kind{LatticeKind::tet5, true}, Kind{LatticeKind::tet5_mixed, true},
                    Kind{LatticeKind::tet6, true}, Kind{LatticeKind::tet6_kuhn, true},
                    Kind{LatticeKind::tet24, true}, Kind{LatticeKind::hex8, true}));

// The middle tetrahedra of the two forms have the cell's even and odd corners; they share an octahedron, of half the cell's edge from its
// middle to each corner.
TEST(OverlaidSplits, RefuseABlockThatEachWouldHaveHalfOf) {
  CoverSpec spec = spacing(1);
  spec.lattice = LatticeKind::tet5_mixed;
  spec.origin = Vec3{0, 0, 0};
  for (const Vec3& cell : {Vec3{0, 0, 0}, Vec3{3, -2, 0}}) {
    const auto box = [&](Real low, Real high) {
      return box_model(cell + low * Vec3{1, 1, 1}, cell + high * Vec3{1, 1, 1});
    };
    try {
      cover(box(0.4, 0.6), spec);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      const std::string what = error.diagnostics().front().message;
      EXPECT_NE(what.find("block 1 lies in the middle of the lattice cell"), std::string::npos)
          << what;
    }
    EXPECT_EQ(cover(box(0.1, 0.6), spec).blocks.arrays.block_count(), 1);
    EXPECT_EQ(cover(box(0.6, 1.4), spec).blocks.arrays.block_count(), 1);
    CoverSpec one = spec;
    one.lattice = LatticeKind::tet5;
    EXPECT_EQ(cover(box(0.4, 0.6), one).arrays().element_count(), 1);
  }
}

Model jointed_rock(unsigned seed, int joints, bool notch) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> unit(0, 1);
  Model model = box_model({0, 0, 0}, {5, 4, 3});
  if (notch) model.solids.push_back(box_solid("notch", {3, -1, 1.5}, {6, 5, 4}, false));
  for (int j = 0; j < joints; ++j)
    add_joint(model, DipOrientation{90 * unit(random), 360 * unit(random)},
              {5 * unit(random), 4 * unit(random), 3 * unit(random)});
  return model;
}

std::vector<HalfSpace> half_spaces(const BlockArrays& a, Index block) {
  std::vector<HalfSpace> inside;
  for (Index f = a.face_begin[block]; f < a.face_begin[block + 1]; ++f) {
    const Vec3& x = a.vertex[a.corner_vertex[a.corner_begin[a.loop_begin[f]]]];
    inside.push_back({a.face_normal[f], dot(a.face_normal[f], x)});
  }
  return inside;
}

Index cell_count(const Lattice& lattice) {
  return lattice.cells[0] * lattice.cells[1] * lattice.cells[2];
}

std::vector<Vec3> random_points(unsigned seed, int count, const Vec3& size) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<Real> unit(0, 1);
  std::vector<Vec3> x;
  for (int i = 0; i < count; ++i)
    x.push_back({size[0] * unit(random), size[1] * unit(random), size[2] * unit(random)});
  return x;
}

Real span(const Lattice& lattice) {
  return dot(lattice.edge[0], cross(lattice.edge[1], lattice.edge[2]));
}

TEST_P(EveryLattice, KeepsTheVolumeOfEachBlock) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Covered c = cover(jointed_rock(seed, 6, true), spec_of(GetParam(), 0.61));
    const CoverArrays& a = c.arrays();
    const Real share = cell_split(a.lattice.kind).share;
    std::vector<Real> volume(c.blocks.arrays.block_count(), 0);
    for (Index r = 0; r < a.regular_count(); ++r) volume[a.regular_block[r]] += span(a.lattice);
    for (Index q = 0; q < a.piece_count(); ++q)
      volume[a.piece_block[q]] += share * piece_volume(a, q);
    for (std::size_t b = 0; b < volume.size(); ++b)
      EXPECT_NEAR(volume[b], c.blocks.arrays.volume[b], 1e-12) << seed;
  }
}

TEST_P(EveryLattice, HasTheElementsAndCoversThatPlainClippingFindsInConvexBlocks) {
  // A star is convex, so is its part in a convex block: one cover for each node and block that meet, one element for each
  // part and block.
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Covered c = cover(jointed_rock(seed, 6, false), spec_of(GetParam(), 0.83));
    const CoverArrays& a = c.arrays();
    const Lattice& lattice = a.lattice;
    Index elements = 0;
    std::set<std::pair<Index, Index>> covers;  // node, block
    for (Index b = 0; b < c.blocks.arrays.block_count(); ++b) {
      const auto inside = half_spaces(c.blocks.arrays, b);
      for (Index cell = 0; cell < cell_count(lattice); ++cell)
        for (int p = 0; p < lattice.split(cell).part_count(); ++p) {
          if (!(clip(part_of(lattice, cell, p), inside).volume() > 1e-14)) continue;
          ++elements;
          const CellPart& part = lattice.split(cell).part[p];
          for (int n = 0; n < part.nodes; ++n)
            covers.emplace(lattice.cell_node(cell, part.node[n]), b);
        }
    }
    EXPECT_EQ(a.element_count(), elements) << seed;
    EXPECT_EQ(a.cover_count(), static_cast<Index>(covers.size())) << seed;
    std::vector<Index> nodes;
    for (const auto& [node, block] : covers) nodes.push_back(node);
    EXPECT_EQ(a.cover_node, nodes) << seed;
  }
}

TEST_P(EveryLattice, HasWeightsThatSumToOneAndReproduceLinearFields) {
  const Covered c = cover(jointed_rock(5, 3, false), spec_of(GetParam(), 0.7));
  const CoverArrays& a = c.arrays();
  const auto x = random_points(7, 300, {5, 4, 3});
  const MaterialPoints points = locate_points(c.covering, x);
  for (std::size_t n = 0; n < x.size(); ++n) {
    ASSERT_NE(points.element[n], none);
    EXPECT_LE(norm(point_position(a, points, n) - x[n]), 1e-14);
    Real sum = 0;
    Vec3 place{};
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
      sum += points.weight[i];
      place += points.weight[i] * a.lattice.node_position(a.cover_node[points.unknown[i]]);
      EXPECT_GT(points.weight[i], -1e-8);
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_LE(norm(place - x[n]), 1e-13);
  }
}

TEST_P(EveryLattice, ReproducesLinearAndQuadraticFieldsByCoversOfThatOrder) {
  for (const int order : {1, 2}) {
    CoverSpec spec = spec_of(GetParam(), 0.9);
    spec.order = order;
    const Covered c = cover(jointed_rock(5, 2, false), spec);
    const CoverArrays& a = c.arrays();
    EXPECT_EQ(a.order, order);
    // u = 1 + η_0 − 2 η_1 η_2 (order 2), by its Taylor series about each node.
    const auto local = [&](const Vec3& x) { return a.lattice.to_local(x - a.lattice.origin); };
    const auto exact = [&](const Vec3& x) {
      const Vec3 e = local(x);
      return 1 + e[0] - (order == 2 ? 2 * e[1] * e[2] : 0.0);
    };
    std::vector<Real> d(static_cast<std::size_t>(a.unknown_count()), 0);
    for (Index p = 0; p < a.cover_count(); ++p) {
      const Vec3 e = local(a.lattice.node_position(a.cover_node[p]));
      d[p] = exact(a.lattice.node_position(a.cover_node[p]));
      d[a.cover_count() + p] = 1;
      if (order == 1) continue;
      d[2 * a.cover_count() + p] = -2 * e[2];
      d[3 * a.cover_count() + p] = -2 * e[1];
      d[8 * a.cover_count() + p] = -2;
    }
    const auto x = random_points(11, 200, {5, 4, 3});
    const MaterialPoints points = locate_points(c.covering, x);
    for (std::size_t n = 0; n < x.size(); ++n) {
      Real u = 0;
      for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i)
        u += points.weight[i] * d[points.unknown[i]];
      EXPECT_NEAR(u, exact(x[n]), 1e-12);
    }
  }
}

// One joint across the rock that ends on the way: the rectangle y0 … y1, z0 … z1 of the plane x = at.
struct Crack {
  Real at, y0, y1, z0, z1;
};

Model cracked_box(const Crack& k) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, Vec3{1, 0, 0}, {k.at, 0, 0});
  model.joints[0].polygon = {
      {k.at, k.y0, k.z0}, {k.at, k.y1, k.z0}, {k.at, k.y1, k.z1}, {k.at, k.y0, k.z1}};
  return model;
}

// What a crack makes of a convex set (a part, or a star) within the rock: two if it covers the whole of the section by its plane.
class Section {
 public:
  void add(const Polyhedron& piece, Real at) {
    for (const Vec3& x : piece.corners()) {
      low_ = std::min(low_, x[0] - at);
      high_ = std::max(high_, x[0] - at);
    }
    for (const Real side : {1.0, -1.0})
      for (const Vec3& x : clip(piece, HalfSpace{{side, 0, 0}, side * at}).corners())
        if (std::abs(x[0] - at) < 1e-10)
          for (int d = 0; d < 2; ++d) {
            min_[d] = std::min(min_[d], x[1 + d]);
            max_[d] = std::max(max_[d], x[1 + d]);
          }
  }
  bool any() const { return low_ < infinity; }
  bool cut_by(const Crack& k) const {
    return low_ < -1e-10 && high_ > 1e-10 && min_[0] >= k.y0 - 1e-10 && max_[0] <= k.y1 + 1e-10 &&
           min_[1] >= k.z0 - 1e-10 && max_[1] <= k.z1 + 1e-10;
  }

 private:
  static constexpr Real infinity = 1e300;
  Real low_ = infinity, high_ = -infinity;
  Real min_[2] = {infinity, infinity}, max_[2] = {-infinity, -infinity};
};

struct Expected {
  Index elements = 0;
  std::map<Index, int> covers;  // by node
};

Expected expected_of(const Lattice& lattice, const Crack& k) {
  const std::vector<HalfSpace> rock{{{1, 0, 0}, 4},  {{-1, 0, 0}, 0}, {{0, 1, 0}, 4},
                                    {{0, -1, 0}, 0}, {{0, 0, 1}, 4},  {{0, 0, -1}, 0}};
  Expected expected;
  std::map<Index, Section> stars;
  for (Index cell = 0; cell < cell_count(lattice); ++cell)
    for (int p = 0; p < lattice.split(cell).part_count(); ++p) {
      const Polyhedron piece = clip(part_of(lattice, cell, p), rock);
      if (!(piece.volume() > 1e-14)) continue;
      Section own;
      own.add(piece, k.at);
      expected.elements += own.cut_by(k) ? 2 : 1;
      const CellPart& part = lattice.split(cell).part[p];
      for (int n = 0; n < part.nodes; ++n)
        stars[lattice.cell_node(cell, part.node[n])].add(piece, k.at);
    }
  for (const auto& [node, star] : stars) expected.covers[node] = star.cut_by(k) ? 2 : 1;
  return expected;
}

TEST_P(EveryLattice, GivesAStarOneCoverWhereAJointEndsInsideItAndTwoWhereItIsCutThrough) {
  // Ends half-way up, ends on both sides, a closed crack inside, a hole of a crack smaller than a star, through.
  for (const Crack& k :
       {Crack{2.1, -1, 5, -1, 2.3}, Crack{1.7, 0.9, 3.1, -1, 5}, Crack{2.1, 0.6, 3.4, 0.7, 3.6},
        Crack{2.05, 1.9, 2.3, 1.9, 2.2}, Crack{2.1, -1, 5, -1, 5}}) {
    const Covered c = cover(cracked_box(k), spec_of(GetParam(), 0.8));
    const Expected expected = expected_of(c.arrays().lattice, k);
    std::map<Index, int> covers;
    for (const Index node : c.arrays().cover_node) ++covers[node];
    EXPECT_EQ(covers, expected.covers) << k.at << ' ' << k.y0 << ' ' << k.z0;
    EXPECT_EQ(c.arrays().element_count(), expected.elements);
  }
}

TEST_P(EveryLattice, GivesAStarThatParallelJointsCutInSixPartsSixCovers) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  for (int j = 0; j < 5; ++j) add_joint(model, Vec3{0, 0, 1}, {0, 0, 1.9 + 0.05 * j});
  const Covered c = cover(model, spec_of(GetParam(), 1));
  std::map<Index, int> covers;
  for (const Index node : c.arrays().cover_node) ++covers[node];
  int most = 0;
  for (const auto& [node, count] : covers) most = std::max(most, count);
  EXPECT_EQ(most, 6);
}

TEST_P(EveryLattice, IsContinuousWithinABlock) {
  // The two sides of a facet see the same covers: any values of the covers move both alike.
  const Covered c = cover(jointed_rock(4, 4, true), spec_of(GetParam(), 0.7));
  const CoverArrays& a = c.arrays();
  std::mt19937 random(3);
  std::uniform_real_distribution<Real> unit(0, 1);
  std::vector<Vec3> value(a.cover_count());
  for (Vec3& v : value) v = {unit(random), unit(random), unit(random)};
  std::vector<Vec3> x;
  while (x.size() < 12000) {
    const auto cell = static_cast<Index>(unit(random) * cell_count(a.lattice));
    const int parts = a.lattice.split(cell).part_count();
    const Polyhedron part = part_of(a.lattice, cell, static_cast<int>(unit(random) * parts));
    const auto& f = part.face[static_cast<std::size_t>(unit(random) * 4)];
    const Real s = unit(random), t = unit(random) * (1 - s);
    const Vec3 on = f[0] + s * (f[1] - f[0]) + t * (f[2] - f[0]);
    const Vec3 n = cross(f[1] - f[0], f[2] - f[0]);
    x.push_back(on + (1e-7 / norm(n)) * n);
    x.push_back(on - (1e-7 / norm(n)) * n);
  }
  const MaterialPoints points = locate_points(c.covering, x);
  const auto block = [&](std::size_t n) {
    const Index e = points.element[n] - a.parts_per_cell() * a.regular_count();
    return e < 0 ? a.regular_block[points.element[n] / a.parts_per_cell()]
                 : a.piece_block[a.piece_begin[e]];
  };
  int compared = 0;
  for (std::size_t n = 0; n < x.size(); n += 2) {
    if (points.element[n] == none || points.element[n + 1] == none || block(n) != block(n + 1))
      continue;
    EXPECT_LE(norm(interpolate(points, n, value) - interpolate(points, n + 1, value)), 2e-5);
    ++compared;
  }
  EXPECT_GT(compared, 500);
}

TEST_P(EveryLattice, IsTheSameForAnyNumberOfThreads) {
#ifdef _OPENMP
  const int before = omp_get_max_threads();
  const Model model = jointed_rock(3, 6, true);
  omp_set_num_threads(1);
  const Covered one = cover(model, spec_of(GetParam(), 0.5));
  omp_set_num_threads(4);
  const Covered four = cover(model, spec_of(GetParam(), 0.5));
  omp_set_num_threads(before);
  EXPECT_EQ(one.arrays().cover_node, four.arrays().cover_node);
  EXPECT_EQ(one.arrays().element_cover, four.arrays().element_cover);
  EXPECT_EQ(one.arrays().regular_cover, four.arrays().regular_cover);
  EXPECT_EQ(one.arrays().vertex_xyz, four.arrays().vertex_xyz);
  EXPECT_EQ(one.arrays().triangle_vertex, four.arrays().triangle_vertex);
#endif
}

TEST_P(EveryLattice, HoldsBlockVerticesInTheirOwnBlocks) {
  const Covered c = cover(jointed_rock(6, 4, true), spec_of(GetParam(), 0.7));
  const CoverArrays& a = c.arrays();
  std::vector<Index> cover_block(a.cover_count(), none);
  for (Index e = 0; e < a.element_count(); ++e) {
    const ElementNodes nodes = element_nodes(a, e);
    const Index cut = e - a.parts_per_cell() * a.regular_count();
    const Index b =
        cut < 0 ? a.regular_block[e / a.parts_per_cell()] : a.piece_block[a.piece_begin[cut]];
    for (int n = 0; n < a.nodes_per_part(); ++n) {
      EXPECT_TRUE(cover_block[nodes.cover[n]] == none || cover_block[nodes.cover[n]] == b);
      cover_block[nodes.cover[n]] = b;
    }
  }
  const BlockArrays& blocks = c.blocks.arrays;
  const MaterialPoints points = locate_block_vertices(c.covering, blocks);
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v) {
      ASSERT_NE(points.element[v], none);
      for (Index i = points.begin[v]; i < points.begin[v + 1]; ++i)
        EXPECT_EQ(cover_block[points.unknown[i]], b);
    }
}

TEST_P(EveryLattice, OfAlignedRockIsItsCellsAsIndices) {
  if (GetParam().oblique) return;
  const Covered c = cover(box_model({0, 0, 0}, {4, 6, 2}), spec_of(GetParam(), 1));
  EXPECT_EQ(c.arrays().regular_count(), 48);
  EXPECT_EQ(c.arrays().cut_count(), 0);
  // tet24: 48 centres of cells and 5·6·2 + 4·7·2 + 4·6·3 of faces besides.
  EXPECT_EQ(c.arrays().cover_count(),
            105 + (GetParam().lattice == LatticeKind::tet24 ? 48 + 188 : 0));
}

TEST(ObliqueLattice, OfARockBetweenItsOwnPlanesIsRegular) {
  // A sheared box whose faces are lattice planes: joint sets and lattice have the same planes.
  CoverSpec spec = spacing(0.5);
  spec.directions = {{{0, 0}, {70, 0}, {80, 90}}};
  spec.spacing = {0.5, 0.25, 0.75};
  spec.origin = Vec3{0, 0, 0};
  Model model = box_model({-4, -4, -4}, {4, 4, 4});
  add_set(model, spec.directions[0], 1, {0, 0, 0});
  add_set(model, spec.directions[1], 1, {0, 0, 0});
  add_set(model, spec.directions[2], 1.5, {0, 0, 0});
  for (const LatticeKind kind : {LatticeKind::tet5, LatticeKind::tet6, LatticeKind::tet24}) {
    spec.lattice = kind;
    const Covered c = cover(model, spec);
    const CoverArrays& a = c.arrays();
    // Inner blocks hold 2 × 4 × 2 whole cells each.
    std::map<Index, int> regular;
    for (const Index b : a.regular_block) ++regular[b];
    int whole = 0;
    for (const auto& [b, count] : regular) {
      if (c.blocks.arrays.finite[b] == 0 || count < 16) continue;
      EXPECT_EQ(count, 16);
      EXPECT_NEAR(c.blocks.arrays.volume[b], 16 * span(a.lattice), 1e-12);
      ++whole;
    }
    EXPECT_GT(whole, 50);
    EXPECT_NEAR(norm(cross(a.lattice.edge[0], a.lattice.edge[1])) * 0.5, span(a.lattice), 1e-15);
  }
}

TEST(BlockLattice, HasOneCellCoverAndElementForEachBlock) {
  CoverSpec spec;
  spec.lattice = LatticeKind::block;
  const Covered c = cover(jointed_rock(2, 6, true), spec);
  const CoverArrays& a = c.arrays();
  const BlockArrays& blocks = c.blocks.arrays;
  ASSERT_EQ(a.cover_count(), blocks.block_count());
  ASSERT_EQ(a.element_count(), blocks.block_count());
  EXPECT_EQ(a.regular_count(), 0);
  for (Index b = 0; b < blocks.block_count(); ++b) {
    EXPECT_EQ(a.cover_node[b], b);
    EXPECT_EQ(a.element_cell[b], b);
    EXPECT_EQ(a.element_cover[b], b);
    EXPECT_LE(norm(a.lattice.block_origin[b] - blocks.centroid[b]), 1e-13);
    Real volume = 0;
    for (Index q = a.piece_begin[b]; q < a.piece_begin[b + 1]; ++q) {
      EXPECT_EQ(a.piece_block[q], b);
      volume += piece_volume(a, q);
    }
    EXPECT_NEAR(volume, blocks.volume[b], 1e-13);
  }
  const MaterialPoints vertices = locate_block_vertices(c.covering, blocks);
  for (Index b = 0; b < blocks.block_count(); ++b)
    for (Index v = blocks.vertex_begin[b]; v < blocks.vertex_begin[b + 1]; ++v) {
      ASSERT_EQ(vertices.begin[v + 1] - vertices.begin[v], 1);
      EXPECT_EQ(vertices.unknown[vertices.begin[v]], b);
      EXPECT_EQ(vertices.weight[vertices.begin[v]], 1);
    }
  EXPECT_EQ(locate_points(c.covering, {{6, 1, 1}}).element[0], none);
}

TEST(BlockLattice, HasOneElementForEachMaterialOfABlock) {
  Model model = box_model({0, 0, 0}, {2, 2, 2});
  model.solids.push_back(box_solid("lining", {2, 0, 0}, {4, 2, 2}));
  model.solids[1].material = 1;
  model.materials.resize(2);
  model.cover = CoverSpec{};
  model.cover->lattice = LatticeKind::block;
  Progress silent;
  const CoverArrays a = build_covers(cut(model).cutting, model, silent).arrays;
  EXPECT_EQ(a.cover_count(), 1);
  ASSERT_EQ(a.element_count(), 2);
  EXPECT_EQ(a.element_material, (std::vector<Index>{0, 1}));
  EXPECT_EQ(a.element_cover, (std::vector<Index>{0, 0}));
}

TEST(Covers, FarFromTheirOriginOrFarLargerThanTheRockAreAnErrorThatNamesTheKey) {
  const auto key_and_message = [](const CoverSpec& spec) -> std::pair<std::string, std::string> {
    try {
      cover(box_model({0, 0, 0}, {1, 1, 2}), spec);
    } catch (const Error& e) {
      return {e.diagnostics().front().place.key, e.diagnostics().front().message};
    }
    return {};
  };
  CoverSpec far = spacing(0.5);
  far.origin = Vec3{1e9, 1e9, 1e9};
  EXPECT_EQ(key_and_message(far).first, "cover.origin");
  EXPECT_EQ(key_and_message(spacing(4000)).first, "");  // constants of tetrahedra keep their digits
  CoverSpec wide = spacing(4000);
  wide.order = 1;
  const auto [key, message] = key_and_message(wide);
  EXPECT_EQ(key, "cover.spacing");
  EXPECT_NE(message.find("2e+03 times the extent of the rock"), std::string::npos) << message;
  wide.spacing = {1900, 1900, 1900};
  EXPECT_EQ(key_and_message(wide).first, "");
}

TEST(Covers, OfMoreElementsThanTheModelAllowsAreAnErrorThatNamesTheLimit) {
  // By estimate: 64 m³ of cells of 1 m³; exactly: 384 elements.
  for (const Index limit : {100, 383}) {
    CoverSpec spec = spacing(1);
    spec.origin = Vec3{0, 0, 0};
    spec.max_elements = limit;
    try {
      cover(box_model({0, 0, 0}, {4, 4, 4}), spec);
      FAIL() << limit;
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::model);
      EXPECT_EQ(e.diagnostics().front().place.key, "cover.spacing");
    }
  }
  CoverSpec cut_more = spacing(1);  // 125 cells hold rock, not the 64 of the estimate
  cut_more.origin = Vec3{0.5, 0.5, 0.5};
  cut_more.max_elements = 385;
  EXPECT_THROW(cover(box_model({0, 0, 0}, {4, 4, 4}), cut_more), Error);
  CoverSpec enough = spacing(1);
  enough.origin = Vec3{0, 0, 0};
  enough.max_elements = 384;
  EXPECT_EQ(cover(box_model({0, 0, 0}, {4, 4, 4}), enough).arrays().element_count(), 384);
}

}  // namespace
}  // namespace rockfold::test
