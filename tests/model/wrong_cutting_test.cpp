// Wrong shapes, finite and random joints, merges, excavations: where the error is found, what it is called and what it
// says.
#include "tests/model/model_errors.hpp"

// One case a line.
// clang-format off

namespace rockfold {
namespace {

// ROCK is 5 lines: what is added starts in line 6.
#define SOLID ROCK "[[solid]]\n"
#define PYRAMID SOLID "shape = 'pyramid'\n"
#define FRUSTUM SOLID "shape = 'frustum'\nbase = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]\n"
#define CYLINDER SOLID "shape = 'cylinder'\naxis = [[0, 0, 0], [0, 0, 5]]\n"
#define SPHERE SOLID "shape = 'sphere'\ncenter = [0, 0, 0]\n"
#define TUNNEL SOLID "shape = 'tunnel'\npath = [[0, 0, 0], [9, 0, 0]]\n"
#define SET ROCK "[[joint_set]]\ndip = 0\ndip_direction = 0\n"
#define RANDOM SET "radius = 1\n[joint_set.random]\n"
#define JOINT ROCK "[[joint]]\nnormal = [0, 0, 1]\npoint = [1, 1, 1]\n"
#define POLYGON ROCK "[[joint]]\nnormal = [0, 0, 1]\n"
#define MERGE ROCK "[[merge]]\n"
#define BOX "shape = 'box'\nmin = [0, 0, 0]\nmax = [1, 1, 1]\n"

TEST(WrongCutting, OfBasedShapes) {
  const Wrong cases[] = {
      {PYRAMID "apex = [0, 0, 1]", 6, 1, "solid[2].base", "is missing, must be 3 or more points"},
      {PYRAMID "base = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]", 6, 1, "solid[2].apex", "is missing, must be 3 numbers"},
      {PYRAMID "base = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\napex = [5, 5, 0]", 9, 8, "solid[2].apex", "lies in the plane of the base"},
      {PYRAMID "base = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\napex = [5, 5, 1]\ncontinues = ['cap1']", 10, 14, "solid[2].continues[1]", "unknown face \"cap1\", did you mean \"cap0\"?"},
      {FRUSTUM, 6, 1, "solid[2].top", "is missing"},
      {FRUSTUM "top = [[1, 1, 2], [3, 1, 2], [2, 3, 2]]", 9, 7, "solid[2].top", "has 3 points, must have as many as base: 4"},
      {FRUSTUM "top = [[1, 1, 2], [3, 1, 2], [3, 3, 2], [2, 1.5, 2]]", 9, 7, "solid[2].top", "is concave, must be convex"},
      {FRUSTUM "top = [[1, 1, 2], [3, 1, 2], [3.5, 3, 2], [1, 3, 2]]", 9, 7, "solid[2].top", "side 1 (points 2 and 3 of base and top) is not planar"},
      {FRUSTUM "top = [[3, 3, 2], [1, 3, 2], [1, 1, 2], [3, 1, 2]]", 9, 7, "solid[2].top", "has corners on both sides of it: list the top's points in the order of the base's"},
      {FRUSTUM "top = [[1, 1, -1], [3, 1, -1], [3, 3, 3], [1, 3, 3]]", 9, 7, "solid[2].top", "meets the plane of the base"},
      {FRUSTUM "top = [[1, 1, 0], [3, 1, 0], [3, 3, 0], [1, 3, 0]]", 9, 7, "solid[2].top", "meets the plane of the base"},
      {SOLID "operation = '-'\n" BOX "interface = 'weld'\n[[joint_material]]\nname = 'weld'\nfriction_angle = 5", 11, 13, "solid[2].interface", "belongs to rock that is added"},
      {SOLID BOX "interface = 'weld'", 10, 13, "solid[2].interface", "unknown joint material \"weld\"; the model has no [[joint_material]]"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongCutting, OfRoundShapes) {
  const Wrong cases[] = {
      {CYLINDER, 6, 1, "solid[2].radius", "is missing, must be > 0 (m)"},
      {CYLINDER "radius = -1", 9, 10, "solid[2].radius", "found -1, must be > 0 (m)"},
      {CYLINDER "radius = 1\nsides = 2", 10, 9, "solid[2].sides", "found 2, must be an integer, 3 to 1000"},
      {SOLID "shape = 'cylinder'\nradius = 1", 6, 1, "solid[2].axis", "is missing, must be 2 points"},
      {SOLID "shape = 'cylinder'\nradius = 1\naxis = [[0, 0, 0]]", 9, 8, "solid[2].axis", "found an array of 1 value, must be 2 points"},
      {SOLID "shape = 'cylinder'\nradius = 1\naxis = [[0, 0, 0], [0, 0, 0]]", 9, 8, "solid[2].axis", "its two points are equal"},
      {SPHERE "radius = 0", 9, 10, "solid[2].radius", "found 0, must be > 0"},
      {SPHERE "radius = 1\nsubdivisions = 8", 10, 16, "solid[2].subdivisions", "found 8, must be an integer, 0 to 7"},
      {SPHERE "radius = 1\ncentre = [0, 0, 0]", 10, 1, "solid[2].centre", "did you mean \"center\"?"},
      {SOLID "shape = 'tunnel'\nsection = 'circle'\nradius = 1", 6, 1, "solid[2].path", "is missing, must be 2 or more points"},
      {SOLID "shape = 'tunnel'\nsection = 'circle'\nradius = 1\npath = [[0, 0, 0]]", 10, 8, "solid[2].path", "must be 2 or more points"},
      {SOLID "shape = 'tunnel'\nsection = 'circle'\nradius = 1\npath = [[0, 0, 0], [1, 0, 0], [1, 0, 0]]", 10, 8, "solid[2].path", "points 2 and 3 are equal"},
      {SOLID "shape = 'tunnel'\nsection = 'circle'\nradius = 1\npath = [[0, 0, 0], [5, 0, 0], [1, 0, 0]]", 10, 8, "solid[2].path", "turns straight back at point 2"},
      {TUNNEL, 6, 1, "solid[2].section", "is missing, must be \"circle\", \"horseshoe\""},
      {TUNNEL "section = 'horse'", 9, 11, "solid[2].section", "did you mean \"horseshoe\"?"},
      {TUNNEL "section = 3", 9, 11, "solid[2].section", "found 3, must be"},
      {TUNNEL "section = 'circle'", 6, 1, "solid[2].radius", "is missing"},
      {TUNNEL "section = 'circle'\nradius = 1\nwidth = 2", 11, 1, "solid[2].width", "unknown key \"width\""},
      {TUNNEL "section = 'rectangle'\nwidth = 2", 6, 1, "solid[2].height", "is missing, must be > 0 (m)"},
      {TUNNEL "section = 'rectangle'\nwidth = 2\nheight = 2\nsides = 4", 12, 1, "solid[2].sides", "unknown key \"sides\""},
      {TUNNEL "section = 'd_shape'\nwidth = 4\nheight = 1.5", 11, 10, "solid[2].height", "found 1.5, must be at least half the width (2.0 m)"},
      {TUNNEL "section = 'horseshoe'\nwidth = 2\nheight = 3", 11, 10, "solid[2].height", "where the walls of this horseshoe meet"},
      {TUNNEL "section = 'horseshoe'\nwidth = 2\nradius = 1", 10, 9, "solid[2].width", "give either radius (half the width) or width"},
      {TUNNEL "section = 'horseshoe'", 6, 1, "solid[2].width", "is missing: give width and height, or radius (m)"},
      {TUNNEL "section = 'd_shape'\nheight = 2", 6, 1, "solid[2].width", "is missing, must be > 0 (m)"},
      {TUNNEL "section = [[0, 0], [1, 0]]", 9, 11, "solid[2].section", "must be 3 or more points [u, v]"},
      {TUNNEL "section = [[0, 0], [1, 0], [1, 1, 1]]", 9, 28, "solid[2].section[3]", "found an array of 3 values, must be 2 numbers [u, v] (m)"},
      {TUNNEL "section = [[0, 0], [1, nan], [1, 1]]", 9, 24, "solid[2].section[2][2]", "found nan, must be a finite number"},
      {TUNNEL "section = [[0, 0], [1, 0], [2, 0], [0, 1]]", 9, 11, "solid[2].section", "points 1, 2 and 3 are collinear"},
      {SOLID "shape = 'mesh'", 6, 1, "solid[2].file", "is missing, must be a text in quotes"},
      {SOLID "shape = 'mesh'\nfile = 'no.stl'", 8, 8, "solid[2].file", "there is no file \"no.stl\"; names are relative to the model's folder"},
      {SOLID "shape = 'terrain'\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'", 6, 1, "solid[2].base", "is missing, must be a number (m)"},
      {SOLID "shape = 'terrain'\nbase = 0\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'\ncolumns = ['x', 'y']", 10, 11, "solid[2].columns", "3 names of columns"},
      {SOLID "shape = 'terrain'\nbase = 0\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'\ncolumns = ['x', 'y', 3]", 10, 22, "solid[2].columns[3]", ""},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongCutting, OfFiniteJoints) {
  const Wrong cases[] = {
      {JOINT "radius = 0", 9, 10, "joint[1].radius", "found 0, must be > 0 (m)"},
      {JOINT "radius = 1\nsides = 1001", 10, 9, "joint[1].sides", "found 1001, must be an integer, 3 to 1000"},
      {JOINT "sides = 8", 9, 9, "joint[1].sides", "belongs to discs, but there is no radius"},
      {JOINT "within = 'rok'", 9, 10, "joint[1].within", "unknown solid \"rok\", did you mean \"rock\"?"},
      {POLYGON "polygon = [[0, 0, 0], [1, 0, 0]]", 8, 11, "joint[1].polygon", "must be 3 or more points"},
      {POLYGON "polygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nradius = 2", 9, 10, "joint[1].radius", "either a radius or a polygon, not both"},
      {POLYGON "polygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\nsides = 8", 9, 9, "joint[1].sides", "this joint is a polygon"},
      {POLYGON "polygon = [[0, 0, 0], [1, 0, 1], [1, 0, 5]]", 8, 11, "joint[1].polygon", "no area on the joint's plane"},
      {POLYGON "polygon = [[0, 0, 0], [1, 0, 1], [2, 0, 5], [1, 1, 0]]", 8, 11, "joint[1].polygon", "points 1, 2 and 3 are collinear"},
      {POLYGON "polygon = [[0, 0, 0], [3, 2, 0], [3, 0, 0], [0, 1, 0]]", 8, 11, "joint[1].polygon", "the edges cross or touch"},
      {ROCK "[[joint]]\npolygon = [[0, 0, 0], [1, 0, 0], [1, 1, 0.5], [0, 1, 0]]", 7, 11, "joint[1].polygon", "is not in one plane with the others"},
      {ROCK "[[joint]]\npolygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\npoint = [0, 0, 1]", 8, 9, "joint[1].point", "is not in the plane of the polygon"},
      {ROCK "[[joint]]\npolygon = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]\ndip = 4", 6, 1, "joint[1].dip_direction", "is missing"},
      {SET "spacing = 1\nradius = -2", 10, 10, "joint_set[1].radius", "found -2, must be > 0 (m)"},
      {SET "spacing = 1\nsides = 8", 10, 9, "joint_set[1].sides", "belongs to discs, but there is no radius"},
      {SET "spacing = 1\nwithin = 3", 10, 10, "joint_set[1].within", "found 3, must be a text in quotes"},
      {ROCK "[[joint_mesh]]\n", 6, 1, "joint_mesh[1].file", "is missing"},
      {ROCK "[[joint_mesh]]\nname = 'f'\nfile = 'f.obj'", 8, 8, "joint_mesh[1].file", "there is no file \"f.obj\"; names are relative to the model's folder (in \"f\")"},
      {ROCK "[[joint_mesh]]\nflatness = 45\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'", 7, 12, "joint_mesh[1].flatness", "found 45, must be >= 0 and < 45 (deg)"},
      {ROCK "[[joint_mesh]]\nflatness = -1\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'", 7, 12, "joint_mesh[1].flatness", "found -1, must be >= 0 and < 45 (deg)"},
      {ROCK "[[joint_table]]\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'\nextents = 'none'\n", 8, 11, "joint_table[1].extents", "must be \"from_columns\" or \"through_going\""},
      {ROCK "[[joint_table]]\nfile = '.'\n", 7, 8, "joint_table[1].file", "is a folder, must be a file"},
      {ROCK "[[joint_table]]\nfile = \"a\\u0000b\"\n", 7, 8, "joint_table[1].file", "must be the name of a file"},
      {JOINT "name = 'F'\n[[joint_mesh]]\nname = 'F'\nfile = '" ROCKFOLD_SOURCE_DIR "/LICENSE'", 11, 8, "joint_mesh[1].name", "already the name of joint[1] (line 6)"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongCutting, OfRandomSets) {
  const Wrong cases[] = {
      {SET "random = 3", 9, 10, "joint_set[1].random", "found 3, must be a table of keys"},
      {SET "spacing = 1\n[joint_set.random]\nspacing = 2", 9, 11, "joint_set[1].spacing", "leave this one out"},
      {SET "count = 1\nradius = 2\n[joint_set.random]\ncount = 2", 9, 9, "joint_set[1].count", "[joint_set.random] has no spacing"},
      {SET "count = 0\n[joint_set.random]\nspacing = 2", 9, 9, "joint_set[1].count", "found 0, must be an integer >= 1"},
      {SET "[joint_set.random]\nspacing = 2\ncount = 3", 11, 9, "joint_set[1].random.count", "the count of joints at random spacings stands in the set itself"},
      {SET "[joint_set.random]\np32 = 1", 10, 7, "joint_set[1].random.p32", "needs a radius"},
      {RANDOM, 10, 1, "joint_set[1].random", "must have one of spacing, p32, p10 or count"},
      {RANDOM "p23 = 1", 11, 1, "joint_set[1].random.p23", "did you mean \"p32\"?"},
      {RANDOM "p32 = 0", 11, 7, "joint_set[1].random.p32", "found 0, must be > 0 (m2/m3)"},
      {RANDOM "p32 = 1\nspacing = 2", 11, 7, "joint_set[1].random.p32", "has both spacing and p32, must have one of"},
      {RANDOM "p10 = 1", 10, 1, "joint_set[1].random.scanline", "is missing, must be 2 points [[x, y, z], [x, y, z]] (m) for p10"},
      {RANDOM "p10 = 1\nscanline = [[0, 0, 0], [0, 0, 0]]", 12, 12, "joint_set[1].random.scanline", "its two points are equal"},
      {RANDOM "p32 = 1\nscanline = [[0, 0, 0], [1, 0, 0]]", 12, 12, "joint_set[1].random.scanline", "belongs to p10, which is not given"},
      {RANDOM "count = 0", 11, 9, "joint_set[1].random.count", "found 0, must be an integer >= 1"},
      {RANDOM "count = 5\nlocation = 'regular'", 12, 12, "joint_set[1].random.location", "found \"regular\", must be \"uniform\""},
      {RANDOM "spacing = 5\nlocation = 'uniform'", 12, 12, "joint_set[1].random.location", "belongs to p32, p10 and count"},
      {RANDOM "count = 5\nseed = -1", 12, 8, "joint_set[1].random.seed", "found -1, must be an integer >= 0"},
      {RANDOM "count = 5\nfisher_kappa = 0", 12, 16, "joint_set[1].random.fisher_kappa", "found 0, must be > 0"},
      {RANDOM "count = 5\nradius = '2'", 12, 10, "joint_set[1].random.radius", "found \"2\", must be a number (m) or a table {distribution, mean, …}"},
      {RANDOM "count = 5\nradius = 0", 12, 10, "joint_set[1].random.radius", "found 0, must be > 0 (m)"},
      {RANDOM "spacing = {mean = 2}", 11, 11, "joint_set[1].random.spacing.distribution", "is missing, must be \"constant\", \"exponential\""},
      {RANDOM "spacing = {distribution = 'lognormal', mean = 2}", 11, 27, "joint_set[1].random.spacing.distribution", "did you mean \"log_normal\"?"},
      {RANDOM "spacing = {distribution = 'exponential'}", 11, 11, "joint_set[1].random.spacing.mean", "is missing, must be > 0 (m)"},
      {RANDOM "spacing = {distribution = 'constant', mean = 2, max = 3}", 11, 49, "joint_set[1].random.spacing.max", "unknown key \"max\""},
      {RANDOM "spacing = {distribution = 'log_normal', mean = 2}", 11, 11, "joint_set[1].random.spacing.standard_deviation", "is missing, must be > 0 (m)"},
      {RANDOM "spacing = {distribution = 'power_law', exponent = 2, max = 4}", 11, 11, "joint_set[1].random.spacing.min", "is missing, must be > 0 (m)"},
      {RANDOM "spacing = {distribution = 'power_law', exponent = 2, min = 0, max = 4}", 11, 60, "joint_set[1].random.spacing.min", "found 0, must be > 0 (m)"},
      {RANDOM "spacing = {distribution = 'power_law', exponent = 2, min = 4, max = 4}", 11, 69, "joint_set[1].random.spacing.max", "found 4.0, must be > min's 4.0 (m)"},
      {RANDOM "spacing = {distribution = 'exponential', mean = 1, min = 20}", 11, 58, "joint_set[1].random.spacing.min", "less than 0.001 of the distribution's values lie between min and max"},
      {RANDOM "spacing = {distribution = 'log_normal', mean = 9, standard_deviation = 1, max = 2}", 11, 81, "joint_set[1].random.spacing.max", "less than 0.001"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

TEST(WrongCutting, OfMergesExcavationsAndLimits) {
  const Wrong cases[] = {
      {MERGE, 6, 1, "merge[1]", "says no region, must have one of box, solid or points"},
      {MERGE "box = [[0, 0, 0], [1, 1, 1]]\nsolid = 'rock'", 8, 9, "merge[1].solid", "has both box and solid"},
      {MERGE "box = [[0, 0, 0], [1, 0, 1]]", 7, 7, "merge[1].box", "y = 0.0 is not under the second's 0.0"},
      {MERGE "box = [0, 0, 0]", 7, 7, "merge[1].box", "must be 2 corners"},
      {MERGE "solid = 'rok'", 7, 9, "merge[1].solid", "unknown solid \"rok\", did you mean \"rock\"?"},
      {MERGE "points = [[0, 0, 0]]", 7, 10, "merge[1].points", "must be 2 or more points"},
      {ROCK "[[excavation]]\nstage = 0\n" BOX, 7, 9, "excavation[1].stage", "found 0, must be an integer >= 1"},
      {ROCK "[[excavation]]\nname = 'rock'\n" BOX, 7, 8, "excavation[1].name", "\"rock\" is already the name of solid[1]"},
      {ROCK "[[excavation]]\nname = 'a'\n" BOX "[[excavation]]\nname = 'a'\n" BOX, 12, 8, "excavation[2].name", "already the name of excavation[1] (line 6)"},
      {ROCK "[[excavation]]\nstage = 1", 6, 1, "excavation[1].shape", "is missing, must be \"box\""},
      {ROCK "[[excavation]]\nmaterial = 'a'\n" BOX, 7, 1, "excavation[1].material", "unknown key \"material\"; the keys here are: name, stage, shape, min, max"},
      {ROCK "[cut]\nmax_cells = 0", 7, 13, "cut.max_cells", "found 0, must be an integer, 1 to 2000000000"},
      {ROCK "[cut]\nmax_cells = 1e6", 7, 13, "cut.max_cells", "must be an integer, 1 to 2000000000"},
      {ROCK "[cut]\nmin_volume = 0", 7, 14, "cut.min_volume", "found 0, must be > 0 (m3)"},
      {ROCK "[cut]\nspecks = 'delete'", 7, 10, "cut.specks", "found \"delete\", must be \"keep\" or \"merge\""},
      {ROCK "[cut]\nmax_aspect_ratio = 0.5", 7, 20, "cut.max_aspect_ratio", "found 0.5, must be >= 1"},
      {ROCK "[[scanline]]\nfrom = [0, 0, 0]", 6, 1, "scanline[1].to", "is missing"},
      {ROCK "[[scanline]]\nfrom = [0, 0, 0]\nto = [0, 0, 0]", 8, 6, "scanline[1].to", "is the point from"},
  };
  for (const auto& wrong : cases) expect_error(wrong);
}

}  // namespace
}  // namespace rockfold
