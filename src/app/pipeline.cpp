#include "src/app/pipeline.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>
#include <unistd.h>

#include "host/bolting/bolt_elements.hpp"
#include "host/contact/lattice_surfaces.hpp"
#include "host/cover/cover.hpp"
#include "host/cover/points/joint_water.hpp"
#include "host/cover/points/loads.hpp"
#include "host/cut/cut.hpp"
#include "host/flatten/face_polygons.hpp"
#include "host/flatten/flatten.hpp"
#include "host/keyblock/first_look.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory/theory.hpp"
#include "host/measure/measure.hpp"
#include "host/measure/parts.hpp"
#include "host/shapes/extents.hpp"
#include "kernels/device/device.hpp"
#include "src/app/answers.hpp"
#include "src/app/certificates.hpp"
#include "src/app/estimate.hpp"
#include "src/app/help_text.hpp"
#include "src/app/joint_sets.hpp"
#include "src/app/process/limits.hpp"
#include "src/app/process/memory.hpp"
#include "src/app/process/signals.hpp"
#include "src/app/process/threads.hpp"
#include "src/app/support_design.hpp"
#include "src/check/contact_needs.hpp"
#include "src/check/contact_steps.hpp"
#include "src/check/held_rock.hpp"
#include "src/check/key_use.hpp"
#include "src/check/needs.hpp"
#include "src/check/opposed_supports.hpp"
#include "src/check/record_check.hpp"
#include "src/check/rock_check.hpp"
#include "src/check/whole_model.hpp"
#include "src/io/exports/export.hpp"
#include "src/model/jointed.hpp"
#include "src/model/openings.hpp"
#include "src/page/write_page.hpp"
#include "src/printed/printed_report.hpp"
#include "src/report/summaries/summary.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/reduction.hpp"
#include "src/run/run_analysis.hpp"
#include "src/store/design_files.hpp"
#include "src/store/histories.hpp"
#include "src/store/output_path.hpp"
#include "src/store/results.hpp"
#include "src/store/resume.hpp"
#include "src/sweep/sweep.hpp"

namespace fs = std::filesystem;

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
  std::optional<ContactSurfaces> contact;
  std::unique_ptr<JointWater> water;  ///< in the joints between blocks
  BoltElements bolts;
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
  if (has_contact(model) && blocks.block_count() > 1) {
    SurfaceArrays surfaces =
        contact_surfaces(cutting, blocks, rock.covering.arrays, face_materials(model));
    MaterialPoints points = locate_surface(rock.covering, surfaces.vertex, surfaces.vertex_block);
    rock.contact = ContactSurfaces{std::move(surfaces), std::move(points)};
    auto water = std::make_unique<JointWater>(cutting, rock.covering, blocks, model);
    if (water->any()) rock.water = std::move(water);
  }
  rock.bolts = bolt_elements(cutting, rock.covering, blocks, model);
  rock.mesh = make_element_mesh(rock.covering.arrays);
  require_in_rock(model, rock.monitors);
  rock.covering.pieces.reset();  // all points are located
  return rock;
}

struct Analysed {
  std::optional<RunResult> run;  ///< none: a signal ended the search for a reduction before it
  std::unique_ptr<RunJournal> journal;  ///< until the result is whole
  std::optional<Reduction> reduction;   ///< where the model asks for one
};

/// By how much the joints' strength may be divided, as found now or before the run that is gone on with.
Reduction reduce_strength(const RunInput& input, const Resumption* resumption, Terminal& terminal) {
  if (resumption && !resumption->journal.origin.search.empty())
    return unpacked_reduction(resumption->journal.origin.search);
  return find_reduction(input, terminal);
}

