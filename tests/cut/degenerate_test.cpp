// Planes that share points and lines in every way: through lattice points, with small integer normals, many of them given
// twice. Against brute force in integers; straight, and turned so that nothing is exact any more.
#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "tests/cut/models/sample_models.hpp"
#include "tests/cut/oracles/complex_check.hpp"
#include "tests/cut/oracles/lattice_arrangement.hpp"

namespace rockfold::test {
namespace {

constexpr int edge = 2;  // the box is a cube of 3 × 3 × 3 lattice points

struct LatticeJoint {
  std::array<std::int64_t, 3> normal, point;
};

std::vector<LatticeJoint> random_joints(unsigned seed) {
  std::mt19937 random(seed);
  const auto small = [&](int low, int high) {
    return std::int64_t{low} + static_cast<std::int64_t>(random() % (high - low + 1));
  };
  std::vector<LatticeJoint> joints(3 + random() % 10);
  const int steep = 1 + static_cast<int>(seed % 3);
  for (auto& [normal, point] : joints) {
    do
      for (auto& c : normal) c = small(-steep, steep);
    while (normal[0] == 0 && normal[1] == 0 && normal[2] == 0);
    for (auto& c : point) c = small(0, edge);
  }
  return joints;
}

// A rotation and a shift; the identity leaves every number as it is.
struct Placement {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, shift{};
  Vec3 direction(const Vec3& v) const { return v[0] * x + v[1] * y + v[2] * z; }
  Vec3 point(const Vec3& p) const { return direction(p) + shift; }
  Vec3 back(const Vec3& p) const {
    return {dot(p - shift, x), dot(p - shift, y), dot(p - shift, z)};
  }
};
Placement random_placement(unsigned seed, Real far) {
  std::mt19937 random(seed + 77);
  std::normal_distribution<Real> gauss;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  Placement p;
  p.z = normalized(any());
  p.x = normalized(cross(any(), p.z));
  p.y = cross(p.z, p.x);
  p.shift = far * any();
  return p;
}

Vec3 real(const std::array<std::int64_t, 3>& v) {
  return {static_cast<Real>(v[0]), static_cast<Real>(v[1]), static_cast<Real>(v[2])};
}

Model model_of(const std::vector<LatticeJoint>& joints, const Placement* placement) {
  Model model;
  const Placement p = placement ? *placement : Placement{};
  if (placement) {
    std::vector<std::pair<Vec3, Vec3>> faces;
    for (const Vec3& axis : {Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
      faces.emplace_back(p.direction(-axis), p.point({0, 0, 0}));
      faces.emplace_back(p.direction(axis), p.point({edge, edge, edge}));
    }
    model.solids.push_back(convex_solid("rock", faces));
  } else {
    model = box_model({0, 0, 0}, {edge, edge, edge});
  }
  for (const LatticeJoint& j : joints)
    add_joint(model, p.direction(real(j.normal)), p.point(real(j.point)));
  return model;
}

// Each block is a cell of the arrangement, each another one, and together they fill the box: so they are all of its cells.
void check_against_brute_force(const BlockArrays& a, const std::vector<LatticeJoint>& joints,
                               const Placement& placement, Real tolerance) {
  std::vector<LatticePlane> planes;
  for (const LatticeJoint& j : joints) planes.push_back(lattice_plane(j.normal, j.point));
  const LatticeArrangement arrangement(edge, planes);
  std::set<std::vector<signed char>> seen;
  for (Index b = 0; b < a.block_count(); ++b) {
    const auto cell = arrangement.cell(placement.back(a.centroid[b]));
    EXPECT_EQ(counts_of(a, b), (Counts{cell.vertices, cell.vertices + cell.faces - 2, cell.faces}))
        << "block " << b;
    EXPECT_NEAR(a.volume[b], cell.volume, tolerance) << "block " << b;
    EXPECT_TRUE(seen.insert(cell.side).second) << "block " << b << " is another one's twin";
  }
  EXPECT_NEAR(sum(a.volume), edge * edge * edge, tolerance);
}

// The planes' rounding moves corners by some 1e-16 of the coordinates, more where planes meet at small angles.
constexpr Real rounding = 1e-12;

void check_straight(const std::vector<LatticeJoint>& joints) {
  const Blocks blocks = cut(model_of(joints, nullptr));
  check_against_brute_force(blocks.arrays, joints, {}, rounding);
  EXPECT_EQ(blocks.arrays.vertices_identified, 0);
  EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true}), std::vector<std::string>{});
}

void check_turned(const std::vector<LatticeJoint>& joints, const Placement& placement) {
  const Real coordinates = norm(placement.shift) + 4;
  const Blocks blocks = cut(model_of(joints, &placement));
  check_against_brute_force(blocks.arrays, joints, placement, rounding * coordinates);
  EXPECT_EQ(faults_of(blocks.complex(), {.whole_faces = true, .area_tolerance = 1e-9}),
            std::vector<std::string>{});
}

void check_shuffled(const std::vector<LatticeJoint>& joints, unsigned seed) {
  std::vector<LatticeJoint> shuffled = joints;
  std::mt19937 random(seed);
  std::shuffle(shuffled.begin(), shuffled.end(), random);
  const BlockArrays a = cut(model_of(joints, nullptr)).arrays,
                    b = cut(model_of(shuffled, nullptr)).arrays;
  EXPECT_EQ(a.volume, b.volume);
  EXPECT_EQ(a.centroid, b.centroid);
  EXPECT_EQ(a.vertex, b.vertex);
  EXPECT_EQ(a.corner_vertex, b.corner_vertex);
}

// How many of the seeds fail, with the first few in the trace. No failure stops the others.
template <class Check>
void check_seeds(unsigned first, unsigned count, const Check& check) {
  for (unsigned seed = first; seed < first + count && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    try {
      check(seed);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  }
}

TEST(DegeneratePlanes, AreCutIntoTheCellsOfTheirArrangement) {
  check_seeds(0, 300, [](unsigned seed) { check_straight(random_joints(seed)); });
}

TEST(DegeneratePlanes, TurnedByAnyRotationToo) {
  check_seeds(0, 300,
              [](unsigned seed) { check_turned(random_joints(seed), random_placement(seed, 0)); });
}

TEST(DegeneratePlanes, TurnedAndFarFromTheOrigin) {
  check_seeds(500, 100, [](unsigned seed) {
    check_turned(random_joints(seed), random_placement(seed, 1e4));
  });
}

TEST(DegeneratePlanes, InAnyOrder) {
  check_seeds(0, 100, [](unsigned seed) { check_shuffled(random_joints(seed), seed); });
}

TEST(SlowDegeneratePlanes, AreCutIntoTheCellsOfTheirArrangement) {
  check_seeds(100000, 10000, [](unsigned seed) { check_straight(random_joints(seed)); });
}

TEST(SlowDegeneratePlanes, TurnedByAnyRotationToo) {
  check_seeds(200000, 10000, [](unsigned seed) {
    check_turned(random_joints(seed), random_placement(seed, seed % 2 ? 1e4 : 0));
  });
}

TEST(SlowDegeneratePlanes, InAnyOrder) {
  check_seeds(300000, 10000, [](unsigned seed) { check_shuffled(random_joints(seed), seed); });
}

}  // namespace
}  // namespace rockfold::test
