#include "src/report/summaries/summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include <fmt/format.h>

#include "src/base/place_text.hpp"
#include "src/base/vector.hpp"
#include "src/io/viewers/stress_measures.hpp"
#include "src/model/check_model.hpp"
#include "src/report/design_names.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/documents/met_surfaces.hpp"
#include "src/report/documents/settled.hpp"
#include "src/report/joint_strength.hpp"
#include "src/report/names.hpp"
#include "src/report/progress_line.hpp"
#include "src/report/summaries/table.hpp"
#include "src/run/base_motion.hpp"

namespace rockfold {

namespace {

/// Components of a displacement, a force or stresses.
std::string point_text(const Vec3& x) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x[0], x[1], x[2]);
}

Index count_true(const std::vector<std::uint8_t>& flags) {
  return static_cast<Index>(std::count(flags.begin(), flags.end(), std::uint8_t{1}));
}

std::string cover_text(const CoverSpec& cover) {
  const Vec3& h = cover.spacing;
  std::string text = fmt::format("{}, order {}", lattice_name(cover.lattice), cover.order);
  if (h[0] != h[1] || h[1] != h[2])
    text += fmt::format(", spacing {:g}, {:g}, {:g} m", h[0], h[1], h[2]);
  else if (h[0] > 0)
    text += fmt::format(", spacing {:g} m", h[0]);
  return text;
}

std::string counted(std::size_t n, const std::string& one, const std::string& many) {
  return grouped(static_cast<std::int64_t>(n)) + " " + (n == 1 ? one : many);
}

/// With a comma behind, for the middle of a list.
std::string counted_if_any(std::size_t n, const std::string& one, const std::string& many) {
  return n == 0 ? "" : counted(n, one, many) + ", ";
}

std::string excavations_text(const Model& model) {
  std::set<Index> stages;
  for (const auto& excavation : model.excavations) stages.insert(excavation.stage);
  return grouped(static_cast<std::int64_t>(model.excavations.size())) + " in " +
         counted(stages.size(), "stage", "stages");
}

/// With the digits that map coordinates need.
std::string extent_text(const NamedExtent& extent) {
  if (!extent.bounded) return "without bounds";
  const auto& [low, high] = extent.box;
  return fmt::format("x {:.10g} to {:.10g}, y {:.10g} to {:.10g}, z {:.10g} to {:.10g} m", low[0],
                     high[0], low[1], high[1], low[2], high[2]);
}

/// "peak 0.3 g, 8 s, from t = 1 to 9 s"; "" without a record.
std::string record_fact(const Model& model) {
  if (!model.base_acceleration || !model.analysis || model.base_acceleration->table.empty())
    return "";
  constexpr Real g = 9.81;  // m/s²
  const RecordSpan span = record_span(model);
  return fact("record", fmt::format("peak {:.3g} g, {:.4g} s, from t = {:.4g} to {:.4g} s",
                                    span.peak / g, span.to - span.from, span.from, span.to));
}

std::string analysis_name(AnalysisType type) {
  switch (type) {
    case AnalysisType::static_:
      return "static";
    case AnalysisType::quasi_static:
      return "quasi-static";
    case AnalysisType::dynamic:
      return "dynamic";
  }
  return "";
}

}  // namespace

std::string fact(const std::string& name, const std::string& value) {
  return fmt::format("  {:<22} {}\n", name, value);
}

std::string check_summary(const Model& model, const std::vector<NamedExtent>& extents) {
  std::string text = model.path + ": ok\n";
  text += fact("title", model.title.empty() ? "-" : model.title);
  text += fact("rock", counted(model.solids.size(), "solid", "solids") + ", " +
                           counted(model.materials.size(), "material", "materials"));
  text += fact("joints",
               counted(model.joint_sets.size(), "set", "sets") + ", " +
                   counted(model.joints.size(), "single joint", "single joints") + ", " +
                   counted_if_any(model.joint_meshes.size(), "mesh", "meshes") +
                   counted_if_any(model.joint_tables.size(), "table", "tables") +
                   counted(model.joint_materials.size(), "joint material", "joint materials"));
  for (const NamedExtent& extent : extents) text += fact("  " + extent.name, extent_text(extent));
  if (!model.merges.empty())
    text += fact("merges", counted(model.merges.size(), "region", "regions"));
  if (!model.excavations.empty()) text += fact("excavations", excavations_text(model));
  if (model.cover) text += fact("covers", cover_text(*model.cover));
  if (model.analysis)
    for (const AnalysisStage& stage : model.analysis->stages)
      text += fact(
          stage.name.empty() ? "analysis" : stage.name,
          fmt::format("{}, {}", analysis_name(stage.type), counted(stage.steps, "step", "steps")) +
              (stage.excavate != 0 ? fmt::format(", without the rock of stage {}", stage.excavate)
                                   : ""));
  text += record_fact(model);
  for (const auto& [command, purpose] :
       {std::pair{"support", Purpose::support}, {"run", Purpose::run}})
    for (const auto& lack : missing_for(model, purpose))
      text += fact(fmt::format("not yet for {}", command), lack.place.key + ": " + lack.message);
  return text;
}

