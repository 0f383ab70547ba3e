// [[fixed]] and [[monitor]].
#include "src/model/draft.hpp"
#include "src/model/read_loads.hpp"
#include "src/model/read_region.hpp"
#include "src/model/read_value.hpp"

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
    if (method) fixed.method = methods[*method];
    const bool point = std::holds_alternative<PointRegion>(fixed.where);
    in.read("stiffness", fixed.stiffness, positive(point ? "N/m" : "Pa/m"));
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
    draft.model.monitors.push_back(monitor);
  });
}

}  // namespace rockfold
