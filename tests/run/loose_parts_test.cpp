#include "src/run/loose_parts.hpp"

#include <string>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/solve/systems/systems.hpp"

namespace rockfold {
namespace {

/// Body 0 (block 1 of the report) held at points, body 1 (block 2) beside it.
SmallSystem two_bodies(const std::vector<Vec3>& points,
                       const std::vector<std::array<std::uint8_t, 3>>& components) {
  SmallSystem s;
  s.covered = reference::cover_regions(
      reference::turned_lattice({0.1, 0.2, 0.3}, 0.6, 0.2, 0.1, {1, 0.5, 0.5}, 1.4),
      {reference::box({0, 0, 0}, {1, 1, 1}, 0, 0, 0),
       reference::box({1, 0, 0}, {2, 1, 1}, 0, 1, 1)});
  s.fixed = reference::fix(
      s.covered, points, [](const Vec3&) { return Vec3{}; }, 1, false);
  s.fixed.component = components;
  return s;
}

using Components = std::vector<std::array<std::uint8_t, 3>>;
const Components whole3(3, {1, 1, 1});

TEST(LooseParts, FindThePartThatNothingHolds) {
  const SmallSystem s = two_bodies({{0.1, 0.1, 0.1}, {0.9, 0.1, 0.1}, {0.1, 0.9, 0.2}}, whole3);
  const auto loose = find_loose_parts(s.covers(), s.fixed);
  ASSERT_EQ(loose.size(), 1u);
  EXPECT_EQ(loose[0].blocks, (std::vector<Index>{1}));
  EXPECT_TRUE(loose[0].motions.empty());
}

struct Case {
  std::string name;
  std::vector<Vec3> points;
  Components components;
  std::vector<std::string> motions;
};

TEST(LooseParts, NameTheRigidMotionsLeftFree) {
  const Components one(1, {1, 1, 1}), two(2, {1, 1, 1});
  const Case cases[] = {
      {"two points leave a turn about their line",
       {{0.5, 0.5, 0}, {0.5, 0.5, 1}},
       two,
       {"rotation about (0.000, 0.000, "}},
      {"one point leaves three turns",
       {{0.2, 0.5, 0.1}},
       one,
       {"rotation", "rotation", "rotation"}},
      {"a smooth floor",
       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
       {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}},
       {"", "", ""}},
      {"rollers 3-2-1 hold",
       {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
       {{1, 1, 1}, {0, 1, 1}, {0, 0, 1}},
       {}},
  };
  for (const Case& c : cases) {
    const SmallSystem s = two_bodies(c.points, c.components);
    auto loose = find_loose_parts(s.covers(), s.fixed);
    const bool held = loose.size() == 1;
    EXPECT_EQ(held, c.motions.empty()) << c.name;
    if (held) continue;
    EXPECT_EQ(loose[0].blocks, (std::vector<Index>{0})) << c.name;
    ASSERT_EQ(loose[0].motions.size(), c.motions.size()) << c.name;
    for (std::size_t m = 0; m < c.motions.size(); ++m)
      EXPECT_NE(loose[0].motions[m].find(c.motions[m]), std::string::npos)
          << c.name << ": " << loose[0].motions[m];
  }
}

TEST(LooseParts, AreRefusedWithTheirBlocksByName) {
  const SmallSystem s = two_bodies({{0.5, 0.5, 0}, {0.5, 0.5, 1}}, Components(2, {1, 1, 1}));
  try {
    require_no_loose_parts(s.covers(), s.fixed);
    FAIL() << "a loose static system passed";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::analysis);
    const std::string message = error.what();
    EXPECT_NE(message.find("2 parts are free"), std::string::npos) << message;
    EXPECT_NE(message.find("block 1 (rotation about"), std::string::npos) << message;
    EXPECT_NE(message.find("block 2 (nothing holds it)"), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace rockfold
