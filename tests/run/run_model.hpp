// A model as text, from reading to the answer, as the program does it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "host/bolting/bolt_elements.hpp"
#include "host/contact/lattice_surfaces.hpp"
#include "host/cover/cover.hpp"
#include "host/cover/points/joint_water.hpp"
#include "host/cover/points/loads.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/flatten.hpp"
#include "src/model/read/read_model.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

struct ModelAnswer {
  RunResult result;
  std::vector<Index> stored;  ///< steps of the stored states
  StoredState last;
};

/// Whom a run tells how far it is, and how it is gone on with.
struct RunHooks {
  Progress* progress = nullptr;
  Checkpoints checkpoints = {};
};

/// Throws what the parts of the program throw; `answer` then holds the states stored before. `change`: what no key of the text sets.
inline void run_model(const std::string& text, ModelAnswer& answer,
                      const std::function<void(Model&)>& change = {}, const RunHooks& hooks = {}) {
  Model model = parse_model(text, "m.toml", {}, Purpose::run);
  if (change) change(model);
  Progress silent;
  const Cutting cutting = cut_blocks(model, silent);
  const BlockArrays blocks = flatten_blocks(cutting, model);
  const Covering covering = build_covers(cutting, model, silent);
  const FixedPoints fixed = fixed_points(cutting, covering, model);
  const LoadPoints loads = load_points(cutting, covering, model);
  const QuietPoints quiet = quiet_points(cutting, covering, model);
  const auto velocities = rigid_velocities(covering, blocks.block_count(), model);
  std::vector<Vec3> points;
  for (const auto& monitor : model.monitors)
    if (monitor.is_of_rock()) points.push_back(monitor.point);
  const MaterialPoints monitors = locate_points(covering, points, Slivers::passed_over),
                       vertices = locate_block_vertices(covering, blocks);
  const auto store = [&](const StoredState& state) {
    answer.stored.push_back(state.step);
    answer.last = state;
  };
  RunInput input{model, covering.arrays, blocks,     fixed,   monitors,
                 loads, quiet,           velocities, vertices};
  ContactSurfaces contact;
  if (has_contact(model) && blocks.block_count() > 1) {
    contact.surfaces = contact_surfaces(cutting, blocks, covering.arrays, face_materials(model));
    contact.points =
        locate_surface(covering, contact.surfaces.vertex, contact.surfaces.vertex_block);
    input.contact = &contact;
  }
  const JointWater water(cutting, covering, blocks, model);
  if (input.contact && water.any()) input.water = &water;
  const BoltElements bolts = bolt_elements(cutting, covering, blocks, model);
  if (bolts.any()) input.bolts = &bolts;
  answer.result =
      run_analysis(input, store, hooks.progress ? *hooks.progress : silent, hooks.checkpoints);
}

inline ModelAnswer run_model(const std::string& text) {
  ModelAnswer answer;
  run_model(text, answer);
  return answer;
}

}  // namespace rockfold
