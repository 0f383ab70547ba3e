// What each command needs of a model.
#include "src/model/check_model.hpp"

#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

#define MATERIAL "[[material]]\nname = 'a'\n"
#define ELASTIC MATERIAL "density = 2700\nyoung_modulus = 1e9\npoisson_ratio = 0.2\n"
#define SET "[[joint_set]]\ndip = 0\ndip_direction = 0\nspacing = 1\n"
#define CLEAN "[[joint_material]]\nfriction_angle = 30\n"

struct Case {
  const char* text;
  Purpose purpose;
  std::vector<std::string> missing;  ///< keys
};

TEST(CheckModel, NamesAllThatACommandLacks) {
  const std::vector<Case> cases = {
      {ROCK, Purpose::cut, {}},
      {ROCK SET, Purpose::cut, {}},
      {ROCK MATERIAL, Purpose::cut, {}},
      {ROCK, Purpose::check, {}},
      {"", Purpose::check, {"solid"}},
      {ROCK, Purpose::support, {"material"}},
      {ROCK MATERIAL SET, Purpose::support, {"joint_material", "material[1].density"}},
      {ROCK MATERIAL "density = 1\n" SET CLEAN, Purpose::support, {}},
      {"gravity = [0, 0, 0]\n" ROCK ELASTIC, Purpose::support, {"gravity"}},
      {"gravity = [0, 0, 0]\n" ROCK ELASTIC "[support]\nwater_pressure = 1", Purpose::support, {}},
      {ROCK "[support]\n", Purpose::check, {"material"}},
      {ROCK MATERIAL "[support]\n", Purpose::check, {"material[1].density"}},
      {ROCK, Purpose::run, {"material", "cover", "analysis"}},
      {ROCK MATERIAL,
       Purpose::run,
       {"cover", "analysis", "material[1].density", "material[1].young_modulus"}},
      {ROCK ELASTIC SET "[cover]\nspacing = 1\n[analysis]\n", Purpose::run, {}},
      {ROCK ELASTIC "[cover]\nspacing = 1\n[analysis]\ntype = 'static'", Purpose::run, {"fixed"}},
      {ROCK ELASTIC SET "[support]\n[cover]\nspacing = 1\n[analysis]\n",
       Purpose::run,
       {"joint_material"}},
      {ROCK MATERIAL "density = 1\n[[joint_mesh]]\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'\n",
       Purpose::support,
       {"joint_material"}},
      {ROCK MATERIAL "density = 1\n[[joint_table]]\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'\n",
       Purpose::support,
       {"joint_material"}},
      {ROCK ELASTIC "[analysis]\n", Purpose::check, {"cover"}},
      {ROCK ELASTIC MATERIAL "name = 'b'\n", Purpose::cut, {""}},  // TOML: name is given twice
      {ROCK ELASTIC "[[material]]\nname = 'unused'\n[cover]\nspacing = 1\n[analysis]\n",
       Purpose::run,
       {}},
  };
  for (const auto& [text, purpose, missing] : cases) {
    const auto errors = errors_of(text, {}, purpose);
    std::vector<std::string> keys;
    for (const auto& error : errors) keys.push_back(error.place.key);
    EXPECT_EQ(keys, missing) << text << "\nsays:\n" << listed(errors);
  }
}

TEST(CheckModel, ThrowsForAModelThatWasReadForLess) {
  const auto model = parse_model(ROCK, "m.toml");
  EXPECT_NO_THROW(check_for(model, Purpose::cut));
  try {
    check_for(model, Purpose::run);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::model);
    ASSERT_EQ(error.diagnostics().size(), 3u);
    EXPECT_EQ(error.diagnostics()[0].place.file, "m.toml");
    EXPECT_EQ(error.diagnostics()[0].place.line, 1);
  }
}

TEST(CheckModel, SaysNothingTwice) {
  // The density is wrong and [cover] misspelt: neither is also missing.
  const auto errors =
      errors_of(ROCK MATERIAL "density = -1\n[covers]\n[analysis]\n", {}, Purpose::run);
  std::vector<std::string> keys;
  for (const auto& error : errors) keys.push_back(error.place.key);
  EXPECT_EQ(keys, (std::vector<std::string>{"material[1].young_modulus", "material[1].density",
                                            "covers"}))
      << listed(errors);
}

}  // namespace
}  // namespace rockfold
