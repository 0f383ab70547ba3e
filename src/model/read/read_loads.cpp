// [[traction]], [[point_load]], [[quiet_boundary]], [[initial_velocity]], [initial_stress] and [base_acceleration].
#include "src/model/read/read_loads.hpp"

#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_region.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/text/numbers/units.hpp"

namespace rockfold {

namespace {

/// Exactly one of `keys` should be there. Reports otherwise.
void require_one(TableReader& in, const std::vector<std::string>& keys, const std::string& unit) {
  std::vector<std::string> given;
  std::string list;
  for (const auto& key : keys) {
    if (in.has(key)) given.push_back(key);
    list += (list.empty() ? "" : key == keys.back() ? " or " : ", ") + key;
  }
  if (given.empty()) in.missing(keys, "is missing, must have one of " + list + " (" + unit + ")");
  if (given.size() > 1)
    in.wrong(given[1], "give either " + given[0] + " or " + given[1] + ", not both");
}

/// Water that stands before a face.
void read_head(TableReader& in, const Vec3& gravity, Traction& traction) {
  Real head = 0;
  if (in.read("head", head, coordinate(), Need::optional)) traction.head = head;
  in.read("density", traction.density, positive("kg/m3"), Need::optional);
  if (in.has("density") && !in.has("head"))
    in.wrong("density", "is that of water up to a head, but there is no head");
  if (in.has("head") && gravity == Vec3{})
    in.wrong("head", "gravity is zero: water gives no pressure");
}

void read_traction_value(TableReader& in, const Vec3& gravity, Traction& traction) {
  require_one(in, {"value", "pressure", "value_table", "pressure_table", "head"}, "Pa; head in m");
  traction.pressure = in.has("pressure") || in.has("pressure_table") || in.has("head");
  read_head(in, gravity, traction);
  in.read("value", traction.value, any_number("Pa"), Need::optional);
  in.read("pressure", traction.value[0], any_number("Pa"), Need::optional);
  read_time_table(in, "value_table", 3, any_number("Pa"), traction.table);
  read_time_table(in, "pressure_table", 1, any_number("Pa"), traction.table);
  traction.follows = traction.pressure;
  if (in.read("follows", traction.follows, Need::optional) && traction.follows &&
      !traction.pressure)
    in.wrong("follows", "only a pressure can follow the face: a value is fixed in space");
}

/// m/s²: one of the units that records are written in.
void read_unit(TableReader& in, std::optional<Real>& target) {
  const Choice units{{"m/s2", "cm/s2", "gal", "g"}, {}};
  const auto chosen = in.choose("unit", units, Need::optional);
  if (!chosen) return;
  const std::string& unit = units.words[*chosen];
  target = number_with_unit("1 " + (unit == "gal" ? "cm/s2" : unit), "m/s2");
}

/// Whether the rows of the table are [t, a].
bool has_one_component(const Value* table) {
  const auto* rows = table ? std::get_if<Array>(&table->data) : nullptr;
  const auto* row = rows && !rows->empty() ? std::get_if<Array>(&rows->front().data) : nullptr;
  return row && row->size() == 2;
}

/// Three components, or one and its direction.
void read_record(TableReader& in, const std::string& model_path, BaseAcceleration& base) {
  require_one(in, {"table", "file"}, "m/s2");
  Vec3 direction{};
  if (in.has("direction") && in.read_direction("direction", direction))
    base.direction = normalized(direction);
  read_unit(in, base.unit);
  if (!in.has("direction") && has_one_component(in.find("table"))) {
    in.wrong("table",
             "has rows [t, a] of one component: give direction = [x, y, z], in which it acts");
    return;
  }
  read_time_table(in, "table", in.has("direction") ? 1 : 3, any_number("m/s2"), base.table);
  for (Vec3& a : base.table.value) {
    if (base.direction) a = a[0] * *base.direction;
    a = base.unit.value_or(1) * a;
  }
  if (!in.has("file")) return;
  if (auto file = read_file_name(in, model_path)) base.file = std::move(*file);
}

/// "step": the [[step]] at whose start the record begins.
void read_start(TableReader& in, const Draft& draft, BaseAcceleration& base) {
  std::string name;
  if (!in.read("step", name, Need::optional)) return;
  const std::string found = "found \"" + name + "\"";
  if (!draft.root.find("step")) {
    in.wrong("step", found + ", but there is no [[step]]");
    return;
  }
  std::string known;
  std::vector<Index> matching;
  if (draft.model.analysis)
    for (const AnalysisStage& stage : draft.model.analysis->stages) {
      if (stage.name == name)
        matching.push_back(static_cast<Index>(&stage - draft.model.analysis->stages.data()));
      known += (known.empty() ? "\"" : ", \"") + stage.name + "\"";
    }
  if (matching.empty()) {
    in.wrong("step", found + ", must be the name of a [[step]]: " + known);
    return;
  }
  if (matching.size() > 1)
    in.wrong("step", found + ", the name of " + std::to_string(matching.size()) +
                         " steps: give them different names");
  base.stage = matching.front();
  if (draft.model.analysis->stages[base.stage].type == AnalysisType::static_)
    in.wrong("step", found + ", a static step, in which nothing moves; must be a dynamic one");
}

}  // namespace

void read_time_table(TableReader& in, const std::string& key, int width, const Range& range,
                     TimeTable& target) {
  const auto* value = in.find(key);
  if (!value) return;
  if (auto table = time_table_from(*value, in.path_of(key), width, range, in.out()))
    target = std::move(*table);
}

void read_tractions(Draft& draft) {
  read_entries(draft, "traction", [&](TableReader& in, Index) {
    Traction traction;
    traction.place = in.place();
    if (const auto region = read_region(in, draft, Regions::surface)) traction.where = *region;
    read_traction_value(in, draft.model.gravity, traction);
    draft.model.tractions.push_back(std::move(traction));
  });
}

void read_point_loads(Draft& draft) {
  read_entries(draft, "point_load", [&](TableReader& in, Index) {
    PointLoad load;
    load.place = in.place();
    in.read("point", load.point, coordinate());
    require_one(in, {"force", "force_table"}, "N");
    in.read("force", load.force, any_number("N"), Need::optional);
    read_time_table(in, "force_table", 3, any_number("N"), load.table);
    draft.model.point_loads.push_back(std::move(load));
  });
}

void read_quiet_boundaries(Draft& draft) {
  read_entries(draft, "quiet_boundary", [&](TableReader& in, Index) {
    QuietBoundary boundary;
    boundary.place = in.place();
    if (const auto region = read_region(in, draft, Regions::surface)) boundary.where = *region;
    draft.model.quiet_boundaries.push_back(std::move(boundary));
  });
}

void read_initial_velocities(Draft& draft) {
  read_entries(draft, "initial_velocity", [&](TableReader& in, Index) {
    InitialVelocity start;
    start.place = in.place();
    if (const auto* where = in.find("where", "must be {block_at = [x, y, z]} or {all = true}")) {
      TableReader region(*where, in.path_of("where"), in.out());
      Vec3 point{};
      bool all = false;
      const bool at = region.has("block_at"), of_all = region.has("all");
      if (at && of_all) region.wrong("all", "has both block_at and all, must have one of them");
      if (!at && !of_all)
        region.missing({"block_at", "all"}, "says no blocks, must have block_at or all = true");
      if (region.read("block_at", point, coordinate(), Need::optional)) start.block_at = point;
      if (region.read("all", all, Need::optional) && !all)
        region.wrong("all", "found false, must be true: give block_at for one block");
    }
    in.read("velocity", start.velocity, any_number("m/s"), Need::optional);
    in.read("angular_velocity", start.angular_velocity, any_number("rad/s"), Need::optional);
    if (!in.has("velocity") && !in.has("angular_velocity"))
      in.missing({"velocity", "angular_velocity"},
                 "is missing, must have velocity (m/s), angular_velocity (rad/s) or both");
    draft.model.initial_velocities.push_back(start);
  });
}

void read_initial_stress(Draft& draft) {
  read_section(draft, "initial_stress", [&](TableReader& in) {
    InitialStress stress;
    stress.any = true;
    if (const auto* value =
            in.find("value", "must be 3 rows of 3 numbers (Pa, compression negative)"))
      if (const auto tensor = tensor_from(*value, in.path_of("value"), any_number("Pa"), in.out()))
        stress.at = *tensor;
    const auto* gradient = in.find("gradient");
    if (gradient)
      if (const auto tensor = tensor_from(*gradient, in.path_of("gradient"),
                                          any_number("Pa per m of depth"), in.out()))
        stress.gradient = *tensor;
    in.read("reference_z", stress.reference_z, coordinate(),
            gradient ? Need::required : Need::optional);
    draft.model.initial_stress = stress;
  });
}

void read_base_acceleration(Draft& draft) {
  read_section(draft, "base_acceleration", [&](TableReader& in) {
    BaseAcceleration base;
    base.place = in.place();
    read_record(in, draft.model.path, base);
    in.read("scale", base.scale, any_number(""), Need::optional);
    read_start(in, draft, base);
    draft.model.base_acceleration = std::move(base);
  });
}

}  // namespace rockfold
