// Bolts, shotcrete, classification, drawings and tables: what is read, and what wrong ones are told.
#include <cmath>

#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

namespace rockfold {
namespace {

TEST(ReadBolts, OfTheCompleteModel) {
  const Model model = parse_model(complete_model, "m.toml", {}, Purpose::check);
  ASSERT_EQ(model.bolt_types.size(), 2u);
  const BoltType &rebar = model.bolt_types[0], &anchor = model.bolt_types[1];
  EXPECT_EQ(rebar.coupling, Coupling::cmc);
  EXPECT_EQ(rebar.action, BoltAction::active);
  EXPECT_EQ(rebar.efficiency, BoltEfficiency::cosine);
  EXPECT_EQ(rebar.plate_capacity, 100e3);
  EXPECT_EQ(*rebar.bond_strength, 150e3);
  EXPECT_EQ(rebar.stiffness, 12e6);
  EXPECT_EQ(anchor.coupling, Coupling::dmfc);
  EXPECT_EQ(anchor.action, BoltAction::active);  // the default of a tensioned bolt
  EXPECT_EQ(anchor.plate_capacity, 500e3);       // as strong as the steel
  EXPECT_EQ(anchor.stiffness, 500e3 / 0.05);     // to both capacities at once
  ASSERT_EQ(model.bolts.size(), 2u);
  EXPECT_EQ(model.bolts[0].name, "spot");
  EXPECT_EQ(model.bolts[0].type.name, "anchor");
  EXPECT_EQ(model.bolts[0].direction, (Vec3{0, 0, -1}));
  EXPECT_NEAR(model.bolts[1].length, std::sqrt(13.0), 1e-15);
  EXPECT_EQ(model.bolts[1].type.action, BoltAction::passive);
  ASSERT_EQ(model.bolt_patterns.size(), 1u);
  const BoltPattern& pattern = model.bolt_patterns[0];
  ASSERT_EQ(pattern.on.size(), 1u);
  EXPECT_TRUE(pattern.on[0].excavation);
  EXPECT_EQ(pattern.on[0].owner, 1);
  EXPECT_EQ(pattern.on[0].faces.size(), 16u);  // the sides of the tunnel
  EXPECT_TRUE(pattern.staggered);
  EXPECT_EQ(pattern.spacing, (std::array<Real, 2>{1.5, 2}));
  EXPECT_EQ(pattern.type.name, "rebar");
  ASSERT_TRUE(model.shotcrete);
  EXPECT_EQ(model.shotcrete->on.size(), 2u);
  EXPECT_FALSE(model.shotcrete->on[1].excavation);
  ASSERT_TRUE(model.pattern_search);
  EXPECT_EQ(model.pattern_search->spacings, (std::vector<Real>{1, 2}));  // ascending, each once
  EXPECT_EQ(model.pattern_search->types, std::vector<Index>{0});
  ASSERT_TRUE(model.classification && model.classification->q && model.classification->rmr);
  EXPECT_EQ(model.classification->q->location, QLocation::portal);
  EXPECT_EQ(model.classification->rmr->orientation, 3);
  EXPECT_EQ(model.drawings.size(), 2u);
  EXPECT_EQ(model.tables.size(), 1u);
}

// One case a line. ROCK is 5 lines.
// clang-format off
#define TYPE ROCK "[[bolt_type]]\nname = 'a'\n"
#define CAPACITIES "force_capacity = 1e5\ndisplacement_capacity = 0.02\n"
#define PATTERN ROCK "[[bolt_pattern]]\n" CAPACITIES "spacing = 1\nlength = 2\n"
#define Q ROCK "[classification.q]\n"
#define QGOOD "jr = 1\nja = 1\njw = 1\nsrf = 1\n"
#define RMR ROCK "[classification.rmr]\njoint_condition = 20\ngroundwater = 'dry'\norientation = 'fair'\n"

TEST(WrongSupport, OfBolts) {
  const Wrong cases[] = {
      {TYPE "force_capacity = 0\ndisplacement_capacity = 1", 8, 18, "bolt_type[1].force_capacity", "found 0, must be > 0 (N)"},
      {TYPE "force_capacity = -1\ndisplacement_capacity = 1", 8, 18, "bolt_type[1].force_capacity", "must be > 0 (N)"},
      {TYPE "force_capacity = 1\ndisplacement_capacity = 0", 9, 25, "bolt_type[1].displacement_capacity", "found 0, must be > 0 (m)"},
      {TYPE "force_capacity = 1", 6, 1, "bolt_type[1].displacement_capacity", "is missing, must be > 0 (m)"},
      {TYPE CAPACITIES "bond_strength = 0", 10, 17, "bolt_type[1].bond_strength", "must be > 0 (N/m)"},
      {TYPE CAPACITIES "plate_capacity = -1", 10, 18, "bolt_type[1].plate_capacity", "must be >= 0 (N)"},
      {TYPE CAPACITIES "shear_capacity = -1", 10, 18, "bolt_type[1].shear_capacity", "must be >= 0 (N)"},
      {TYPE CAPACITIES "yield = 1e8", 6, 1, "bolt_type[1].diameter", "is missing: with a yield stress it is needed, must be > 0 (m)"},
      {TYPE CAPACITIES "diameter = 0.1\nyield = 5e8", 11, 9, "bolt_type[1].yield", "N, more than the force_capacity of "},
      {TYPE CAPACITIES "pretension = 2e5", 10, 14, "bolt_type[1].pretension", " N, more than the force_capacity of "},
      {TYPE CAPACITIES "rupture = 2", 10, 11, "bolt_type[1].rupture", "must be > 0 and <= 1"},
      {TYPE CAPACITIES "bond_stiffness = 0", 10, 18, "bolt_type[1].bond_stiffness", "must be > 0 (N/m per m)"},
      {PATTERN "on = 'rock'\ninstall = 'stage 2'", 12, 11, "bolt_pattern[1].install", "found \"stage 2\", which is neither the name of a [[step]] nor \"stage N\" of an [[excavation]]"},
      {TYPE CAPACITIES "coupling = 'cmc'", 10, 12, "bolt_type[1].coupling", "did you mean \"CMC\"?"},
      {TYPE CAPACITIES "anchor_length = 1", 10, 17, "bolt_type[1].anchor_length", "belongs to coupling \"DMFC\""},
      {TYPE CAPACITIES "coupling = 'DMFC'\nbond_strength = 1", 6, 1, "bolt_type[1].anchor_length", "coupling \"DMFC\" needs it"},
      {PATTERN "on = 'rock'\ncoupling = 'DMFC'\nanchor_length = 2.1", 13, 17, "bolt_pattern[1].anchor_length", "the anchor of 2.1 m is longer than the bolt of 2.0 m"},
      {TYPE CAPACITIES "coupling = 'DMFC'\nanchor_length = 5\n[[bolt]]\ntype = 'a'\ncollar = [0, 0, 0]\ntoe = [0, 0, 3]", 15, 7, "bolt[1].toe", "the anchor of 5.0 m is longer than the bolt of 3.0 m: see anchor_length of the bolt type"},
      {TYPE CAPACITIES "coupling = 'DMFC'\nanchor_length = 5\n[pattern_search]\non = 'rock'\nspacing = [1]\nlength = [2, 4]", 15, 10, "pattern_search.length", "no bolt is as long as the anchor of a (5.0 m)"},
      {TYPE CAPACITIES "[[bolt_type]]\nname = 'a'\n" CAPACITIES, 11, 8, "bolt_type[2].name", "is already the name of bolt_type[1] (line 6)"},
      {ROCK "[[bolt]]\n" CAPACITIES "collar = [0, 0, 0]\nlength = 3", 6, 1, "bolt[1].direction", "is missing, must be 3 numbers"},
      {ROCK "[[bolt]]\n" CAPACITIES "collar = [0, 0, 0]\ntoe = [0, 0, 0]", 10, 7, "bolt[1].toe", "is the collar"},
      {ROCK "[[bolt]]\n" CAPACITIES "collar = [0, 0, 0]\ntoe = [0, 0, 1]\nlength = 2", 11, 10, "bolt[1].length", "given by collar and toe"},
      {ROCK "[[bolt]]\ntype = 'x'\ncollar = [0, 0, 0]\ntoe = [0, 0, 1]", 7, 8, "bolt[1].type", "unknown bolt type \"x\"; the model has no [[bolt_type]]"},
      {TYPE CAPACITIES "[[bolt]]\ntype = 'a'\nforce_capacity = 3\ncollar = [0, 0, 0]\ntoe = [0, 0, 1]", 12, 18, "bolt[1].force_capacity", "is given by the bolt type"},
      {PATTERN, 6, 1, "bolt_pattern[1].on", "is missing, must name an excavation, a solid or a face of one"},
      {PATTERN "on = 'tunnel'", 11, 6, "bolt_pattern[1].on", "must be an excavation, a solid or a face of one (\"tunnel\", \"rock.xmin\"); the model has: rock"},
      {PATTERN "on = ['rock.zmin', 'rock']", 11, 6, "bolt_pattern[1].on", "\"rock.zmin\" and \"rock\" have faces in common, which would get two grids"},
      {PATTERN "on = ['rock.zmin', 'rck']", 11, 20, "bolt_pattern[1].on[2]", "did you mean \"rock\"?"},
      {PATTERN "on = 'rock.top'", 11, 6, "bolt_pattern[1].on", "unknown face \"top\" of \"rock\"; its faces are: xmin, xmax"},
      {PATTERN "on = 'rock.zmn'", 11, 6, "bolt_pattern[1].on", "did you mean \"zmin\"?"},
      {PATTERN "on = 'rock'\nlayout = 'hexagonal'", 12, 10, "bolt_pattern[1].layout", "must be \"rectangular\" or \"staggered\""},
      {PATTERN "on = 'rock'\ninclination = [10, 0]", 12, 15, "bolt_pattern[1].inclination", "first angle is over the second"},
      {ROCK "[[bolt_pattern]]\n" CAPACITIES "on = 'rock'\nspacing = [1, 0]\nlength = 2", 10, 15, "bolt_pattern[1].spacing[2]", "found 0, must be > 0 (m)"},
      {ROCK "[[bolt_pattern]]\n" CAPACITIES "on = 'rock'\nspacing = 1\nlength = 2e3", 11, 10, "bolt_pattern[1].length", "must be > 0 and <= 1000 (m)"},
      {ROCK "[shotcrete]\nthickness = 0\nshear_strength = 1\non = 'rock'", 7, 13, "shotcrete.thickness", "must be > 0 (m)"},
      {ROCK "[shotcrete]\nthickness = 1\nshear_strength = 1\non = []", 9, 6, "shotcrete.on", "is empty, must name at least one wall"},
      {ROCK "[pattern_search]\non = 'rock'\nspacing = [1]\nlength = [1]", 6, 1, "pattern_search.types", "no catalogue to choose from"},
      {TYPE CAPACITIES "[pattern_search]\non = 'rock'\nspacing = []\nlength = [1]", 12, 11, "pattern_search.spacing", "lengths (m)"},
      {TYPE CAPACITIES "[pattern_search]\non = 'rock'\nspacing = [1]\nlength = [1]\ntypes = ['b']", 14, 10, "pattern_search.types[1]", "unknown bolt type \"b\""},
      {TYPE CAPACITIES "mass_per_metre = 1\n[[bolt_type]]\n" CAPACITIES "[pattern_search]\non = 'rock'\nspacing = [1]\nlength = [1]", 14, 1, "pattern_search.types", "give it to all or to none"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongSupport, OfClassifications) {
  const Wrong cases[] = {
      {ROCK "[classification]\nspan = 3", 6, 1, "classification", "neither [classification.q] nor [classification.rmr]"},
      {Q QGOOD "rqd = 101", 11, 7, "classification.q.rqd", "must be 0 to 100 (%)"},
      {Q QGOOD "jn = 21", 11, 6, "classification.q.jn", "must be 0.5 to 20 (joint set number"},
      {Q "jr = 6\nja = 1\njw = 1\nsrf = 1\n", 7, 6, "classification.q.jr", "must be 0.5 to 5"},
      {Q "jr = 1\nja = 0.5\njw = 1\nsrf = 1\n", 8, 6, "classification.q.ja", "must be 0.75 to 20"},
      {Q "jr = 1\nja = 1\njw = 1.5\nsrf = 1\n", 9, 6, "classification.q.jw", "must be 0.05 to 1"},
      {Q "jr = 1\nja = 1\njw = 1\nsrf = 500\n", 10, 7, "classification.q.srf", "must be 0.5 to 400"},
      {Q "jr = 1\nja = 1\njw = 1\n", 6, 1, "classification.q.srf", "is missing, must be 0.5 to 400"},
      {RMR, 6, 1, "classification.rmr.uniaxial_strength", "or give point_load_index"},
      {RMR "point_load_index = 0.5e6", 10, 20, "classification.rmr.point_load_index", "none below 1 MPa"},
      {RMR "point_load_index = 5e6\nuniaxial_strength = 1e8", 10, 20, "classification.rmr.point_load_index", "give one of them"},
      {RMR "uniaxial_strength = 1e8\nrqd = -1", 11, 7, "classification.rmr.rqd", "must be 0 to 100"},
      {ROCK "[classification.rmr]\nuniaxial_strength = 1e8\njoint_condition = 31\ngroundwater = 'dry'\norientation = 'fair'", 8, 19, "classification.rmr.joint_condition", "must be 0 to 30"},
      {ROCK "[classification.rmr]\nuniaxial_strength = 1e8\njoint_condition = 'rough'\ngroundwater = 'dry'\norientation = 'fair'", 8, 19, "classification.rmr.joint_condition", "must be \"very_rough\", \"slightly_rough\""},
      {ROCK "[classification.rmr]\nuniaxial_strength = 1e8\njoint_condition = 20\ngroundwater = 'moist'\norientation = 'fair'", 9, 15, "classification.rmr.groundwater", "must be \"dry\", \"damp\""},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongSupport, OfDrawingsAndTables) {
  const Wrong cases[] = {
      {ROCK "[[drawing]]\noutput = 'a.png'\nkind = 'stereonet'", 7, 10, "drawing[1].output", "must be a name that ends in .svg"},
      {ROCK "[[drawing]]\noutput = 'a.svg'\nkind = 'sterionet'", 8, 8, "drawing[1].kind", "did you mean \"stereonet\"?"},
      {ROCK "[[drawing]]\noutput = 'a.svg'\nkind = 'bolt_layout'", 6, 1, "drawing[1].on", "must name an excavation"},
      {ROCK "[[drawing]]\noutput = 'a.svg'\nkind = 'stereonet'\nprojection = 'equal_area'\njoint_pyramids = true", 9, 14, "drawing[1].projection", "need \"equal_angle\""},
      {ROCK "[[table]]\noutput = '.csv'\nkind = 'bolts'", 7, 10, "table[1].output", "must be a name that ends in .csv"},
      {ROCK "[[drawing]]\noutput = '../../evil.svg'\nkind = 'stereonet'", 7, 10, "drawing[1].output", "found \"../../evil.svg\", must be a plain name that ends in .svg, without folders"},
      {ROCK "[[drawing]]\noutput = '/tmp/evil.svg'\nkind = 'stereonet'", 7, 10, "drawing[1].output", "must be a plain name"},
      {ROCK "[[table]]\noutput = 'a/b.csv'\nkind = 'bolts'", 7, 10, "table[1].output", "must be a plain name"},
      {ROCK "[[table]]\noutput = '..\\b.csv'\nkind = 'bolts'", 7, 10, "table[1].output", "must be a plain name"},
      {ROCK "[[table]]\noutput = \"a\\u0000.csv\"\nkind = 'bolts'", 7, 10, "table[1].output", "must be a plain name"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}
// clang-format on

}  // namespace
}  // namespace rockfold
