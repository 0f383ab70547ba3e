// What the model's format names and is not built yet is refused by its name, where it stands.
#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

// One case a line.
// clang-format off

namespace rockfold {
namespace {

struct NotYet {
  const char* text;  ///< behind ROCK, from line 6
  int line, column;
  const char* key;
};


TEST(NotSupportedYet, IsSaidOfEachKeyAndValue) {
  const NotYet cases[] = {
      {"[contact]\npenalty = 0", 6, 2, "contact"},
      {"[[bolt]]\nname = 'b'", 6, 3, "bolt"},
      {"[[bolt_pattern]]\nname = 'b'", 6, 3, "bolt_pattern"},
      {"[solver]\npreconditioner = 'multigrid'", 7, 18, "solver.preconditioner"},
      {"[output]\ncheckpoint_every = 60.0", 7, 1, "output.checkpoint_every"},
  };
  for (const auto& [text, line, column, key] : cases) {
    const auto errors = errors_of(std::string(ROCK) + text);
    SCOPED_TRACE(std::string(text) + "\nsays:\n" + listed(errors));
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_EQ(errors[0].place.line, line);
    EXPECT_EQ(errors[0].place.column, column);
    EXPECT_EQ(errors[0].place.key, key);
    EXPECT_NE(errors[0].message.find("not supported yet"), std::string::npos);
  }
}

}  // namespace
}  // namespace rockfold
