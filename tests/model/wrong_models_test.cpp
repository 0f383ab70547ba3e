// Wrong models: where the error is found, what it is called and what it says.
#include <gtest/gtest.h>

#include "tests/model/model_errors.hpp"

// One case a line.
// clang-format off

namespace rockfold {
namespace {

// ROCK is 5 lines: what is added starts in line 6.
#define SET ROCK "[[joint_set]]\ndip = 0\ndip_direction = 0\nspacing = 1\n"
#define JOINT ROCK "[[joint]]\npoint = [1, 1, 1]\n"
#define SOLID "[[solid]]\n"
#define PRISM SOLID "shape = 'prism'\nextrude = [0, 0, 1]\n"
#define PLANES "[[solid]]\nshape = 'halfspaces'\n"
// Lines 6 to 9 of CLEAN and 10 to 13 of BED.
#define CLEAN ROCK "[[joint_material]]\nname = 'clean'\nfriction_angle = 35\ncohesion = 1e4\n"
#define BED CLEAN "[[joint]]\nname = 'bed'\nnormal = [0, 0, 1]\npoint = [1, 1, 1]\n"
#define CONTACT CLEAN "[contact]\n"
#define MONITOR BED "[[monitor]]\npoint = [1, 1, 1]\n"
#define MATERIAL ROCK "[[material]]\nname = 'a'\n"
#define RUN ROCK "[analysis]\n"
#define FIXED ROCK "[[fixed]]\n"
#define TRACTION ROCK "[[traction]]\nwhere = {face = 'rock.zmax'}\n"

// The columns of syntax errors are the TOML library's own: they differ by one or so between its versions.
TEST(WrongModel, IsNoToml) {
  const Wrong cases[] = {
      {"title = [1,", 1, 0, "", "TOML syntax"},
      {ROCK "[joint]\nname = 'a'\n[joint]\nname = 'b'\n", 8, 0, "", "double brackets, all of them: [[joint]]"},
      {ROCK "[cover]\nspacing = 1\n[cover]\nlattice = 'block'\n", 8, 0, "", "a table stands once"},
      {"title = 'a'\ntitle = 'b'", 2, 0, "", "cannot redefine existing"},
      {"title = 'a\n'", 1, 0, "", "TOML syntax"},
      {"title = '\xFF'", 1, 0, "", "utf-8"},
      {"gravity = [0, 0, -.5]", 1, 0, "", "expected decimal digit"},
      {"[[solid]\n", 1, 0, "", "TOML syntax"},
      {"[=]\n", 1, 0, "", "TOML syntax"},
      {"title = 'Übung'\nrepose = 35°", 2, 12, "", "only ASCII may stand outside of quotes"},
      {"a = [1,\xC2\xA0" "2]", 1, 8, "", "only ASCII may stand outside of quotes"},
      {"a = 1e999", 1, 0, "", "TOML syntax"},
      {"a = 99999999999999999999", 1, 0, "", "not representable"},
      {"title = \"\"\n\na.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = 1", 3, 40, "", "more than 20 parts"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, AsAWhole) {
  const Wrong cases[] = {
      {"", 1, 1, "solid", "no [[solid]]"},
      {"solid = []", 1, 1, "solid", "no [[solid]]"},
      {"solid = 3", 1, 9, "solid", "found 3, must be a table [[solid]]"},
      {"[solid]\nshape = 'box'", 1, 1, "solid", "write [[solid]], not [solid]"},
      {"solid = [3]", 1, 10, "solid[1]", "found 3, must be a table of keys"},
      {ROCK "[[cover]]\nspacing = 1", 6, 1, "cover", "write [cover], not [[cover]]"},
      {ROCK "[matrial]\n", 6, 2, "matrial", "unknown key \"matrial\", did you mean \"material\"?"},
      {ROCK "[quantum]\n", 6, 2, "quantum", "the keys here are: title, gravity, material,"},
      {CLEAN "bolt = [{collar = [0, 0, 0]}]\n", 10, 1, "joint_material[1].bolt", "unknown key \"bolt\": it belongs to the model, before the first table in brackets, or as [bolt] or [[bolt]]"},
      {MATERIAL "unit_weight = 26\n", 8, 1, "material[1].unit_weight", "density = \"26 kN/m3\""},
      {BED "[[water]]\ntable = 2.0\n", 15, 9, "water[1].table", "of water that stands level, its height is head = 2.0"},
      {"titel = 'a'\n" ROCK, 1, 1, "titel", "did you mean \"title\"?"},
      {"title = 3\n" ROCK, 1, 9, "title", "found 3, must be a text in quotes"},
      {"gravity = -9.81\n" ROCK, 1, 11, "gravity", "found -9.81, must be 3 numbers [x, y, z] (m/s2)"},
      {"gravity = [0, -9.81]\n" ROCK, 1, 11, "gravity", "found an array of 2 values, must be 3 numbers"},
      {"gravity = [0, 0, nan]\n" ROCK, 1, 18, "gravity[3]", "found nan, must be a finite number (m/s2)"},
      {"gravity = [0, 0, '-9.81']\n" ROCK, 1, 18, "gravity[3]", "found \"-9.81\", must be a number (m/s2)"},
      {"gravity = [0, -1e31, 0]\n" ROCK, 1, 15, "gravity[2]", "found -1e31, must be at most 1e30 in size"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfMaterials) {
  const Wrong cases[] = {
      {MATERIAL "density = 0", 8, 11, "material[1].density", "found 0, must be > 0 (kg/m3) (in \"a\")"},
      {MATERIAL "density = '26,5 kN/m3'", 8, 11, "material[1].density", "decimals stand behind a point: 26.5, not 26,5 (a decimal comma)"},
      {MATERIAL "density = ' -0,005 t/m3'", 8, 11, "material[1].density", "point: -0.005, not -0,005 (a decimal comma)"},
      {MATERIAL "density = '2,6,5 t/m3'", 8, 11, "material[1].density", "must be a number (kg/m3), or text with a unit: kg/m3"},
      {MATERIAL "density = true", 8, 11, "material[1].density", "found true, must be a number (kg/m3)"},
      {MATERIAL "density = 1979-05-27", 8, 11, "material[1].density", "found a date or time, must be a number"},
      {MATERIAL "young_modulus = 1e9\npoisson_ratio = 0.5", 9, 17, "material[1].poisson_ratio", "found 0.5, must be > -1 and < 0.5 ("},
      {MATERIAL "young_modulus = 1e9\npoisson_ratio = -1", 9, 17, "material[1].poisson_ratio", "found -1, must be > -1 and < 0.5"},
      {MATERIAL "young_modulus = 1e9", 6, 1, "material[1].poisson_ratio", "is missing, must be > -1 and < 0.5"},
      {MATERIAL "young_modulus = inf\npoisson_ratio = 0.2", 8, 17, "material[1].young_modulus", "found inf, must be a finite number, > 0 (Pa)"},
      {MATERIAL "[[material]]\nname = 'a'", 9, 8, "material[2].name", "\"a\" is already the name of material[1] (line 6)"},
      {MATERIAL "desity = 1", 8, 1, "material[1].desity", "did you mean \"density\"?"},
      {ROCK "[[material]]\nname = ''", 7, 8, "material[1].name", "must be one line of text, not empty"},
      {ROCK "[[material]]\nname = \"a\\nb\"", 7, 8, "material[1].name", "must be one line of text"},
      {ROCK "[[material]]\nname = 7", 7, 8, "material[1].name", "found 7, must be a text in quotes"},
      {ROCK "[[joint_material]]\nfriction_angle = 90", 7, 18, "joint_material[1].friction_angle", "found 90, must be >= 0 and < 90 (deg)"},
      {ROCK "[[joint_material]]\ncohesion = 1", 6, 1, "joint_material[1].friction_angle", "is missing, must be >= 0 and < 90"},
      {ROCK "[[joint_material]]\nfriction = 3", 7, 1, "joint_material[1].friction", "did you mean \"friction_angle\"?"},
      {ROCK "[[joint_material]]\nfriction_angle = 3\ncohesion = -1", 8, 12, "joint_material[1].cohesion", "found -1, must be >= 0 (Pa)"},
      {ROCK "[[joint_material]]\nfriction_angle = 3\nnormal_stiffness = 0", 8, 20, "joint_material[1].normal_stiffness", "must be > 0 (Pa/m)"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfJointMaterials) {
  const Wrong cases[] = {
      {ROCK "[[joint_material]]\nfriction_angle = -1", 7, 18, "joint_material[1].friction_angle", "found -1, must be >= 0 and < 90 (deg)"},
      {CLEAN "normal_stiffness = -1e9", 10, 20, "joint_material[1].normal_stiffness", "found -1e9, must be > 0 (Pa/m) (in \"clean\")"},
      {CLEAN "shear_stiffness = 0", 10, 19, "joint_material[1].shear_stiffness", "found 0, must be > 0 (Pa/m)"},
      {CLEAN "shear_stiffness = '5 GPa'", 10, 19, "joint_material[1].shear_stiffness", "GPa/m"},
      {CLEAN "tensile_strength = -1", 10, 20, "joint_material[1].tensile_strength", "found -1, must be >= 0 (Pa)"},
      {CLEAN "dilation_angle = 36", 10, 18, "joint_material[1].dilation_angle", "found 36.0, must be at most friction_angle = 35.0 (deg)"},
      {CLEAN "dilation_angle = -1", 10, 18, "joint_material[1].dilation_angle", "found -1, must be >= 0 and < 90 (deg)"},
      {CLEAN "dilation_angle = 5\ndilation_limit = 0", 11, 18, "joint_material[1].dilation_limit", "found 0, must be > 0 (m)"},
      {CLEAN "dilation_limit = 0.1", 10, 18, "joint_material[1].dilation_limit", "there is no dilation_angle"},
      {CLEAN "residual_friction_angle = 35.5", 10, 27, "joint_material[1].residual_friction_angle", "found 35.5, must be at most friction_angle = 35.0 (deg)"},
      {CLEAN "residual_friction_angle = 90", 10, 27, "joint_material[1].residual_friction_angle", "found 90, must be >= 0 and < 90 (deg)"},
      {CLEAN "residual_cohesion = 2e4", 10, 21, "joint_material[1].residual_cohesion", "must be at most cohesion = 10000.0 (Pa)"},
      {CLEAN "residual_cohesion = -1", 10, 21, "joint_material[1].residual_cohesion", "found -1, must be >= 0 (Pa)"},
      {ROCK "[[joint_material]]\nfriction_angle = 3\nresidual_cohesion = 1", 8, 21, "joint_material[1].residual_cohesion", "must be at most cohesion = 0.0 (Pa)"},
      {CLEAN "residual_friction_angel = 30", 10, 1, "joint_material[1].residual_friction_angel", "did you mean \"residual_friction_angle\"?"},
      {CLEAN "dilatation_angle = 3", 10, 1, "joint_material[1].dilatation_angle", "did you mean \"dilation_angle\"?"},
      // What is wrong in the peak values is told once.
      {ROCK "[[joint_material]]\nfriction_angle = 95\ndilation_angle = 5\nresidual_friction_angle = 30", 7, 18, "joint_material[1].friction_angle", "found 95"},
      {ROCK "[[joint_material]]\nfriction_angle = 35\ncohesion = -1\nresidual_cohesion = 5", 8, 12, "joint_material[1].cohesion", "found -1"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfContact) {
  const Wrong cases[] = {
      {CONTACT "material = 'claen'", 11, 12, "contact.material", "unknown joint material \"claen\", did you mean \"clean\"?"},
      {CONTACT "material = 'clay'", 11, 12, "contact.material", "unknown joint material \"clay\""},
      {ROCK "[contact]\nmaterial = 'clay'", 7, 12, "contact.material", "the model has no [[joint_material]]"},
      {CONTACT "restitution = 1.1", 11, 15, "contact.restitution", "found 1.1, must be 0 to 1 (0 plastic, 1 elastic impact)"},
      {CONTACT "restitution = -0.1", 11, 15, "contact.restitution", "found -0.1, must be 0 to 1"},
      {CONTACT "restitution = '1'", 11, 15, "contact.restitution", "found \"1\", must be a number"},
      {CONTACT "max_iterations = 0", 11, 18, "contact.max_iterations", "found 0, must be an integer >= 1"},
      {CONTACT "max_iterations = 2.5", 11, 18, "contact.max_iterations", "found 2.5, must be an integer >= 1"},
      {CONTACT "max_penetration = -1e-5", 11, 19, "contact.max_penetration", "must be >= 0 (m)"},
      {CONTACT "max_penetration = nan", 11, 19, "contact.max_penetration", "found nan, must be a finite number"},
      {CONTACT "penetration = 1", 11, 1, "contact.penetration", "did you mean \"max_penetration\"?"},
      {CONTACT "penalty = 1", 11, 1, "contact.penalty", "the keys here are: material, max_iterations, restitution, max_penetration"},
      {CLEAN "[[contact]]\nrestitution = 0", 10, 1, "contact", "write [contact], not [[contact]]"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfMonitorsOfJoints) {
  const Wrong cases[] = {
      {MONITOR "joint = 'bde'", 16, 9, "monitor[1].joint", "unknown joint \"bde\", did you mean \"bed\"?"},
      {MONITOR "joint = 'fault'", 16, 9, "monitor[1].joint", "unknown joint \"fault\""},
      {MONITOR "joint = 'rock.interface'", 16, 9, "monitor[1].joint", "unknown joint \"rock.interface\""},
      {MONITOR "joint = 1", 16, 9, "monitor[1].joint", "found 1, must be a text in quotes"},
      {ROCK "[[monitor]]\npoint = [1, 1, 1]\njoint = 'bed'", 8, 9, "monitor[1].joint", "unknown joint \"bed\"; the model has no joints"},
      {BED "[[monitor]]\njoint = 'bed'", 14, 1, "monitor[1].point", "is missing"},
      {CLEAN "[[jiont]]\nname = 'bed'\n[[monitor]]\npoint = [1, 1, 1]\njoint = 'bed'", 10, 3, "jiont", "did you mean \"joint\"?"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfSolids) {
  const Wrong cases[] = {
      {SOLID "shape = 'bax'", 2, 9, "solid[1].shape", "\"mesh\" or \"terrain\"; did you mean \"box\"?"},
      {SOLID "min = [0, 0, 0]", 1, 1, "solid[1].shape", "is missing, must be \"box\""},
      {SOLID "shpae = 'box'\nmin = [0, 0, 0]", 2, 1, "solid[1].shpae", "did you mean \"shape\"?"},
      {SOLID "shape = 'box'\nmin = [0, 0, 0]", 1, 1, "solid[1].max", "is missing"},
      {SOLID "shape = 'box'\nmin = [0, 0, 0]\nmax = [1, 0, 1]", 4, 7, "solid[1].max", "found y = 0.0, must be > min's 0.0 (m)"},
      {SOLID "shape = 'box'\nmin = [0, 0, 0]\nmax = [1, 2e9, 1]", 4, 11, "solid[1].max[2]", "found 2e9, must be at most 1e9 in size (m)"},
      {SOLID "shape = 'box'\nmin = [0, 0, 0]\nmax = [1e9, 1, 0.1]", 1, 1, "solid[1]", "is 0.1 m thick"},
      {SOLID "name = 's'\noperation = 'subtract'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]", 3, 13, "solid[1].operation", "must be \"add\""},
      {SOLID "operation = 'union'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]", 2, 13, "solid[1].operation", "must be \"add\", \"subtract\""},
      {ROCK "material = 'granite'", 6, 12, "solid[1].material", "unknown material \"granite\"; the model has no [[material]]"},
      {ROCK "material = 'b'\n[[material]]\nname = 'a'", 6, 12, "solid[1].material", "unknown material \"b\"; the model has: a"},
      {ROCK "material = 'granit'\n[[material]]\nname = 'granite'", 6, 12, "solid[1].material", "did you mean \"granite\"?"},
      {ROCK "material = 'granite'\n[[matrial]]\nname = 'granite'", 7, 3, "matrial", "did you mean \"material\"?"},
      {ROCK "continues = ['xmin', 'zmni']", 6, 22, "solid[1].continues[2]", "unknown face \"zmni\", did you mean \"zmin\"?"},
      {ROCK "continues = ['side']", 6, 14, "solid[1].continues[1]", "its faces are: xmin, xmax"},
      {ROCK "continues = 'xmin'", 6, 13, "solid[1].continues", "must be an array of face names in quotes"},
      {ROCK "continues = [0]", 6, 14, "solid[1].continues[1]", "found 0, must be a text in quotes"},
      {ROCK ROCK, 7, 8, "solid[2].name", "\"rock\" is already the name of solid[1] (line 1)"},
      {ROCK "extrude = [0, 0, 1]", 6, 1, "solid[1].extrude", "unknown key \"extrude\"; the keys here are: name, operation, shape, min, max, continues, material, interface"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfHalfspaces) {
  const Wrong cases[] = {
      {PLANES, 1, 1, "solid[1].planes", "is missing, must be 4 or more planes"},
      {PLANES "planes = [{dip = 0, dip_direction = 0, point = [0, 0, 0], keep = 'above'}]", 3, 10, "solid[1].planes", "must be 4 or more planes"},
      {PLANES "planes = 4", 3, 10, "solid[1].planes", "found 4, must be 4 or more planes"},
      {ROCK PLANES "operation = '-'\nplanes = [{dip = 0, point = [0, 0, 0], keep = 'above'}]", 9, 11, "solid[2].planes[1].dip_direction", "is missing, must be 0 to 360"},
      {ROCK PLANES "operation = '-'\nplanes = [{dip_direction = 0, point = [0, 0, 0], keep = 'above'}]", 9, 11, "solid[2].planes[1].dip", "is missing, must be 0 to 90 (deg)"},
      {ROCK PLANES "operation = '-'\nplanes = [{point = [0, 0, 0], keep = 'above'}]", 9, 11, "solid[2].planes[1].dip", "needs dip and dip_direction (deg), or normal"},
      {ROCK PLANES "operation = '-'\nplanes = [{normal = [0, 0, 1], point = [0, 0, 0]}]", 9, 11, "solid[2].planes[1].keep", "must be \"below\" or \"above\""},
      {ROCK PLANES "operation = '-'\nplanes = [{normal = [0, 0, 1], keep = 'above'}]", 9, 11, "solid[2].planes[1].point", "is missing"},
      {ROCK PLANES "operation = '-'\nplanes = [{normal = [0, 0, 1], dip = 4, point = [0, 0, 0], keep = 'above'}]", 9, 21, "solid[2].planes[1].normal", "not both"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfPrisms) {
  const Wrong cases[] = {
      {PRISM "base = [[0, 0, 0], [1, 0, 0]]", 4, 8, "solid[1].base", "must be 3 or more points"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [0, 1]]", 4, 31, "solid[1].base[3]", "found an array of 2 values"},
      {PRISM "base = [[1, 1, 1], [1, 1, 1], [1, 1, 1]]", 4, 8, "solid[1].base", "all points are equal"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [1, 0, 0], [0, 1, 0]]", 4, 8, "solid[1].base", "points 2 and 3 are equal"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 0]]", 4, 8, "solid[1].base", "points 4 and 1 are equal; the last edge closes by itself"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [2, 0, 0]]", 4, 8, "solid[1].base", "encloses no area"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0]]", 4, 8, "solid[1].base", "points 1, 2 and 3 are collinear"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [1, 1, 1e-6], [0, 1, 0]]", 4, 8, "solid[1].base", "is not in one plane with the others"},
      {PRISM "base = [[0, 0, 0], [1, 1, 0], [1, 0, 0], [0, 1, 0]]", 4, 8, "solid[1].base", "edges cross"},
      {PRISM "base = [[0, 3, 0], [2, -3, 0], [-3, 1, 0], [3, 1, 0], [-2, -3, 0]]", 4, 8, "solid[1].base", "the edges cross or touch: the one from point 1 to 2 and the one from point 4 to 5"},
      {PRISM "base = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [2, 0, 0], [0, 4, 0]]", 4, 8, "solid[1].base", "the edges cross or touch: the one from point 1 to 2 and the one from point 3 to 4"},
      {PRISM "base = [[0, 0, 0], [2, 2, 0], [4, 0, 0], [4, 4, 0], [2, 2, 0], [0, 4, 0]]", 4, 8, "solid[1].base", "points 2 and 5 are equal"},
      {SOLID "shape = 'prism'\nbase = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]", 1, 1, "solid[1].extrude", "is missing"},
      {SOLID "shape = 'prism'\nbase = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nextrude = [0, 0, 0]", 4, 11, "solid[1].extrude", "must not be zero"},
      {SOLID "shape = 'prism'\nbase = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nextrude = [1, 2, 0]", 4, 11, "solid[1].extrude", "lies in the plane of the base"},
      {PRISM "base = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ncontinues = ['sied']", 5, 14, "solid[1].continues[1]", "did you mean \"side\"?"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfJoints) {
  const Wrong cases[] = {
      {ROCK "[[joint_set]]\nname = 'J1'\ndip = 91\ndip_direction = 0\nspacing = 1", 8, 7, "joint_set[1].dip", "found 91, must be 0 to 90 (deg) (in \"J1\")"},
      {ROCK "[[joint_set]]\ndip = 9\ndip_direction = -90.0\nspacing = 1", 8, 17, "joint_set[1].dip_direction", "found -90.0, must be 0 to 360"},
      {ROCK "[[joint_set]]\ndip = 9\ndip_direction = 9\nspacing = -1.0", 9, 11, "joint_set[1].spacing", "found -1.0, must be > 0 (m)"},
      {ROCK "[[joint_set]]\ndip = 9\ndip_direction = 9", 6, 1, "joint_set[1].spacing", "is missing, must be > 0"},
      {ROCK "[[joint_set]]\ndip = 9\ndip_direction = 9\nspcing = 1", 9, 1, "joint_set[1].spcing", "unknown key \"spcing\", did you mean \"spacing\"?"},
      {SET "count = 0", 10, 9, "joint_set[1].count", "found 0, must be an integer >= 1"},
      {SET "count = 2.5", 10, 9, "joint_set[1].count", "found 2.5, must be an integer >= 1"},
      {SET "count = 3000000000", 10, 9, "joint_set[1].count", "must be an integer, 1 to 2147483647"},
      {SET "material = 'clean'", 10, 12, "joint_set[1].material", "unknown joint material \"clean\"; the model has no [[joint_material]]"},
      {SET "origin = [0, 0]", 10, 10, "joint_set[1].origin", "must be 3 numbers"},
      {JOINT, 6, 1, "joint[1].dip", "needs dip and dip_direction (deg), or normal"},
      {JOINT "dip = 3", 6, 1, "joint[1].dip_direction", "is missing, must be 0 to 360"},
      {JOINT "normal = [0, 0, 0]", 8, 10, "joint[1].normal", "must not be zero"},
      {JOINT "normal = [0, 0, 1]\ndip = 3\ndip_direction = 4", 8, 10, "joint[1].normal", "either a normal or dip and dip_direction, not both"},
      {ROCK "[[joint]]\nnormal = [0, 0, 1]", 6, 1, "joint[1].point", "is missing"},
      {ROCK "[[joint]]\nname = 'F1'\nnormal = [0, 0, 1]\npoint = [0, 0, 1e10]", 9, 16, "joint[1].point[3]", "must be at most 1e9 in size (m) (in \"F1\")"},
      {SET "name = 'F'\n[[joint]]\nname = 'F'\nnormal = [0, 0, 1]\npoint = [1, 1, 1]", 12, 8, "joint[1].name", "already the name of joint_set[1] (line 6)"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfCovers) {
  const Wrong cases[] = {
      {ROCK "[cover]\n", 6, 1, "cover.spacing", "is missing, must be one number or 3, one for each of the directions (m)"},
      {ROCK "[cover]\nspacing = 0", 7, 11, "cover.spacing", "found 0, must be > 0"},
      {ROCK "[cover]\nspacing = [1, 2]", 7, 11, "cover.spacing", "found an array of 2 values, must be one number or 3"},
      {ROCK "[cover]\nspacing = [1, 2, 0]", 7, 18, "cover.spacing[3]", "found 0, must be > 0"},
      {ROCK "[cover]\nspacing = 1\nlattice = 'tet7'", 8, 11, "cover.lattice", "found \"tet7\", must be \"tet5\", \"tet6\","},
      {ROCK "[cover]\nspacing = 1\nmixed = true", 8, 9, "cover.mixed", "the two forms of lattice = \"tet5\", which it needs"},
      {ROCK "[cover]\nspacing = 1\nmixed = 1", 8, 9, "cover.mixed", "found 1, must be true or false"},
      {ROCK "[cover]\nspacing = 1\nmax_elements = 0", 8, 16, "cover.max_elements", "found 0, must be an integer >= 1"},
      {ROCK "[cover]\nspacing = 1\njoint_tips = 'cut'", 8, 14, "cover.joint_tips", "must be \"keep\" or \"extend\""},
      {ROCK "[cover]\nlattice = 'block'\norigin = [0, 0, 0]", 8, 10, "cover.origin", "has no planes, must be left out"},
      {ROCK "[cover]\nlattice = 'block'\njoints = 'welded'", 8, 10, "cover.joints", "must be \"separate\""},
      {ROCK "[cover]\nspacing = 1\ndirections = [[0, 0], [90, 0], [89, 180]]", 8, 14, "cover.directions", "families 2 and 3 are nearly parallel: they meet at 1.0 degrees"},
      {ROCK "[cover]\nspacing = 1\ndirections = [[90, 0], [90, 60], [90, 120]]", 8, 14, "cover.directions", "nearly parallel to one line"},
      {ROCK "[cover]\nspacing = 1\norder = 3", 8, 9, "cover.order", "found 3, must be an integer, 0 to 2"},
      {ROCK "[cover]\nspacing = 1\ndirections = [[0, 0], [90, 0]]", 8, 14, "cover.directions", "must be 3 pairs [dip, dip direction] (deg)"},
      {ROCK "[cover]\nspacing = 1\ndirections = [[0, 0], [90, 0], [90, 90, 0]]", 8, 32, "cover.directions[3]", "must be 2 numbers"},
      {ROCK "[cover]\nspacing = 1\ndirections = [[0, 0], [95, 0], [90, 90]]", 8, 24, "cover.directions[2][1]", "found 95, must be 0 to 90"},
      {ROCK "[cover]\nspacing = 1\njoints = 'open'", 8, 10, "cover.joints", "must be \"separate\" or \"welded\""},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfConditions) {
  const Wrong cases[] = {
      {FIXED, 6, 1, "fixed[1].where", "must say one of face, box, point, plane or block_at"},
      {FIXED "where = 'rock.zmin'", 7, 9, "fixed[1].where", "found \"rock.zmin\", must be a table: where = {face = \"rock.zmin\"}"},
      {FIXED "where = 'top'", 7, 9, "fixed[1].where", "found \"top\", must be a table: where = {face = \"rock.zmin\"}"},
      {FIXED "where = 3", 7, 9, "fixed[1].where", "found 3, must be a table of keys"},
      {FIXED "where = {}", 7, 9, "fixed[1].where", "says no region, must have one of face, box"},
      {FIXED "where = {fase = 'rock.zmin'}", 7, 10, "fixed[1].where.fase", "did you mean \"face\"?"},
      {FIXED "where = {face = 'rock.zmin', point = [0, 0, 0]}", 7, 9, "fixed[1].where", "has both face and point"},
      {FIXED "where = {face = 'zmin'}", 7, 17, "fixed[1].where.face", "must be \"solid.face\", e.g. \"rock.zmin\""},
      {FIXED "where = {face = 'rok.zmin'}", 7, 17, "fixed[1].where.face", "unknown solid \"rok\", did you mean \"rock\"?"},
      {FIXED "where = {face = 'rock.top'}", 7, 17, "fixed[1].where.face", "unknown face \"top\" of solid \"rock\"; its faces are: xmin,"},
      {FIXED "where = {box = [[0, 0, 0], [1, -1, 1]]}", 7, 16, "fixed[1].where.box", "y = 0.0 is over the second's -1.0"},
      {FIXED "where = {box = [0, 0, 0, 1, 1, 1]}", 7, 16, "fixed[1].where.box", "must be 2 corners"},
      {FIXED "where = {plane = {point = [0, 0, 0]}}", 7, 18, "fixed[1].where.plane.normal", "is missing"},
      {FIXED "where = {plane = {point = [0, 0, 0], normal = [0, 0, 1], tolerance = -1}}", 7, 70, "fixed[1].where.plane.tolerance", "found -1, must be >= 0 (m)"},
      {FIXED "where = {block_at = [0, 0, 'a']}", 7, 28, "fixed[1].where.block_at[3]", "found \"a\", must be a number (m)"},
      {FIXED "where = {block_at = [0, 0, 0]}\ncomponents = []", 8, 14, "fixed[1].components", "must be an array of one or more of"},
      {FIXED "where = {block_at = [0, 0, 0]}\ncomponents = ['x', 'w']", 8, 20, "fixed[1].components[2]", "found \"w\", must be one or more of"},
      {FIXED "where = {block_at = [0, 0, 0]}\ncomponents = ['x', 'x']", 8, 20, "fixed[1].components[2]", "\"x\" is given twice"},
      {FIXED "where = {block_at = [0, 0, 0]}\nmethod = 'penality'", 8, 10, "fixed[1].method", "did you mean \"penalty\"?"},
      {ROCK "[[point_load]]\npoint = [0, 0, 0]", 6, 1, "point_load[1].force", "is missing"},
      {ROCK "[[point_load]]\npoint = [0, 0, 0]\nforce = 5", 8, 9, "point_load[1].force", "found 5, must be 3 numbers [x, y, z] (N)"},
      {FIXED "where = {point = [0, 0, 0]}\nvalue_table = []", 8, 15, "fixed[1].value_table", "must be a table over time, rows [t, x, y, z] (s, m)"},
      {FIXED "where = {point = [0, 0, 0]}\nvalue_table = [[0, 0, 0]]", 8, 16, "fixed[1].value_table[1]", "found an array of 3 values, must be a row [t, x, y, z] (s, m)"},
      {FIXED "where = {point = [0, 0, 0]}\nvalue_table = [[0, 0, 0, 0], [0, 0, 0, 1]]", 8, 30, "fixed[1].value_table[2]", "found time 0.0 after 0.0, times must ascend (s)"},
      {FIXED "where = {point = [0, 0, 0]}\nvalue = [0, 0, 0]\nvalue_table = [[0, 0, 0, 0]]", 9, 15, "fixed[1].value_table", "either value or value_table"},
      {FIXED "where = {point = [0, 0, 0]}\nstiffness = 0", 8, 13, "fixed[1].stiffness", "found 0, must be > 0 (N/m)"},
      {FIXED "where = {face = 'rock.zmin'}\nstiffness = -1", 8, 13, "fixed[1].stiffness", "found -1, must be > 0 (Pa/m)"},
      {FIXED "where = {point = [0, 0, 0]}\nmethod = 'lagrange'\nstiffness = 1", 9, 13, "fixed[1].stiffness", "has no use with method = \"lagrange\""},
      {ROCK "[[point_load]]\npoint = [0, 0, 0]\nforce = [0, 0, 0]\nforce_table = [[0, 0, 0, 0]]", 9, 15, "point_load[1].force_table", "either force or force_table"},
      {ROCK "[[point_load]]\npoint = [0, 0, 0]\nforce_table = [[1, 0, 0, 0], [0.5, 0, 0, 0]]", 8, 30, "point_load[1].force_table[2]", "times must ascend"},
      {ROCK "[[monitor]]\nname = 'm'", 6, 1, "monitor[1].point", "is missing, must be 3 numbers [x, y, z] (in \"m\")"},
      {ROCK "[[monitor]]\nname = 'm'\npoint = [1, 1, 1]\n[[monitor]]\nname = 'm'\npoint = [1, 1, 1]", 10, 8, "monitor[2].name", "already the name of monitor[1]"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfLoads) {
  const Wrong cases[] = {
      {TRACTION "value = [0, 0, 1]\npressure = 1", 9, 12, "traction[1].pressure", "either value or pressure, not both"},
      {TRACTION, 6, 1, "traction[1].value", "is missing, must have one of value, pressure, value_table, pressure_table or head (Pa; head in m)"},
      {TRACTION "presure = 1", 8, 1, "traction[1].presure", "did you mean \"pressure\"?"},
      {TRACTION "pressure = nan", 8, 12, "traction[1].pressure", "found nan, must be a finite number (Pa)"},
      {TRACTION "pressure_table = [[0, 1, 2]]", 8, 19, "traction[1].pressure_table[1]", "must be a row [t, value] (s, Pa)"},
      {TRACTION "pressure_table = [[0, 1], ['a', 1]]", 8, 28, "traction[1].pressure_table[2][1]", "found \"a\", must be a number (s)"},
      {TRACTION "value = [0, 0, 1]\nfollows = true", 9, 11, "traction[1].follows", "only a pressure can follow the face"},
      {ROCK "[[traction]]\npressure = 1", 6, 1, "traction[1].where", "must say one of face, plane or box"},
      {ROCK "[[traction]]\npressure = 1\nwhere = {point = [0, 0, 0]}", 8, 18, "traction[1].where.point", "a point has no free faces, must have one of face, plane or box"},
      {ROCK "[[traction]]\npressure = 1\nwhere = {face = 'rock.top'}", 8, 17, "traction[1].where.face", "unknown face \"top\" of solid \"rock\""},
      {ROCK "[[quiet_boundary]]\nwhere = {face = 'rok.zmin'}", 7, 17, "quiet_boundary[1].where.face", "did you mean \"rock\"?"},
      {ROCK "[[initial_velocity]]\nwhere = {all = true}", 6, 1, "initial_velocity[1].velocity", "must have velocity (m/s), angular_velocity (rad/s) or both"},
      {ROCK "[[initial_velocity]]\nvelocity = [0, 0, 1]", 6, 1, "initial_velocity[1].where", "must be {block_at = [x, y, z]} or {all = true}"},
      {ROCK "[[initial_velocity]]\nwhere = {all = false}\nvelocity = [0, 0, 1]", 7, 16, "initial_velocity[1].where.all", "found false, must be true"},
      {ROCK "[[initial_velocity]]\nwhere = {}\nvelocity = [0, 0, 1]", 7, 9, "initial_velocity[1].where.block_at", "says no blocks"},
      {ROCK "[initial_stress]", 6, 1, "initial_stress.value", "is missing, must be 3 rows of 3 numbers"},
      {ROCK "[initial_stress]\nvalue = [1, 2]", 7, 9, "initial_stress.value", "must be 3 rows [[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]] (Pa)"},
      {ROCK "[initial_stress]\nvalue = [[1, 2, 0], [3, 1, 0], [0, 0, 1]]", 7, 9, "initial_stress.value", "must be symmetric: xy is 2.0, but yx is 3.0"},
      {ROCK "[initial_stress]\nvalue = [[1, 0, 0], [0, 1, 0], [0, 0, 1]]\ngradient = [[0, 0, 0], [0, 0, 0], [0, 0, -1]]", 6, 1, "initial_stress.reference_z", "is missing"},
      {ROCK "[base_acceleration]", 6, 1, "base_acceleration.table", "must have one of table or file (m/s2)"},
      {ROCK "[base_acceleration]\ntable = [[0, 0, 0, 0], [-1, 0, 0, 0]]", 7, 24, "base_acceleration.table[2]", "times must ascend"},
      {ROCK "[base_acceleration]\ntable = [[0, 0], [1, 2]]", 7, 9, "base_acceleration.table", "give direction = [x, y, z]"},
      {ROCK "[base_acceleration]\ntable = [[0, 0, 0, 0]]\ndirection = [1, 0, 0]", 7, 10, "base_acceleration.table[1]", "must be a row [t, value]"},
      {ROCK "[base_acceleration]\ntable = [[0, 0]]\ndirection = [0, 0, 0]", 8, 13, "base_acceleration.direction", ""},
      {ROCK "[base_acceleration]\ntable = [[0, 0, 0, 0]]\nunit = 'ft'", 8, 8, "base_acceleration.unit", "\"gal\" or \"g\""},
      {ROCK "[base_acceleration]\nfile = 'no such.csv'", 7, 8, "base_acceleration.file", "there is no file"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfStrength) {
  const Wrong cases[] = {
      {MATERIAL "cohesion = 1e6", 6, 1, "material[1].friction_angle", "is missing, must be >= 0 and < 90 (deg)"},
      {MATERIAL "friction_angle = 30", 6, 1, "material[1].cohesion", "is missing, must be >= 0 (Pa)"},
      {MATERIAL "cohesion = 1e6\nfriction_angle = 45\ntensile_strength = 2e6", 10, 20, "material[1].tensile_strength", "must be at most cohesion / tan(friction_angle)"},
      {MATERIAL "cohesion = 1e6\nfriction_angle = 45\nhoek_brown = {sigma_ci = 1e8, m_i = 10}", 10, 14, "material[1].hoek_brown", "give one strength"},
      {MATERIAL "hoek_brown = {m_i = 10}", 8, 14, "material[1].hoek_brown.sigma_ci", "is missing, must be > 0 (Pa)"},
      {MATERIAL "hoek_brown = {sigma_ci = 1e8}", 8, 14, "material[1].hoek_brown.m_i", "must have m_i (intact rock), or m_b (rock mass)"},
      {MATERIAL "hoek_brown = {sigma_ci = 1e8, m_i = 10, gsi = 50}", 8, 41, "material[1].hoek_brown.gsi", "did you mean \"GSI\"?"},
      {MATERIAL "hoek_brown = {sigma_ci = 1e8, m_i = 10, GSI = 150}", 8, 47, "material[1].hoek_brown.GSI", "found 150, must be 1 to 100"},
      {MATERIAL "hoek_brown = {sigma_ci = 1e8, m_i = 10, GSI = 50, a = 0.5}", 8, 55, "material[1].hoek_brown.a", "GSI and D say what a is"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, OfAnalyses) {
  const Wrong cases[] = {
      {RUN "type = 'dynamik'", 7, 8, "analysis.type", "must be \"static\", \"quasi_static\" or \"dynamic\"; did you mean \"dynamic\"?"},
      {RUN "time_step = 0", 7, 13, "analysis.time_step", "found 0, must be > 0 (s)"},
      {RUN "time_step = 0.5\nend_time = 0.1", 8, 12, "analysis.end_time", "found 0.1, must be at least one time_step (0.5 s)"},
      {RUN "time_step = 1e-12", 6, 1, "analysis.end_time", "more than 2147483647 times time_step"},
      {RUN "steps = 0", 7, 9, "analysis.steps", "found 0, must be an integer >= 1"},
      {RUN "steps = 5\nend_time = 1", 7, 9, "analysis.steps", "either steps or end_time, not both"},
      {RUN "dynamic_ratio = 1.5", 7, 17, "analysis.dynamic_ratio", "found 1.5, must be 0 to 1"},
      {RUN "type = 'static'\nsteps = 5", 8, 9, "analysis.steps", "found 5, must be 1: a static analysis takes its loads in one step"},
      {RUN "type = 'quasi_static'\ndynamic_ratio = 0.5", 8, 17, "analysis.dynamic_ratio", "a quasi_static analysis has 0"},
      {RUN "[[step]]\ntype = 'quasistatic'", 8, 8, "step[1].type", "did you mean \"quasi_static\"?"},
      {RUN "[[step]]\n[[step]]\ntype = 'static'\nsteps = 2", 10, 9, "step[2].steps", "must be 1: a static analysis takes its loads in one step"},
      {RUN "[[step]]\nkinematics = 'large'", 8, 1, "step[1].kinematics", "unknown key"},
      {RUN "[[step]]\nexcavate = 1", 8, 12, "step[1].excavate", "found 1, but there is no [[excavation]]"},
      {RUN "[[step]]\nexcavate = 3\n[[excavation]]\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]", 8, 12, "step[1].excavate", "found 3, must be a stage of an [[excavation]]: 1"},
      {RUN "[[step]]\nexcavate = 1\n[[step]]\nexcavate = 1\n[[excavation]]\nshape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]", 10, 12, "step[2].excavate", "found 1, whose rock \"step 1\" takes away already"},
      {RUN "max_displacement_ratio = 0", 7, 26, "analysis.max_displacement_ratio", "must be > 0 and <= 1"},
      {RUN "newmark = 0.25", 7, 11, "analysis.newmark", "must be a table"},
      {RUN "newmark = {alpha = 1}", 7, 12, "analysis.newmark.alpha", "the keys here are: beta, gamma"},
      {RUN "newmark = {beta = 0}", 7, 19, "analysis.newmark.beta", "found 0, must be >= 1e-4 (1e-4 comes to the explicit scheme"},
      {RUN "newmark = {gamma = -0.5}", 7, 20, "analysis.newmark.gamma", "found -0.5, must be >= 0"},
      {RUN "type = 'quasi_static'\ntolerance_of_balance = 1e-6", 8, 24, "analysis.tolerance_of_balance", "is for type = \"quasi_static\" with scheme = \"explicit\""},
      {RUN "type = 'quasi_static'\nscheme = 'explicit'\nmass_scaling = 1e-3", 9, 16, "analysis.mass_scaling", "is for type = \"dynamic\" with scheme = \"explicit\" or \"auto\""},
      {RUN "mass_scaling = 2", 7, 16, "analysis.mass_scaling", "found 2, must be 0 to 1 (of the mass of all rock)"},
      {RUN "[[contact_pair]]\nbetween = ['rock', 'nothing']", 8, 11, "contact_pair[1].between", "no joint material and no solid is called \"nothing\""},
      {CLEAN "[[contact_pair]]\nbetween = ['rock', 'clean']\nmaterial = 'clean'\n[[contact_pair]]\nbetween = ['clean', 'rock']\nmaterial = 'clean'", 14, 11, "contact_pair[2].between", "names two surfaces that an entry before names too"},
      {CLEAN "[[joint_material]]\nname = 'rock'\nfriction_angle = 30\n[[contact_pair]]\nbetween = ['rock', 'clean']\nmaterial = 'clean'", 14, 11, "contact_pair[1].between", "\"rock\" is the name of a joint material and of a solid"},
      {BED "[[water]]\nhead = 2\nfactor = 1.5\n", 16, 10, "water[1].factor", "found 1.5, must be 0 to 1 (of the pressure)"},
      {BED "[[water]]\nhead = 2\naperture = 0.01\n", 16, 12, "water[1].aperture", "needs when_open = \"drains\""},
      {BED "[[water]]\nhead = 2\nhead_table = [[0, 2]]\n", 16, 14, "water[1].head_table", "has both head and head_table"},
      {BED "[[water]]\npressure_table = [[0, 2], [0, 3]]\n", 15, 0, "water[1].pressure_table[2]", "times must ascend"},
      {RUN "scheme = 'leapfrog'", 7, 10, "analysis.scheme", "must be \"auto\", \"implicit\" or \"explicit\""},
      {RUN "kinematics = 'medium'", 7, 14, "analysis.kinematics", "must be \"small\" or \"large\""},
      {RUN "rayleigh = {alpha = -1}", 7, 21, "analysis.rayleigh.alpha", "found -1, must be >= 0 (1/s)"},
      {RUN "rayleigh = {beta = 1, damping_ratio = 0.05, frequencies = [1, 10]}", 7, 12, "analysis.rayleigh", "give either alpha and beta, or damping_ratio and frequencies"},
      {RUN "rayleigh = {damping_ratio = 0.05}", 7, 12, "analysis.rayleigh.frequencies", "two frequencies (Hz)"},
      {RUN "rayleigh = {damping_ratio = 1, frequencies = [1, 10]}", 7, 29, "analysis.rayleigh.damping_ratio", "found 1, must be >= 0 and < 1 (of critical damping)"},
      {RUN "rayleigh = {damping_ratio = 0.05, frequencies = [1, 0]}", 7, 53, "analysis.rayleigh.frequencies[2]", "found 0, must be > 0 (Hz)"},
      {RUN "rayleigh = {damping_ratio = 0.05, frequencies = [1, 2, 3]}", 7, 49, "analysis.rayleigh.frequencies", "found 3, must be 2 (Hz)"},
      {RUN "time = 1", 7, 1, "analysis.time", "did you mean \"time_step\"?"},
      {ROCK "[solver]\ntolerance = 1", 7, 13, "solver.tolerance", "found 1, must be > 0 and < 1"},
      {ROCK "[solver]\nmax_iterations = -5", 7, 18, "solver.max_iterations", "must be an integer >= 1"},
      {ROCK "[output]\nevery = -1", 7, 9, "output.every", "found -1, must be an integer >= 0"},
      {ROCK "[support]\ntarget_factor_of_safety = 0", 7, 27, "support.target_factor_of_safety", "must be > 0"},
      {ROCK "[support]\nwater_pressure = -1", 7, 18, "support.water_pressure", "found -1, must be >= 0 (Pa)"},
      {ROCK "[support]\nseismic_coefficient = 0.1", 7, 23, "support.seismic_coefficient", "must be 3 numbers [x, y, z] (fraction of g)"},
      {ROCK "[support]\njoint_faces_only = 1", 7, 20, "support.joint_faces_only", "found 1, must be true or false"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongModel, TellsAllErrorsAtOnceByLine) {
  const auto errors = errors_of(R"(gravity = [0, 0, inf]
[[solid]]
name = "rock"
shape = "box"
min = [0, 0, 0]
max = [0, 4, -1]
material = "granite"
[[joint_set]]
dip = 95
dip_direction = "N"
spcing = 2
[cover]
lattice = "hex9"
spacing = -1
[[fixed]]
where = {face = "rock.zmin"}
components = ["u"]
[analysis]
kinematics = "lrge"
newmark = {beta = 0}
[contact]
name = "b"
)");
  std::vector<std::string> found;
  for (const auto& error : errors) found.push_back(std::to_string(error.place.line) + " " + error.place.key);
  const std::vector<std::string> expected{
      "1 gravity[3]",         "6 solid[1].max", "6 solid[1].max",       "7 solid[1].material",
      "9 joint_set[1].dip",   "10 joint_set[1].dip_direction",          "11 joint_set[1].spcing",
      "13 cover.lattice",     "14 cover.spacing",                       "17 fixed[1].components[1]",
      "19 analysis.kinematics", "20 analysis.newmark.beta",             "22 contact.name"};
  EXPECT_EQ(found, expected) << listed(errors);
}

TEST(WrongModel, OfManyErrorsSaysHowManyMore) {
  std::string text = ROCK;
  for (int i = 0; i < 2000; ++i) text += "[[joint]]\n";  // each lacks an orientation and a point
  const auto errors = errors_of(text);
  ASSERT_EQ(errors.size(), 1001u);
  EXPECT_EQ(errors.back().message, "and 3000 more errors");
}

}  // namespace
}  // namespace rockfold
