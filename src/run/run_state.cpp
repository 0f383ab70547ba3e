#include "src/run/run_state.hpp"

#include <cstring>
#include <stdexcept>

#include "src/base/error.hpp"

namespace rockfold {
namespace {

/// Of what follows: changed with it.
constexpr std::uint64_t format = 0x0007'504b'4843'4652;  // "RFCHKP", 7

struct StageLength {
  std::int64_t steps = 0;
  Real time_step = 0, last_time_step = 0;
  bool operator==(const StageLength&) const = default;
};

StageLength length_of(const AnalysisStage& stage) {
  return {stage.steps, stage.time_step, stage.last_time_step.value_or(stage.time_step)};
}

[[noreturn]] void refuse(const AnalysisStage& stage, const std::string& why) {
  throw Error(ErrorKind::usage, why + ": run the model anew",
              Place{stage.place.file, stage.place.line, stage.place.column, stage.place.key});
}

void pass(Archive& archive, StoredState& state) {
  archive.all(state.step, state.motion.time, state.motion.displacement, state.motion.velocity,
              state.motion.acceleration, state.element_stress, state.block_stress,
              state.nodal_stress, state.contacts, state.gone, state.bolts.displacement,
              state.bolts.force, state.bolts.mobilisation, state.bolts.status);
}

}  // namespace

CheckpointFacts make_checkpoint_facts(Index steps, Index states, Real time) {
  return {format, steps, states, time};
}

CheckpointFacts checkpoint_facts(std::span<const std::byte> checkpoint) {
  CheckpointFacts facts;
  Archive(checkpoint).pass(facts);
  if (facts.format != format) throw std::runtime_error("a checkpoint of another version");
  return facts;
}

void pass_histories(Archive& archive, RunResult& result) {
  archive.all(result.steps, result.base, result.energy_time, result.energies, result.contacts,
              result.support_gap, result.iterations, result.preconditioner, result.largest_substeps,
              result.divided_steps, result.divided_in_stage, result.most_parts, result.settled,
              result.made, result.by_substeps);
  ContactHistory& contact = result.contact_history;
  archive.all(contact.open, contact.stick, contact.slide, contact.iterations, contact.substeps);
  for (MonitorHistory& m : result.monitors)
    archive.all(m.time, m.displacement, m.velocity, m.acceleration, m.stress);
  for (JointHistory& j : result.joint_monitors)
    archive.all(j.time, j.normal_stress, j.shear_stress, j.opening, j.slip, j.state);
}

void pass_stages(Archive& archive, const Analysis& analysis, Index stage, Index step) {
  std::vector<StageLength> now, then;
  for (const AnalysisStage& s : analysis.stages) now.push_back(length_of(s));
  then = now;
  archive.pass(then);
  if (then.size() != now.size())
    throw Error(ErrorKind::usage, "the number of [[step]]s has changed: run the model anew");
  for (Index s = 0; s <= stage && s < std::ssize(now); ++s) {
    const AnalysisStage& given = analysis.stages[s];
    if (now[s] == then[s]) continue;
    if (s < stage) refuse(given, "this part of the analysis is over, its length cannot change");
    if (now[s].time_step != then[s].time_step)
      refuse(given, "the time step cannot change on the way");
    if (step > now[s].steps)
      refuse(given, "has " + std::to_string(now[s].steps) + " steps, but " + std::to_string(step) +
                        " are done already");
    const bool cut = then[s].last_time_step != then[s].time_step;
    if (step == then[s].steps && (cut || now[s].steps == step))
      refuse(given, "its last step is done and was of another length");
  }
}

std::vector<std::byte> packed(const StoredState& state) {
  Archive archive;
  StoredState copy = state;
  pass(archive, copy);
  return std::move(archive.bytes());
}

StoredState unpacked_state(std::span<const std::byte> bytes) {
  Archive archive(bytes);
  StoredState state;
  pass(archive, state);
  if (!archive.at_end()) throw std::runtime_error("longer than a state");
  return state;
}

std::uint64_t hash_of(const StoredState& state) {
  Hash hash;
  hash.add(std::as_bytes(std::span(&state.step, 1)));
  hash.add(std::as_bytes(std::span(&state.motion.time, 1)));
  for (const auto* field :
       {&state.motion.displacement, &state.motion.velocity, &state.motion.acceleration})
    hash.add(std::as_bytes(std::span(*field)));
  return hash.value();
}

}  // namespace rockfold
