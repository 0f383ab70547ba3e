// Lines, sections and intensities in cut rock, against numbers by hand and against the planes themselves.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "host/measure/measure.hpp"
#include "host/measure/parts.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {
namespace {

RockMeasures measures_of(const Model& model) {
  const Blocks blocks = cut(model);
  return measure_rock(blocks.cutting, blocks.arrays, model);
}

Model plus_line(Model model, const Vec3& from, const Vec3& to) {
  model.scanlines.push_back({"line" + std::to_string(model.scanlines.size() + 1), from, to, {}});
  return model;
}

/// Joints across x at 1, 1.05, 1.2 and 2 of 4 m: pieces of 1, 0.05, 0.15, 0.8 and 2 m.
TEST(Scanlines, HaveRqdFromPiecesOfTenCentimetres) {
  Model model = box_model({0, 0, 0}, {4, 2, 3});
  for (const Real x : {1.0, 1.05, 1.2, 2.0}) add_joint(model, Vec3{1, 0, 0}, {x, 0, 0});
  const RockMeasures m = measures_of(model);
  ASSERT_EQ(m.lines.size(), 3u);
  EXPECT_EQ(m.lines[0].name, "x");
  EXPECT_EQ(m.lines[0].crossings, 4);
  EXPECT_EQ(m.lines[0].pieces, 5);
  EXPECT_NEAR(m.lines[0].length_in_rock, 4, 1e-9);
  EXPECT_NEAR(m.lines[0].rqd, 3.95 / 4, 1e-9);
  EXPECT_EQ(m.lines[1].crossings + m.lines[2].crossings, 0);
  EXPECT_EQ(m.lines[2].rqd, 1);
  EXPECT_NEAR(m.rqd, 8.95 / 9, 1e-9);
  EXPECT_NEAR(m.all_joints.p10, 4.0 / 9, 1e-9);
}

TEST(Scanlines, CountPiecesOfJustTenCentimetres) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  add_set(model, Vec3{1, 0, 0}, 0.1, {0.3, 0, 0});
  EXPECT_NEAR(measures_of(model).lines[0].rqd, 1, 1e-9);
  model.joint_sets[0].spacing = 0.0999;
  EXPECT_LT(measures_of(model).lines[0].rqd, 0.2);  // the two ends
}

/// Out of the rock on both sides and through a hole of 1 m in its middle.
TEST(Scanlines, LieInRockOnlyWhereThereIsSome) {
  Model model = box_model({0, 0, 0}, {4, 2, 3});
  model.solids.push_back(box_solid("hole", {1, -1, -1}, {2, 3, 4}, false));
  add_joint(model, Vec3{1, 0, 0}, {3.05, 0, 0});
  add_joint(model, Vec3{1, 0, 0}, {1.5, 0, 0});  // in the hole
  model = plus_line(model, {-5, 1, 1.5}, {10, 1, 1.5});
  model = plus_line(model, {-5, 9, 1.5}, {10, 9, 1.5});
  const RockMeasures m = measures_of(model);
  ASSERT_EQ(m.lines.size(), 2u);
  EXPECT_NEAR(m.lines[0].length_in_rock, 3, 1e-9);
  EXPECT_EQ(m.lines[0].crossings, 1);
  EXPECT_EQ(m.lines[0].pieces, 3);
  EXPECT_EQ(m.lines[1].length_in_rock, 0);
  EXPECT_TRUE(std::isnan(m.lines[1].rqd));
  EXPECT_EQ(m.rqd, 1);
}

/// Oblique through-going planes: a line crosses those that part its ends.
TEST(Scanlines, CrossThePlanesThatPartTheirEnds) {
  std::mt19937 random(11);
  std::uniform_real_distribution<Real> in(-1, 1);
  const auto point = [&](Real size) {
    return Vec3{size * in(random), size * in(random), size * in(random)};
  };
  for (int n = 0; n < 10; ++n) {
    Model model = box_model({-3, -3, -3}, {3, 3, 3});
    for (int j = 0; j < 12; ++j) add_joint(model, point(1), point(2));
    for (int l = 0; l < 20; ++l) model = plus_line(model, point(2.9), point(2.9));
    const RockMeasures m = measures_of(model);
    for (std::size_t l = 0; l < model.scanlines.size(); ++l) {
      const Scanline& line = model.scanlines[l];
      Index expected = 0;
      for (const Joint& joint : model.joints) {
        const Vec3& normal = std::get<Vec3>(joint.plane.orientation);
        expected += (dot(normal, line.from - joint.plane.point) > 0) !=
                    (dot(normal, line.to - joint.plane.point) > 0);
      }
      EXPECT_EQ(m.lines[l].crossings, expected);
      EXPECT_NEAR(m.lines[l].length_in_rock, norm(line.to - line.from), 1e-9);
    }
  }
}

/// 27 planes of 100 m² in 1,000 m³; lines and sections through the middle, which is a corner of eight blocks.
TEST(Intensities, OfACubeOfAThousandBlocks) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  for (const Vec3& n : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    add_set(model, n, 1, {0, 0, 0});
  const RockMeasures m = measures_of(model);
  ASSERT_EQ(m.intensities.size(), 3u);
  for (const OriginIntensity& i : m.intensities) {
    EXPECT_EQ(i.joints, 9);
    EXPECT_NEAR(i.area, 900, 1e-9);
    EXPECT_NEAR(i.p32, 0.9, 1e-12);
    EXPECT_NEAR(i.p30, 0.009, 1e-12);
    EXPECT_NEAR(i.p21, 2 * 9 * 10 / 300.0, 1e-9);  // seen on two of the three sections
    EXPECT_NEAR(i.p20, 2 * 9 / 300.0, 1e-12);
    EXPECT_NEAR(i.p10, 9 / 30.0, 1e-12);
  }
  EXPECT_NEAR(m.volumetric_joint_count, 2.7, 1e-12);
  for (const SectionMeasure& s : m.sections) EXPECT_NEAR(s.area, 100, 1e-9);
  EXPECT_NEAR(m.blocks.volume_by_volume[2], 1, 1e-12);
}

