// Suggestions for mistyped words, and numbers as messages show them.
#include "src/model/text/nearest.hpp"

#include <gtest/gtest.h>

#include "src/model/text/value.hpp"

namespace rockfold {
namespace {

TEST(NearestWord, ForgivesAThirdOfTheLetters) {
  const std::vector<std::string> keys{"name", "dip", "dip_direction", "spacing", "friction_angle"};
  EXPECT_EQ(nearest_word("spacign", keys), "spacing");
  EXPECT_EQ(nearest_word("Spacing", keys), "spacing");
  EXPECT_EQ(nearest_word("spc", keys), "");
  EXPECT_EQ(nearest_word("dp", keys), "dip");
  EXPECT_EQ(nearest_word("dip-direction", keys), "dip_direction");
  EXPECT_EQ(nearest_word("friction", keys), "friction_angle");
  EXPECT_EQ(nearest_word("angle", keys), "friction_angle");
  EXPECT_EQ(nearest_word("gle", keys), "");
  EXPECT_EQ(nearest_word("quantum", keys), "");
  EXPECT_EQ(nearest_word("", keys), "");
  EXPECT_EQ(nearest_word("name", {}), "");
}

TEST(Suggestion, ListsWhatThereIsWhereNothingIsNear) {
  EXPECT_EQ(suggestion("spacng", {"spacing"}, "the keys are"), ", did you mean \"spacing\"?");
  EXPECT_EQ(suggestion("quantum", {"a", "b"}, "the keys are"), "; the keys are: a, b");
  EXPECT_EQ(suggestion("quantum", {}, "the keys are"), "");
}

TEST(NumberText, IsShortAndExact) {
  EXPECT_EQ(number_text(-1), "-1.0");
  EXPECT_EQ(number_text(0.1), "0.1");
  EXPECT_EQ(number_text(1e9), "1e9");
  EXPECT_EQ(number_text(2.5e-7), "2.5e-7");
  EXPECT_EQ(number_text(1e300), "1e300");
  EXPECT_EQ(number_text(123456), "123456.0");
}

TEST(Described, CutsLongTextsBetweenCharacters) {
  const Value value{std::string(59, 'a') + "éé", {}};
  EXPECT_EQ(described(value), '"' + std::string(59, 'a') + "…\"");
}

}  // namespace
}  // namespace rockfold
