// Key blocks, the support designed for them, and classification.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "src/printed/sections.hpp"
#include "src/report/summaries/keyblock_words.hpp"

namespace rockfold {

namespace {

using Rows = std::vector<std::vector<std::string>>;
constexpr std::size_t most_rows = 600;   // of key blocks: some twelve pages
constexpr std::size_t most_stable = 10;  // of blocks that stay

std::string motion_text(const Json& key) {
  const std::string words = mode_words(key);
  return key.at("planes").empty() ? words : words + ": " + joined(key.at("planes"));
}

/// "12", of a group "12, 15".
std::string blocks_text(const Json& key) {
  std::string text;
  for (const Json& id : key.at("blocks"))
    text += fmt::format("{}{}", text.empty() ? "" : ", ", id.get<Index>());
  return text.empty() ? fmt::format("{}", key.at("block").get<Index>()) : text;
}

std::string safety_text(const Json& factor) {
  if (!factor.is_number()) return "none";
  return factor > 100 ? "> 100" : digits(factor, 3);
}

bool is_supported(const Json& keys) {
  return std::any_of(keys.begin(), keys.end(),
                     [](const Json& key) { return key.contains("supported_factor_of_safety"); });
}

/// The factor of joints that have slipped stands behind that of joints that have not.
constexpr std::ptrdiff_t residual_column = 7;

Json residual_factor(const Json& key) {
  return key.value("residual_factor_of_safety", key.at("factor_of_safety"));
}

/// Whether any is less safe on joints that have slipped.
bool loses_strength(const Json& keys) {
  return std::any_of(keys.begin(), keys.end(), [](const Json& key) {
    return residual_factor(key) < key.at("factor_of_safety");
  });
}

std::vector<HtmlColumn> columns(bool supported, bool slipped) {
  std::vector<HtmlColumn> list{{"block", "", true},        {"batch"},
                               {"volume", "m³"},           {"weight", "kN"},
                               {"motion", "", true},       {"direction", "trend/plunge"},
                               {"factor of safety"},       {"support force", "kN"},
                               {"support pressure", "kPa"}};
  if (slipped) list.insert(list.begin() + residual_column, {"once slipped"});
  if (supported) list.insert(list.end(), {{"bolts"}, {"with support"}, {"use", "%"}, {"held"}});
  return list;
}

std::vector<std::string> row_of(const Json& key, bool supported, bool slipped) {
  std::vector<std::string> row{blocks_text(key),
                               fmt::format("{}", key.at("batch").get<Index>()),
                               digits(key.at("volume")),
                               digits(key.at("weight"), 4, 1e3),
                               motion_text(key),
                               trend_text(key.at("direction")),
                               safety_text(key.at("factor_of_safety")),
                               digits(key.at("support_force"), 4, 1e3),
                               digits(key.at("support_pressure"), 4, 1e3)};
  if (slipped) row.insert(row.begin() + residual_column, safety_text(residual_factor(key)));
  if (supported)
    row.insert(row.end(),
               {fmt::format("{}", key.at("bolts").size()),
                safety_text(key.value("supported_factor_of_safety", Json())),
                digits(key.value("utilisation", Json()), 3),
                key.contains("adequate") ? (key.at("adequate").get<bool>() ? "yes" : "no") : ""});
  return row;
}

/// Less safe first; those that nothing holds before all others.
std::vector<Json> by_safety(const Json& keys) {
  std::vector<Json> sorted(keys.begin(), keys.end());
  const auto rank = [](const Json& key) {
    const Json& f = key.at("factor_of_safety");
    return std::pair(key.at("batch").get<Index>(), f.is_number() ? f.get<Real>() : -1);
  };
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Json& a, const Json& b) { return rank(a) < rank(b); });
  return sorted;
}

void add_batches(Html& html, const Json& support) {
  const Json& batches = support.at("totals").at("batches");
  const Json stages = support.at("totals").value("batch_stages", Json::array());
  const bool staged =
      std::any_of(stages.begin(), stages.end(), [](const Json& s) { return s > 0; });
  if (batches.size() < 2) return;
  Rows rows;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    Real volume = 0, force = 0;
    for (const Json& key : support.at("keyblocks"))
      if (key.at("batch") == i + 1)
        volume += key.at("volume").get<Real>(), force += key.at("support_force").get<Real>();
    rows.push_back({std::to_string(i + 1), fmt::format("{}", batches[i].get<Index>()),
                    digits(volume), digits(force / 1e3)});
    if (staged)
      rows.back().insert(rows.back().begin(), fmt::format("{}", stages.at(i).get<Index>()));
  }
  std::vector<HtmlColumn> columns{
      {"batch"}, {"key blocks"}, {"volume", "m³"}, {"support force", "kN"}};
  if (staged) columns.insert(columns.begin(), {"stage"});
  html.table(staged
                 ? "Batches of each stage of excavation: each can move once those before it at its "
                   "stage are gone"
                 : "Batches: each can move once those before are gone",
             columns, rows);
}

