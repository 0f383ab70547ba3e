// [[merge]], [[excavation]], [cut] and [[scanline]].
#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

constexpr Index most_cells = 2'000'000'000;  // ids of cells are 32 bits wide

void read_merge_box(TableReader& in, Merge& merge) {
  const auto corners = two_points_from(*in.find("box"), in.path_of("box"), "corners", in.out());
  if (!corners) return;
  const auto& [min, max] = *corners;
  for (int d = 0; d < 3; ++d)
    if (!(min[d] < max[d])) {
      in.wrong("box", std::string("the first corner must be the lower one, but its ") + "xyz"[d] +
                          " = " + number_text(min[d]) + " is not under the second's " +
                          number_text(max[d]));
      return;
    }
  merge.region = Merge::Box{min, max};
}

void read_merge_points(TableReader& in, Merge& merge) {
  if (auto points = points_from(*in.find("points"), in.path_of("points"), 2, in.out()))
    merge.region = Merge::Blocks{std::move(*points)};
}

}  // namespace

void read_merges(Draft& draft) {
  read_entries(draft, "merge", [&](TableReader& in, Index) {
    Merge merge;
    merge.place = in.place();
    std::vector<std::string> given;
    for (const char* way : {"box", "solid", "points"})
      if (in.has(way)) given.emplace_back(way);
    if (given.empty())
      in.missing({"", "box", "solid", "points"},
                 "says no region, must have one of box, solid or points");
    if (given.size() > 1)
      in.wrong(given[1], "has both " + given[0] + " and " + given[1] +
                             ", must have one of box, solid or points");
    if (given.size() == 1 && given[0] == "box") read_merge_box(in, merge);
    if (given.size() == 1 && given[0] == "points") read_merge_points(in, merge);
    if (given.size() == 1 && given[0] == "solid") {
      Merge::InSolid region{none};
      in.read_optional_reference("solid", draft.solids, region.solid);
      merge.region = region;
    }
    draft.model.merges.push_back(std::move(merge));
  });
}

void read_excavations(Draft& draft) {
  read_entries(draft, "excavation", [&](TableReader& in, Index number) {
    Excavation excavation;
    excavation.name = in.read_name(draft.excavations, "excavation" + std::to_string(number));
    excavation.place = in.place();
    // Faces are reported as name.face, whether of a solid or of an excavation.
    if (const Index solid = draft.solids.find(excavation.name); solid != none)
      in.wrong("name",
               "\"" + excavation.name + "\" is already the name of " + draft.solids.path(solid));
    in.read("stage", excavation.stage, IntegerRange{.low = 1}, Need::optional);
    auto shape = read_shape(in, false, draft.model.path);
    draft.excavation_has_shape.push_back(shape.has_value());
    if (shape) excavation.shape = std::move(*shape);
    draft.model.excavations.push_back(std::move(excavation));
  });
}

void read_cut(Draft& draft) {
  read_section(draft, "cut", [&](TableReader& in) {
    auto& cut = draft.model.cut;
    Index cells = 0;
    if (in.read("max_cells", cells, IntegerRange{.low = 1, .high = most_cells}, Need::optional)) {
      cut.max_cells = cells;
      if (const Value* given = in.find("max_cells"))
        cut.place_of_max_cells = in.out().place(given->spot, in.path_of("max_cells"));
    }
    in.read("min_volume", cut.min_volume, positive("m3"));
    if (in.choose("specks", {{"keep", "merge"}, {}}, Need::optional) == 1)
      cut.specks = Specks::merge;
    in.read("max_aspect_ratio", cut.max_aspect_ratio, Range{.low = 1});
  });
}

void read_scanlines(Draft& draft) {
  read_entries(draft, "scanline", [&](TableReader& in, Index number) {
    Scanline line;
    line.name = in.read_name(draft.scanlines, "scanline" + std::to_string(number));
    line.place = in.place();
    const bool from = in.read("from", line.from, coordinate());
    const bool to = in.read("to", line.to, coordinate());
    if (from && to && norm(line.to - line.from) == 0)
      in.wrong("to", "is the point from, must be the line's other end");
    draft.model.scanlines.push_back(std::move(line));
  });
}

}  // namespace rockfold
