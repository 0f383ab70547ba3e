// [[drawing]] and [[table]].
#include "src/model/draft.hpp"
#include "src/model/read_walls.hpp"

namespace rockfold {

namespace {

/// "output", with the ending that its kind has.
void read_output_name(TableReader& in, const std::string& ending, std::string& target) {
  std::string name;
  if (!in.read("output", name)) return;
  if (name.size() <= ending.size() || !name.ends_with(ending) ||
      name.find('\0') != std::string::npos)
    in.wrong("output",
             "found " + described({name, {}}) + ", must be a name that ends in " + ending);
  target = name;
}

void read_stereonet(TableReader& in, const Draft& draft, Drawing& drawing) {
  const auto hemisphere = in.choose("hemisphere", {{"lower", "upper"}, {}}, Need::optional);
  drawing.upper = hemisphere && *hemisphere == 1;
  const auto projection =
      in.choose("projection", {{"equal_angle", "equal_area"}, {}}, Need::optional);
  drawing.equal_area = projection && *projection == 1;
  in.read("joint_pyramids", drawing.joint_pyramids, Need::optional);
  in.read("poles", drawing.poles, Need::optional);
  if (drawing.joint_pyramids && drawing.equal_area)
    in.wrong("projection", "joint_pyramids need \"equal_angle\", where whole planes are circles");
  if (in.has("on"))
    if (auto on = read_wall(in, "on", draft)) drawing.on = std::move(*on);
}

}  // namespace

void read_drawings(Draft& draft) {
  read_entries(draft, "drawing", [&](TableReader& in, Index) {
    Drawing drawing;
    drawing.place = in.place();
    read_output_name(in, ".svg", drawing.file);
    const auto kind = in.choose("kind", {{"stereonet", "bolt_layout"}, {}});
    if (!kind) {
      in.give_up();
      return;
    }
    drawing.kind = static_cast<Drawing::Kind>(*kind);
    if (drawing.kind == Drawing::Kind::stereonet) {
      read_stereonet(in, draft, drawing);
    } else if (auto on = read_wall(in, "on", draft)) {
      drawing.on = std::move(*on);
    }
    draft.model.drawings.push_back(std::move(drawing));
  });
}

void read_tables(Draft& draft) {
  read_entries(draft, "table", [&](TableReader& in, Index) {
    TableFile table;
    table.place = in.place();
    read_output_name(in, ".csv", table.file);
    const auto kind = in.choose("kind", {{"blocks", "keyblocks", "bolts", "bolt_crossings",
                                          "pattern_search", "classification"},
                                         {}});
    if (kind) table.kind = static_cast<TableFile::Kind>(*kind);
    draft.model.tables.push_back(std::move(table));
  });
}

}  // namespace rockfold
