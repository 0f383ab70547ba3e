// [[drawing]] and [[table]].
#include <algorithm>

#include "src/model/read/draft.hpp"
#include "src/model/read/read_walls.hpp"

namespace rockfold {

namespace {

/// A name for a file in the result's folder: no way leads out of it.
bool is_plain_name(const std::string& name) {
  return std::none_of(name.begin(), name.end(), [](unsigned char c) {
    return c == '/' || c == '\\' || c < 0x20 || c == 0x7F;
  });
}

/// "output", with the ending that its kind has.
void read_output_name(TableReader& in, const std::string& ending, std::string& target) {
  std::string name;
  if (!in.read("output", name)) return;
  const std::string found = "found " + described({name, {}}) + ", ";
  if (!is_plain_name(name))
    in.wrong("output", found + "must be a plain name that ends in " + ending +
                           ", without folders: the file is written beside the result");
  else if (name.size() <= ending.size() || !name.ends_with(ending))
    in.wrong("output", found + "must be a name that ends in " + ending);
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
    drawing.place_of_file = in.place_of("output");
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
    table.place_of_file = in.place_of("output");
    const auto kind = in.choose("kind", {{"blocks", "keyblocks", "bolts", "bolt_crossings",
                                          "pattern_search", "classification", "monitors", "energy"},
                                         {}});
    if (kind) table.kind = static_cast<TableFile::Kind>(*kind);
    draft.model.tables.push_back(std::move(table));
  });
}

}  // namespace rockfold
