// Models that have no answer: each is refused with a message that says which solid and why.
#include <string>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/cut/sample_models.hpp"

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
  expect_refusal(model, "cells", "joint_set");
}

}  // namespace
}  // namespace rockfold::test