/// m³: tables leave smaller ones out.
Real smallest_block(const ReportSource& source) {
  return source.answer.at("setup").value("support", Json::object()).value("smallest_block", 0.0);
}

void add_shotcrete(Html& html, const Json& setup) {
  const Json support = setup.value("support", Json::object());
  if (!support.contains("shotcrete")) return;
  const Json& s = support.at("shotcrete");
  html.facts({{"Shotcrete on", joined(s.at("on"))},
              {"Thickness", quantity(s.at("thickness"), "m")},
              {"Shear strength", quantity(s.at("shear_strength"), "Pa")},
              {"Adhesion to the rock", s.at("adhesion_strength").is_null()
                                           ? "not looked at"
                                           : quantity(s.at("adhesion_strength"), "Pa")}});
}

}  // namespace

std::string mode_words(const Json& key) {
  const std::string mode = key.at("mode");
  if (mode == "single_plane") return "slides";
  if (mode == "two_planes") return "slides on two";
  if (mode == "rotation") return "turns";
  if (mode == "lifting") {
    const std::string words = mode_words(SlidingMode::lifting, key.at("direction").get<Vec3>());
    return words == "falls" ? words : "is " + words;
  }
  return "at rest";
}

void add_keyblocks(Html& html, const ReportSource& source) {
  const Json& support = source.support();
  if (support.is_null()) return;
  html.heading(2, "Key blocks", "keyblocks");
  const Real smallest = smallest_block(source);
  std::vector<Json> keys = by_safety(support.at("keyblocks"));
  if (keys.empty())
    html.paragraph("No block, and no group that fails one way, moves under these loads.");
  if (support.contains("stability"))
    html.paragraph(fmt::format("The whole mass, all blocks at once, {}.",
                               support.at("stability").at("in_words").get<std::string>()));
  const Json& totals = support.at("totals");
  if (const Json doubtful = totals.value("below_target", Json{{"blocks", 0}});
      doubtful.at("blocks") > 0)
    html.paragraph(fmt::format(
        "Blocks that stay, but with less than the target factor of safety: {}; they need a support "
        "force of {}.",
        doubtful.at("blocks").get<Index>(), quantity(doubtful.at("support_force"), "N")));
  if (totals.value("further_batches", "") == "not_examined")
    html.paragraph(
        "What moves once these key blocks are gone has not been looked for: support.batches = 0 "
        "does.");
  const auto small =
      std::erase_if(keys, [&](const Json& key) { return key.at("volume") < smallest; });
  add_batches(html, support);
  const bool supported = is_supported(support.at("keyblocks"));
  const bool slipped =
      loses_strength(support.at("keyblocks")) || loses_strength(support.at("stable"));
  Rows rows;
  for (std::size_t i = 0; i < std::min(keys.size(), most_rows); ++i)
    rows.push_back(row_of(keys[i], supported, slipped));
  if (!rows.empty())
    html.table("Key blocks by batch, the least safe first; `none`: nothing resists",
               columns(supported, slipped), rows);
  if (keys.size() > most_rows)
    html.paragraph(fmt::format("… and {} more: [[table]] kind = \"keyblocks\" lists them all.",
                               keys.size() - most_rows));
  if (small > 0)
    html.paragraph(fmt::format("{} key {} smaller than {} m³ not listed.", small,
                               small == 1 ? "block is" : "blocks are", digits(smallest)));
  std::vector<Json> stable = by_safety(support.at("stable"));
  std::erase_if(stable, [&](const Json& key) { return key.at("volume") < smallest; });
  rows.clear();
  const bool stable_supported = is_supported(support.at("stable"));
  for (std::size_t i = 0; i < std::min(stable.size(), most_stable); ++i)
    rows.push_back(row_of(stable[i], stable_supported, slipped));
  if (!rows.empty())
    html.table(fmt::format("The least safe of the blocks that stay ({} of {})", rows.size(),
                           stable.size()),
               columns(stable_supported, slipped), rows);
}

