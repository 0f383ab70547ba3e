// Small models that are cut, searched for key blocks and bolted.
#pragma once

#include <string>

#include "host/bolting/bolting.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "host/keyblock/keyblock.hpp"
#include "src/base/progress.hpp"
#include "src/model/read/read_model.hpp"

namespace rockfold::test {

struct CutRock {
  Model model;
  BlockArrays blocks;
  KeyblockReport keyblocks;
};

inline CutRock cut_rock(const std::string& text) {
  CutRock rock;
  rock.model = parse_model(text, "m.toml", {}, Purpose::support);
  Progress progress;
  const Cutting cutting = cut_blocks(rock.model, progress);
  rock.blocks = flatten_blocks(cutting, rock.model);
  rock.keyblocks = find_keyblocks(rock.blocks, rock.model);
  return rock;
}

/// The roof of a room under rock of 27 kN/m³ (g = 10), with a tetrahedron of height 1 m over its middle: joints that dip 60°,
/// apex at (0, 0, 1), base an equilateral triangle of side 2 m at z = 0. W = 15.588 kN, V = √3/3, A = √3.
inline const std::string roof_wedge = R"(
gravity = [0, 0, -10]
[[material]]
name = "rock"
density = 2700
[[joint_material]]
name = "smooth"
friction_angle = 20
[[solid]]
name = "rock"
shape = "box"
min = [-6, -6, -3]
max = [6, 6, 6]
continues = ["xmin", "xmax", "ymin", "ymax", "zmin", "zmax"]
[[excavation]]
name = "room"
shape = "box"
min = [-4, -4, -2]
max = [4, 4, 0]
[[joint]]
name = "A"
dip = 60
dip_direction = 30
point = [0, 0, 1]
[[joint]]
name = "B"
dip = 60
dip_direction = 150
point = [0, 0, 1]
[[joint]]
name = "C"
dip = 60
dip_direction = 270
point = [0, 0, 1]
[support]
target_factor_of_safety = 2
)";

}  // namespace rockfold::test
