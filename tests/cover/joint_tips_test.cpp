// joint_tips = "extend": a joint that ends inside an element cuts it in two. Counts against plain clipping in double.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "host/cover/points/loads.hpp"
#include "src/base/vector.hpp"
#include "tests/cover/covers.hpp"
#include "tests/cover/plain_clipping.hpp"

namespace rockfold::test {
namespace {

/// The rectangle y0 … y1, z0 … z1 of the plane x = at, in a box from 0 to 4.
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

const std::vector<HalfSpace> rock{{{1, 0, 0}, 4},  {{-1, 0, 0}, 0}, {{0, 1, 0}, 4},
                                  {{0, -1, 0}, 0}, {{0, 0, 1}, 4},  {{0, 0, -1}, 0}};

/// Whether a convex set reaches to both sides of the crack's plane.
bool straddles(const Polyhedron& set, const Crack& k) {
  bool low = false, high = false;
  for (const Vec3& x : set.corners()) low |= x[0]<k.at - 1e-9, high |= x[0]> k.at + 1e-9;
  return low && high;
}

/// Whether it holds an area of the crack.
bool holds(const Polyhedron& set, const Crack& k) {
  return straddles(
      clip(set, {{{0, -1, 0}, -k.y0}, {{0, 1, 0}, k.y1}, {{0, 0, -1}, -k.z0}, {{0, 0, 1}, k.z1}}),
      k);
}

struct Counts {
  Index elements = 0;
  std::map<Index, int> covers;  // by node
};

// A part that holds an area of the crack is two elements; a star is two covers where the crack runs, or is prolonged, through all of
// its parts that lie on both sides.
Counts expected_of(const Lattice& lattice, const Crack& k) {
  Counts expected;
  std::map<Index, std::set<bool>> sides;  // by node: whether each straddling part is cut
  for (Index cell = 0; cell < lattice.cells[0] * lattice.cells[1] * lattice.cells[2]; ++cell)
    for (int p = 0; p < lattice.split(cell).part_count(); ++p) {
      const Polyhedron piece = clip(part_of(lattice, cell, p), rock);
      if (!(piece.volume() > 1e-14)) continue;
      const bool cut = holds(piece, k);
      expected.elements += cut ? 2 : 1;
      const CellPart& part = lattice.split(cell).part[p];
      for (int n = 0; n < part.nodes; ++n) {
        auto& of_star = sides[lattice.cell_node(cell, part.node[n])];
        if (straddles(piece, k)) of_star.insert(cut);
      }
    }
  for (const auto& [node, cut] : sides) expected.covers[node] = cut == std::set<bool>{true} ? 2 : 1;
  return expected;
}

Counts counts_of(const CoverArrays& a) {
  Counts counts;
  counts.elements = a.element_count();
  for (const Index node : a.cover_node) ++counts.covers[node];
  return counts;
}

CoverSpec extended(LatticeKind kind, Real h) {
  CoverSpec spec = spacing(h);
  spec.lattice = kind;
  spec.joint_tips = JointTips::extend;
  return spec;
}

const LatticeKind kinds[] = {LatticeKind::tet5,  LatticeKind::tet6, LatticeKind::tet6_kuhn,
                             LatticeKind::tet24, LatticeKind::hex8, LatticeKind::tet5_mixed};

TEST(JointTips, ExtendedCutEachElementThatTheyEndIn) {
  for (const LatticeKind kind : kinds)
    for (const Crack& k : {Crack{2.1, -1, 5, -1, 2.3}, Crack{1.7, 0.9, 3.1, -1, 5},
                           Crack{2.1, 0.6, 3.4, 0.7, 3.6}, Crack{2.05, 1.9, 2.3, 1.9, 2.2}}) {
      const Covered c = cover(cracked_box(k), extended(kind, 0.8));
      const Counts expected = expected_of(c.arrays().lattice, k), found = counts_of(c.arrays());
      EXPECT_EQ(found.elements, expected.elements) << lattice_name(kind) << ' ' << k.at;
      EXPECT_EQ(found.covers, expected.covers) << lattice_name(kind) << ' ' << k.at;
      Real volume = c.arrays().regular_count() * lattice_cell_volume(c.arrays());
      for (Index q = 0; q < c.arrays().piece_count(); ++q)
        volume += cell_split(kind).share * piece_volume(c.arrays(), q);
      EXPECT_NEAR(volume, 64, 64e-13);
    }
}

/// A strip of a lattice plane, low < z < high, through a box from 0 to 4 whose lattice cells are cubes of 1 m.
struct Strip {
  Vec3 normal;  // horizontal
  Real at, low, high;
};

Model cut_by(const Strip& s) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, s.normal, {s.at, 0, 0});
  const Vec3 along = 9 * cross(Vec3{0, 0, 1}, s.normal);
  for (const auto& [side, z] : {std::pair{-1, s.low}, {1, s.low}, {1, s.high}, {-1, s.high}})
    model.joints[0].polygon.push_back(Vec3{s.at, 0, z} + Real(side) * along);
  return model;
}