namespace {

/// Joints with the same block on both sides: of those that were meant to cut blocks off, a sign that they fall short.
std::string dead_end_fact(const CutTotals& totals) {
  constexpr Real least = 1e-6;  // of the joint area, whose six digits stand above it
  const Real area = totals.dangling_joint_area, whole = totals.joint_area;
  if (!(area > least * whole)) return "";
  if (area < whole)
    return fact("dead ends",
                fmt::format("{:.6g} m2 of it, {:.3g} %: joints that end inside a block", area,
                            100 * area / whole));
  return fact("dead ends",
              fmt::format("{:.6g} m2, all of it: every joint ends inside a block and cuts nothing "
                          "off. Larger joints, or others that they end on, would",
                          area));
}

std::string block_list(const std::vector<Index>& blocks) {
  constexpr std::size_t most = 8;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, blocks.size()); ++i)
    text += fmt::format("{}{}", i == 0 ? "" : ", ", blocks[i] + 1);
  return text + (blocks.size() > most ? ", …" : "");
}

/// How many specks went to their neighbours; the largest of them, each with the block that it is part of now.
std::string speck_facts(const SpeckReport& specks) {
  constexpr std::size_t most = 5;
  std::vector<Speck> largest = specks.merged;
  std::stable_sort(largest.begin(), largest.end(),
                   [](const Speck& a, const Speck& b) { return a.volume > b.volume; });
  Real volume = 0;
  for (const Speck& speck : largest) volume += speck.volume;
  std::string text =
      fact("specks",
           fmt::format("{} of less than {:.3g} m3{} merged with a neighbour: {:.3g} m3 in all",
                       grouped(static_cast<std::int64_t>(largest.size())), specks.limit,
                       specks.limit_is_given ? "" : ", a millionth of the mean block,", volume));
  for (std::size_t i = 0; i < std::min(most, largest.size()); ++i)
    text += fact("", fmt::format("{:.3g} m3 near {} into block {}", largest[i].volume,
                                 point_text(largest[i].centroid), largest[i].block + 1));
  if (largest.size() > most)
    text += fact("", fmt::format("… and {} smaller ones",
                                 grouped(static_cast<std::int64_t>(largest.size() - most))));
  if (!specks.left.empty())
    text += fact("", fmt::format("{} left, with no neighbour that may take them: blocks {}",
                                 grouped(static_cast<std::int64_t>(specks.left.size())),
                                 block_list(specks.left)));
  return text;
}

}  // namespace

std::string bodies_summary(const BodyFit& fit) {
  return fact(
      "bodies from files",
      fmt::format("{} that touch, fitted together to {:.2g} m ({}): {} pairs of faces are one "
                  "plane, corners moved by {:.2g} m at most",
                  grouped(fit.bodies), fit.tolerance,
                  fit.is_given ? "contact.tolerance" : "the files' decimals", grouped(fit.contacts),
                  fit.largest_move));
}

std::string cut_summary(const CutTotals& totals, const BlockArrays& blocks) {
  const auto [smallest, largest] = std::minmax_element(blocks.volume.begin(), blocks.volume.end());
  std::string text =
      fact("blocks",
           fmt::format("{} ({} finite, {} convex)", grouped(blocks.block_count()),
                       grouped(count_true(blocks.finite)), grouped(count_true(blocks.convex))));
  text += fact("volume", fmt::format("{:.6g} m3 of rock", total_volume(blocks)));
  if (smallest != blocks.volume.end())
    text += fact("smallest, largest", fmt::format("{:.4g} m3, {:.4g} m3", *smallest, *largest));
  if (totals.specks) text += speck_facts(*totals.specks);
  text += fact("joint area", fmt::format("{:.6g} m2", totals.joint_area));
  text += dead_end_fact(totals);
  text += fact("faces, vertices",
               fmt::format("{}, {}", grouped(static_cast<std::int64_t>(blocks.face_normal.size())),
                           grouped(static_cast<std::int64_t>(blocks.vertex.size()))));
  return text;
}

