#include "src/check/contact_needs.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/model/openings.hpp"
#include "src/report/error_text.hpp"
#include "src/run/made_energy.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

Index blocks_at_first(const Model& model, const BlockArrays& blocks) {
  return static_cast<Index>(
      std::count_if(blocks.stage.begin(), blocks.stage.end(),
                    [&](Index stage) { return is_there_at_first(model, stage); }));
}

/// How many blocks could go through others: those that lean on each other; where motions are large and go on, any.
Index blocks_that_may_meet(const Model& model, const BlockArrays& blocks) {
  const bool travels = model.analysis->large() && !model.analysis->has(AnalysisType::static_);
  return travels ? blocks_at_first(model, blocks) : blocks_in_touch(model, blocks);
}

}  // namespace

Index blocks_in_touch(const Model& model, const BlockArrays& blocks) {
  const auto is_there = [&](Index b) { return is_there_at_first(model, blocks.stage[b]); };
  std::vector<std::uint8_t> touches(blocks.stage.size());
  for (const auto& shared : blocks.interfaces)
    if (is_there(shared.block[0]) && is_there(shared.block[1]))
      for (const Index b : shared.block) touches[b] = 1;
  return static_cast<Index>(std::count(touches.begin(), touches.end(), std::uint8_t{1}));
}

void check_contact(const Model& model, const BlockArrays& blocks, Terminal& terminal) {
  const Index count = blocks_that_may_meet(model, blocks);
  if (count < 2 || model.cover->joints == JointTreatment::welded) return;
  if (has_contact(model)) {
    const Analysis& analysis = *model.analysis;
    if (!analysis.has(AnalysisType::dynamic) ||
        (analysis.newmark_beta == 0.25 && analysis.newmark_gamma == 0.5))
      return;
    Place place = analysis.place;
    place.key += ".newmark";
    throw Error(ErrorKind::model,
                {{place,
                  "must be {beta = 0.25, gamma = 0.5} where blocks touch each other: only "
                  "then is no energy made in impacts"}});
  }
  terminal.warn(fmt::format(
      "the {} blocks move through each other: contact needs cover.order = 0 or 1, no cover.mixed, "
      "analysis.kinematics = \"large\" and no static analysis (\"quasi_static\" finds the same "
      "rest). With cover.joints = \"welded\" the rock moves as one mass",
      count));
}

namespace {

/// Of the area of all joints, which is told to six digits.
constexpr Real least_dead_end = 1e-6;

void warn_of_dead_ends(const Model& model, const BlockArrays& blocks, Real joint_area,
                       Terminal& terminal) {
  Real area = 0;
  Index most = none, count = 0;
  for (Index b = 0; b < static_cast<Index>(blocks.dead_end_area.size()); ++b) {
    const Real of_block = blocks.dead_end_area[b];
    if (!(of_block > 0) || !is_there_at_first(model, blocks.stage[b])) continue;
    area += of_block;
    ++count;
    if (most == none || of_block > blocks.dead_end_area[most]) most = b;
  }
  const bool touch = has_contact(model) && blocks.block_count() > 1;
  const bool of_blocks = model.cover->lattice == LatticeKind::block;
  if (!(area > least_dead_end * joint_area)) return;
  const std::string where = count == 1
                                ? fmt::format("block {}", most + 1)
                                : fmt::format("{} blocks, most in block {}", count, most + 1);
  terminal.warn(fmt::format(
      "{:.4g} m2 of joints end inside {}: contact is between blocks alone, and there {}. Joints "
      "that go on to another joint or a face part blocks",
      area, where,
      touch || of_blocks
          ? "they are intact rock, which neither opens nor slips"
          : "they are open cracks, whose sides pass through each other where they close"));
}

/// Those on a lattice that are not convex and have no support.
std::vector<Index> blocks_that_may_fold(const Model& model, const BlockArrays& blocks,
                                        const CoverArrays& covers, const FixedPoints& fixed) {
  std::vector<Index> found;
  if (model.cover->lattice == LatticeKind::block || !model.analysis->large()) return found;
  std::vector<std::uint8_t> held(blocks.convex.size());
  for (const Index e : fixed.points.element)
    if (e != none) held[block_of(covers, e)] = 1;
  for (Index b = 0; b < blocks.block_count(); ++b)
    if (!blocks.convex[b] && !held[b] && is_there_at_first(model, blocks.stage[b]))
      found.push_back(b);
  return found;
}

}  // namespace

