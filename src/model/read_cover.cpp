// [cover].
#include <cmath>

#include "src/base/vector.hpp"
#include "src/model/draft.hpp"
#include "src/model/read_value.hpp"

namespace rockfold {

namespace {

constexpr Real perpendicular = 1e-9;  // cosine; a degree given with 9 digits

void check_perpendicular(TableReader& in, const CoverSpec& cover) {
  for (int i = 0; i < 3; ++i)
    for (int j = i + 1; j < 3; ++j) {
      if (std::abs(dot(unit_normal(cover.directions[i]), unit_normal(cover.directions[j]))) <=
          perpendicular)
        continue;
      in.wrong("directions", "directions that are not perpendicular are not supported yet: " +
                                 std::to_string(i + 1) + " and " + std::to_string(j + 1) +
                                 " are not, to 1e-9");
      return;
    }
}

void read_directions(TableReader& in, CoverSpec& cover) {
  const auto* value = in.find("directions");
  if (!value) return;
  const auto* list = std::get_if<Array>(&value->data);
  if (!list || list->size() != 3) {
    in.wrong("directions",
             "found " + described(*value) + ", must be 3 pairs [dip, dip direction] (deg)");
    return;
  }
  bool good = true;
  for (std::size_t i = 0; i < 3; ++i)
    good = read_dip_pair((*list)[i], item_path(in.path_of("directions"), i), cover.directions[i],
                         in.out()) &&
           good;
  if (good) check_perpendicular(in, cover);
}

}  // namespace

void read_cover(Draft& draft) {
  read_section(draft, "cover", [&](TableReader& in) {
    CoverSpec cover;
    cover.place = in.place();
    in.choose("lattice", {{"tet6"}, {"tet5", "tet6_kuhn", "tet24", "hex8", "block"}},
              Need::optional);
    in.read("spacing", cover.spacing, length());
    Index order = 0;
    if (in.read("order", order, IntegerRange{.low = 0, .high = 2}, Need::optional) && order > 0)
      in.wrong("order", "order " + std::to_string(order) + " is not supported yet, must be 0");
    read_directions(in, cover);
    Vec3 origin{};
    if (in.read("origin", origin, coordinate(), Need::optional)) cover.origin = origin;
    const auto joints = in.choose("joints", {{"separate", "welded"}, {}}, Need::optional);
    if (joints == 1) cover.joints = JointTreatment::welded;
    draft.model.cover = cover;
  });
}

}  // namespace rockfold