namespace {

/// More [[fixed]] than this are summed.
constexpr std::size_t most_conditions = 8;

std::string monitor_facts(const MonitorHistory& monitor) {
  if (monitor.displacement.empty()) return "";
  return fact("monitor " + monitor.name, fmt::format("displacement {} m, {:.4g} m long",
                                                     point_text(monitor.displacement.back()),
                                                     norm(monitor.displacement.back()))) +
         fact("", fmt::format("principal stresses {} Pa",
                              point_text(principal_stresses(monitor.stress.back()))));
}

std::string monitor_facts(const JointHistory& monitor) {
  if (monitor.time.empty()) return "";
  return fact("monitor " + monitor.name,
              fmt::format("{}: normal stress {:.4g} Pa, shear stress {:.4g} Pa", monitor.joint,
                          monitor.normal_stress.back(), monitor.shear_stress.back())) +
         fact("", fmt::format("opening {:.4g} m, slip {:.4g} m, {}", monitor.opening.back(),
                              monitor.slip.back(), contact_name(monitor.state.back())));
}

std::string largest_text(const char* what, const LargestAtJoint& largest,
                         const BlockArrays& blocks) {
  const std::string joint = joint_name(blocks, largest.joint);
  return fmt::format("{} {:.4g} m, {} between blocks {} and {}", what, largest.value,
                     joint.empty() ? "faces that met" : joint, largest.block[0] + 1,
                     largest.block[1] + 1);
}

/// Whether displacements count from a later step than the first.
bool resets(const Model& model) {
  const auto& steps = model.analysis->stages;
  return std::any_of(steps.begin(), steps.end(),
                     [](const AnalysisStage& step) { return step.reset_displacement; });
}

std::string excavation_facts(const RunReport& report) {
  const Index gone = count_true(report.run.gone);
  if (gone == 0) return "";
  const auto& stages = report.model.analysis->stages;
  std::string text = fact("excavated", counted(gone, "block", "blocks") + " on the way");
  for (const Settled& s : report.run.settled)
    text += fact("", settled_text(settled_json(s, stages[s.stage])));
  if (const auto& settling = report.run.settling)
    text += fact("", settling_text(settling_json(*settling, stages[settling->stage])));
  if (report.run.walls > 0)
    text += fact("", fmt::format("its walls still bear {:.3g} % of what it pressed them with",
                                 100 * report.run.walls));
  return text;
}

std::string water_fact(const RunReport& report) {
  const auto& water = report.run.water;
  if (!water) return "";
  const Real share = water->whole_force > 0 ? water->force / water->whole_force : 1;
  return fact("water in joints",
              fmt::format("up to {:.4g} kPa on {:.4g} m2, {:.4g} kN on either side{}",
                          1e-3 * water->largest_pressure, water->area, 1e-3 * water->force,
                          share > 0.999 ? ""
                                        : fmt::format("; {:.3g} % of what it would be had nothing "
                                                      "slid off or opened",
                                                      100 * share)));
}

std::string shotcrete_fact(const RunReport& report) {
  const auto& shotcrete = report.run.shotcrete;
  if (!shotcrete) return "";
  std::string text = fmt::format("over {:.4g} m of joints, bears {:.4g} kN", shotcrete->length,
                                 1e-3 * shotcrete->force);
  if (shotcrete->yielding > 0)
    text += fmt::format("; all that it can along {:.4g} m", shotcrete->yielding);
  if (shotcrete->broken > 0) text += fmt::format("; broken along {:.4g} m", shotcrete->broken);
  return fact("shotcrete", text);
}

std::string bolts_fact(const RunReport& report) {
  const std::vector<BoltResult>& bolts = report.run.bolts;
  if (bolts.empty()) return "";
  std::map<std::string, Index> states;
  const BoltResult* most = &bolts.front();
  for (const BoltResult& bolt : bolts) {
    ++states[bolt.installed ? bolt_status_name(bolt.status) : "not in yet"];
    if (bolt.mobilisation > most->mobilisation) most = &bolt;
  }
  std::string text;
  for (const auto& [state, count] : states)
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, state);
  return fact("bolts", text) +
         fact("",
              fmt::format(
                  "most used {}, {:.3g} % of what it bears: {:.4g} kN along it{}", most->name,
                  100 * most->mobilisation, 1e-3 * most->force,
                  most->shear > 0 ? fmt::format(", {:.4g} kN across", 1e-3 * most->shear) : ""));
}