/// Steps through the analysis and stores its states, if there is a writer. If it fails, the states so far are kept.
Analysed analyse(const CoveredRock& rock, const Model& model, const BlockArrays& blocks,
                 ResultWriter* writer, const Options& options, const Resumption* resumption,
                 Probe* probe, Terminal& terminal) {
  Model weakened;  // the model itself but where a reduction has been found
  const auto input_of = [&](const Model& of) {
    return RunInput{of,
                    rock.covering.arrays,
                    blocks,
                    rock.fixed,
                    rock.monitors,
                    rock.loads,
                    rock.quiet,
                    rock.velocities,
                    rock.block_vertices,
                    &rock.mesh,
                    rock.contact ? &*rock.contact : nullptr,
                    rock.water.get(),
                    rock.bolts.any() ? &rock.bolts : nullptr};
  };
  const DeviceScope device(options.threads);
  std::optional<Reduction> reduction;
  if (model.reduction && !probe) {
    reduction = reduce_strength(input_of(model), resumption, terminal);
    if (reduction->interrupted) return {{}, nullptr, reduction};
    weakened = model;
    weakened.joint_materials = with_strength_divided(model.joint_materials, reduction->shown());
  }
  const RunInput input = input_of(reduction ? weakened : model);
  if (!writer)
    return {run_analysis(
                input, [](const auto&) {}, terminal),
            nullptr, reduction};
  const StoreState show = [&](const StoredState& state) {
    add_stored_state(*writer, rock.block_vertices, state);
  };
  auto journal = open_journal(options, model, writer->path(), resumption, show,
                              reduction ? packed(*reduction) : std::vector<std::byte>{});
  const StoreState store = [&](const StoredState& state) {
    journal->add_state(state.step, state.motion.time, hash_of(state), packed(state));
    show(state);
  };
  try {
    const Checkpoints checkpoints = checkpoints_in(*journal, model, resumption);
    if (probe)
      return {run_analysis(input, store, terminal, {}, probe->watch()), std::move(journal), {}};
    return {run_analysis(input, store, terminal, checkpoints), std::move(journal), reduction};
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::usage) throw;  // what is there is as it was
    keep_states(*writer, error.kind(), terminal);
    if (error.kind() != ErrorKind::io) journal->remove();  // it would fail again
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
                   const BlockArrays& blocks, const PolygonMesh& polygons,
                   const BlockFields& fields) {
  PolygonMesh triangles;
  if (wants_export(options, ExportFormat::stl) || wants_export(options, ExportFormat::vtp))
    triangles = face_triangles(blocks);
  PartArrays parts;
  if (wants_parts(options)) parts = convex_parts(cutting, blocks);
  for (const auto& path : options.exports)
    export_blocks({blocks, polygons, triangles, parts, model.title,
                   fields.block_class.empty() ? nullptr : &fields},
                  path);
}

/// Where a run was interrupted within letting go what a step excavates; "" elsewhere.
std::string settling_place(const RunResult& run, const Model& model) {
  if (!run.settling) return "";
  const AnalysisStage& stage = model.analysis->stages[run.settling->stage];
  return fmt::format(
      ", and {} quasi-static steps in which stage {} is let go before \"{}\" goes on",
      run.settling->steps, stage.excavate, stage.name);
}

/// The limit that ended the run, if one did.
std::optional<Error> limit_met(const RunResult& run, const Model& model, const Options& options,
                               const std::string& path) {
  if (!run.interrupted) return {};
  return stop_error(
      fmt::format("stopped after {} of {} steps, t = {:.6g} s{}; {}", run.steps,
                  model.analysis->steps(), run.time, settling_place(run, model),
                  options.no_result
                      ? "nothing is stored (--no-result)"
                      : fmt::format("{} holds the states so far, and `rockfold resume {}` goes on",
                                    path, path)));
}

/// Of a search for a reduction that a signal or a limit ended: what it knows so far, since nothing is stored. Returns the exit status.
int end_search(const Options& options, const Model& model, const Reduction& reduction,
               Terminal& terminal) {
  const std::string known = fmt::format(
      "in the search for the factor of [reduction], {}; no result is stored",
      reduction.trials.empty() ? "before its first trial" : "which " + bounds_text(reduction));
  const auto limit = stop_error("stopped " + known);
  if (!limit) terminal.warn("interrupted " + known);
  print_search(options, model, reduction, limit, terminal);
  return interrupted_status();
}

/// How many blocks a model may have without a question: any where the user has said that they are meant.
Real most_blocks(const Options& options, const Model& model) {
  const bool given = !model.cut.place_of_max_cells.file.empty();
  return options.yes || given ? any_number_of_blocks : blocks_without_asking;
}

/// Of `support`, beside key blocks, where the mass is small enough. That it is not found is no reason to lose the key blocks.
std::optional<StabilityReport> whole_mass_beside(const Cutting& cutting, const BlockArrays& blocks,
                                                 const Model& model, PhaseClock& clock,
                                                 Terminal& terminal) {
  const Index count = moving_block_count(blocks, model);
  if (count == 0 || count > most_blocks_beside_keys) return std::nullopt;
  try {
    return clock.measure("stability", "the whole mass",
                         [&] { return find_stability(cutting, blocks, model, terminal); });
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::analysis) throw;
    terminal.warn(fmt::format("the whole mass was not looked at: {}", error.what()));
    return std::nullopt;
  }
}

