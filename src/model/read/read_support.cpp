// [support], and [[water]], the load of block theory that it does not share with other analyses.
#include <algorithm>

#include "src/base/vector.hpp"
#include "src/model/openings.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/read_loads.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

/// "joints" of [[water]]: names of joints, each in one entry only.
void read_wet_joints(TableReader& in, const Draft& draft, Water& water) {
  const auto* value = in.find("joints");
  const auto* names =
      value ? array_from(*value, in.path_of("joints"), 1, "name of a joint", in.out()) : nullptr;
  if (!names) return;
  for (std::size_t i = 0; i < names->size(); ++i) {
    const std::string path = item_path(in.path_of("joints"), i);
    const auto name = text_from((*names)[i], path, in.out());
    if (!name) continue;
    if (!is_joint(draft, *name)) {
      if (draft.joints.complete() && draft.solids.complete())
        in.out().add((*names)[i].spot, path,
                     "there is no joint named \"" + *name +
                         "\", and no solid with an interface of that name (\"dam.interface\")");
      continue;
    }
    const auto names_it = [&](const Water& other) {
      return std::find(other.joints.begin(), other.joints.end(), *name) != other.joints.end();
    };
    const auto& others = draft.model.waters;
    if (std::any_of(others.begin(), others.end(), names_it) || names_it(water))
      in.out().add((*names)[i].spot, path, "the water of \"" + *name + "\" is already given");
    water.joints.push_back(*name);
  }
}

void read_table(TableReader& in, Water& water) {
  const Value& value = *in.find("table");
  if (std::holds_alternative<double>(value.data) ||
      std::holds_alternative<std::int64_t>(value.data)) {
    in.wrong("table",
             "found " + described(value) + ", must be a plane, {point = [0, 0, " +
                 described(value) +
                 "]}; of water that stands level, its height is head = " + described(value));
    return;
  }
  TableReader table(*in.find("table"), in.path_of("table"), in.out());
  if (!table.is_table()) return;
  WaterTable level{{}, {0, 0, 1}};
  if (table.has("dip") || table.has("dip_direction") || table.has("normal")) {
    Orientation orientation;
    if (read_orientation(table, orientation)) level.normal = unit_normal(orientation);
  }
  table.read("point", level.point, coordinate());
  water.level = level;
}

/// Exactly one of pressure, table and head.
void read_level(TableReader& in, Water& water) {
  std::vector<std::string> given;
  for (const char* key : {"pressure", "pressure_table", "table", "head", "head_table"})
    if (in.has(key)) given.emplace_back(key);
  if (given.empty())
    in.missing({"pressure", "pressure_table", "table", "head", "head_table"},
               "says not how high the water stands: must have one of pressure, table or head, or "
               "pressure_table or head_table over time");
  if (given.size() > 1)
    in.wrong(given[1], "has both " + given[0] + " and " + given[1] +
                           ", must have one of pressure, table or head");
  WaterPressure pressure;
  if (in.read("pressure", pressure.value, not_negative("Pa"), Need::optional))
    water.level = pressure;
  if (in.has("table")) read_table(in, water);
  WaterHead head;
  if (in.read("head", head.elevation, coordinate(), Need::optional)) water.level = head;
  read_time_table(in, "pressure_table", 1, not_negative("Pa"), water.course);
  read_time_table(in, "head_table", 1, coordinate(), water.course);
  if (water.course.empty()) return;
  constexpr Real time_of_statics = 1;  // s, as of loads over time
  const Real usual = water.course.at(time_of_statics)[0];
  if (in.has("head_table"))
    water.level = WaterHead{usual};
  else
    water.level = WaterPressure{usual};
}

/// How the pressure goes on to edges that drain. Both may be left out.
void read_law(TableReader& in, Water& water) {
  bool drains = true;
  if (in.read("drains", drains, Need::optional)) water.drains = drains;
  const auto law = in.choose("law", {{"hydrostatic", "drained", "mid_height"}, {}}, Need::optional);
  if (!law) return;
  water.law = static_cast<WaterLaw>(*law);
  const bool needs_drains = water.law != WaterLaw::hydrostatic;
  if (water.drains && *water.drains != needs_drains)
    in.wrong("law", needs_drains
                        ? "has no pressure at edges that drain, but drains is false: must be "
                          "\"hydrostatic\", or drains true"
                        : "has its full pressure at the very edge, but drains is true: must be "
                          "\"drained\" or \"mid_height\", or drains false");
}

/// What becomes of it where a joint opens.
void read_opening(TableReader& in, Water& water) {
  const auto kind = in.choose("when_open", {{"stays", "drains"}, {}}, Need::optional);
  Real aperture = 1e-3;
  const bool given = in.read("aperture", aperture, positive("m"), Need::optional);
  if (kind && *kind == 1)
    water.drained_at = aperture;
  else if (given)
    in.wrong("aperture",
             "is the opening at which a joint has drained: needs when_open = \"drains\"");
}

void read_batches(TableReader& in, SupportSpec& support) {
  Index batches = 0;
  if (in.read("batches", batches, IntegerRange{.low = 0}, Need::optional))
    support.batches = batches;
}

}  // namespace

void read_support(Draft& draft) {
  read_section(draft, "support", [&](TableReader& in) {
    SupportSpec support;
    in.read("joint_faces_only", support.joint_faces_only, Need::optional);
    in.read("water_pressure", support.water_pressure, not_negative("Pa"), Need::optional);
    in.read("seismic_coefficient", support.seismic_coefficient, any_number("fraction of g"),
            Need::optional);
    in.read("target_factor_of_safety", support.target_factor_of_safety, positive(""),
            Need::optional);
    Vec3 direction{};
    if (in.has("support_direction") && in.read_direction("support_direction", direction))
      support.support_direction = unit_normal(direction);
    in.read("rotation", support.rotation, Need::optional);
    in.read("largest_group", support.largest_group, IntegerRange{.low = 1, .high = 1000},
            Need::optional);
    read_batches(in, support);
    in.read("smallest_block", support.smallest_block, not_negative("m3"), Need::optional);
    const auto stress = in.choose("stress", {{"elastic", "far_field"}, {}}, Need::optional);
    support.stress = stress ? static_cast<JointStress>(*stress) : usual_joint_stress(draft.model);
    in.read("clamping", support.clamping, Need::optional);
    draft.model.support = support;
  });
}

void read_waters(Draft& draft) {
  bool default_given = false;
  read_entries(draft, "water", [&](TableReader& in, Index) {
    Water water;
    water.place = in.place();
    read_wet_joints(in, draft, water);
    if (!in.has("joints")) {
      if (default_given) in.wrong("", "an entry without joints was given before: name the joints");
      default_given = true;
    }
    in.read("density", water.density, positive("kg/m3"), Need::optional);
    in.read("factor", water.factor, between(0, 1, "of the pressure"), Need::optional);
    read_level(in, water);
    read_law(in, water);
    read_opening(in, water);
    if (draft.model.gravity == Vec3{} && !in.has("pressure"))
      in.wrong("", "gravity is zero: a water table or head gives no pressure");
    draft.model.waters.push_back(std::move(water));
  });
}

}  // namespace rockfold
