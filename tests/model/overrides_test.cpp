// --set key.path=value.
#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

Model with(const std::vector<std::string>& overrides) {
  return parse_model(complete_model, "m.toml", overrides);
}

TEST(Override, ReachesEveryKindOfPlace) {
  EXPECT_EQ(with({"cover.spacing=0.5"}).cover->spacing[0], 0.5);
  EXPECT_EQ(with({"cover . spacing = 0.5"}).cover->spacing[0], 0.5);
  EXPECT_EQ(with({"joint_set.1.spacing=3"}).joint_sets[0].spacing, 3);
  EXPECT_EQ(with({"joint_set[1].spacing=3"}).joint_sets[0].spacing, 3);
  EXPECT_EQ(with({"joint_set.J1.spacing=3"}).joint_sets[0].spacing, 3);
  EXPECT_EQ(with({"joint_set[J1].spacing=3"}).joint_sets[0].spacing, 3);
  EXPECT_EQ(with({"gravity.3=-1.5"}).gravity, (Vec3{0.5, 0, -1.5}));
  EXPECT_EQ(with({"gravity=[0, 0, -1]"}).gravity, (Vec3{0, 0, -1}));
  EXPECT_TRUE(
      std::get<HalfspacesShape>(with({"solid.'cut.away'.planes.2.keep=above"}).solids[1].shape)
          .planes[1]
          .keep_above);
  EXPECT_EQ(with({"analysis.type=static"}).analysis->steps(), 1);
  EXPECT_EQ(with({"analysis.newmark.beta=0.25"}).analysis->newmark_beta, 0.25);
  EXPECT_TRUE(with({"joint_set=[]", "water=[]"}).joint_sets.empty());
}

TEST(Override, TakesTextWithoutQuotes) {
  EXPECT_EQ(with({"title=My \"slope\" #3 = \\new"}).title, "My \"slope\" #3 = \\new");
  EXPECT_EQ(with({"title='quoted'"}).title, "quoted");
  EXPECT_EQ(with({"title=''"}).title, "");
  EXPECT_EQ(with({"title=1\nfoo=2"}).title, "1\nfoo=2");
}

TEST(Override, MakesWhatIsNotThereYet) {
  const auto model =
      parse_model(ROCK, "m.toml", {"cover.spacing=2", "support.water_pressure=5", "title=new"});
  EXPECT_EQ(model.cover->spacing[0], 2);
  EXPECT_EQ(model.support->water_pressure, 5);
  EXPECT_EQ(model.title, "new");
}

TEST(Override, WithoutAValueTakesOut) {
  EXPECT_EQ(with({"title="}).title, "");
  const auto all = with({}).joint_sets.size();
  ASSERT_GE(all, 2u);
  EXPECT_EQ(with({"water=", "joint_set.J1="}).joint_sets.size(), all - 1);
  EXPECT_NE(with({"water=", "joint_set.1="}).joint_sets[0].name, "J1");
  EXPECT_TRUE(with({"joint_set=", "water="}).joint_sets.empty());
  EXPECT_EQ(with({"analysis.newmark.beta=0.3", "analysis.newmark="}).analysis->newmark_beta, 0.25);
}

TEST(Override, IsAppliedInOrderAndStored) {
  const auto model = parse_model(ROCK, "m.toml", {"cover.spacing=2", "cover.spacing=3"});
  EXPECT_EQ(model.cover->spacing[0], 3);
  EXPECT_EQ(model.text, ROCK
            "\n# Overridden on the command line:\n#   --set cover.spacing=2\n#   --set "
            "cover.spacing=3\n");
  EXPECT_TRUE(errors_of(model.text).empty());
}

struct WrongValue {
  const char* override_text;
  const char* key;
  const char* part;
};

TEST(Override, OfAWrongValueIsItsPlace) {
  const WrongValue cases[] = {
      {"joint_set.J1.spacing=-1", "joint_set[1].spacing", "found -1, must be > 0"},
      {"joint_set.1.spacing=2 kg", "joint_set[1].spacing",
       "found \"2 kg\", must be a number (m), or text with a unit: m, mm"},
      {"gravity.3=nan", "gravity[3]", "must be a finite number"},
      {"gravity=[0, 0", "gravity", "must be 3 numbers"},
      {"cover.spcing=3", "cover.spcing", "did you mean \"spacing\"?"},
      {"foo.bar=3", "foo", "unknown key \"foo\""},
      {"cover.order=3", "cover.order", "must be an integer, 0 to 2"},
      {"cover=3", "cover", "must be a table [cover]"},
  };
  for (const auto& [text, key, part] : cases) {
    const auto errors = errors_of(complete_model, {text});
    SCOPED_TRACE(std::string(text) + "\nsays:\n" + listed(errors));
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].place.file, std::string("--set ") + text);
    EXPECT_EQ(errors[0].place.line, 0);
    EXPECT_EQ(errors[0].place.key, key);
    EXPECT_NE(errors[0].message.find(part), std::string::npos);
  }
}

struct Malformed {
  const char* override_text;
  const char* part;
};

TEST(Override, ThatIsMalformedIsAUsageError) {
  const Malformed cases[] = {
      {"cover.spacing", "has no '='"},
      {"", "empty part"},
      {"=3", "empty part"},
      {"cover..spacing=3", "empty part"},
      {"cover.=3", "empty part"},
      {"joint_set[1=3", "open bracket"},
      {"joint_set[]=3", "empty part"},
      {"joint_set[1]spacing=3", "where '.', '[' or '=' should stand"},
      {"solid.'rock=3", "open quote"},
      {"joint_set.6.spacing=3", "joint_set has 5 entries, no number 6"},
      {"joint_set.0.spacing=3", "joint_set has 5 entries, no number 0"},
      {"joint_set.J2.spacing=3", "no entry named \"J2\", did you mean \"J1\"?"},
      {"cover.spacing.x=3", "cover.spacing is 1.5, it has no \"x\""},
      {"drift.1.name=3", "the model has no drift to change an entry of"},
      {"drift=", "takes drift out of the model, where there is none"},
      {"cover.drift.x=", "takes cover.drift out of the model, where there is none"},
      {"cover.spcing=", "(a value stands behind '='), did you mean \"spacing\"?"},
      {"joint_sett.J1=", "takes joint_sett out of the model, where there is none"},
      {"joint_sett.J1=", "did you mean \"joint_set\"?"},
      {"analysis.newmark.theta=", "the keys there are: beta, gamma"},
      {"joint_set.6=", "joint_set has 5 entries, no number 6"},
      {"title=\xFF", "no UTF-8"},
  };
  for (const auto& [text, part] : cases) {
    SCOPED_TRACE(text);
    try {
      with({text});
      FAIL();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace rockfold
