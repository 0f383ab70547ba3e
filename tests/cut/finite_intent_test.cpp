// What the user meant by finite joints: polygons that share lines and corners but for rounding or noise (decision 5, rules
// 1 to 5).
#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/cut/models/nef_models.hpp"
#include "tests/cut/oracles/conservation.hpp"

namespace rockfold::test {
namespace {

const std::vector<std::string> none_differ;
constexpr Real pi = 3.14159265358979323846;

// A rotation, a shift and noise of up to `noise` m in each coordinate.
class Placement {
 public:
  Placement(unsigned seed, const Vec3& shift, Real noise)
      : random_(seed), shift_(shift), noise_(-noise, noise) {
    std::normal_distribution<Real> gauss;
    const auto any = [&] { return Vec3{gauss(random_), gauss(random_), gauss(random_)}; };
    z_ = normalized(any());
    x_ = normalized(cross(any(), z_));
    y_ = cross(z_, x_);
  }
  Vec3 direction(const Vec3& v) const { return v[0] * x_ + v[1] * y_ + v[2] * z_; }
  Vec3 operator()(const Vec3& p) {
    Vec3 moved = direction(p) + shift_;
    for (Real& c : moved) c += noise_(random_);
    return moved;
  }

  /// A cube of edge 2·half about the origin, turned and shifted.
  Model cube(Real half) {
    Model model;
    std::vector<std::pair<Vec3, Vec3>> faces;
    for (int d = 0; d < 3; ++d)
      for (const Real s : {-1.0, 1.0}) {
        Vec3 n{};
        n[d] = s;
        faces.emplace_back(direction(n), (*this)(half * n));
      }
    model.solids.push_back(convex_solid("rock", faces));
    return model;
  }
  /// The plane is the one that best fits the corners (Newell).
  void add(Model& model, const std::vector<Vec3>& corners) {
    std::vector<Vec3> moved;
    for (const Vec3& p : corners) moved.push_back((*this)(p));
    Vec3 normal{};
    for (std::size_t i = 1; i + 1 < moved.size(); ++i)
      normal += cross(moved[i] - moved[0], moved[i + 1] - moved[0]);
    add_joint(model, normal, moved[0]);
    model.joints.back().polygon = moved;
  }

 private:
  std::mt19937 random_;
  Vec3 x_, y_, z_, shift_;
  std::uniform_real_distribution<Real> noise_;
};

// Near, and far enough that doubles are 2e-12 m apart; exact, and with noise of a tenth of the tolerance.
template <class Check>
void in_all_placements(const Check& check, Real largest_noise = 5e-11) {
  for (const Vec3& shift : {Vec3{}, Vec3{1e4, -2e4, 500}})
    for (const Real noise : {0.0, largest_noise})
      for (unsigned seed = 1; seed <= 5; ++seed) {
        SCOPED_TRACE(testing::Message()
                     << "seed " << seed << " shift " << shift[0] << " noise " << noise);
        Placement place(seed, shift, noise);
        try {
          check(place);
        } catch (const std::exception& error) {
          ADD_FAILURE() << error.what();
        }
      }
}

void expect_volume(const Blocks& blocks, Real volume) {
  EXPECT_NEAR(sum(blocks.arrays.volume), volume, 1e-8 * volume);
  EXPECT_EQ(losses(blocks, std::cbrt(volume) * 2, 1e-9), none_differ);
}

Index block_of_volume(const BlockArrays& a, Real volume) {
  for (Index b = 0; b < a.block_count(); ++b)
    if (std::abs(a.volume[b] - volume) < 1e-6 * volume) return b;
  ADD_FAILURE() << "no block of volume " << volume;
  return none;
}

TEST(RadialJoints, OfOneLineMakeASectorEach) {
  for (const int joints : {3, 5, 6})
    in_all_placements([&](Placement& place) {
      Model model = place.cube(2);
      for (int i = 0; i < joints; ++i) {
        const Real t = 2 * pi * (i + 0.05 * (i % 2)) / joints + 0.1;
        const Vec3 out{4 * std::cos(t), 4 * std::sin(t), 0}, foot{0.3, -0.2, 0}, up{0, 0, 3};
        place.add(model, {foot - up, foot - up + out, foot + up + out, foot + up});
      }
      const Blocks blocks = cut(model);
      ASSERT_EQ(blocks.arrays.block_count(), joints);
      for (Index b = 0; b < joints; ++b) {
        EXPECT_EQ(blocks.arrays.shell_count[b], 1);
        EXPECT_EQ(blocks.arrays.genus[b], 0);
        EXPECT_GT(blocks.arrays.volume[b], 1);
      }
      EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
      expect_volume(blocks, 64);
    });
}

TEST(RadialJoints, ThatCrossOnOneLineMakeTwoSectorsEach) {
  for (const int joints : {3, 5, 6})
    in_all_placements([&](Placement& place) {
      Model model = place.cube(2);
      for (int i = 0; i < joints; ++i) {
        const Real t = pi * i / joints + 0.1;
        const Vec3 out{4 * std::cos(t), 4 * std::sin(t), 0}, foot{0.3, -0.2, 0}, up{0, 0, 3};
        place.add(model, {foot - up - out, foot - up + out, foot + up + out, foot + up - out});
      }
      const Blocks blocks = cut(model);
      EXPECT_EQ(blocks.arrays.block_count(), 2 * joints);
      expect_volume(blocks, 64);
    });
}

// They end inside the rock: a star that divides nothing.
TEST(RadialJoints, ThatEndInsideAreDeadEnds) {
  for (const int joints : {3, 5, 6})
    in_all_placements([&](Placement& place) {
      Model model = place.cube(2);
      for (int i = 0; i < joints; ++i) {
        const Real t = 2 * pi * i / joints + 0.1;
        const Vec3 out{std::cos(t), std::sin(t), 0}, up{0, 0, 1};
        place.add(model, {-up, out - up, out + up, up});
      }
      const Blocks blocks = cut(model);
      ASSERT_EQ(blocks.arrays.block_count(), 1);
      EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{8, 12, 6}));
      EXPECT_TRUE(blocks.arrays.convex[0]);
      EXPECT_NEAR(blocks.cutting.totals.dangling_joint_area, 2 * joints, 1e-8);
      expect_volume(blocks, 64);
    });
}

