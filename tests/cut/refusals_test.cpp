// Models that have no answer: each is refused with a message that says which solid and why.
#include <string>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {
namespace {

// The error that cutting throws; fails the test if it throws none.
Error refusal(const Model& model) {
  try {
    cut(model);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "the model was cut";
  return Error(ErrorKind::analysis, "");
}

void expect_refusal(const Model& model, const std::string& part_of_message,
                    const std::string& part_of_key) {
  const Error error = refusal(model);
  EXPECT_EQ(error.kind(), ErrorKind::model);
  EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos) << error.what();
  EXPECT_NE(error.diagnostics().front().place.key.find(part_of_key), std::string::npos)
      << error.diagnostics().front().place.key;
}

Model halfspaces(const std::vector<std::pair<Vec3, Vec3>>& normals_and_points) {
  Model model;
  model.solids.push_back(convex_solid("wedge", normals_and_points));
  return model;
}

TEST(Refusals, HalfSpacesWithoutABound) {
  expect_refusal(halfspaces({{{0, 0, 1}, {}}}), "no bounded volume", "wedge");
  expect_refusal(halfspaces({{{0, 0, 1}, {}}, {{1, 0, 0}, {}}, {{0, 1, 0}, {}}}),
                 "no bounded volume", "wedge");
  // A prism without its far end.
  expect_refusal(
      halfspaces({{{0, -1, 0}, {}}, {{-1, 0, 0}, {}}, {{1, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {}}}),
      "no bounded volume", "wedge");
}

TEST(Refusals, HalfSpacesWithNothingInside) {
  expect_refusal(halfspaces({{{0, 0, 1}, {0, 0, 0}}, {{0, 0, -1}, {0, 0, 1}}}), "", "wedge");
  // A tetrahedron inside out.
  expect_refusal(
      halfspaces({{{1, 0, 0}, {}}, {{0, 1, 0}, {}}, {{0, 0, 1}, {}}, {{-1, -1, -1}, {1, 0, 0}}}),
      "", "wedge");
}

TEST(Refusals, HalfSpacesThatMeetInAPlaneOnly) {
  expect_refusal(halfspaces({{{0, 0, 1}, {}},
                             {{0, 0, -1}, {}},
                             {{1, 0, 0}, {1, 0, 0}},
                             {{-1, 0, 0}, {}},
                             {{0, 1, 0}, {0, 1, 0}},
                             {{0, -1, 0}, {}}}),
                 "", "wedge");
}

TEST(Refusals, NothingAdded) {
  Model model;
  model.solids.push_back(box_solid("hole", {0, 0, 0}, {1, 1, 1}, false));
  expect_refusal(model, "no solid is added", "solid");
}

TEST(Refusals, EverythingTakenAway) {
  Model model = box_model({0, 0, 0}, {1, 1, 1});
  model.solids.push_back(box_solid("hole", {-1, -1, -1}, {2, 2, 2}, false));
  expect_refusal(model, "leave no rock", "solid");
  std::get<BoxShape>(model.solids[1].shape) = {{0, 0, 0}, {1, 1, 1}};
  expect_refusal(model, "leave no rock", "solid");
}

TEST(Refusals, MoreJointsThanAnyoneMeant) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  add_set(model, DipOrientation{30, 60}, 1e-7, {});
  expect_refusal(model, "planes", "joint_set");
  model.joint_sets[0].spacing = 0.02;
  add_set(model, DipOrientation{60, 160}, 0.02, {});
  add_set(model, DipOrientation{80, 260}, 0.02, {});
  expect_refusal(model, "cells", "cut.max_cells");
}

TEST(Refusals, OneCellMoreThanTheLimit) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  // Cut if so many are allowed; else the message has `told` and the place of cut.max_cells.
  const auto expect_cells = [](Model limited, std::int64_t cells, const std::string& told) {
    limited.cut.max_cells = cells;
    limited.cut.place_of_max_cells = {"m.toml", 7, 13, "cut.max_cells"};
    EXPECT_EQ(cut(limited).cutting.totals.cells, cells);
    if (cells == 1) return;
    limited.cut.max_cells = cells - 1;
    const Error error = refusal(limited);
    EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
    EXPECT_EQ(error.diagnostics().front().place.line, 7);
    EXPECT_EQ(error.diagnostics().front().place.key, "cut.max_cells");
  };
  expect_cells(model, 1, "");
  add_set(model, DipOrientation{0, 0}, 1, {});
  expect_cells(model, 10, "makes 10 cells");
  add_set(model, DipOrientation{90, 0}, 1, {});
  add_set(model, DipOrientation{90, 90}, 1, {});
  expect_cells(model, 1000, "makes about 1000 cells");  // by the estimate
  Model slab = model;                                   // a tenth of the box is left
  slab.solids.push_back(box_solid("above", {0, 0, 1}, {10, 10, 10}, false));
  expect_cells(slab, 100, "makes about 130 cells");
  for (JointSet& set : model.joint_sets) set.count = 3;  // one plane of each inside
  expect_cells(model, 8, "makes 8 cells");
}

TEST(Refusals, FiniteJointsOfTooManyCells) {
  Model model = box_model({0, 0, 0}, {10, 10, 10});
  Joint joint;
  joint.plane = {Vec3{0, 0, 1}, {5, 5, 5}};
  joint.radius = 1;
  joint.place = {"m.toml", 12, 1, "joint[1]"};
  model.joints.push_back(joint);
  model.cut.max_cells = 1;
  const Error error = refusal(model);
  EXPECT_EQ(error.kind(), ErrorKind::model);
  EXPECT_EQ(error.diagnostics().front().place.file, "m.toml");
  EXPECT_EQ(error.diagnostics().front().place.line, 12);
}

TEST(Refusals, BeforeJointsCutAreThoseOfCheck) {
  const auto expect_both = [](const Model& model, const std::string& part) {
    expect_refusal(model, part, "");
    try {
      check_cutting(model, {});
      ADD_FAILURE() << "check has not found: " << part;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  };
  const Model box = box_model({0, 0, 0}, {10, 10, 10});
  EXPECT_NO_THROW(check_cutting(box, {}));
  Model model = box;
  model.merges.push_back({Merge::Blocks{{{5, 5, 5}, {11, 5, 5}}}, {"m.toml", 3, 1, "merge[1]"}});
  expect_both(model, "(11, 5, 5) is not in the rock");
  model = box;
  model.solids.push_back(model.solids.front());
  model.solids.back().add = false;
  expect_both(model, "leave no rock");
  model = box;
  for (const DipOrientation& orientation : {DipOrientation{0, 0}, {90, 0}, {90, 90}})
    add_set(model, orientation, 0.03, {});
  expect_both(model, "cells");
}

}  // namespace
}  // namespace rockfold::test
