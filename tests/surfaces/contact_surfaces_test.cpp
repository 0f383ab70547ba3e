// The surfaces that contact gets of a cutting: they close, hold the blocks' volume and areas, and detection finds the joints in them.
#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "host/contact/lattice_surfaces.hpp"
#include "host/contact/surfaces.hpp"
#include "host/flatten/flatten.hpp"
#include "kernels/contact/contact.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {
namespace {

struct Rock {
  Cutting cutting;
  BlockArrays blocks;
  SurfaceArrays surfaces;
};

Rock make_rock(Model model) {
  model.joint_materials.emplace_back();
  for (JointSet& set : model.joint_sets) set.material = 0;
  for (Joint& joint : model.joints) joint.material = 0;
  Progress progress;
  Rock r;
  r.cutting = cut_blocks(model, progress);
  r.blocks = flatten_blocks(r.cutting, model);
  r.surfaces = contact_surfaces(r.cutting, r.blocks);
  return r;
}

std::vector<Model> models() {
  std::vector<Model> all;
  Model sets = box_model({0, 0, 0}, {10, 10, 10});
  add_set(sets, DipOrientation{60, 90}, 3.1, {});
  add_set(sets, DipOrientation{70, 200}, 3.7, {});
  add_set(sets, DipOrientation{20, 320}, 2.9, {0.1, 0, 0});
  all.push_back(sets);
  Model steps = box_model({0, 0, 0}, {8, 8, 8});
  steps.solids.push_back(box_solid("step", {4, -1, 4}, {9, 9, 9}, false));
  steps.solids.push_back(box_solid("cave", {1, 1, 1}, {3, 3, 3}, false));
  add_set(steps, DipOrientation{0, 0}, 2, {0, 0, 0});
  add_set(steps, DipOrientation{55, 77}, 3, {4, 4, 4});
  add_joint(steps, Vec3{1, 1, 0}, {4, 4, 4});
  all.push_back(steps);
  std::mt19937 random(5);
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit;
  Model planes = box_model({100, 0, 0}, {110, 7, 5});
  for (int i = 0; i < 9; ++i)
    add_joint(planes, Vec3{gauss(random), gauss(random), gauss(random)},
              {100 + 10 * unit(random), 7 * unit(random), 5 * unit(random)});
  all.push_back(planes);
  return all;
}

TEST(ContactSurfaces, CloseRoundEachBlock) {
  for (const Model& model : models()) {
    const Rock r = make_rock(model);
    const SurfaceArrays& s = r.surfaces;
    std::vector<Real> volume(s.block_count(), 0);
    std::vector<Vec3> sum(s.block_count(), Vec3{});
    for (Index p = 0; p < s.part_count(); ++p)
      for (Index f = s.part_face_begin[p]; f < s.part_face_begin[p + 1]; ++f) {
        const Index b = s.part_block[p];
        const Vec3 o = r.blocks.centroid[b];
        for (Index c = s.corner_begin[f] + 1; c + 1 < s.corner_begin[f + 1]; ++c) {
          const Vec3 x = s.vertex[s.corner_vertex[s.corner_begin[f]]] - o,
                     y = s.vertex[s.corner_vertex[c]] - o, z = s.vertex[s.corner_vertex[c + 1]] - o;
          volume[b] += dot(x, cross(y, z)) / 6;
          sum[b] += 0.5 * cross(y - x, z - x);
        }
      }
    for (Index b = 0; b < s.block_count(); ++b) {
      EXPECT_NEAR(volume[b], r.blocks.volume[b], 1e-9 * (1 + r.blocks.volume[b]));
      EXPECT_LT(norm(sum[b]), 1e-9);
    }
  }
}

TEST(ContactSurfaces, OfConvexBlocksHaveTheirEdges) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(model, Vec3{1, 2, 3}, {2, 2, 2});
  const Rock r = make_rock(model);
  ASSERT_EQ(r.surfaces.block_count(), 2);
  for (Index p = 0; p < 2; ++p)
    EXPECT_EQ(r.surfaces.part_edge_begin[p + 1] - r.surfaces.part_edge_begin[p],
              r.blocks.edge_count[p]);
}