/// Of which law holds where that is not plain: faces of two materials, or of none.
std::string met_facts(const RunReport& report) {
  std::string text;
  for (const Json& met : met_json(report.model, report.run.met))
    if (met.at("by") != "own") text += fact(text.empty() ? "faces that met" : "", met_text(met));
  return text;
}

std::string rest_facts(const RunReport& report) {
  const Rest& rest = *report.run.rest;
  const Index blocks = report.blocks.block_count() - count_true(report.run.gone);
  std::string text = excavation_facts(report);
  text +=
      fact("moved",
           fmt::format("{} of {} blocks by more than a hundredth of their size; {}",
                       grouped(rest.moved), grouped(blocks),
                       rest.at_rest ? fmt::format("all at rest since t = {:.4g} s", rest.since)
                                    : fmt::format("the fastest moves at {:.3g} m/s", rest.speed)));
  for (const auto& [what, largest] :
       {std::pair{"largest slip", rest.slip}, {"largest opening", rest.opening}})
    if (largest.block[0] != none)
      text += fact("", largest_text(what, largest, report.blocks) +
                           (resets(report.model) ? ", since t = 0" : ""));
  if (const auto weaker = materials_that_lose_strength(report.model, report.blocks);
      !weaker.empty())
    text += fact("strength lost by slip", strength_loss_text(weaker));
  text += water_fact(report) + bolts_fact(report) + shotcrete_fact(report) + met_facts(report);
  const ContactCount& c = report.run.contacts;
  return text + fact("contact points", fmt::format("{} stick, {} slide, {} open", grouped(c.stick),
                                                   grouped(c.slide), grouped(c.open)));
}

/// How far the last quasi-static step is from balance, where that is more than rounding.
std::string unbalanced_fact(const Unbalanced& unbalanced) {
  constexpr Real least = 1e-6;
  if (!(unbalanced.share > least)) return "";
  return fact("unbalanced",
              fmt::format("{:.2g} % of the load, most of it on block {}: {:.4g} N{}",
                          100 * unbalanced.share, unbalanced.block + 1, unbalanced.force,
                          is_far_from_balance(unbalanced)
                              ? "; reactions and stresses are of rock that moves"
                              : ""));
}

std::string strength_fact(const RockStrength& strength) {
  if (strength.block == none) return "";
  std::string text =
      fmt::format("at least {:.3g} of the stress, in block {} at {}", strength.least_ratio,
                  strength.block + 1, place_text(strength.point));
  if (strength.failed_volume > 0)
    text += fmt::format("; below 1 in {:.4g} m3", strength.failed_volume);
  return fact("strength", text);
}

Vec3 sum_of_forces(const std::vector<Reaction>& conditions) {
  Vec3 sum{};
  for (const Reaction& condition : conditions) sum += condition.force;
  return sum;
}

/// Without what is nothing but rounding and the solver's tolerance.
std::string energy_text(const Energy& energy) {
  const std::pair<const char*, Real> parts[] = {{"kinetic", energy.kinetic},
                                                {"strain", energy.strain},
                                                {"potential", energy.potential},
                                                {"contact", energy.contact},
                                                {"friction", energy.friction},
                                                {"impact", energy.impact},
                                                {"dissipated", energy.dissipated},
                                                {"work of loads", energy.loads},
                                                {"work of supports", energy.supports},
                                                {"excavated", energy.excavated},
                                                {"bolts", energy.bolts}};
  Real largest = 0;
  for (const auto& [name, value] : parts) largest = std::max(largest, std::abs(value));
  std::string text;
  for (const auto& [name, value] : parts)
    if (std::abs(value) > 1e-6 * largest)
      text += fmt::format("{}{} {:.4g} J", text.empty() ? "" : ", ", name, value);
  return text.empty() ? "0 J" : text;
}

/// Why steps are explicit, where the model did not ask for it.
std::string reason_text(const BySubsteps& by) {
  if (by.failed != 0) return ", as the implicit one did not come to balance";
  if (by.iterated == 0) return "";
  return fmt::format(", as iterations had cost {:.2g} times as much", by.iterated / by.instead);
}