// 12 vertices, each on five planes none of which it is on exactly. Edge 2: volume 20/3·φ², φ = (1 + √5)/2.
std::vector<std::vector<Vec3>> icosahedron() {
  const Real phi = (1 + std::sqrt(5.0)) / 2;
  std::vector<Vec3> v;
  for (const Real s : {-1.0, 1.0})
    for (const Real t : {-phi, phi})
      for (const Vec3& p : {Vec3{0, s, t}, {s, t, 0}, {t, 0, s}}) v.push_back(p);
  std::vector<std::vector<Vec3>> triangles;
  for (std::size_t i = 0; i < v.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (std::size_t k = 0; k < j; ++k)
        if (norm(v[i] - v[j]) < 2.1 && norm(v[j] - v[k]) < 2.1 && norm(v[k] - v[i]) < 2.1)
          triangles.push_back({v[i], v[j], v[k]});
  return triangles;
}

TEST(IcosahedronOfJoints, ClosesOneBlock) {
  const Real phi = (1 + std::sqrt(5.0)) / 2, volume = 20.0 / 3 * phi * phi;
  in_all_placements([&](Placement& place) {
    Model model = place.cube(2.5);
    for (const auto& triangle : icosahedron()) place.add(model, triangle);
    ASSERT_EQ(model.joints.size(), 20u);
    const Blocks blocks = cut(model);
    const BlockArrays& a = blocks.arrays;
    ASSERT_EQ(a.block_count(), 2);
    const Index inner = block_of_volume(a, volume);
    ASSERT_NE(inner, none);
    EXPECT_EQ(counts_of(a, inner), (Counts{12, 30, 20}));
    EXPECT_TRUE(a.convex[inner]);
    EXPECT_EQ(counts_of(a, 1 - inner), (Counts{8 + 12, 12 + 30, 6 + 20}));
    EXPECT_EQ(a.shell_count[1 - inner], 2);
    EXPECT_EQ(a.genus[1 - inner], 0);
    EXPECT_FALSE(a.convex[1 - inner]);
    EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
    EXPECT_EQ(a.interfaces.size(), 20u);
    expect_volume(blocks, 125);
  });
}

// Without one of its triangles it closes nothing.
TEST(IcosahedronOfJoints, LacksATriangleAndIsNoBlock) {
  in_all_placements([&](Placement& place) {
    Model model = place.cube(2.5);
    for (const auto& triangle : icosahedron()) place.add(model, triangle);
    model.joints.erase(model.joints.begin() + 7);
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{8, 12, 6}));
    EXPECT_NEAR(blocks.cutting.totals.dangling_joint_area, 19 * std::sqrt(3.0), 1e-7);
  });
}

