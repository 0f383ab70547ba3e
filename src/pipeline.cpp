#include "src/pipeline.hpp"

#include <algorithm>
#include <optional>

#include "host/cover/cover.hpp"
#include "host/cover/loads.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/face_polygons.hpp"
#include "host/flatten/flatten.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory.hpp"
#include "host/measure/measure.hpp"
#include "host/measure/parts.hpp"
#include "host/shapes/extents.hpp"
#include "kernels/device/device.hpp"
#include "src/answers.hpp"
#include "src/design_files.hpp"
#include "src/io/exports/export.hpp"
#include "src/memory.hpp"
#include "src/needs.hpp"
#include "src/output_path.hpp"
#include "src/results.hpp"
#include "src/rock_check.hpp"
#include "src/run/run_analysis.hpp"
#include "src/signals.hpp"
#include "src/support_design.hpp"
#include "src/threads.hpp"
#include "src/whole_model.hpp"

namespace rockfold {

namespace {

/// Covers over the cut rock, and the points of it that conditions, loads, monitors and results
/// refer to.
struct CoveredRock {
  Covering covering;
  FixedPoints fixed;
  MaterialPoints monitors, block_vertices;
  LoadPoints loads;
  QuietPoints quiet;
  std::vector<RigidVelocity> velocities;
  ElementMesh mesh;
};

CoveredRock cover_rock(const Cutting& cutting, const Model& model, const BlockArrays& blocks,
                       Progress& progress) {
  CoveredRock rock;
  rock.covering = build_covers(cutting, model, progress);
  rock.fixed = fixed_points(cutting, rock.covering, model);
  rock.monitors = locate_points(rock.covering, monitor_points(model), Slivers::passed_over);
  rock.loads = load_points(cutting, rock.covering, model);
  rock.quiet = quiet_points(cutting, rock.covering, model);
  rock.velocities = rigid_velocities(rock.covering, blocks.block_count(), model);
  rock.block_vertices = locate_block_vertices(rock.covering, blocks);
  rock.mesh = make_element_mesh(rock.covering.arrays);
  require_in_rock(model, rock.monitors);
  rock.covering.pieces.reset();  // all points are located
  return rock;
}

/// Steps through the analysis and stores its states. If it fails, the states so far are kept.
RunResult analyse(const CoveredRock& rock, const Model& model, const BlockArrays& blocks,
                  ResultWriter& writer, int threads, Terminal& terminal) {
  const RunInput input{
      model,      rock.covering.arrays, blocks,          rock.fixed,          rock.monitors,
      rock.loads, rock.quiet,           rock.velocities, rock.block_vertices, &rock.mesh};
  const auto store = [&](const StoredState& state) {
    add_stored_state(writer, rock.block_vertices, state);
  };
  const DeviceScope device(threads);
  try {
    return run_analysis(input, store, terminal);
  } catch (const Error& error) {
    keep_states(writer, error.kind(), terminal);
    throw;
  }
}

bool wants_export(const Options& options, ExportFormat format) {
  return std::any_of(options.exports.begin(), options.exports.end(),
                     [&](const auto& path) { return export_format(path) == format; });
}
/// Whether an export needs blocks as convex parts.
bool wants_parts(const Options& options) {
  return wants_export(options, ExportFormat::three_dec);
}

void write_exports(const Options& options, const Model& model, const Cutting& cutting,
                   const BlockArrays& blocks, const PolygonMesh& polygons) {
  PolygonMesh triangles;
  if (wants_export(options, ExportFormat::stl)) triangles = face_triangles(blocks);
  PartArrays parts;
  if (wants_parts(options)) parts = convex_parts(cutting, blocks);
  for (const auto& path : options.exports)
    export_blocks({blocks, polygons, triangles, parts, model.title}, path);
}

/// demo, cut, support, run: each is the same way, left earlier or later.
int analyse_rock(const Options& options, Terminal& terminal) {
  PhaseClock clock(terminal);
  const Model model = load_model(options, terminal);
  const std::string path = result_path(options);
  check_output_paths(options, model);

  Cutting cutting = clock.measure("cut", [&] { return cut_blocks(model, terminal); });
  return_free_memory();
  const BlockArrays blocks =
      clock.measure("cut", "joining blocks", [&] { return flatten_blocks(cutting, model); });
  warn_of_cutting(cutting.totals.intent, terminal);

  std::optional<RockMeasures> measures;
  if (wants_measures(options, model))
    measures = clock.measure("measure", "measuring blocks and joints",
                             [&] { return measure_rock(cutting, blocks, model); });
  if (measures) warn_of_flagged_blocks(measures->blocks, model, terminal);

  std::optional<KeyblockReport> keyblocks;
  std::optional<SupportDesign> design;
  if (wants_support(options, model)) {
    warn_of_immobile_blocks(blocks, terminal);
    keyblocks = clock.measure("keyblock", "finding key blocks",
                              [&] { return find_keyblocks(blocks, model); });
    design = clock.measure("support", "designing support", [&] {
      return design_support(blocks, *keyblocks, measures ? &*measures : nullptr, model);
    });
    warn_of_support_design(*design, terminal);
  }

  std::optional<CoveredRock> rock;
  if (wants_run(options)) {
    warn_of_missing_contact(model, blocks, terminal);
    warn_of_keys_without_use(model, terminal);
    warn_of_conditional_stability(model, terminal);
    rock = clock.measure("cover", [&] { return cover_rock(cutting, model, blocks, terminal); });
  }

  // From here on the flat arrays say all, but for those exports.
  if (!wants_parts(options)) cutting.complex.reset();
  return_free_memory();

  remember_interrupts();
  ResultWriter writer(path, model, result_header(options));
  PolygonMesh polygons;
  clock.measure("output", "writing blocks", [&] {
    polygons = face_polygons(blocks);
    BlockFields fields = keyblocks ? block_fields(*keyblocks) : BlockFields{};
    if (design && design->bolting) add_bolting(fields, *design->bolting);
    writer.write_blocks(blocks, polygons, fields,
                        measures ? measures->blocks.flags : std::vector<std::uint8_t>{});
  });

  if (design && !(model.drawings.empty() && model.tables.empty()))
    clock.measure("output", "writing drawings and tables",
                  [&] { write_design_files(blocks, *keyblocks, *design, model, path); });

  if (!options.exports.empty())
    clock.measure("output", "writing exports",
                  [&] { write_exports(options, model, cutting, blocks, polygons); });
  polygons = {};  // as large as the blocks, and states need it no more

  std::optional<RunResult> run;
  if (rock) {
    clock.measure("output", "writing elements",
                  [&] { writer.write_elements(rock->covering.arrays, rock->mesh); });
    run = analyse(*rock, model, blocks, writer, options.threads, terminal);
    writer.write_energies(run->energy_time, run->energies);
    add_run_seconds(clock, *run);
    warn_of_large_rotation(model, *run, terminal);
    warn_of_lost_energy(model, *run, terminal);
    warn_of_divided_steps(model, *run, terminal);
    warn_of_missing_factors(model, *run, terminal);
    if (!run->interrupted) warn_of_support_gap(model, *run, rock->fixed, terminal);
    warn_of_interruption(*run, model, terminal);
  }
  clock.measure("output", [&] { writer.finish(); });

  print_answer({options, model, cutting.totals, blocks, measures ? &*measures : nullptr,
                keyblocks ? &*keyblocks : nullptr, design ? &*design : nullptr,
                rock ? &rock->covering.arrays : nullptr, run ? &*run : nullptr, path},
               terminal, clock.seconds());
  return interrupted_status();
}

int check_model(const Options& options, Terminal& terminal) {
  const Model model = read_whole_model(options.input, options.overrides, Purpose::check);
  check_output_names(options, model);
  if (!model.solids.empty()) check_rock(model);
  warn_of_model(model, terminal);
  if (!model.solids.empty()) warn_of_joints_beside_rock(model, terminal);
  if (model.support) warn_of_free_rock(model, terminal);
  print_check(options, model, named_extents(model), terminal);
  return 0;
}

int tell_theory(const Options& options, Terminal& terminal) {
  PhaseClock clock(terminal);
  const Model model = load_model(options, terminal);
  const TheoryReport report = clock.measure("theory", "joint pyramids and their blocks",
                                            [&] { return joint_set_theory(model); });
  print_theory(options, model, report, terminal, clock.seconds());
  return 0;
}

int tell_info(const Options& options) {
  print_info(options, read_result_info(options.input));
  return 0;
}

}  // namespace

int run_command(const Options& options, Terminal& terminal) {
  exit_at_once_when_interrupted(options.json);
  use_threads(options.threads);
  switch (options.command) {
    case Command::check:
      return check_model(options, terminal);
    case Command::theory:
      return tell_theory(options, terminal);
    case Command::info:
      return tell_info(options);
    case Command::examples:
      return hand_out_examples(options);
    default:
      return analyse_rock(options, terminal);
  }
}

}  // namespace rockfold
