#include "perf/shared/moving_rock.hpp"

#include <ctime>
#include <vector>

#include <fmt/format.h>

#include "host/bolting/bolt_elements.hpp"
#include "host/contact/lattice_surfaces.hpp"
#include "host/cover/cover.hpp"
#include "host/cover/points/joint_water.hpp"
#include "host/cover/points/loads.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "src/base/timer.hpp"
#include "src/model/read/read_model.hpp"

namespace rockfold {

MovingRock run_moving_rock(const std::string& text, Index from) {
  MovingRock answer;
  const Model model = parse_model(text, "benchmark.toml", {}, Purpose::run);
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  const BlockArrays blocks = flatten_blocks(cutting, model);
  const Covering covering = build_covers(cutting, model, silent);
  const FixedPoints fixed = fixed_points(cutting, covering, model);
  const LoadPoints loads;
  const QuietPoints quiet;
  const std::vector<RigidVelocity> velocities;
  const MaterialPoints monitors, vertices = locate_block_vertices(covering, blocks);
  ContactSurfaces contact;
  contact.surfaces = contact_surfaces(cutting, blocks, covering.arrays);
  contact.points = locate_surface(covering, contact.surfaces.vertex, contact.surfaces.vertex_block);
  RunInput input{model, covering.arrays, blocks,     fixed,   monitors,
                 loads, quiet,           velocities, vertices};
  input.contact = &contact;
  const JointWater water(cutting, covering, blocks, model);
  if (water.any()) input.water = &water;
  const BoltElements bolts = bolt_elements(cutting, covering, blocks, model);
  if (bolts.any()) input.bolts = &bolts;
  Timer timer;
  std::clock_t start = std::clock();
  const auto store = [&](const StoredState& state) {
    if (state.step != from) return;
    timer = Timer();
    start = std::clock();
  };
  answer.result = run_analysis(input, store, silent);
  answer.seconds = timer.seconds();
  answer.processor = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  answer.blocks = blocks.block_count();
  return answer;
}

std::string jointed_slope(Real friction, Index steps, const std::string& then) {
  constexpr const char* sets[] = {"dip = 32\ndip_direction = 80", "dip = 75\ndip_direction = 10",
                                  "dip = 70\ndip_direction = 265"};
  std::string text = fmt::format(
      "[[material]]\ndensity = 2600\nyoung_modulus = 1e10\npoisson_ratio = 0.25\n"
      "[[joint_material]]\nname = 'clean'\nfriction_angle = {}\nnormal_stiffness = 1e10\n"
      "shear_stiffness = 5e9\n"
      "[[solid]]\nname = 'slope'\nshape = 'prism'\nbase = [[0, 0, 0], [60, 0, 0], [60, 0, 10], "
      "[40, 0, 10], [28, 0, 34], [0, 0, 34]]\nextrude = [0, 24, 0]\n"
      "continues = ['0', '1', '5', 'cap0', 'cap1']\n"
      "[cover]\nlattice = 'block'\n[[fixed]]\nwhere = {{face = 'slope.5'}}\n"
      "[[fixed]]\nwhere = {{face = 'slope.0'}}\n"
      "[[step]]\ntype = 'quasi_static'\ntime_step = 0.01\nsteps = {}\n"
      "[[step]]\nname = 'then'\ntype = 'dynamic'\n{}\n[output]\nevery = {}\n",
      friction, steps, then, steps);
  for (const char* set : sets)
    text += fmt::format("[[joint_set]]\n{}\nspacing = 4\nmaterial = 'clean'\n", set);
  return text;
}

}  // namespace rockfold