void warn_of_contact_within_blocks(const Model& model, const BlockArrays& blocks, Real joint_area,
                                   const CoverArrays& covers, const FixedPoints& fixed,
                                   Terminal& terminal) {
  if (model.cover->joints == JointTreatment::welded) return;
  warn_of_dead_ends(model, blocks, joint_area, terminal);
  const auto folding = blocks_that_may_fold(model, blocks, covers, fixed);
  if (folding.empty()) return;
  const bool one = folding.size() == 1;
  const std::string which =
      one ? fmt::format("block {} is not convex, and nothing holds it", folding[0] + 1)
          : fmt::format("{} blocks are not convex, and nothing holds them (block {} first)",
                        folding.size(), folding[0] + 1);
  terminal.warn(which +
                ": where rock of one block folds, its parts pass through each other, since contact "
                "is between "
                "blocks. A joint across the notch would make two blocks of it");
}

namespace {

/// Times E/h: joints as stiff as a hundred of these yield a hundredth of what the rock does; the iterations grow with k h/E.
constexpr Real stiff = 1000;
/// Of the energy turned over, what contact may make out of nothing before the user should know.
constexpr Real largest_made_share = 0.01;

/// m: the cube root of the mean volume.
Real size_of(const BlockArrays& blocks) {
  Real volume = 0;
  for (const Real v : blocks.volume) volume += v;
  return std::cbrt(volume / static_cast<Real>(blocks.block_count()));
}

void warn_of_stiff_joints(const Model& model, Real size, Terminal& terminal) {
  Real modulus = 0;
  for (const Material& m : model.materials) modulus = std::max(modulus, m.young_modulus);
  const Real rock = modulus / size;
  for (const JointMaterial& joint : model.joint_materials)
    for (const auto& [key, k] : {std::pair{"normal_stiffness", joint.normal_stiffness},
                                 std::pair{"shear_stiffness", joint.shear_stiffness}})
      if (k && *k >= stiff * rock)
        terminal.warn(fmt::format(
            "{}.{} = {:.3g} Pa/m is {:.2g} times E/h of the blocks (h = {:.2g} m, E/h = {:.2g} "
            "Pa/m): contact so stiff takes many iterations; from 100 times E/h on joints yield a "
            "hundredth of what the rock does",
            joint.place.key, key, *k, *k / rock, size, rock));
}

}  // namespace

void warn_of_contact_stiffness(const Model& model, const BlockArrays& blocks, Terminal& terminal) {
  if (blocks_at_first(model, blocks) < 2 || model.cover->joints == JointTreatment::welded ||
      !has_contact(model))
    return;
  warn_of_stiff_joints(model, size_of(blocks), terminal);
}

void warn_of_unbalanced_start(const Model& model, bool meet, Terminal& terminal) {
  if (!meet || !has_contact(model) || model.gravity == Vec3{} || model.initial_stress.any) return;
  const AnalysisStage& first = model.analysis->stages.front();
  if (first.share_handed_on() == 0) return;
  Place place = first.place;
  place.key += ".type";
  terminal.warn(diagnostic_line(
      {place,
       "is \"dynamic\" from the start, which is no equilibrium: gravity comes on at once, the "
       "joints bear nothing yet, blocks bounce on them and those near their limit may slip. A "
       "[[step]] of type = \"quasi_static\" before it brings the rock to rest under its weight"}));
}

void warn_of_made_energy(const RunResult& run, Terminal& terminal) {
  if (run.made.share() > largest_made_share) terminal.warn(made_energy_text(run.made));
}

void warn_of_deep_overlap(const RunResult& run, const BlockArrays& blocks, Terminal& terminal) {
  constexpr Real much = 0.05;  // of the blocks' size: joints give way by thousandths of it
  const Real size = size_of(blocks), depth = run.contacts.largest_penetration;
  if (!(depth > much * size)) return;
  terminal.warn(
      fmt::format("at the end blocks lie in each other by up to {:.3g} m, {:.2g} % of their mean "
                  "size: supports "
                  "press them together, or joints are too soft (joint_material.normal_stiffness)",
                  depth, 100 * depth / size));
}

}  // namespace rockfold