/// What set the pace, and what was done about it.
std::string pace_text(const BySubsteps& by) {
  std::string text = fmt::format("; the fastest blocks by {:.3g} s", by.shortest);
  if (by.added_mass > 0) text += fmt::format(", with {:.2g} % of mass added", 100 * by.added_mass);
  return text;
}

/// The preconditioner of the last solve, and the fallback by its name where one was taken.
std::string preconditioner_text(const RunResult& run) {
  const std::int64_t count = run.iterations.fallbacks;
  const std::string fallback = preconditioner_name(Preconditioner::direct);
  std::string name = preconditioner_name(run.preconditioner);
  if (count == 0) return name;
  return fmt::format("{}, {}as fallback in {} solve{}", name,
                     name == fallback ? "" : fallback + " ", grouped(count), count == 1 ? "" : "s");
}

}  // namespace

std::string run_summary(const RunReport& report) {
  const auto& run = report.run;
  std::string text = fact(
      "covers", fmt::format("{} of {} elements, {} unknowns", grouped(report.covers.cover_count()),
                            grouped(report.covers.element_count()),
                            grouped(3 * std::int64_t{report.covers.unknown_count()})));
  const std::string steps = run.interrupted
                                ? fmt::format("{} of {} (interrupted)", grouped(run.steps),
                                              grouped(report.model.analysis->steps()))
                                : grouped(run.steps);
  text +=
      fact("steps", fmt::format("{} to t = {:.6g} s, {} solver iterations ({})", steps, run.time,
                                grouped(run.iterations.pcg), preconditioner_text(run)));
  for (const BySubsteps& by : run.by_substeps)
    text += fact("explicit steps",
                 fmt::format("{} to {}{}: {} substeps, {} contact points looked at{}",
                             grouped(by.first), grouped(by.first + by.steps - 1), reason_text(by),
                             grouped(by.substeps), grouped(by.visits), pace_text(by)));
  text += record_fact(report.model);
  const LargestDisplacement& largest = run.largest_displacement;
  const bool counts_anew = resets(report.model);
  const std::string since = counts_anew ? ", since the reset" : "";
  text += fact("largest displacement",
               largest.block == none
                   ? "none: nothing moved" + since
                   : fmt::format("{:.4g} m, in block {} at {}{}", largest.length, largest.block + 1,
                                 place_text(largest.point), since));
  if (run.rest) text += rest_facts(report);
  if (run.unbalanced) text += unbalanced_fact(*run.unbalanced);
  for (const auto& monitor : run.monitors) text += monitor_facts(monitor);
  for (const auto& monitor : run.joint_monitors) text += monitor_facts(monitor);
  text += strength_fact(run.strength);
  if (run.conditions.size() <= most_conditions)
    for (std::size_t n = 0; n < run.conditions.size(); ++n)
      text += fact(fmt::format("reaction of fixed {}", n + 1),
                   point_text(run.conditions[n].force) + " N");
  else
    text += fact("reactions", point_text(sum_of_forces(run.conditions)) + " N in all");
  return text + fact("energy", energy_text(run.energy));
}

std::string info_summary(const ResultInfo& info, const std::string& path) {
  std::string text = path + (info.title.empty() ? "" : ": " + info.title) + "\n";
  text += fact("made by", fmt::format("rockfold {} {} ({})", info.version, info.command,
                                      info.commit.empty() ? "commit unknown" : info.commit));
  text += fact("units", info.units);
  text += fact("blocks", fmt::format("{}, {:.6g} m3, {} faces", grouped(info.blocks), info.volume,
                                     grouped(info.faces)));
  text += fact("block theory",
               info.block_theory ? "class, batch, mode and support of each block" : "-");
  if (info.covers > 0)
    text += fact("covers", fmt::format("{} physical covers, {} elements", grouped(info.covers),
                                       grouped(info.elements)));
  if (info.step.empty()) {
    text += fact("states", "none");
  } else {
    text += fact("states", fmt::format("{}, t = {:g} … {:g} s", info.step.size(), info.time.front(),
                                       info.time.back()));
  }
  if (info.unfinished)
    text += fact("unfinished",
                 fmt::format("`rockfold resume {}` goes on from step {}, t = {:g} s", path,
                             info.unfinished->checkpoint, info.unfinished->checkpoint_time));
  if (info.file_bytes == 0) return text;
  text += fact("size", fmt::format("{:.3g} MB in {}", info.file_bytes / 1e6,
                                   counted(info.datasets.size(), "data set", "data sets")));
  return text;
}

}  // namespace rockfold