/// A cube cut by 13 discs in three sets: some of its blocks are not convex.
Model cube_with_discs(int seed) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  const DipOrientation mean[] = {{62, 225}, {82, 355}, {38, 175}};
  for (const DipOrientation& dip : mean) {
    JointSet set;
    set.name = std::string("J").append(std::to_string(model.joint_sets.size() + 2));
    set.orientation = dip;
    set.radius = 5;
    set.random = RandomSet{};
    set.random->seed = static_cast<std::uint64_t>(seed + 1000 * model.joint_sets.size());
    set.random->fisher_kappa = model.joint_sets.size() == 1 ? 80 : 60;
    set.random->count = model.joint_sets.size() < 2 ? 5 : 3;
    model.joint_sets.push_back(set);
  }
  return model;
}

// The hull of a cell is closed (Euler), and is far where the cell shows nothing.
TEST(ContactSurfaces, OfCellsHaveTheirHulls) {
  const Rock r = make_rock(cube_with_discs(1));
  const SurfaceArrays& s = r.surfaces;
  int far_edges = 0;
  for (Index p = 0; p < s.part_count(); ++p) {
    const Index faces = s.part_hull_begin[p + 1] - s.part_hull_begin[p],
                edges = s.part_edge_begin[p + 1] - s.part_edge_begin[p],
                vertices = s.part_vertex_begin[p + 1] - s.part_vertex_begin[p];
    if (r.blocks.convex[s.part_block[p]] != 0) {
      EXPECT_EQ(faces, 0);
      continue;
    }
    EXPECT_EQ(vertices - edges + faces, 2);
    const bool shows = s.part_face_begin[p] < s.part_face_begin[p + 1];
    EXPECT_EQ(s.part_far_begin[p + 1] - s.part_far_begin[p] == faces, !shows);
    for (Index e = s.part_edge_begin[p]; e < s.part_edge_begin[p + 1]; ++e)
      far_edges += s.edge_far[e];
  }
  EXPECT_GT(far_edges, 0);
}

/// Cells of 2 m whose planes run through the models' faces, or through nothing.
Lattice lattice_over(const BlockArrays& blocks, LatticeKind kind, bool aligned) {
  Lattice lattice;
  lattice.kind = kind;
  Vec3 low = blocks.vertex[0], high = low;
  for (const Vec3& x : blocks.vertex)
    for (int d = 0; d < 3; ++d) low[d] = std::min(low[d], x[d]), high[d] = std::max(high[d], x[d]);
  for (int d = 0; d < 3; ++d) {
    lattice.origin[d] = low[d] - (aligned ? 2 : 1.37);
    lattice.edge[d][d] = 2;
    lattice.cells[d] = static_cast<Index>((high[d] - lattice.origin[d]) / 2) + 2;
  }
  return lattice;
}

/// m: how deep the deepest point lies as detection begins.
Real deepest(const SurfaceArrays& surfaces) {
  ContactOptions options;
  options.laws.emplace_back();
  options.search_distance = 0.1;
  options.skin = 0.5;
  Contacts contacts(surfaces, options);
  contacts.detect(surfaces.vertex);
  Real most = 0;
  for (const ContactPoint& p : contacts.points()) {
    Vec3 d{};
    for (int k = 0; k < 6; ++k) d += p.weight[k] * surfaces.vertex[p.vertex[k]];
    most = std::max(most, -dot({p.normal[0], p.normal[1], p.normal[2]}, d) - p.offset);
  }
  return most;
}

// Cells never overlap. What parts two of them is often a virtual face of one, or an edge of such.
TEST(ContactSurfaces, OfBlocksCutByDiscsOverlapNowhere) {
  for (int seed = 1; seed <= 60; ++seed) {
    const Rock r = make_rock(cube_with_discs(seed));
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    EXPECT_LT(deepest(r.surfaces), r.surfaces.tolerance);
    if (seed % 20 != 0) continue;
    for (const LatticeKind kind : {LatticeKind::hex8, LatticeKind::tet6})
      EXPECT_LT(deepest(divide_surfaces(r.surfaces, lattice_over(r.blocks, kind, false))),
                r.surfaces.tolerance);
  }
}