/// The trace of x + 2y = c on z = const in a box 4 × 2 is a segment known by hand.
TEST(Sections, HaveTracesOfObliqueJoints) {
  Model model = box_model({0, 0, 0}, {4, 2, 3});
  add_joint(model, Vec3{1, 2, 0}, {2, 1, 0});  // from (0, 2) to (4, 0)
  add_joint(model, Vec3{0, 0, 1}, {0, 0, 1});
  const RockMeasures m = measures_of(model);
  EXPECT_NEAR(m.sections[2].trace_length[0], std::sqrt(20.0), 1e-5);
  EXPECT_EQ(m.sections[2].trace_count[0], 1);  // of one joint, in however many parts
  EXPECT_EQ(m.sections[2].trace_count[1], 0);
  EXPECT_NEAR(m.sections[0].trace_length[0], 3, 1e-5);
  EXPECT_NEAR(m.sections[0].trace_length[1], 2, 1e-9);
  EXPECT_NEAR(m.sections[0].area, 6, 1e-9);
  EXPECT_NEAR(m.sections[1].area, 12, 1e-9);
}

/// A section through rock with a hole.
TEST(Sections, HaveTheAreaOfTheRockAlone) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("hole", {1, 1, -1}, {2.5, 3, 5}, false));
  const RockMeasures m = measures_of(model);
  EXPECT_NEAR(m.sections[2].area, 13, 1e-9);
  EXPECT_NEAR(m.sections[0].area, 8, 1e-9);  // through the hole, x = 2
}

Real volume_of_part(const PartArrays& parts, Index p) {
  Real volume = 0;
  const Vec3 o = parts.vertex[parts.corner_vertex[parts.corner_begin[parts.face_begin[p]]]];
  for (Index f = parts.face_begin[p]; f < parts.face_begin[p + 1]; ++f) {
    const auto at = [&](Index c) { return parts.vertex[parts.corner_vertex[c]] - o; };
    const Index begin = parts.corner_begin[f];
    for (Index c = begin + 1; c + 1 < parts.corner_begin[f + 1]; ++c)
      volume += dot(at(begin), cross(at(c), at(c + 1))) / 6;
  }
  return volume;
}

/// Faces that two origins share: a disc in a joint's plane, a face with a hole that another solid's face fills.
TEST(ConvexParts, OfAConvexBlockAreOneWithOneFaceAPlane) {
  Model disc = box_model({0, 0, 0}, {4, 4, 4});
  add_joint(disc, Vec3{0, 0, 1}, {2, 2, 2});
  disc.joints.push_back(disc.joints[0]);
  disc.joints[0].polygon = {{1, 1, 2}, {3, 1, 2}, {2, 3, 2}};
  Model hole = box_model({0, 0, 0}, {4, 4, 4});
  hole.solids.push_back(box_solid("filling", {1, 1, 2}, {3, 3, 4}));
  for (const Model& model : {disc, hole}) {
    const Blocks blocks = cut(model);
    const PartArrays parts = convex_parts(blocks.cutting, blocks.arrays);
    ASSERT_EQ(parts.part_count(), blocks.arrays.block_count());
    for (Index b = 0; b < parts.part_count(); ++b) {
      EXPECT_GT(face_count(blocks.arrays, b), 6);
      EXPECT_EQ(blocks.arrays.convex[b], 1);
      EXPECT_EQ(parts.face_begin[b + 1] - parts.face_begin[b], 6);
      EXPECT_NEAR(volume_of_part(parts, b), blocks.arrays.volume[b], 1e-12 * 64);
    }
    EXPECT_EQ(parts.vertex.size(), 8 * parts.block.size());
    EXPECT_EQ(parts.corner_vertex.size(), 24 * parts.block.size());
  }
}

/// A cube with a square through-hole, cut once: concave blocks by their cells, convex ones whole.
TEST(ConvexParts, MakeUpTheBlocks) {
  Model model = box_model({0, 0, 0}, {4, 4, 4});
  model.solids.push_back(box_solid("hole", {1, 1, -1}, {3, 3, 3}, false));
  add_joint(model, Vec3{0.1, 0.2, 1}, {2, 2, 2});
  add_joint(model, Vec3{1, 1, 0}, {0.5, 0.25, 0});
  const Blocks blocks = cut(model);
  const PartArrays parts = convex_parts(blocks.cutting, blocks.arrays);
  std::vector<Real> volume(blocks.arrays.block_count(), 0);
  std::vector<Index> count(volume.size(), 0);
  for (Index p = 0; p < parts.part_count(); ++p) {
    const Real v = volume_of_part(parts, p);
    EXPECT_GT(v, 0);
    volume[parts.block[p]] += v;
    ++count[parts.block[p]];
  }
  bool concave = false;
  for (Index b = 0; b < blocks.arrays.block_count(); ++b) {
    EXPECT_NEAR(volume[b], blocks.arrays.volume[b], 1e-12 * 64);
    if (blocks.arrays.convex[b])
      EXPECT_EQ(count[b], 1);
    else
      concave = concave || count[b] > 1;
  }
  EXPECT_TRUE(concave);
}

}  // namespace
}  // namespace rockfold::test
