#include "src/run/made_energy.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/base/place_text.hpp"
#include "src/run/contact_setup.hpp"
#include "src/run/records/contact_samples.hpp"

namespace rockfold {
namespace {

/// Beyond a tenth what moves is another motion than the rock's.
constexpr Real most_made_share = 0.1;

}  // namespace

void count_made_energy(const Energy* before, const Energy& now, MadeEnergy& made) {
  if (!before) {
    made.turned_over += std::abs(now.kinetic) + now.strain + now.contact;
    return;
  }
  const Real changes =
      std::abs(now.kinetic - before->kinetic) + std::abs(now.strain - before->strain) +
      std::abs(now.potential - before->potential) + std::abs(now.contact - before->contact) +
      std::abs(now.dissipated - before->dissipated);
  made.turned_over += 0.5 * changes;
  if (now.impact >= before->impact) return;
  made.energy += before->impact - now.impact;
  ++made.steps;
}

void note_gain(const RunInput& input, const Motion& motion, MadeEnergy& made) {
  const EnergyGain& gain = motion.largest_gain();
  if (!(gain.energy > made.largest)) return;
  const auto samples = contact_samples(input, contact_options(input.model, input.blocks).laws,
                                       {gain.point}, motion.state().displacement);
  if (samples.empty()) return;
  made.largest = gain.energy;
  made.place = samples.front().place;
  std::copy(samples.front().block, samples.front().block + 2, made.block);
}

std::string made_energy_text(const MadeEnergy& made) {
  std::string text = fmt::format(
      "contact made {:.3g} J out of nothing in {} step{} (energy.impact falls there), {:.2g} % of "
      "all energy turned over",
      made.energy, made.steps, made.steps == 1 ? "" : "s", 100 * made.share());
  if (made.block[0] != none)
    text += fmt::format(", most of it between blocks {} and {} near {}", made.block[0] + 1,
                        made.block[1] + 1, place_text(made.place));
  return text +
         ": blocks that overlap slide or turn onto larger areas. Stiffer joints "
         "(joint_material.normal_stiffness) overlap less; in impacts a shorter time_step helps too";
}

void require_little_made(const MadeEnergy& made, Index step, Real time) {
  if (made.share() <= most_made_share) return;
  throw Error(ErrorKind::analysis,
              fmt::format("step {}, time {:.3g} s: {}", step, time, made_energy_text(made)));
}

}  // namespace rockfold