/// demo, cut, support, run: each is the same way, left earlier or later.
int analyse_rock(const Options& options, Terminal& terminal, const Resumption* resumption = nullptr,
                 Probe* probe = nullptr) {
  PhaseClock clock(terminal);
  std::optional<DeviceScope> device;
  Model read = load_model(options, terminal);
  if (probe) probe->shorten(read);
  const Model model = std::move(read);
  if (resumption) require_same_inputs(resumption->journal.origin, model);
  const std::string path = result_path(options);
  check_output_paths(options, model);
  if (!options.no_result) require_states_replaced_knowingly(options, path);
  if (!options.no_result && !resumption && wants_run(options))
    if (const std::string lost = unfinished_run(path); !lost.empty()) terminal.warn(lost);

  Cutting cutting = clock.measure("cut", [&] {
    return cut_blocks(model, terminal,
                      resumption ? any_number_of_blocks : most_blocks(options, model));
  });
  return_free_memory();
  const BlockArrays blocks =
      clock.measure("cut", "joining blocks", [&] { return flatten_blocks(cutting, model); });
  warn_of_cutting(cutting.totals.intent, terminal);
  require_whole_contact(blocks, model);

  std::optional<RockMeasures> measures;
  if (wants_measures(options, model))
    measures = clock.measure("measure", "measuring blocks and joints",
                             [&] { return measure_rock(cutting, blocks, model); });
  if (measures) warn_of_flagged_blocks(measures->blocks, model, terminal);

  std::optional<KeyblockReport> keyblocks;
  std::optional<SupportDesign> design;
  if (wants_support(options, model)) {
    warn_of_immobile_blocks(blocks, terminal);
    std::optional<JointStressReport> stress;
    if (has_elastic_joint_stress(model)) {
      device.emplace(options.threads);
      stress = clock.measure("stress", "in-situ stress round openings",
                             [&] { return find_joint_stress(blocks, model, terminal); });
    }
    for (const std::string& text :
         joint_stress_warnings(blocks, model, stress ? &*stress : nullptr))
      terminal.warn(text);
    keyblocks = clock.measure("keyblock", "finding key blocks", [&] {
      return find_keyblocks(blocks, model, stress ? &stress->tractions : nullptr);
    });
    warn_of_thin_contacts(*keyblocks, terminal);
    design = clock.measure("support", "designing support", [&] {
      return design_support(blocks, *keyblocks, measures ? &*measures : nullptr, model);
    });
    warn_of_support_design(*design, terminal);
    if (design->bolting)
      clock.measure("support", "looking behind key blocks", [&] {
        warn_of_anchors_that_move(blocks, *keyblocks, *design->bolting, model,
                                  stress ? &stress->tractions : nullptr, terminal);
      });
    design->joint_stress = std::move(stress);
  }

  std::optional<StabilityReport> stability;
  if (options.command == Command::support) {
    stability = whole_mass_beside(cutting, blocks, model, clock, terminal);
  } else if (options.command == Command::stability) {
    stability = clock.measure("stability", "the whole mass",
                              [&] { return find_stability(cutting, blocks, model, terminal); });
    warn_of_partly_held(*stability, terminal);
    if (!options.certificate.empty())
      clock.measure("output", "writing the certificate",
                    [&] { write_certificate(options.certificate, *stability, terminal); });
  }

  std::optional<CoveredRock> rock;
  if (wants_run(options)) {
    check_contact(model, blocks, terminal);
    warn_of_contact_stiffness(model, blocks, terminal);
    warn_of_unbalanced_start(model, blocks_in_touch(model, blocks) > 0, terminal);
    warn_of_record(model, terminal);
    warn_of_keys_without_use(model, terminal);
    warn_of_conditional_stability(model, terminal);
    rock = clock.measure("cover", [&] { return cover_rock(cutting, model, blocks, terminal); });
    require_supports_agree(model, rock->covering.arrays, rock->fixed, terminal);
    warn_of_contact_within_blocks(model, blocks, cutting.totals.joint_area, rock->covering.arrays,
                                  rock->fixed, terminal);
    warn_of_long_contact_steps(model, blocks, rock->covering.arrays, rock->fixed, rock->velocities,
                               terminal);
    warn_of_held_rock(model, blocks, rock->covering.arrays, rock->fixed, terminal);
    warn_of_unheld_rock(model, blocks, rock->covering.arrays, rock->fixed, terminal);
  }

  // From here on the flat arrays say all, but for those exports.
  if (!wants_parts(options)) cutting.complex.reset();
  return_free_memory();

  remember_interrupts();
  std::optional<ResultWriter> writer;
  if (!options.no_result) writer.emplace(path, model, result_header(options));
  PolygonMesh polygons;
  BlockFields fields = keyblocks ? block_fields(*keyblocks) : BlockFields{};
  if (design && design->bolting) add_bolting(fields, *design->bolting);
  if (writer || !options.exports.empty()) polygons = face_polygons(blocks);
  if (writer)
    clock.measure("output", "writing blocks", [&] {
      writer->write_blocks(blocks, polygons, fields,
                           measures ? measures->blocks.flags : std::vector<std::uint8_t>{});
      if (keyblocks && has_first_looks(model))
        writer->write_first_looks(find_first_looks(blocks, model));
    });

  if (design && !(model.drawings.empty() && model.tables.empty()))
    clock.measure("output", "writing drawings and tables",
                  [&] { write_design_files(blocks, *keyblocks, *design, model, path); });

  if (!options.exports.empty())
    clock.measure("output", "writing exports",
                  [&] { write_exports(options, model, cutting, blocks, polygons, fields); });
  polygons = {};  // as large as the blocks, and states need it no more

  std::optional<RunResult> run;
  std::optional<Reduction> reduction;
  std::unique_ptr<RunJournal> journal;
  if (rock) {
    if (writer)
      clock.measure("output", "writing elements", [&] {
        writer->write_elements(rock->covering.arrays, rock->mesh);
        writer->write_bolts(rock->bolts.lines());
      });
    auto analysed = analyse(*rock, model, blocks, writer ? &*writer : nullptr, options, resumption,
                            probe, terminal);
    analysis_is_over();
    if (!analysed.run) return end_search(options, model, *analysed.reduction, terminal);
    run = std::move(analysed.run);
    reduction = std::move(analysed.reduction);
    journal = std::move(analysed.journal);
    if (writer) add_histories(*writer, model, *run);
    write_history_files(*run, model, path);
    add_run_seconds(clock, *run);
    warn_of_large_rotation(model, *run, terminal);
    warn_of_lost_energy(model, *run, terminal);
    warn_of_divided_steps(model, *run, terminal);
    warn_of_made_energy(*run, terminal);
    warn_of_deep_overlap(*run, blocks, terminal);
    warn_of_guessed_material(model, *run, terminal);
    warn_of_imbalance(model, *run, terminal);
    warn_of_missing_factors(model, *run, terminal);
    if (!run->interrupted) warn_of_support_gap(model, *run, terminal);
    warn_of_interruption(*run, model, options, terminal);
  }
  const Answer answer{options,
                      model,
                      cutting.totals,
                      blocks,
                      measures ? &*measures : nullptr,
                      keyblocks ? &*keyblocks : nullptr,
                      design ? &*design : nullptr,
                      stability ? &*stability : nullptr,
                      rock ? &rock->covering.arrays : nullptr,
                      run ? &*run : nullptr,
                      reduction ? &*reduction : nullptr,
                      path,
                      unused_keys(options, model),
                      run ? limit_met(*run, model, options, path) : std::nullopt};
  clock.measure("output", [&] {
    if (!writer) return;
    writer->write_answer(stored_answer(answer, terminal.warnings()));
    if (run && !run->interrupted)
      writer->write_run(whole_answer(answer, terminal), run_origin(options, model));
    writer->finish();
    if (run && !run->interrupted) journal->remove();
  });
  if (probe) return 0;
  if (options.command == Command::demo && has_page())
    clock.measure("output", "writing the page",
                  [&] { write_page(path, page_path(options), page_choice(options)); });

  if (options.report)
    clock.measure("output", "writing the report",
                  [&] { write_report(path, report_path(options)); });

  print_answer(answer, terminal, clock.seconds());
  return run && run->interrupted ? interrupted_status() : 0;
}

