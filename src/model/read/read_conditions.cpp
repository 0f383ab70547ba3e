// [[fixed]] and [[monitor]].
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_region.hpp"
#include "src/model/read/read_loads.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

void read_components(TableReader& in, std::array<bool, 3>& components) {
  const auto* value = in.find("components");
  const std::string what = "one or more of \"x\", \"y\", \"z\"";
  const std::string path = in.path_of("components");
  const auto* list = value ? array_from(*value, path, 1, "an array of " + what, in.out()) : nullptr;
  if (!list) return;
  components = {false, false, false};
  for (std::size_t i = 0; i < list->size(); ++i) {
    const auto name = text_from((*list)[i], item_path(path, i), in.out());
    if (!name) continue;
    const auto d = name->size() == 1 ? std::string("xyz").find(*name) : std::string::npos;
    if (d == std::string::npos) {
      in.out().add((*list)[i].spot, item_path(path, i),
                   "found " + described((*list)[i]) + ", must be " + what);
    } else if (components[d]) {
      in.out().add((*list)[i].spot, item_path(path, i), "\"" + *name + "\" is given twice");
    } else {
      components[d] = true;
    }
  }
}

/// "joint" of a monitor.
void read_watched_joint(TableReader& in, const Draft& draft, Monitor& monitor) {
  std::string name;
  if (!in.read("joint", name, Need::optional)) return;
  if (is_joint(draft, name)) {
    monitor.joint = name;
    return;
  }
  // A section of joints, or a name, that could not be read is told already.
  bool told = !draft.joints.complete() || !draft.solids.complete();
  for (const char* section : {"joint", "joint_set", "joint_mesh", "joint_table"})
    told = told || in.out().explained(section);
  if (told) return;
  const auto names = joint_names(draft);
  in.wrong("joint", "unknown joint " + described({name, {}}) +
                        (names.empty() ? "; the model has no joints"
                                       : suggestion(name, names, "the model has")));
}

}  // namespace

void read_fixed(Draft& draft) {
  read_entries(draft, "fixed", [&](TableReader& in, Index) {
    Fixed fixed;
    fixed.place = in.place();
    if (const auto region = read_region(in, draft, Regions::any)) fixed.where = *region;
    read_components(in, fixed.components);
    if (in.has("value") && in.has("value_table"))
      in.wrong("value_table", "give either value or value_table, not both");
    in.read("value", fixed.value, coordinate(), Need::optional);
    read_time_table(in, "value_table", 3, coordinate(), fixed.table);
    const auto method =
        in.choose("method", {{"augmented_lagrangian", "penalty", "lagrange"}, {}}, Need::optional);
    constexpr FixMethod methods[] = {FixMethod::augmented_lagrangian, FixMethod::penalty,
                                     FixMethod::lagrange};
    const bool point = std::holds_alternative<PointRegion>(fixed.where);
    in.read("stiffness", fixed.stiffness, positive(point ? "N/m" : "Pa/m"));
    if (method)
      fixed.method = methods[*method];
    else if (fixed.stiffness)
      fixed.method = FixMethod::penalty;
    if (fixed.stiffness && fixed.method == FixMethod::lagrange)
      in.wrong("stiffness", "has no use with method = \"lagrange\", which has no springs");
    draft.model.fixed.push_back(fixed);
  });
}

void read_monitors(Draft& draft) {
  read_entries(draft, "monitor", [&](TableReader& in, Index number) {
    Monitor monitor;
    monitor.name = in.read_name(draft.monitors, "monitor" + std::to_string(number));
    monitor.place = in.place();
    in.read("point", monitor.point, coordinate());
    read_watched_joint(in, draft, monitor);
    draft.model.monitors.push_back(monitor);
  });
}

}  // namespace rockfold
