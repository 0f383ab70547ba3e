// What was modelled: summary, materials, joints, the model's text.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "src/base/sha256.hpp"
#include "src/printed/sections.hpp"

namespace rockfold {

namespace {

using Facts = std::vector<std::pair<std::string, std::string>>;

/// "1 solid, 3 joint sets".
std::string count_text(const Json& counts) {
  static const std::vector<std::array<const char*, 3>> names{
      {"solids", "solid", "solids"},
      {"joint_sets", "joint set", "joint sets"},
      {"joints", "single joint", "single joints"},
      {"joint_meshes", "joint mesh", "joint meshes"},
      {"joint_tables", "table of joints", "tables of joints"},
      {"excavations", "excavation", "excavations"},
      {"fixed", "condition of fixity", "conditions of fixity"},
      {"tractions", "traction", "tractions"},
      {"point_loads", "point load", "point loads"},
      {"water", "water level", "water levels"}};
  std::string text;
  for (const auto& [key, one, many] : names)
    if (const Index count = counts.at(key); count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, count == 1 ? one : many);
  return text;
}

/// Nothing where the size of the blocks decides.
std::string spacing_text(const Json& spacing) {
  const auto is_zero = [](const Json& x) { return x == 0; };
  if (std::all_of(spacing.begin(), spacing.end(), is_zero)) return "";
  return ", spacing " + vector_text(spacing) + " m";
}

/// "1.8 ± 0.8 (log-normal)".
std::string distribution_text(const Json& d) {
  const std::string kind = d.at("distribution");
  if (kind == "constant") return digits(d.at("mean"));
  if (kind == "power_law")
    return fmt::format("{} to {} (power law, exponent {})", digits(d.at("min")),
                       digits(d.at("max")), digits(d.at("exponent")));
  if (kind == "log_normal")
    return fmt::format("{} ± {} (log-normal)", digits(d.at("mean")),
                       digits(d.at("standard_deviation")));
  return digits(d.at("mean")) + " (exponential)";
}

/// How close the joints of a set lie, in m or by what was asked for.
std::string density_text(const Json& joint) {
  const Json random = joint.value("random", Json::object());
  if (random.contains("spacing")) return distribution_text(random.at("spacing"));
  if (random.contains("p32")) return "P32 " + digits(random.at("p32")) + " m²/m³";
  if (random.contains("p10")) return "P10 " + digits(random.at("p10")) + " per m";
  if (random.contains("count")) return fmt::format("{} discs", random.at("count").get<Index>());
  return digits(joint.at("spacing"));
}

std::string radius_text(const Json& joint) {
  const Json random = joint.value("random", Json::object());
  if (random.contains("radius")) return distribution_text(random.at("radius"));
  return joint.at("radius").is_null() ? "through-going" : digits(joint.at("radius"));
}

/// "300", or that poles do not scatter.
std::string scatter_text(const Json& joint) {
  if (!joint.contains("random")) return "–";
  const Json& kappa = joint.at("random").at("fisher_kappa");
  return kappa.is_null() ? "none" : digits(kappa);
}

/// "level at 12 m, joints clay, fault".
std::string water_text(const Json& water) {
  std::string text;
  if (water.contains("pressure")) text = quantity(water.at("pressure"), "Pa");
  if (water.contains("head")) text = "level at " + quantity(water.at("head"), "m");
  if (water.contains("table")) {
    const Json& table = water.at("table");
    const Vec3 normal = table.at("normal").get<Vec3>();
    text = normal[0] == 0 && normal[1] == 0
               ? "level at " + quantity(table.at("point").at(2), "m")
               : fmt::format("table through ({}) m, normal ({})", vector_text(table.at("point")),
                             vector_text(table.at("normal")));
  }
  if (water.contains("head_table") || water.contains("pressure_table"))
    text += " at t = 1 s, changing over time";
  if (water.contains("factor")) text += fmt::format(", {} of it", digits(water.at("factor")));
  if (water.at("density") != 1000) text += ", " + digits(water.at("density")) + " kg/m³";
  const std::string law = water.value("law", "hydrostatic");
  if (law == "mid_height") text += ", none at edges that drain, peak at mid-height";
  if (law == "drained")
    text += ", falling from corners inside the rock to none at edges that drain";
  return text + (water.at("joints").empty() ? ", in all joints that no other names"
                                            : ", in " + joined(water.at("joints")));
}

void add_water(Facts& facts, const Json& support) {
  const Json& waters = support.at("water");
  if (waters.empty() || support.at("water_pressure") != 0)
    facts.emplace_back("Water pressure in joints", quantity(support.at("water_pressure"), "Pa"));
  for (const Json& water : waters) facts.emplace_back("Water", water_text(water));
}

void add_materials(Html& html, const Json& setup) {
  std::vector<std::vector<std::string>> rows;
  for (const Json& m : setup.at("materials"))
    rows.push_back({m.at("name"), digits(m.at("density")), digits(m.at("young_modulus"), 4, 1e9),
                    digits(m.at("poisson_ratio"))});
  if (!rows.empty())
    html.table("Rock",
               {{"material", "", true},
                {"density", "kg/m³"},
                {"Young's modulus", "GPa"},
                {"Poisson's ratio"}},
               rows);
  rows.clear();
  const auto stiffness = [](const Json& value) {
    return value.is_null() ? std::string("default") : digits(value, 4, 1e9);
  };
  for (const Json& m : setup.at("joint_materials"))
    rows.push_back({m.at("name"), digits(m.at("friction_angle")), digits(m.at("cohesion"), 4, 1e3),
                    digits(m.at("tensile_strength"), 4, 1e3),
                    digits(m.at("residual_friction_angle")),
                    digits(m.at("residual_cohesion"), 4, 1e3), digits(m.at("dilation_angle")),
                    stiffness(m.at("normal_stiffness")), stiffness(m.at("shear_stiffness"))});
  if (!rows.empty())
    html.table("Joint materials (Mohr–Coulomb)",
               {{"material", "", true},
                {"friction", "°"},
                {"cohesion", "kPa"},
                {"tension", "kPa"},
                {"residual friction", "°"},
                {"residual cohesion", "kPa"},
                {"dilation", "°"},
                {"normal stiffness", "GPa/m"},
                {"shear stiffness", "GPa/m"}},
               rows);
}

void add_net(Html& html, const ReportSource& source) {
  const Json& setup = source.answer.at("setup");
  NetContent net;
  net.title_of_document = "Stereonet";
  for (const Json& joint : setup.at("joints"))
    net.planes.push_back({joint.at("name"), joint.at("normal").get<Vec3>(), joint.at("dip"),
                          joint.at("dip_direction")});
  for (const auto& [joint, normal] : source.poles) {
    const auto plane = std::find_if(net.planes.begin(), net.planes.end(),
                                    [&name = joint](const NetPlane& p) { return p.name == name; });
    net.poles.push_back({normal, static_cast<std::size_t>(plane - net.planes.begin())});
  }
  for (const Json& m : setup.at("joint_materials"))
    net.friction_angles.push_back(m.at("friction_angle"));
  net.equal_area = true;
  html.figure(draw_net(net),
              "Joints between blocks. Poles inside a friction circle belong to planes too gentle "
              "to slide on.");
}

}  // namespace

const Json& ReportSource::support() const {
  static const Json none_found = nullptr;
  if (answer.contains("support")) return answer.at("support");
  return answer.contains("keyblocks") ? answer : none_found;
}

void add_summary(Html& html, const ReportSource& source) {
  const Json& answer = source.answer;
  const Json& totals = answer.at("totals");
  Facts facts{{"Result", source.file},
              {"Made by", fmt::format("rockfold {} {} (commit {})", source.version, source.command,
                                      source.commit.empty() ? "unknown" : source.commit)},
              {"Model", "SHA-256 " + sha256(source.model)},
              {"Blocks", digits(totals.at("blocks"), 8)}};
  if (const Json& support = source.support(); !support.is_null()) {
    const Json& sums = support.at("totals");
    const Json& first = sums.at("first_batch");
    facts.emplace_back(
        "Key blocks",
        fmt::format("{} in {} {}, {} m³; support force {}", sums.at("keyblocks").get<Index>(),
                    sums.at("batches").size(), sums.at("batches").size() == 1 ? "batch" : "batches",
                    digits(sums.at("keyblock_volume")), quantity(sums.at("support_force"), "N")));
    facts.emplace_back(
        "First batch",
        fmt::format("{} key blocks, {} m³; support force {}", first.at("keyblocks").get<Index>(),
                    digits(first.at("volume")), quantity(first.at("support_force"), "N")));
    // Results of programs before these keys do without.
    if (const Json doubtful = sums.value("below_target", Json{{"blocks", 0}});
        doubtful.at("blocks") > 0)
      facts.emplace_back(
          "Below the target",
          fmt::format("{} that {}; support force {}", doubtful.at("blocks").get<Index>(),
                      doubtful.at("blocks") == 1 ? "stays" : "stay",
                      quantity(doubtful.at("support_force"), "N")));
    if (sums.value("further_batches", "") == "not_examined")
      facts.emplace_back("Further batches", "not looked for (support.batches)");
  }
  if (source.has_run()) {
    facts.emplace_back("Analysis",
                       fmt::format("{} steps to {} s{}", totals.at("steps").get<Index>(),
                                   digits(totals.at("time")),
                                   totals.value("interrupted", false) ? ", interrupted" : ""));
    facts.emplace_back("Largest displacement", quantity(totals.at("largest_displacement"), "m"));
  }
  facts.emplace_back("Warnings",
                     answer.at("warnings").empty()
                         ? "none"
                         : fmt::format("{}, listed at the end", answer.at("warnings").size()));
  html.facts(facts);
}

void add_model(Html& html, const ReportSource& source) {
  const Json& setup = source.answer.at("setup");
  html.heading(2, "Model");
  Facts facts{{"Consists of", count_text(setup.at("counts"))},
              {"Gravity", vector_text(setup.at("gravity")) + " m/s² (east, north, up)"}};
  if (!setup.at("files").empty())
    facts.emplace_back("Files", joined(setup.at("files")) + " (not part of the model's SHA-256)");
  if (setup.contains("support")) {
    const Json& s = setup.at("support");
    facts.emplace_back("Target factor of safety", digits(s.at("target_factor_of_safety")));
    add_water(facts, s);
    if (s.at("seismic_coefficient") != Json(Vec3{}))
      facts.emplace_back("Seismic coefficient", vector_text(s.at("seismic_coefficient")));
  }
  if (setup.contains("analysis")) {
    const Json& a = setup.at("analysis");
    facts.emplace_back("Kinematics", a.at("kinematics").get<std::string>() + " displacements");
    if (a.contains("lattice"))
      facts.emplace_back(
          "Cover", fmt::format("lattice {}{}, order {}, joints {}{}",
                               a.at("lattice").get<std::string>(), spacing_text(a.at("spacing")),
                               a.at("order").get<int>(), a.at("joints").get<std::string>(),
                               a.at("contact").get<bool>() ? ", blocks in contact" : ""));
  }
  html.facts(facts);
  add_materials(html, setup);
}

void add_block_sizes(Html& html, const ReportSource& source) {
  if (!source.answer.contains("statistics")) return;
  const Json& volume = source.answer.at("statistics").at("volume");
  html.heading(2, "Sizes of blocks");
  std::vector<std::vector<std::string>> rows(2);
  std::vector<HtmlColumn> columns{{"share of the blocks", "", true}};
  rows[0].emplace_back("by number");
  rows[1].emplace_back("by volume");
  for (const auto& [name, value] : volume.at("by_number").items()) {
    columns.push_back({name, "m³"});
    rows[0].push_back(digits(value, 3));
    rows[1].push_back(digits(volume.at("by_volume").at(name), 3));
  }
  html.table(
      "D50: half of the blocks are smaller. Mean volume " + quantity(volume.at("mean"), "m³"),
      columns, rows);
}

void add_joints(Html& html, const ReportSource& source) {
  const Json& joints = source.answer.at("setup").at("joints");
  if (joints.empty() && source.poles.empty()) return;
  html.heading(2, "Joints");
  std::vector<std::vector<std::string>> rows;
  for (const Json& j : joints)
    rows.push_back({j.at("name"), j.at("kind"), digits(j.at("dip"), 3),
                    digits(j.at("dip_direction"), 3), scatter_text(j), density_text(j),
                    radius_text(j), j.at("material")});
  html.table("",

             {{"joint", "", true},
              {"kind", "", true},
              {"dip", "°"},
              {"dip direction", "°"},
              {"Fisher's κ"},
              {"spacing", "m"},
              {"radius", "m"},
              {"material", "", true}},
             rows);
  std::string files;
  for (const Json& file : source.answer.at("setup").value("joint_files", Json::array())) {
    const bool mesh = file.at("kind") == "mesh";
    files += fmt::format("{}{} ({} of {} {})", files.empty() ? "" : ", ",
                         file.at("name").get<std::string>(), mesh ? "a mesh" : "a table",
                         file.at(mesh ? "triangles" : "joints").get<Index>(),
                         mesh ? "triangles" : "joints");
  }
  if (!files.empty()) html.paragraph("Joints from files: " + files + ".");
  add_net(html, source);
}

void add_warnings(Html& html, const ReportSource& source) {
  const Json& warnings = source.answer.at("warnings");
  const Json& unused = source.answer.at("unused");
  if (warnings.empty() && unused.empty()) return;
  html.heading(2, "Warnings");
  if (!warnings.empty()) html.list(warnings.get<std::vector<std::string>>());
  if (!unused.empty())
    html.paragraph(fmt::format("Not used by `{}`: {}.", source.command, joined(unused)));
}

void add_model_text(Html& html, const ReportSource& source) {
  html.heading(2, "Appendix: the model");
  html.paragraph("As read, with what the command line changed. SHA-256 " + sha256(source.model));
  html.preformatted(source.model);
}

}  // namespace rockfold
