// [[fixed]], [[point_load]] and [[monitor]].
#include "src/model/draft.hpp"
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
    if (const auto region = read_region(in, draft)) fixed.where = *region;
    read_components(in, fixed.components);
    in.read("value", fixed.value, coordinate(), Need::optional);
    in.not_yet("value_table", "give a constant value");
    if (in.choose("method", {{"augmented_lagrangian", "penalty"}, {"lagrange"}}, Need::optional) ==
        1)
      fixed.method = FixMethod::penalty;
    draft.model.fixed.push_back(fixed);
  });
}

void read_point_loads(Draft& draft) {
  read_entries(draft, "point_load", [&](TableReader& in, Index) {
    PointLoad load;
    load.place = in.place();
    in.read("point", load.point, coordinate());
    const bool table = in.not_yet("force_table", "give a constant force");
    in.read("force", load.force, any_number("N"), table ? Need::optional : Need::required);
    draft.model.point_loads.push_back(load);
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
