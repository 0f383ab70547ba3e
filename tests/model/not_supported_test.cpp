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

#define COVER "[cover]\nspacing = 1\n"
#define FIXED "[[fixed]]\nwhere = {point = [0, 0, 0]}\n"
#define LOAD "[[point_load]]\npoint = [0, 0, 0]\n"

TEST(NotSupportedYet, IsSaidOfEachKeyAndValue) {
  const NotYet cases[] = {
      {"[[traction]]\nwhere = {face = 'rock.zmax'}\nvalue = [0, 0, -1]", 6, 3, "traction"},
      {"[[initial_velocity]]\nwhere = {all = true}", 6, 3, "initial_velocity"},
      {"[contact]\npenalty = 0", 6, 2, "contact"},
      {"[[bolt]]\nname = 'b'", 6, 3, "bolt"},
      {"[[bolt_pattern]]\nname = 'b'", 6, 3, "bolt_pattern"},
      {COVER "lattice = 'tet5'", 8, 11, "cover.lattice"},
      {COVER "lattice = 'tet6_kuhn'", 8, 11, "cover.lattice"},
      {COVER "lattice = 'tet24'", 8, 11, "cover.lattice"},
      {COVER "lattice = 'hex8'", 8, 11, "cover.lattice"},
      {COVER "lattice = 'block'", 8, 11, "cover.lattice"},
      {COVER "order = 1", 8, 9, "cover.order"},
      {COVER "order = 2", 8, 9, "cover.order"},
      {COVER "directions = [[0, 0], [80, 0], [90, 90]]", 8, 14, "cover.directions"},
      {FIXED "value_table = [[0, 0, 0, 0]]", 8, 1, "fixed[1].value_table"},
      {FIXED "method = 'lagrange'", 8, 10, "fixed[1].method"},
      {LOAD "force_table = [[0, 0, 0, 0]]", 8, 1, "point_load[1].force_table"},
      {"[analysis]\nkinematics = 'large'", 7, 14, "analysis.kinematics"},
      {"[analysis]\nnewmark = {beta = 0.3}", 7, 19, "analysis.newmark.beta"},
      {"[analysis]\nnewmark = {gamma = 0.6}", 7, 20, "analysis.newmark.gamma"},
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