// m × m squares of two triangles each, from side to side of the cube, at heights of up to `bumps`: two blocks, of all
// triangles and five sides each. No two neighbours meet at an angle of a sine below `least_sine`.
class GridSurface {
 public:
  GridSurface(int m, Real bumps, Real least_sine) : m_(m) {
    for (int i = 0; i < m; ++i)
      for (int j = 0; j < m; ++j) {
        const Index a = i * (m + 1) + j, b = a + m + 1;
        triangles_.push_back({a, b, b + 1});
        triangles_.push_back({a, b + 1, a + 1});
      }
    std::mt19937 random(17);
    std::uniform_real_distribution<Real> height(-bumps, bumps);
    do {
      posts_.clear();
      for (int i = 0; i <= m; ++i)
        for (int j = 0; j <= m; ++j)
          posts_.push_back({6.0 * i / m - 3, 6.0 * j / m - 3, height(random)});
    } while (sine() < least_sine);
  }
  Real sine() const {
    Real least = 1;
    for (const auto& p : triangles_)
      for (const auto& q : triangles_) {
        const auto common = std::count_if(p.begin(), p.end(), [&](Index v) {
          return std::find(q.begin(), q.end(), v) != q.end();
        });
        if (common == 2) least = std::min(least, norm(cross(normal(p), normal(q))));
      }
    return least;
  }
  Vec3 normal(const std::array<Index, 3>& t) const {
    return normalized(cross(posts_[t[1]] - posts_[t[0]], posts_[t[2]] - posts_[t[0]]));
  }
  const std::vector<std::array<Index, 3>>& triangles() const { return triangles_; }
  const std::vector<Vec3>& posts() const { return posts_; }
  void expect_two_halves(const Model& model, bool one_plane) const {
    const Blocks blocks = cut(model);
    const BlockArrays& a = blocks.arrays;
    ASSERT_EQ(a.block_count(), 2);
    const Index vertices = one_plane ? 8 : (m_ + 1) * (m_ + 1) + 4,
                faces = one_plane ? 6 : 2 * m_ * m_ + 5;
    for (Index b = 0; b < 2; ++b) {
      EXPECT_EQ(counts_of(a, b), (Counts{vertices, vertices + faces - 2, faces}));
      EXPECT_EQ(a.shell_count[b], 1);
      EXPECT_EQ(a.genus[b], 0);
    }
    EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
    expect_volume(blocks, 216);
  }

 private:
  int m_;
  std::vector<Vec3> posts_;
  std::vector<std::array<Index, 3>> triangles_;
};

void expect_grid_divides(const GridSurface& grid, Real noise) {
  SCOPED_TRACE(testing::Message() << grid.triangles().size() << " triangles, sine " << grid.sine());
  in_all_placements(
      [&](Placement& place) {
        Model model = place.cube(3);
        for (const auto& [a, b, c] : grid.triangles())
          place.add(model, {grid.posts()[a], grid.posts()[b], grid.posts()[c]});
        grid.expect_two_halves(model, false);
      },
      noise);
}

// Noise moves the line in which two triangles meet by its size over their angle's sine: that must stay below the tolerance.
TEST(TriangularGrid, OfBumpsDividesTheRockInTwo) {
  for (const int m : {1, 2, 3, 5}) {
    expect_grid_divides({m, 1.0, 0.05}, 1e-11);
    expect_grid_divides({m, 0.1, 2e-3}, 0);
  }
}
// Each triangle is a joint of its own: one plane, many origins. Noise turns triangles by as much as it is to their size.
TEST(TriangularGrid, OfOnePlaneDividesTheRockInTwo) {
  for (const int m : {1, 2, 3, 6}) expect_grid_divides({m, 0, 0}, 1e-11);
}
// Down to a hundred-thousandth; where the bumps are as small as the tolerance itself (1e-9 of the size) the surface leaks.
TEST(TriangularGrid, OfShallowBumpsDividesTheRockInTwo) {
  for (const Real bumps : {1e-2, 1e-3, 1e-4}) expect_grid_divides({4, bumps, 0}, 0);
}