/// Goes on with an interrupted run, or tells of a finished one.
int resume_run(const Options& options, Terminal& terminal) {
  if (const auto resumption = find_run(options))
    return analyse_rock(resumption->options, terminal, &*resumption);
  const auto document = read_run_document(options.input);
  if (!document)
    throw Error(
        ErrorKind::io,
        "holds no run that came to its end, and there is no journal beside it to go on from",
        Place{options.input, 0, 0, {}});
  print_finished(options, *document);
  return 0;
}

struct ScratchFolder {
  ScratchFolder() : path(fs::temp_directory_path() / fmt::format("rockfold-trial-{}", getpid())) {
    fs::create_directories(path);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
  fs::path path;
};

/// What the most that can be done with a model will take: its beginning is carried out, and what it writes is thrown away.
Estimate estimate_model(const Options& options, const Model& model, Terminal& terminal) {
  Options trial = options;
  trial.command = model.analysis ? Command::run : model.support ? Command::support : Command::cut;
  const ScratchFolder folder;
  trial.output = (folder.path / "trial.vtkhdf").string();
  Probe probe(model);
  analyse_rock(trial, terminal, nullptr, &probe);
  return probe.estimate(command_name(trial.command));
}

/// What can only be told of rock that has been cut. What stops the cutting is for the commands that cut to tell.
void look_at_supports_of_cut_rock(const Model& model, Terminal& terminal) {
  Progress silent;
  Covering covering;
  BlockArrays blocks;
  FixedPoints fixed;
  try {
    const Cutting cutting = cut_blocks(model, silent);
    covering = build_covers(cutting, model, silent);
    blocks = flatten_blocks(cutting, model);
    fixed = fixed_points(cutting, covering, model);
  } catch (const Error&) {
    return;
  }
  require_supports_agree(model, covering.arrays, fixed, terminal);
  warn_of_held_rock(model, blocks, covering.arrays, fixed, terminal);
  warn_of_unheld_rock(model, blocks, covering.arrays, fixed, terminal);
}

int check_model(const Options& options, Terminal& terminal) {
  Model model =
      read_whole_model(options.input, options.model_text, options.overrides, Purpose::check);
  if (options.seed) reseed(model, *options.seed);
  check_output_names(options, model);
  if (!model.solids.empty()) check_rock(model, most_blocks(options, model));
  warn_of_model(model, terminal);
  if (!model.solids.empty()) warn_of_joints_beside_rock(model, terminal);
  if (model.support) warn_of_free_rock(model, terminal);
  warn_of_unbalanced_start(model, has_joints(model), terminal);
  warn_of_record(model, terminal);
  const bool block_covers = model.cover && model.cover->lattice == LatticeKind::block;
  const bool of_blocks = block_covers && (may_leave_rock_unheld(model) || may_oppose(model));
  if ((may_hold_all(model) || of_blocks) && !options.estimate)
    look_at_supports_of_cut_rock(model, terminal);
  std::optional<Estimate> estimate;
  if (options.estimate) estimate = estimate_model(options, model, terminal);
  print_check(options, model, named_extents(model), estimate ? &*estimate : nullptr, terminal);
  return 0;
}

int tell_theory(const Options& options, Terminal& terminal) {
  PhaseClock clock(terminal);
  const Model model = load_model(options, terminal);
  check_output_paths(options, model);
  const TheoryReport report = clock.measure("theory", "joint pyramids and their blocks",
                                            [&] { return joint_set_theory(model); });
  print_theory(options, model, report, terminal, clock.seconds());
  return 0;
}

int view_result(const Options& options) {
  check_page_path(options);
  const auto facts = write_page(options.input, page_path(options), page_choice(options));
  print_page(options, page_path(options), facts);
  return 0;
}

int report_result(const Options& options) {
  check_report_path(options);
  print_report(options, report_path(options), write_report(options.input, report_path(options)));
  return 0;
}

int tell_info(const Options& options) {
  print_info(options, info_of_result(options.input));
  return 0;
}

/// A model from standard input is read once, and keeps no file's name.
Options with_input_read(Options options) {
  if (options.input == "-" && takes_model(options.command)) {
    options.model_text = model_file_text(options.input);
    options.input = "<stdin>";
  }
  return options;
}

}  // namespace

int run_command(const Options& given, Terminal& terminal) {
  const Options options = with_input_read(given);
  exit_at_once_when_interrupted(options.json);
  use_threads(options.threads);
  const LimitWatch watch(options);
  switch (options.command) {
    case Command::check:
      return check_model(options, terminal);
    case Command::theory:
      return tell_theory(options, terminal);
    case Command::sets:
      return tell_joint_sets(options, terminal);
    case Command::view:
      return view_result(options);
    case Command::report:
      return report_result(options);
    case Command::resume:
      return resume_run(options, terminal);
    case Command::sweep:
      return run_sweep(options, terminal);
    case Command::info:
      return tell_info(options);
    case Command::verify:
      return verify_certificate(options);
    case Command::examples:
      return hand_out_examples(options);
    default:
      return analyse_rock(options, terminal);
  }
}

}  // namespace rockfold