/// Expects the joints whole, and nothing else pressed.
void expect_joints(const SurfaceArrays& surfaces, const BlockArrays& blocks) {
  ContactOptions options;
  JointLaw law;
  law.normal_stiffness = law.shear_stiffness = 1e9;
  options.laws = {law};
  options.search_distance = 1e-3;
  options.skin = 1e-2;
  Contacts contacts(surfaces, options);
  contacts.detect(surfaces.vertex);
  std::map<std::pair<Index, Index>, Real> expected, found;
  for (const BlockArrays::Interface& i : blocks.interfaces)
    expected[{i.block[0], i.block[1]}] += i.area;
  for (const ContactPoint& p : contacts.points()) {
    Vec3 d{};
    for (int k = 0; k < 6; ++k) d += p.weight[k] * surfaces.vertex[p.vertex[k]];
    if (p.memory.broken != 0) {  // corners and edges that touch across joints
      EXPECT_GE(dot({p.normal[0], p.normal[1], p.normal[2]}, d), -1e-9);
      continue;
    }
    found[{surfaces.vertex_block[p.vertex[0]], surfaces.vertex_block[p.vertex[3]]}] += p.area;
  }
  EXPECT_GT(expected.size(), 10u);
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [pair, area] : expected)
    EXPECT_NEAR(found[pair], area, 1e-7) << pair.first << " " << pair.second;
  // corners that touch across joints, to the last bit of their places
  EXPECT_LT(contacts.evaluate(surfaces.vertex).energy.elastic, 1e-18);
}

TEST(ContactSurfaces, HoldTheJointsThatDetectionFinds) {
  for (const Model& model : models()) {
    const Rock r = make_rock(model);
    expect_joints(r.surfaces, r.blocks);
  }
}

/// [B] m², of the faces of each block.
std::vector<Real> areas(const SurfaceArrays& s) {
  std::vector<Real> area(s.block_count(), 0);
  for (Index p = 0; p < s.part_count(); ++p)
    for (Index f = s.part_face_begin[p]; f < s.part_face_begin[p + 1]; ++f) {
      const Vec3 o = s.vertex[s.corner_vertex[s.corner_begin[f]]];
      Vec3 sum{};
      for (Index c = s.corner_begin[f] + 1; c + 1 < s.corner_begin[f + 1]; ++c)
        sum += cross(s.vertex[s.corner_vertex[c]] - o, s.vertex[s.corner_vertex[c + 1]] - o);
      area[s.part_block[p]] += 0.5 * norm(sum);
    }
  return area;
}

TEST(DividedSurfaces, LieInOnePartOfACellEachAndHoldTheJoints) {
  int number = 0;
  for (const Model& model : models()) {
    const Rock r = make_rock(model);
    ++number;
    for (const LatticeKind kind : {LatticeKind::hex8, LatticeKind::tet6, LatticeKind::tet5})
      for (const bool aligned : {true, false}) {
        SCOPED_TRACE(testing::Message() << "model " << number << ", lattice "
                                        << static_cast<int>(kind) << (aligned ? " aligned" : ""));
        const SurfaceArrays s = divide_surfaces(r.surfaces, lattice_over(r.blocks, kind, aligned));
        EXPECT_GT(s.part_count(), r.surfaces.part_count());
        const std::vector<Real> whole = areas(r.surfaces), divided = areas(s);
        for (Index b = 0; b < s.block_count(); ++b) EXPECT_NEAR(divided[b], whole[b], 1e-7) << b;
        for (Index p = 0; p < s.part_count(); ++p) {
          Vec3 low = s.vertex[s.part_vertex[s.part_vertex_begin[p]]], high = low;
          for (Index i = s.part_vertex_begin[p]; i < s.part_vertex_begin[p + 1]; ++i)
            for (int d = 0; d < 3; ++d) {
              low[d] = std::min(low[d], s.vertex[s.part_vertex[i]][d]);
              high[d] = std::max(high[d], s.vertex[s.part_vertex[i]][d]);
            }
          for (int d = 0; d < 3; ++d) EXPECT_LE(high[d] - low[d], 2 + 1e-5);
        }
        expect_joints(s, r.blocks);
      }
  }
}

}  // namespace
}  // namespace rockfold::test
