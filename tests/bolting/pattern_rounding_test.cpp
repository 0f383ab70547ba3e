// Bolts of a pattern where a coordinate is a boundary: corners of a section, bends, joints, whole numbers of spacings. No
// last digit may decide whether a bolt is there.
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/bolting/bolting.hpp"
#include "src/base/vector.hpp"
#include "tests/bolting/bolted_models.hpp"

namespace rockfold {
namespace {

using test::cut_rock;
using test::CutRock;

constexpr Real degree = std::numbers::pi / 180;

const std::string rock_and_joint = R"(
[[material]]
density = 2700
[[joint_material]]
friction_angle = 25
[support]
rotation = false
)";

const std::string bolts_of_a_pattern =
    "length = 3\nforce_capacity = 1e5\ndisplacement_capacity = 0.02\n";

std::vector<Bolt> bolts_of(const std::string& text) {
  const CutRock rock = cut_rock(text);
  return support_blocks(rock.blocks, rock.keyblocks, rock.model).bolts;
}

/// A tunnel along y, 6 m long in the rock, with rings of bolts at y = 1, 3 and 5.
std::string tunnel(const std::string& section, const std::string& layout) {
  return rock_and_joint +
         "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [-15, 0, -8]\nmax = [15, 6, 18]\n"
         "continues = ['xmin', 'xmax', 'ymin', 'ymax', 'zmin', 'zmax']\n"
         "[[excavation]]\nname = 'tunnel'\nshape = 'tunnel'\npath = [[0, -2, 0], [0, 8, 0]]\n" +
         section +
         "\n[[joint]]\ndip = 90\ndip_direction = 90\npoint = [0, 0, 0]\n"
         "[[bolt_pattern]]\non = 'tunnel'\nspacing = [1.5, 2]\n" +
         layout + bolts_of_a_pattern;
}

/// One bolt for each node of the grid that lies on the section, whatever the node lies on.
void expect_whole_rings(const std::string& section, const std::string& layout) {
  SCOPED_TRACE(section + layout);
  const CutRock rock = cut_rock(tunnel(section, layout));
  const BoltingReport report = support_blocks(rock.blocks, rock.keyblocks, rock.model);
  const Real half = report.groups[0].wall_area / 6 / 2;  // of the perimeter
  std::map<long, std::vector<Real>> rings;
  for (const Bolt& bolt : report.bolts) rings[std::lround(bolt.collar[1])].push_back(bolt.sheet[0]);
  ASSERT_EQ(rings.size(), 3u);
  Real crown = 0;
  for (const Vec3& x : rock.blocks.vertex)
    if (std::abs(x[0]) < 5.5 && x[2] < 17) crown = std::max(crown, x[2]);
  for (const auto& [y, ring] : rings) {
    const bool moved = layout.find("staggered") != std::string::npos && (y - 1) / 2 % 2 == 0;
    Real u = moved ? 0.75 : 0;
    while (u - 1.5 >= -half) u -= 1.5;
    for (const Real at : ring) {
      EXPECT_NEAR(at, u, 1e-9) << "ring " << y;
      u += 1.5;
    }
    EXPECT_GT(u, half - 1e-5 * half) << "ring " << y;
  }
  for (const Bolt& bolt : report.bolts)
    if (std::abs(bolt.sheet[0]) < 1e-9) {
      EXPECT_NEAR(bolt.collar[0], 0, 1e-6);
      EXPECT_NEAR(bolt.collar[2], crown, 1e-6);
    }
}

TEST(PatternRoundATunnel, HasACrownBoltWhereTheCrownIsACornerOfTheSection) {
  for (const char* shape : {"d_shape", "horseshoe"})
    for (const char* width : {"3", "3.5", "4.2", "4.5", "5", "5.5", "7", "9"})
      expect_whole_rings(
          fmt::format("section = '{}'\nwidth = {}\nheight = {}", shape, width, width),
          std::string(width) == "7" ? "layout = 'staggered'\n" : "");
  expect_whole_rings("section = [[-3, 0], [3, 0], [0, 4]]", "");
  expect_whole_rings("section = 'circle'\nradius = 3", "");
}

/// The corner is found for each u that is the corner's but for rounding, and so are the sides.
TEST(PatternRoundATunnel, HasABoltAtEachCornerOfTheSection) {
  // 2 m squares of wall: corners at u = ±1, ±3 of 8.
  const auto bolts =
      bolts_of(rock_and_joint +
               "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [-5, 0, -5]\nmax = [5, 6, 7]\n"
               "continues = ['xmin', 'xmax', 'ymin', 'ymax', 'zmin', 'zmax']\n"
               "[[excavation]]\nname = 'tunnel'\nshape = 'tunnel'\npath = [[0, -2, 0], [0, 8, 0]]\n"
               "section = 'rectangle'\nwidth = 2\nheight = 2\n"
               "[[bolt_pattern]]\non = 'tunnel'\nspacing = [1, 3]\n" +
               bolts_of_a_pattern);
  EXPECT_EQ(bolts.size(), 2u * 8);
}

/// A slice so thin that a look aside from its last ring is beyond its end.
TEST(PatternRoundATunnel, HasRingsAtBothEndsOfASlice) {
  const auto bolts = bolts_of(
      rock_and_joint +
      "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [-5, 0, -5]\nmax = [5, 0.1, 7]\n"
      "continues = ['xmin', 'xmax', 'ymin', 'ymax', 'zmin', 'zmax']\n"
      "[[excavation]]\nname = 'tunnel'\nshape = 'tunnel'\npath = [[0, 0, 0], [0, 0.1, 0]]\n"
      "section = 'rectangle'\nwidth = 2\nheight = 2\n"
      "[[bolt_pattern]]\non = 'tunnel'\nspacing = [1, 0.1]\noffset = [0, 0.05]\n" +
      bolts_of_a_pattern);
  EXPECT_EQ(bolts.size(), 2u * 8);
}

TEST(PatternRoundATunnel, GoesOnRoundABend) {
  // Rows every 2 m from 1 m on: v = 5 is the bend; on either side of it the crown has its bolt.
  for (const Real angle : {0.0, 17.0, 33.3, 90.0}) {
    const Real c = std::cos(angle * degree), s = std::sin(angle * degree);
    const auto at = [&](Real x, Real y) {
      return fmt::format("[{:.17g}, {:.17g}, 0]", c * x - s * y, s * x + c * y);
    };
    const std::string path = fmt::format("{}, {}, {}", at(0, -5), at(0, 0), at(3, 4));
    std::string text = rock_and_joint;
    text += "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [-20, -20, -8]\nmax = [20, 20, 12]\n";
    text += "[[excavation]]\nname = 'tunnel'\nshape = 'tunnel'\npath = [" + path + "]\n";
    text += "section = 'd_shape'\nwidth = 3.5\nheight = 3.5\n";
    text += "[[bolt_pattern]]\non = 'tunnel'\nspacing = [1, 2]\n" + bolts_of_a_pattern;
    const auto bolts = bolts_of(text);
    std::vector<Real> crown;
    for (const Bolt& bolt : bolts)
      if (std::abs(bolt.sheet[0]) < 1e-9) crown.push_back(bolt.sheet[1]);
    ASSERT_EQ(crown.size(), 5u) << angle;
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(crown[i], 1 + 2 * static_cast<Real>(i), 1e-9) << angle;
  }
}

/// A wall of 10 m × 10 m that looks to the east, in a model turned about the vertical and moved; joints cross its middle.
std::string wall(Real spacing, Real angle, const Vec3& moved) {
  const Real c = std::cos(angle * degree), s = std::sin(angle * degree);
  const auto turned = [&](const Vec3& x) {
    return Vec3{c * x[0] - s * x[1], s * x[0] + c * x[1], x[2]};
  };
  const auto text = [](const Vec3& x) {
    return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", x[0], x[1], x[2]);
  };
  std::string planes;
  for (const auto& [normal, at] : {std::pair<Vec3, Real>{{1, 0, 0}, 5},
                                   {{-1, 0, 0}, 5},
                                   {{0, 1, 0}, 5},
                                   {{0, -1, 0}, 5},
                                   {{0, 0, 1}, 5},
                                   {{0, 0, -1}, 5}})
    planes += fmt::format("{{normal = {}, point = {}, keep = 'below'}},", text(turned(normal)),
                          text(turned(at * normal) + moved));
  std::string joints;
  for (const Vec3& normal : {Vec3{0, 1, 0}, Vec3{0, 0, 1}})
    joints +=
        fmt::format("[[joint]]\nnormal = {}\npoint = {}\n", text(turned(normal)), text(moved));
  return rock_and_joint + "[[solid]]\nname = 'rock'\nshape = 'halfspaces'\nplanes = [" + planes +
         "]\ncontinues = ['1', '2', '3', '4', '5']\n" + joints +
         "[[bolt_pattern]]\non = 'rock.0'\n" + fmt::format("spacing = {}\n", spacing) +
         bolts_of_a_pattern;
}

TEST(PatternOnAWall, HasAsManyBoltsAsWholeSpacingsFitWhereverTheModelIs) {
  for (const auto& [spacing, bolts] :
       {std::pair{1.0, 100u}, {1.25, 64u}, {2.0, 25u}, {2.5, 16u}, {3.0, 9u}})
    for (int k = 0; k < 8; ++k) {
      const Vec3 moved = k % 2 == 0 ? Vec3{} : Vec3{0.1, 0.3, 0.7};
      const auto drilled = bolts_of(wall(spacing, k * 11.3, moved));
      EXPECT_EQ(drilled.size(), bolts) << spacing << " " << k;
      // Those on a joint are in one of its blocks, not in neither or both.
      for (const Bolt& bolt : drilled) {
        Real length = 0;
        for (const RockSegment& segment : bolt.rock) length += segment.to - segment.from;
        EXPECT_NEAR(length, 3, 1e-9);
      }
    }
}

TEST(PatternOnAWall, WhoseGridReachesItsRimHasBoltsOnAllOfIt) {
  for (int k = 0; k < 8; ++k) {
    const std::string text = wall(2, k * 11.3, {0.1, 0.3, 0.7}) + "offset = [1, 1]\n";
    EXPECT_EQ(bolts_of(text).size(), 36u) << k;
  }
}

}  // namespace
}  // namespace rockfold