/// Parts of a node's star are one where they share a facet (three nodes and more) of which the strip takes nothing.
int covers_at(const CoverArrays& a, Index node, const Strip& s, bool extended) {
  struct Part {
    Index cell;
    std::set<Index> nodes;
    int body;
  };
  std::vector<Part> star;
  for (Index cell = 0; cell < a.lattice.cells[0] * a.lattice.cells[1] * a.lattice.cells[2]; ++cell)
    for (const CellPart& part : a.lattice.split(cell).part) {
      const Vec3 centre = a.lattice.cell_centre(cell);
      if (std::any_of(centre.begin(), centre.end(), [](Real x) { return x < 0 || x > 4; }))
        continue;
      Part p{cell, {}, static_cast<int>(star.size())};
      for (int n = 0; n < part.nodes; ++n) p.nodes.insert(a.lattice.cell_node(cell, part.node[n]));
      if (p.nodes.count(node) != 0) star.push_back(std::move(p));
    }
  const auto open = [&](const Part& p, const Part& q) {
    std::vector<Vec3> shared;
    for (const Index n : p.nodes)
      if (q.nodes.count(n) != 0) shared.push_back(a.lattice.node_position(n));
    if (shared.size() < 3) return p.cell == q.cell && a.lattice.kind == LatticeKind::tet5_mixed;
    bool held = true;
    Real low = 9, high = -9;
    for (const Vec3& x : shared) {
      held = held && std::abs(dot(s.normal, x) - s.normal[0] * s.at) < 1e-9;
      low = std::min(low, x[2]), high = std::max(high, x[2]);
    }
    held = held && low < s.high && high > s.low;
    const bool whole = low >= s.low && high <= s.high;
    return !(held && (extended || whole));
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (Part& p : star)
      for (Part& q : star)
        if (p.body > q.body && open(p, q)) p.body = q.body, changed = true;
  }
  std::set<int> bodies;
  for (const Part& p : star) bodies.insert(p.body);
  return static_cast<int>(bodies.size());
}

TEST(JointTips, InLatticePlanesAreProlongedToTheEdgesOfTheFacetsThatTheyEndIn) {
  const Vec3 x{1, 0, 0}, diagonal{1, -1, 0};
  struct {
    LatticeKind kind;
    Strip strip;
  } const cases[] = {{LatticeKind::hex8, {x, 2, -1, 2.3}},
                     {LatticeKind::tet6, {x, 2, -1, 2.3}},
                     {LatticeKind::tet6, {x, 3, 0.7, 2.6}},
                     {LatticeKind::tet6, {diagonal, 1, -1, 1.4}},
                     {LatticeKind::tet6_kuhn, {diagonal, 0, 1.2, 5}},
                     {LatticeKind::tet5, {x, 1, 0.2, 2.3}},
                     {LatticeKind::tet24, {x, 2, -1, 2.3}},
                     {LatticeKind::tet24, {diagonal, 0, -1, 2.6}},
                     {LatticeKind::tet5_mixed, {x, 2, -1, 2.3}}};
  for (const auto& [kind, strip] : cases) {
    CoverSpec spec = extended(kind, 1);
    spec.origin = Vec3{0, 0, 0};
    Index covers_kept = 0;
    for (const bool extend : {false, true}) {
      spec.joint_tips = extend ? JointTips::extend : JointTips::keep;
      const Covered c = cover(cut_by(strip), spec);
      const Counts found = counts_of(c.arrays());
      EXPECT_EQ(found.elements, 64 * cell_split(kind).part_count()) << lattice_name(kind);
      for (const auto& [node, covers] : found.covers) {
        EXPECT_EQ(covers, covers_at(c.arrays(), node, strip, extend))
            << lattice_name(kind) << ", node " << node << (extend ? ", extended" : ", kept");
      }
      const auto all = static_cast<Index>(c.arrays().cover_node.size());
      EXPECT_GT(all, covers_kept);
      covers_kept = all;
      EXPECT_NEAR(c.blocks.cutting.totals.dangling_joint_area,
                  (std::min(strip.high, 4.0) - std::max(strip.low, 0.0)) *
                      (strip.normal[1] == 0 ? 4 : std::sqrt(2.0) * (4 - strip.at)),
                  1e-12);
    }
  }
}