// From a file, triangles share their corners exactly.
void expect_mesh_divides(const GridSurface& grid) {
  SCOPED_TRACE(testing::Message() << "sine " << grid.sine());
  in_all_placements(
      [&](Placement& place) {
        Model model = place.cube(3);
        const auto surface = std::make_shared<TriangleSurface>();
        for (const Vec3& p : grid.posts()) surface->vertices.push_back(place(p));
        surface->triangles = grid.triangles();
        JointMesh mesh;
        mesh.name = "fault";
        mesh.surface = surface;
        model.joint_meshes.push_back(mesh);
        if (grid.sine() > 1e-9)
          grid.expect_two_halves(model, false);
        else  // turned, a plane is one to rounding only: how many faces it has is open
          EXPECT_EQ(cut(model).arrays.block_count(), 2);
      },
      0);
}

TEST(MeshedJoint, DividesTheRockInTwo) {
  for (const Real bumps : {1.0, 0.1}) expect_mesh_divides({5, bumps, 2e-3});
  expect_mesh_divides({5, 0, 0});
}
// A smooth or nearly plane surface.
TEST(MeshedJoint, DividesTheRockInTwoWhereItsBumpsAreShallow) {
  for (const Real bumps : {1e-2, 1e-3}) expect_mesh_divides({5, bumps, 0});
}

// A window of 2 × 2 m in a joint across the rock, and a disc before it in the same plane.
Model window_and_disc(Placement& place, Real radius) {
  Model model = place.cube(3);
  const auto frame = [&](Real x0, Real x1, Real y0, Real y1) {
    place.add(model, {{x0, y0, 0.5}, {x1, y0, 0.5}, {x1, y1, 0.5}, {x0, y1, 0.5}});
  };
  frame(-4, 4, -4, -1);
  frame(-4, 4, 1, 4);
  frame(-4, -1, -1, 1);
  frame(1, 4, -1, 1);
  std::vector<Vec3> disc;
  for (int i = 0; i < 16; ++i)
    disc.push_back({radius * std::cos(pi * i / 8 + 0.2), radius * std::sin(pi * i / 8 + 0.2), 0.5});
  place.add(model, disc);
  return model;
}

TEST(Window, IsClosedByALargerPatchInItsPlane) {
  in_all_placements([](Placement& place) {
    const Blocks blocks = cut(window_and_disc(place, 1.5));  // 1.5·cos(π/16) > √2
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    EXPECT_NEAR(blocks.cutting.totals.joint_area, 36, 1e-7);
    EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
    expect_volume(blocks, 216);
  });
}

TEST(Window, StaysOpenAtItsCornersBehindASmallerPatch) {
  in_all_placements([](Placement& place) {
    const Blocks blocks = cut(window_and_disc(place, 1.4));
    ASSERT_EQ(blocks.arrays.block_count(), 1);
    EXPECT_EQ(counts_of(blocks.arrays, 0), (Counts{8, 12, 6}));
    EXPECT_NEAR(blocks.cutting.totals.joint_area, blocks.cutting.totals.dangling_joint_area, 1e-9);
    EXPECT_LT(blocks.cutting.totals.joint_area, 36 - 1e-3);
    expect_volume(blocks, 216);
  });
}

// A joint that starts on another at a very small angle: a wedge of volume slope/8, slope/2 wide. L = √3. Its plane cuts the cell
// beyond its start too: a wedge as wide that is part of the block there.
Blocks cut_with_wedge(Real slope) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  add_corners(model, {{-1, -1, 0.5}, {2, -1, 0.5}, {2, 2, 0.5}, {-1, 2, 0.5}});
  const Real z = 0.5 + 1.5 * slope;
  add_joint(model, Vec3{-slope, 0, 1}, {0.5, 0, 0.5});
  model.joints.back().polygon = {{0.5, -1, 0.5}, {2, -1, z}, {2, 2, z}, {0.5, 2, 0.5}};
  Blocks blocks = cut(model);
  EXPECT_NEAR(sum(blocks.arrays.volume), 1, 1e-12);
  return blocks;
}

TEST(ShallowDihedral, OfFiniteJointsMakesAWedge) {
  for (const Real slope : {3.5e-9, 9e-9, 1.1e-8, 3e-7, 1e-6, 1e-3}) {
    SCOPED_TRACE(slope);
    // Both wedges; steeper than 1e-8 also the glue between them and the rest, which then is as wide as they (rule 4).
    const Index doubts = slope < 1e-8 ? 2 : slope < 3.4e-7 ? 3 : 0;
    const Blocks blocks = cut_with_wedge(slope);
    ASSERT_EQ(blocks.arrays.block_count(), 3);
    const Real least = *std::min_element(blocks.arrays.volume.begin(), blocks.arrays.volume.end());
    EXPECT_NEAR(least / (slope / 8), 1, 1e-7);
    EXPECT_EQ(blocks.cutting.totals.dangling_joint_area, 0);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 0);
    EXPECT_EQ(blocks.cutting.totals.intent.doubts, doubts);
  }
}

