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

#define RUN "[[material]]\ndensity = 2600\nyoung_modulus = 1e10\npoisson_ratio = 0.2\n[analysis]\ntype = 'dynamic'\ntime_step = 0.1\nsteps = 1\n"
#define BLOCKS "[cover]\nlattice = 'block'\n"

/// Of a key that only some commands use, those alone: the reader takes it.
TEST(NotSupportedYet, IsSaidByTheRunAlone) {
  const NotYet cases[] = {
      {"[cover]\nspacing = 1\norder = 2\n[[joint]]\nname = 'bed'\nnormal = [0, 0, 1]\npoint = [1, 1, 1]\n[[monitor]]\nname = 'crest'\npoint = [1, 1, 1]\njoint = 'bed'\n", 21, 1, "monitor[1].joint"},
      {"[cover]\nspacing = 1\norder = 2\n[[excavation]]\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n[[step]]\n[[step]]\nexcavate = 1\n", 22, 1, "step[2].excavate"},
      {BLOCKS "[contact]\nmax_penetration = 1e-4\n", 16, 1, "contact.max_penetration"},
  };
  for (const auto& [text, line, column, key] : cases) {
    const std::string model = std::string(ROCK) + RUN + text;
    for (const Purpose purpose : {Purpose::cut, Purpose::run, Purpose::check}) {
      const auto errors = errors_of(model, {}, purpose);
      SCOPED_TRACE(listed(errors));
      ASSERT_EQ(errors.size(), purpose == Purpose::cut ? 0u : 1u);
      if (errors.empty()) continue;
      EXPECT_EQ(errors[0].place.line, line);
      EXPECT_EQ(errors[0].place.key, key);
    }
  }
}

}  // namespace
}  // namespace rockfold
