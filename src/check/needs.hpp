// What a command needs of the model beyond what any model must have, and what the user should know
// about it.
#pragma once

#include "host/cut/cut.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/measure/block_statistics.hpp"
#include "host/stability/stability.hpp"
#include "src/app/command_line.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"
#include "src/report/terminal.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

bool wants_support(const Options& options, const Model& model);
/// Statistics and intensities: for the report of `cut`, and wherever the model asks for flags.
bool wants_measures(const Options& options, const Model& model);
bool wants_run(const Options& options);

/// Reads the model (the demo's from the program itself). Throws Error(model) naming what the
/// command lacks in it.
Model load_model(const Options& options, Terminal& terminal);

/// --seed: each random set gets a seed of its own, which no set of another network has; the model's text says so.
void reseed(Model& model, std::uint64_t seed);

/// What is allowed in the model and its files and hardly meant, each with its place.
void warn_of_model(const Model& model, Terminal& terminal);
/// And of files in other units.
void warn_of_joints_beside_rock(const Model& model, Terminal& terminal);
/// Block theory of rock that goes on nowhere.
void warn_of_free_rock(const Model& model, Terminal& terminal);

std::vector<Vec3> monitor_points(const Model& model);

/// Throws Error(model) with every monitor that lies outside the rock.
void require_in_rock(const Model& model, const MaterialPoints& monitors);

void warn_of_cutting(const IntentReport& intent, Terminal& terminal);
/// Throws Error(analysis) where the contact of a joint does not add up to its area on both sides: block theory would take a face for free.
void require_whole_contact(const BlockArrays& blocks, const Model& model);
/// Blocks below cut.min_volume or above cut.max_aspect_ratio: they stay, but the user should look.
void warn_of_flagged_blocks(const BlockStatistics& statistics, const Model& model,
                            Terminal& terminal);
/// No block is finite, or none of the finite ones has a free face: block theory has nothing to look at.
void warn_of_immobile_blocks(const BlockArrays& blocks, Terminal& terminal);
/// Blocks that slide on a contact of next to no area, at most five of them by name.
void warn_of_thin_contacts(const KeyblockReport& keyblocks, Terminal& terminal);
/// Blocks that a [[fixed]] holds in some directions alone: a rigid mass knows held and free blocks.
void warn_of_partly_held(const StabilityReport& stability, Terminal& terminal);
/// Under small kinematics strains are linear in the displacement, which is right for small rotations only.
void warn_of_large_rotation(const Model& model, const RunResult& run, Terminal& terminal);
/// Average acceleration keeps the energy: where it does not, the solver has not found the motion.
void warn_of_lost_energy(const Model& model, const RunResult& run, Terminal& terminal);
/// Keys of motion in a static analysis.
void warn_of_keys_without_use(const Model& model, Terminal& terminal);
/// Newmark parameters that blow up where the time step is long for the stiffest element.
void warn_of_conditional_stability(const Model& model, Terminal& terminal);
/// Steps that found no solution until they were taken in parts; not those that max_displacement_ratio divides.
void warn_of_divided_steps(const Model& model, const RunResult& run, Terminal& terminal);
/// Points held that could not be brought to their places.
void warn_of_support_gap(const Model& model, const RunResult& run, Terminal& terminal);
/// Factors were asked for, and the last solve went without them.
void warn_of_missing_factors(const Model& model, const RunResult& run, Terminal& terminal);
/// The last quasi-static step is no equilibrium.
/// The law of faces that met was that of the first of several joint materials, as no key names one.
void warn_of_guessed_material(const Model& model, const RunResult& run, Terminal& terminal);
void warn_of_imbalance(const Model& model, const RunResult& run, Terminal& terminal);
void warn_of_interruption(const RunResult& run, const Model& model, const Options& options,
                          Terminal& terminal);

}  // namespace rockfold