TEST(JointTips, AreKeptByDefault) {
  const Crack k{2.1, -1, 5, -1, 2.3};
  const CoverSpec keep = spacing(0.8);
  const Covered kept = cover(cracked_box(k), keep),
                cut = cover(cracked_box(k), extended(LatticeKind::tet6, 0.8));
  EXPECT_LT(kept.arrays().element_count(), cut.arrays().element_count());
}

TEST(JointTips, ThatEndAtAnotherJointCutNothingBeyondIt) {
  Model model = cracked_box({2.1, -1, 5, -1, 2.3});
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2.3});
  const Covered kept = cover(model, spacing(0.8)),
                cut = cover(model, extended(LatticeKind::tet6, 0.8));
  EXPECT_EQ(kept.arrays().element_cover, cut.arrays().element_cover);
  EXPECT_EQ(kept.arrays().vertex_xyz, cut.arrays().vertex_xyz);
}

TEST(JointTips, OfTwoCrossingJointsInOneElementMakeFourOfIt) {
  // Both end at z = 2.05 in the cell 0 … 4 × 0 … 4 × 1 … 3 of a hexahedral lattice.
  Model model = cracked_box({2.1, -1, 5, -1, 2.05});
  add_joint(model, Vec3{0, 1, 0}, {0, 1.8, 0});
  model.joints[1].polygon = {{-1, 1.8, -1}, {5, 1.8, -1}, {5, 1.8, 2.05}, {-1, 1.8, 2.05}};
  CoverSpec spec = extended(LatticeKind::hex8, 4);
  spec.origin = Vec3{0, 0, 1};
  spec.spacing = {2, 4, 4};
  const Covered c = cover(model, spec);
  // Below z = 1 the joints run through: four elements; 1 to 3: prolonged, four; above 3: one.
  EXPECT_EQ(c.arrays().element_count(), 9);
  // The star of a node at z = 3 holds the whole element above: one cover. Those at 1 see four parts, as those at −1.
  std::map<Real, std::set<int>> covers;
  std::map<Index, int> count;
  for (const Index node : c.arrays().cover_node) ++count[node];
  for (const auto& [node, n] : count) covers[c.arrays().lattice.node_position(node)[2]].insert(n);
  EXPECT_EQ(covers, (std::map<Real, std::set<int>>{{-1, {4}}, {1, {4}}, {3, {1}}, {5, {1}}}));
}

TEST(JointTips, OfWeldedJointsCutNothing) {
  CoverSpec welded = extended(LatticeKind::tet6, 0.8);
  welded.joints = JointTreatment::welded;
  const Covered c = cover(cracked_box({2.1, -1, 5, -1, 2.3}), welded);
  const Covered intact = cover(box_model({0, 0, 0}, {4, 4, 4}), spacing(0.8));
  EXPECT_EQ(c.arrays().element_count(), intact.arrays().element_count());
  EXPECT_EQ(c.arrays().cover_node, intact.arrays().cover_node);
}

TEST(JointTips, ExtendedLeaveLoadedFacesTheirArea) {
  Model model = cracked_box({2.1, -1, 5, -1, 0.3});
  Traction traction;
  traction.where = FaceRegion{0, {4}};
  traction.pressure = traction.follows = true;
  traction.value = {1, 0, 0};
  model.tractions.push_back(traction);
  for (const LatticeKind kind : kinds) {
    const Covered c = cover(model, extended(kind, 0.8));
    const LoadPoints loads = load_points(c.blocks.cutting, c.covering, c.model);
    Real area = 0;
    for (const Vec3& a : loads.area) area += norm(a);
    EXPECT_NEAR(area, 16, 16e-13) << lattice_name(kind);
  }
}

// The floor of the notch and the joint lie in one plane: on one facet of an element, or inside of one.
TEST(JointTips, BesideALoadedFaceInTheirPlaneLeaveItItsArea) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("notch", {0, 0, 2}, {2, 4, 4}, false));
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 2});
  model.joints[0].polygon = {{1, -1, 2}, {2.7, -1, 2}, {2.7, 2.3, 2}, {1, 2.3, 2}};
  Traction traction;
  traction.where = FaceRegion{1, {4}};
  traction.pressure = traction.follows = true;
  traction.value = {1, 0, 0};
  model.tractions.push_back(traction);
  for (const LatticeKind kind : kinds)
    for (const Real z : {0.0, 0.5}) {
      CoverSpec spec = extended(kind, 1);
      spec.origin = Vec3{0.5, 0, z};
      const Covered c = cover(model, spec);
      const LoadPoints loads = load_points(c.blocks.cutting, c.covering, c.model);
      Real area = 0;
      for (const Vec3& x : loads.area) area += norm(x);
      EXPECT_NEAR(area, 8, 8e-13) << lattice_name(kind) << ' ' << z;
    }
}

}  // namespace
}  // namespace rockfold::test
