// What only a motion in time can make use of is refused elsewhere; and what [analysis] says of damping.
#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

std::string model_of(const std::string& type, const std::string& rest) {
  return "[[material]]\nname = 'granite'\ndensity = 2700.0\nyoung_modulus = 1e9\npoisson_ratio = "
         "0.2\n" ROCK
         "material = 'granite'\n[cover]\nspacing = 1.0\n[[fixed]]\nwhere = {face = 'rock.zmin'}\n"
         "[analysis]\ntype = '" +
         type + "'\n" + rest;
}

TEST(LoadsInTime, AreRefusedWhereNothingMoves) {
  const std::string base = "[base_acceleration]\ntable = [[0, 0, 0, 0], [1, 1, 0, 0]]\n";
  const std::string start = "[[initial_velocity]]\nwhere = {all = true}\nvelocity = [1, 0, 0]\n";
  expect_error({model_of("static", base).c_str(), 18, 0, "base_acceleration", "static analysis"},
               Purpose::run);
  for (const char* type : {"static", "quasi_static"})
    expect_error(
        {model_of(type, start).c_str(), 18, 0, "initial_velocity[1]", "type = \"dynamic\""},
        Purpose::run);
  expect_error({model_of("dynamic", start + "[[step]]\ntype = 'quasi_static'\n[[step]]\n").c_str(),
                18, 0, "initial_velocity[1]", "must begin with a dynamic step"},
               Purpose::run);
  expect_error({model_of("dynamic", "[[step]]\nseismic = true\n").c_str(), 18, 0, "step[1].seismic",
                "no support.seismic_coefficient"},
               Purpose::run);
  EXPECT_TRUE(errors_of(model_of("dynamic", base + start), {}, Purpose::run).empty());
  EXPECT_TRUE(errors_of(model_of("quasi_static", base), {}, Purpose::run).empty());
}

TEST(BaseAcceleration, BeginsWithTheStepThatItNames) {
  const std::string base =
      "[base_acceleration]\ntable = [[0, 0, 0, 0], [1, 1, 0, 0]]\nstep = 'shaking'\n";
  const std::string steps =
      "[[step]]\ntype = 'quasi_static'\nname = 'gravity'\n[[step]]\nname = 'shaking'\n";
  const Model model = parse_model(model_of("dynamic", base + steps), "m.toml", {}, Purpose::run);
  EXPECT_EQ(model.base_acceleration->stage, 1);
  const Model none_named = parse_model(
      model_of("dynamic", base.substr(0, base.find("step")) + steps), "m.toml", {}, Purpose::run);
  EXPECT_EQ(none_named.base_acceleration->stage, 0);
  const std::pair<std::string, const char*> wrong[] = {
      {"", "found \"shaking\", but there is no [[step]]"},
      {"[[step]]\nname = 'quake'\n[[step]]\n",
       "found \"shaking\", must be the name of a [[step]]: \"quake\", \"step 2\""},
      {steps + "[[step]]\nname = 'shaking'\n", "the name of 2 steps"},
      {"[[step]]\ntype = 'static'\nname = 'shaking'\n[[step]]\n", "a static step"}};
  for (const auto& [rest, message] : wrong)
    expect_error(
        {model_of("dynamic", base + rest).c_str(), 20, 8, "base_acceleration.step", message},
        Purpose::run);
}

/// 3, 0, 4 has length 5; 1 g is 9.81 m/s².
TEST(BaseAcceleration, MayBeOneComponentInADirectionAndInG) {
  const Model model = parse_model(
      model_of("dynamic",
               "[base_acceleration]\ntable = [[0, 0], [1, 0.5]]\ndirection = [3, 0, 4]\nunit = "
               "'g'\n"),
      "m.toml", {}, Purpose::run);
  const BaseAcceleration& base = *model.base_acceleration;
  EXPECT_EQ(base.unit, 9.81);
  EXPECT_NEAR(base.table.value[1][0], 0.6 * 0.5 * 9.81, 1e-12);
  EXPECT_EQ(base.table.value[1][1], 0);
  EXPECT_NEAR(base.table.value[1][2], 0.8 * 0.5 * 9.81, 1e-12);
}

/// A damping ratio of 5 % at 1 and 10 Hz.
TEST(Rayleigh, FollowsFromADampingRatioAtTwoFrequencies) {
  const Model model =
      parse_model(model_of("dynamic", "rayleigh = {damping_ratio = 0.05, frequencies = [1, 10]}"),
                  "m.toml", {}, Purpose::run);
  EXPECT_NEAR(model.analysis->rayleigh_alpha, 0.57119866, 1e-8);
  EXPECT_NEAR(model.analysis->rayleigh_beta, 0.00144686, 1e-8);
  const Model given = parse_model(
      model_of("dynamic", "rayleigh = {alpha = 0.3}\nnewmark = {beta = 0.5, gamma = 1}"), "m.toml",
      {}, Purpose::run);
  EXPECT_EQ(given.analysis->rayleigh_alpha, 0.3);
  EXPECT_EQ(given.analysis->rayleigh_beta, 0);
  EXPECT_EQ(given.analysis->newmark_beta, 0.5);
  EXPECT_EQ(given.analysis->newmark_gamma, 1);
}

}  // namespace
}  // namespace rockfold
