// [[bolt_type]], [[bolt]], [[bolt_pattern]], [shotcrete] and [pattern_search].
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/read/read_walls.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/value.hpp"

namespace rockfold {

namespace {

constexpr Real longest_bolt = 1000;  // m

Range bolt_length() {
  return {.low = 0, .high = longest_bolt, .low_open = true, .unit = "m"};
}

const std::vector<std::string> capacity_keys{
    "coupling",       "force_capacity", "displacement_capacity",
    "plate_capacity", "bond_strength",  "anchor_length",
    "shear_capacity", "stiffness",      "action",
    "efficiency",     "mass_per_metre", "young_modulus",
    "diameter",       "yield",          "rupture",
    "bond_stiffness", "pretension"};

void read_coupling(TableReader& in, BoltType& type) {
  const auto coupling = in.choose("coupling", {{"CMC", "CFC", "DMFC"}, {}}, Need::optional);
  if (coupling) type.coupling = static_cast<Coupling>(*coupling);
  in.read("anchor_length", type.anchor_length, length());
  const bool discrete = type.coupling == Coupling::dmfc;
  if (type.anchor_length && !discrete)
    in.wrong("anchor_length", "belongs to coupling \"DMFC\": the others are held all along");
  if (discrete && type.bond_strength && !type.anchor_length)
    in.missing({"anchor_length"},
               "is missing: with a bond_strength, coupling \"DMFC\" needs it, " + length().text());
  const auto action = in.choose("action", {{"active", "passive"}, {}}, Need::optional);
  type.action = action     ? static_cast<BoltAction>(*action)
                : discrete ? BoltAction::active
                           : BoltAction::passive;
}

/// What makes it an element of an analysis.
void read_element(TableReader& in, BoltType& type) {
  in.read("young_modulus", type.young_modulus, positive("Pa"));
  in.read("diameter", type.diameter, length());
  in.read("yield", type.yield, positive("Pa"));
  in.read("rupture", type.rupture, Range{.low = 0, .high = 1, .low_open = true, .unit = ""});
  in.read("bond_stiffness", type.bond_stiffness, positive("N/m per m"));
  in.read("pretension", type.pretension, not_negative("N"));
  if (type.force_capacity > 0 && type.pretension.value_or(0) > type.force_capacity)
    in.wrong("pretension", "found " + number_text(*type.pretension) +
                               " N, more than the force_capacity of " +
                               number_text(type.force_capacity) + " N");
  if (!type.yield) return;
  if (!type.diameter) {
    in.missing({"diameter"}, "is missing: with a yield stress it is needed, " + length().text());
    return;
  }
  const Real force = *type.yield * std::numbers::pi / 4 * *type.diameter * *type.diameter;
  if (type.force_capacity > 0 && force > (1 + 1e-9) * type.force_capacity)
    in.wrong("yield", "over the section it is " + number_text(std::round(force)) +
                          " N, more than the force_capacity of " +
                          number_text(type.force_capacity) + " N");
}

BoltType read_capacities(TableReader& in) {
  BoltType type;
  const bool force = in.read("force_capacity", type.force_capacity, positive("N"));
  const bool displacement =
      in.read("displacement_capacity", type.displacement_capacity, positive("m"));
  if (!in.read("plate_capacity", type.plate_capacity, not_negative("N"), Need::optional))
    type.plate_capacity = type.force_capacity;
  in.read("bond_strength", type.bond_strength, positive("N/m"));
  in.read("shear_capacity", type.shear_capacity, not_negative("N"), Need::optional);
  if (!in.read("stiffness", type.stiffness, positive("N/m"), Need::optional) && force &&
      displacement)
    type.stiffness = type.force_capacity / type.displacement_capacity;
  const auto efficiency = in.choose("efficiency", {{"full", "cosine"}, {}}, Need::optional);
  if (efficiency) type.efficiency = static_cast<BoltEfficiency>(*efficiency);
  in.read("mass_per_metre", type.mass_per_metre, positive("kg/m"));
  read_coupling(in, type);
  read_element(in, type);
  return type;
}

/// Into Analysis::stages: the one at whose start rock of this stage of excavation goes; before all of them where no step takes it.
Index stage_of_excavation(const Model& model, Index stage) {
  if (!model.analysis) return 0;
  const auto& stages = model.analysis->stages;
  const auto takes = std::find_if(stages.begin(), stages.end(),
                                  [&](const auto& s) { return s.excavate == stage; });
  return takes == stages.end() ? 0 : static_cast<Index>(takes - stages.begin());
}

/// "install" names a stage of excavation or a step: into Analysis::stages. Without one it is `otherwise`.
void read_install(TableReader& in, const Draft& draft, Index& target, Index otherwise = 0) {
  target = otherwise;
  const Value* value = in.find("install");
  if (!value) return;
  const auto text = text_from(*value, in.path_of("install"), in.out());
  if (!text) return;
  static const std::vector<AnalysisStage> no_stages;
  const auto& stages = draft.model.analysis ? draft.model.analysis->stages : no_stages;
  for (std::size_t s = 0; s < stages.size(); ++s)
    if (!stages[s].name.empty() && stages[s].name == *text) {
      target = static_cast<Index>(s);
      return;
    }
  for (const Excavation& e : draft.model.excavations)
    if (*text == "stage " + std::to_string(e.stage)) {
      target = stage_of_excavation(draft.model, e.stage);
      return;
    }
  std::vector<std::string> names;
  for (const AnalysisStage& stage : stages)
    if (!stage.name.empty()) names.push_back(stage.name);
  for (const Excavation& e : draft.model.excavations)
    names.push_back("stage " + std::to_string(e.stage));
  in.wrong("install", "found \"" + *text +
                          "\", which is neither the name of a [[step]] nor "
                          "\"stage N\" of an [[excavation]]" +
                          suggestion(*text, names, "there are"));
}

/// "type" names a [[bolt_type]]; without it the capacities stand here.
BoltType read_type(TableReader& in, const Draft& draft) {
  if (!in.has("type")) return read_capacities(in);
  for (const auto& key : capacity_keys)
    if (in.has(key)) in.wrong(key, "is given by the bolt type; leave one of both out");
  Index type = none;
  if (in.read_reference("type", draft.bolt_types, type) && type != none)
    return draft.model.bolt_types[type];
  return {};
}

/// Into Analysis::stages: that of walls, when the last of them is there.
Index when_made(const Model& model, const std::vector<WallFaces>& walls) {
  Index last = 0;
  for (const WallFaces& wall : walls)
    if (wall.excavation && wall.owner != none)
      last = std::max(last, stage_of_excavation(model, model.excavations[wall.owner].stage));
  return last;
}

/// Whether a bolt is shorter than its anchor, beyond rounding.
bool too_short(Real length, const BoltType& type) {
  return length > 0 && type.anchor_length && *type.anchor_length > (1 + 1e-9) * length;
}

/// The anchor is a part of the bolt.
void check_anchor(TableReader& in, const BoltType& type, Real length) {
  if (!too_short(length, type)) return;
  const std::string sizes = "the anchor of " + number_text(*type.anchor_length) +
                            " m is longer than the bolt of " + number_text(length) + " m";
  if (in.has("anchor_length"))
    in.wrong("anchor_length", sizes + ", must be at most the bolt's length");
  else
    in.wrong(in.has("toe") ? "toe" : "length", sizes + ": see anchor_length of the bolt type");
}

void read_bolt_direction(TableReader& in, Vec3& target) {
  Vec3 direction{};
  if (in.read_direction("direction", direction)) target = unit_normal(direction);
}

void read_inclination(TableReader& in, std::array<Real, 2>& target) {
  const Value* value = in.find("inclination");
  const std::string path = in.path_of("inclination");
  const auto* list = value ? array_from(*value, path, 2, "2 angles", in.out()) : nullptr;
  if (!list) return;
  for (std::size_t i = 0; i < 2; ++i)
    if (const auto x = real_from((*list)[i], item_path(path, i), between(-90, 90, "deg"), in.out()))
      target[i] = *x;
  if (list->size() > 2) in.wrong("inclination", "must be 2 angles [lowest, highest]");
  if (target[0] > target[1])
    in.wrong("inclination", "must be [lowest, highest], but the first angle is over the second");
}

/// Two lengths, or one for both.
void read_pair(TableReader& in, const std::string& key, std::array<Real, 2>& target,
               const Range& range, Need need) {
  const Value* value =
      in.find(key, need == Need::required ? "must be 2 lengths, each > 0 (m)" : "");
  if (!value) return;
  const std::string path = in.path_of(key);
  const auto* list = std::get_if<Array>(&value->data);
  if (!list) {
    if (const auto x = real_from(*value, path, range, in.out())) target = {*x, *x};
    return;
  }
  if (list->size() != 2) {
    in.wrong(key, "found " + described(*value) + ", must be 2 lengths (m)");
    return;
  }
  for (std::size_t i = 0; i < 2; ++i)
    if (const auto x = real_from((*list)[i], item_path(path, i), range, in.out())) target[i] = *x;
}

/// No face may carry two grids.
void require_apart(TableReader& in, const std::vector<WallFaces>& walls) {
  if (!in.has("on"))
    in.missing({"on"}, "is missing, must name an excavation, a solid or a face of one");
  for (std::size_t i = 0; i < walls.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (walls[i].shares_faces_with(walls[j]))
        in.wrong("on", "\"" + walls[j].name + "\" and \"" + walls[i].name +
                           "\" have faces in common, which would get two grids");
}

/// What patterns and the search for one have in common.
void read_layout(TableReader& in, const Draft& draft, BoltPattern& pattern) {
  pattern.on = read_walls(in, "on", draft);
  require_apart(in, pattern.on);
  const auto layout = in.choose("layout", {{"rectangular", "staggered"}, {}}, Need::optional);
  pattern.staggered = layout && *layout == 1;
  read_pair(in, "offset", pattern.offset, coordinate(), Need::optional);
  read_inclination(in, pattern.inclination);
  if (in.has("direction")) {
    Vec3 direction{};
    read_bolt_direction(in, direction);
    pattern.direction = direction;
  }
}

/// An array of lengths, ascending and each once.
std::vector<Real> read_lengths(TableReader& in, const std::string& key, const Range& range) {
  std::vector<Real> lengths;
  const Value* value = in.find(key, "must be an array of lengths (m)");
  const auto* list =
      value ? array_from(*value, in.path_of(key), 1, "an array of lengths (m)", in.out()) : nullptr;
  for (std::size_t i = 0; list && i < list->size(); ++i)
    if (const auto x = real_from((*list)[i], item_path(in.path_of(key), i), range, in.out()))
      lengths.push_back(*x);
  std::sort(lengths.begin(), lengths.end());
  lengths.erase(std::unique(lengths.begin(), lengths.end()), lengths.end());
  return lengths;
}

std::vector<Index> read_searched_types(TableReader& in, const Draft& draft) {
  std::vector<Index> types;
  const Value* value = in.find("types");
  if (!value) {
    for (std::size_t i = 0; i < draft.bolt_types.all().size(); ++i)
      types.push_back(static_cast<Index>(i));
    if (types.empty() && draft.bolt_types.complete())
      in.missing({"types"}, "the model has no [[bolt_type]]: there is no catalogue to choose from");
    return types;
  }
  const std::string path = in.path_of("types");
  const auto* list = array_from(*value, path, 1, "names of bolt types", in.out());
  for (std::size_t i = 0; list && i < list->size(); ++i) {
    const auto name = text_from((*list)[i], item_path(path, i), in.out());
    if (!name) continue;
    const Index type = draft.bolt_types.find(*name);
    if (type != none)
      types.push_back(type);
    else if (draft.bolt_types.complete())
      in.out().add((*list)[i].spot, item_path(path, i), "unknown bolt type \"" + *name + "\"");
  }
  return types;
}

/// Patterns can be compared by their mass only where all types have one.
void check_masses(TableReader& in, const Draft& draft, const std::vector<Index>& types) {
  const auto has_mass = [&](Index t) {
    return draft.model.bolt_types[t].mass_per_metre.has_value();
  };
  const auto with = std::count_if(types.begin(), types.end(), has_mass);
  if (with != 0 && with != static_cast<std::ptrdiff_t>(types.size()))
    in.wrong("types",
             "some bolt types have a mass_per_metre and others have none: give it to all "
             "or to none of them");
}

/// Each type needs a length that holds its anchor; shorter ones are not tried with it.
void check_anchors(TableReader& in, const Draft& draft, const PatternSearch& search) {
  for (const Index t : search.types) {
    const BoltType& type = draft.model.bolt_types[t];
    if (!search.lengths.empty() && too_short(search.lengths.back(), type))
      in.wrong("length", "no bolt is as long as the anchor of " + type.name + " (" +
                             number_text(*type.anchor_length) + " m)");
  }
}

}  // namespace

void read_bolt_types(Draft& draft) {
  read_entries(draft, "bolt_type", [&](TableReader& in, Index number) {
    const std::string name = in.read_name(draft.bolt_types, "type" + std::to_string(number));
    BoltType type = read_capacities(in);
    type.name = name;
    draft.model.bolt_types.push_back(std::move(type));
  });
}

void read_bolts(Draft& draft) {
  read_entries(draft, "bolt", [&](TableReader& in, Index number) {
    SpotBolt bolt;
    bolt.name = in.read_name(draft.bolts, "bolt" + std::to_string(number));
    bolt.place = in.place();
    const bool collar = in.read("collar", bolt.collar, coordinate());
    if (in.has("toe")) {
      Vec3 toe{};
      const bool good = in.read("toe", toe, coordinate()) && collar;
      for (const char* other : {"direction", "length"})
        if (in.has(other)) in.wrong(other, "is given by collar and toe; leave it out");
      if (good && norm(toe - bolt.collar) > 0) {
        bolt.length = norm(toe - bolt.collar);
        bolt.direction = normalized(toe - bolt.collar);
        if (bolt.length > longest_bolt) in.wrong("toe", "makes the bolt longer than 1000 m");
      } else if (good) {
        in.wrong("toe", "is the collar, must be the bolt's other end");
      }
    } else {
      read_bolt_direction(in, bolt.direction);
      in.read("length", bolt.length, bolt_length());
    }
    bolt.type = read_type(in, draft);
    check_anchor(in, bolt.type, bolt.length);
    read_install(in, draft, bolt.install);
    draft.model.bolts.push_back(std::move(bolt));
  });
}

void read_bolt_patterns(Draft& draft) {
  read_entries(draft, "bolt_pattern", [&](TableReader& in, Index number) {
    BoltPattern pattern;
    pattern.name = in.read_name(draft.bolts, "pattern" + std::to_string(number));
    pattern.place = in.place();
    read_layout(in, draft, pattern);
    read_pair(in, "spacing", pattern.spacing, length(), Need::required);
    in.read("length", pattern.length, bolt_length());
    pattern.type = read_type(in, draft);
    check_anchor(in, pattern.type, pattern.length);
    read_install(in, draft, pattern.install, when_made(draft.model, pattern.on));
    draft.model.bolt_patterns.push_back(std::move(pattern));
  });
}

void read_shotcrete(Draft& draft) {
  read_section(draft, "shotcrete", [&](TableReader& in) {
    Shotcrete shotcrete;
    shotcrete.place = in.place();
    shotcrete.on = read_walls(in, "on", draft);
    if (!in.has("on"))
      in.missing({"on"}, "is missing, must name the walls: an excavation, a solid or a face");
    in.read("thickness", shotcrete.thickness, length());
    in.read("shear_strength", shotcrete.shear_strength, positive("Pa"));
    in.read("adhesion_strength", shotcrete.adhesion_strength, positive("Pa"));
    in.read("bond_width", shotcrete.bond_width, length(), Need::optional);
    if (in.has("bond_width") && !in.has("adhesion_strength"))
      in.wrong("bond_width", "belongs to the adhesion, but there is no adhesion_strength");
    read_install(in, draft, shotcrete.install, when_made(draft.model, shotcrete.on));
    draft.model.shotcrete = std::move(shotcrete);
  });
}

void read_pattern_search(Draft& draft) {
  read_section(draft, "pattern_search", [&](TableReader& in) {
    PatternSearch search;
    search.place = in.place();
    read_layout(in, draft, search.pattern);
    search.pattern.name = "search";
    search.pattern.place = search.place;
    search.spacings = read_lengths(in, "spacing", length());
    search.lengths = read_lengths(in, "length", bolt_length());
    search.types = read_searched_types(in, draft);
    check_masses(in, draft, search.types);
    check_anchors(in, draft, search);
    const auto hold = in.choose("hold", {{"all", "first_batch"}, {}}, Need::optional);
    if (hold) search.hold = static_cast<HoldTarget>(*hold);
    in.read("smallest_block", search.smallest_block, not_negative("m3"), Need::optional);
    draft.model.pattern_search = std::move(search);
  });
}

}  // namespace rockfold
