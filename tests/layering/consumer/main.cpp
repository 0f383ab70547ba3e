// A program outside the repository: cuts a unit cube in two with the installed libraries.
#include <cstdio>

#include "host/cut/cut.hpp"
#include "kernels/device/device.hpp"
#include "src/model/read/read_model.hpp"

constexpr char cube[] = R"(
title = "A cube in two"
[[material]]
name = "granite"
density = 2700.0
young_modulus = 30e9
poisson_ratio = 0.25
[[joint_material]]
name = "clean"
friction_angle = 35.0
[[solid]]
name = "rock"
operation = "add"
shape = "box"
min = [0, 0, 0]
max = [1, 1, 1]
material = "granite"
[[joint]]
name = "J"
dip = 30.0
dip_direction = 40.0
point = [0.5, 0.4, 0.6]
material = "clean"
)";

int main() {
  const rockfold::DeviceScope device(1);
  rockfold::Progress progress;
  const rockfold::Cutting cutting =
      rockfold::cut_blocks(rockfold::parse_model(cube, "cube"), progress);
  std::printf("%s: %d cells\n", rockfold::device_description().c_str(),
              static_cast<int>(cutting.totals.cells));
  return cutting.totals.cells == 2 ? 0 : 1;
}