void add_support_design(Html& html, const ReportSource& source) {
  const Json& support = source.support();
  if (support.is_null() || !(support.contains("bolting") || support.contains("pattern_search")))
    return;
  html.heading(2, "Support design", "support");
  if (support.contains("bolting")) {
    const Json& b = support.at("bolting");
    html.facts({{"Bolts", fmt::format("{}, {} m in all", b.at("bolts").get<Index>(),
                                      digits(b.at("length")))},
                {"Held", fmt::format("{} of {} key blocks; of the first batch {} of {}",
                                     b.at("adequate").get<Index>(), support.at("keyblocks").size(),
                                     b.at("first_batch_adequate").get<Index>(),
                                     b.at("first_batch").get<Index>())}});
    Rows rows;
    for (const Json& g : b.at("groups"))
      rows.push_back({g.at("name"), g.at("kind"), fmt::format("{}", g.at("bolts").get<Index>()),
                      g.at("coupling"), g.at("action"), digits(g.at("force_capacity"), 4, 1e3),
                      digits(g.at("displacement_capacity"), 4, 1e-3),
                      digits(g.value("wall_area", Json()))});
    if (!rows.empty())
      html.table("",
                 {{"bolts", "", true},
                  {"kind", "", true},
                  {"number"},
                  {"coupling"},
                  {"action"},
                  {"capacity", "kN"},
                  {"displacement capacity", "mm"},
                  {"wall", "m²"}},
                 rows);
    add_shotcrete(html, source.answer.at("setup"));
    html.paragraph(
        "Supported factors, bolts that cross and their use stand in the table of key blocks.",
        "note");
  }
  if (!support.contains("pattern_search")) return;
  const Json& search = support.at("pattern_search");
  Rows rows;
  for (const Json& t : search.at("tried"))
    rows.push_back(
        {t.at("type"),
         vector_text(t.at("spacing").is_array() ? t.at("spacing") : Json::array({t.at("spacing")})),
         digits(t.at("length")), fmt::format("{}", t.at("bolts").get<Index>()),
         fmt::format("{} of {}", t.at("held").get<Index>(), search.at("key_blocks").get<Index>()),
         safety_text(t.at("least_factor_of_safety")),
         t == search.at("best")                 ? "best"
         : t == search.value("nearest", Json()) ? "nearest"
                                                : ""});
  html.table("Patterns tried",
             {{"bolt", "", true},
              {"spacing", "m"},
              {"length", "m"},
              {"bolts"},
              {"held"},
              {"least factor"},
              {"", "", true}},
             rows);
  for (const auto& [key, text] : {std::pair{"not_held", "With the nearest pattern key blocks stay"},
                                  std::pair{"disturbed", "Its active bolts bring blocks"}})
    if (const Json left = search.value(key, Json::array()); !left.empty())
      html.paragraph(fmt::format("{} below the target factor of safety: {}.", text,
                                 fmt::join(left.get<std::vector<Index>>(), ", ")));
}

namespace {

/// What a part of the document has of these, with their units.
struct Parameter {
  const char* key;
  const char* name;
  const char* unit;
};

void add_parameters(Html& html, const std::string& title, const Json& parts,
                    const std::vector<Parameter>& parameters) {
  html.heading(3, title);
  std::vector<std::pair<std::string, std::string>> facts;
  for (const auto& [key, name, unit] : parameters) {
    const Json value = parts.value(key, Json());
    if (value.is_number()) facts.emplace_back(name, quantity(value, unit));
    if (value.is_string()) facts.emplace_back(name, value.get<std::string>());
  }
  html.facts(facts);
}

}  // namespace

void add_classification(Html& html, const ReportSource& source) {
  const Json& support = source.support();
  if (support.is_null() || !support.contains("classification")) return;
  const Json& c = support.at("classification");
  html.heading(2, "Classification", "classification");
  if (c.contains("q"))
    add_parameters(html, "Q (Barton)", c.at("q"),
                   {{"rqd", "RQD", "%"},
                    {"jn", "Jn", ""},
                    {"jr", "Jr", ""},
                    {"ja", "Ja", ""},
                    {"jw", "Jw", ""},
                    {"srf", "SRF", ""},
                    {"value", "Q", ""},
                    {"class", "Class", ""},
                    {"unsupported_span", "Unsupported span", "m"},
                    {"roof_bolt_length", "Roof bolts", "m"},
                    {"wall_bolt_length", "Wall bolts", "m"},
                    {"roof_pressure", "Roof pressure", "Pa"}});
  if (c.contains("rmr")) {
    add_parameters(html, "RMR 89 (Bieniawski)", c.at("rmr"),
                   {{"value", "RMR", ""},
                    {"class", "Class", ""},
                    {"rock", "Rock", ""},
                    {"rqd", "RQD", "%"},
                    {"spacing", "Spacing", "m"},
                    {"roof_pressure", "Roof pressure", "Pa"},
                    {"deformation_modulus", "Deformation modulus", "Pa"}});
    add_parameters(html, "Ratings of RMR", c.at("rmr").at("ratings"),
                   {{"strength", "Strength", ""},
                    {"rqd", "RQD", ""},
                    {"spacing", "Spacing", ""},
                    {"joint_condition", "Condition of joints", ""},
                    {"groundwater", "Groundwater", ""},
                    {"orientation", "Orientation", ""}});
  }
  add_parameters(html, "What block theory asks for", c.at("block_theory"),
                 {{"keyblocks", "Key blocks", ""},
                  {"support_force", "Support force", "N"},
                  {"largest_pressure", "Largest pressure", "Pa"},
                  {"mean_pressure", "Mean pressure", "Pa"},
                  {"deepest", "Deepest key block", "m"}});
}

}  // namespace rockfold