TEST(ShallowDihedral, OfFiniteJointsMakesNoWedgeNarrowerThanTheTolerance) {
  for (const Real slope : {1.01e-10, 3e-10, 3e-9, 3.4e-9}) {
    SCOPED_TRACE(slope);
    const Blocks blocks = cut_with_wedge(slope);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    for (const Real v : blocks.arrays.volume) EXPECT_NEAR(v, 0.5, 1.01 * slope / 8);
    Real shared = 0;
    for (const auto& i : blocks.arrays.interfaces) shared += i.area;
    EXPECT_NEAR(shared, 1, 1e-12);
    EXPECT_EQ(blocks.cutting.totals.intent.slivers, 2);
    EXPECT_EQ(blocks.cutting.totals.intent.doubts, 2);
    EXPECT_EQ(blocks.cutting.totals.intent.near_planes, (std::vector<std::string>{"F1", "F2"}));
  }
}

// Both end there, on either side: four corners of a bent joint, no wedge.
TEST(ShallowDihedral, OfTwoHalvesIsABentJoint) {
  for (const Real slope : {3e-9, 1e-6, 1e-3}) {
    SCOPED_TRACE(slope);
    Model model = box_model({0, 0, 0}, {1, 1, 1});
    add_corners(model, {{-1, -1, 0.5}, {0.5, -1, 0.5}, {0.5, 2, 0.5}, {-1, 2, 0.5}});
    const Real z = 0.5 + 1.5 * slope;
    add_joint(model, Vec3{-slope, 0, 1}, {0.5, 0, 0.5});
    model.joints.back().polygon = {{0.5, -1, 0.5}, {2, -1, z}, {2, 2, z}, {0.5, 2, 0.5}};
    const Blocks blocks = cut(model);
    ASSERT_EQ(blocks.arrays.block_count(), 2);
    for (Index b = 0; b < 2; ++b)
      EXPECT_EQ(counts_of(blocks.arrays, b), (Counts{10, 15, 7})) << "block " << b;
    EXPECT_NEAR(std::abs(blocks.arrays.volume[0] - blocks.arrays.volume[1]) / (slope / 4), 1, 1e-6);
  }
}

// Closed cages of 1 m in a chain, each a step of a whole edge from the one before, turned and far from the origin: walls of
// one plane are turned from each other by rounding alone.
TEST(Cages, InAChainAtMapCoordinatesHoldABlockEach) {
  std::mt19937 random(18);
  std::normal_distribution<Real> gauss;
  for (int i = 0; i < 30; ++i) {
    const Vec3 u = normalized({gauss(random), gauss(random), gauss(random)});
    const Vec3 v = normalized(cross(u, {gauss(random), gauss(random), gauss(random)}));
    const Vec3 w = cross(u, v);
    const auto at = [&](const Vec3& x) {
      return Vec3{512345.678, 5412345.43, 321.1} + x[0] * u + x[1] * v + x[2] * w;
    };
    Model model;
    Solid rock = box_solid("rock", {}, {});
    PrismShape prism;
    prism.base = {at({0, 0, 0}), at({40, 0, 0}), at({40, 40, 0}), at({0, 40, 0})};
    prism.extrude = 40.0 * w;
    rock.shape = prism;
    model.solids.push_back(rock);
    std::set<Vec3> cages;
    Vec3 foot{17, 17, 17};
    for (int step = 0; step < 4; ++step) {
      foot[random() % 3] += 1;
      foot[random() % 3] += 1;
      cages.insert(foot);
    }
    for (const Vec3& o : cages)
      for (int d = 0; d < 3; ++d)
        for (const Real side : {0.0, 1.0}) {
          Joint joint;
          joint.name = "wall";
          for (const auto& [s, t] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            Vec3 x = o;
            x[d] += side, x[(d + 1) % 3] += s, x[(d + 2) % 3] += t;
            joint.polygon.push_back(at(x));
          }
          joint.plane = {normalized(cross(joint.polygon[1] - joint.polygon[0],
                                          joint.polygon[2] - joint.polygon[0])),
                         joint.polygon[0]};
          model.joints.push_back(joint);
        }
    EXPECT_EQ(cut(model).arrays.block_count(), static_cast<Index>(cages.size()) + 1) << i;
  }
}

}  // namespace
}  // namespace rockfold::test
