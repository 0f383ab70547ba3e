// [cover].
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

// Volume spanned by the three unit normals: about the sine of 3° where one family is inclined to the other two. The lattice's edges
// are up to 1 / this longer than its spacing.
constexpr Real least_span = 0.05;

std::string short_number(Real x) {
  return number_text(std::round(1000 * x) / 1000);
}

void check_span(TableReader& in, const CoverSpec& cover) {
  const Vec3 a = unit_normal(cover.directions[0]), b = unit_normal(cover.directions[1]),
             c = unit_normal(cover.directions[2]);
  const Real span = std::abs(dot(a, cross(b, c)));
  if (span >= least_span) return;
  const auto parallel = [&](const char* which, const Vec3& m, const Vec3& n) {
    const Real sine = norm(cross(m, n));
    if (sine >= least_span) return false;
    in.wrong("directions", std::string("families ") + which +
                               " are nearly parallel: they meet at " +
                               short_number(std::asin(sine) * 180 / std::numbers::pi) +
                               " degrees, must meet at 3 or more");
    return true;
  };
  if (parallel("1 and 2", a, b) || parallel("1 and 3", a, c) || parallel("2 and 3", b, c)) return;
  in.wrong("directions",
           "the three families are nearly parallel to one line: their unit normals span "
           "a volume of " +
               short_number(span) + ", must span " + short_number(least_span) + " or more");
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
  if (good) check_span(in, cover);
}

// One number, or one for each of the directions.
void read_spacing(TableReader& in, CoverSpec& cover) {
  const std::string path = in.path_of("spacing"),
                    expected = "must be one number or 3, one for each of the directions (m)";
  const bool optional = cover.lattice == LatticeKind::block;
  const auto* value = in.find("spacing", optional ? "" : expected);
  if (!value) return;
  const auto* list = std::get_if<Array>(&value->data);
  if (!list) {
    if (const auto one = real_from(*value, path, length(), in.out()))
      cover.spacing = {*one, *one, *one};
  } else if (list->size() != 3) {
    in.wrong("spacing", "found " + described(*value) + ", " + expected);
  } else {
    for (std::size_t i = 0; i < 3; ++i)
      if (const auto one = real_from((*list)[i], item_path(path, i), length(), in.out()))
        cover.spacing[i] = *one;
  }
}

void read_lattice(TableReader& in, CoverSpec& cover) {
  constexpr LatticeKind kinds[] = {LatticeKind::tet5,  LatticeKind::tet6, LatticeKind::tet6_kuhn,
                                   LatticeKind::tet24, LatticeKind::hex8, LatticeKind::block};
  if (const auto kind = in.choose(
          "lattice", {{"tet5", "tet6", "tet6_kuhn", "tet24", "hex8", "block"}, {}}, Need::optional))
    cover.lattice = kinds[*kind];
  bool mixed = false;
  if (!in.read("mixed", mixed, Need::optional) || !mixed) return;
  if (cover.lattice == LatticeKind::tet5)
    cover.lattice = LatticeKind::tet5_mixed;
  else
    in.wrong("mixed", "mixed = true overlays the two forms of lattice = \"tet5\", which it needs");
}

// A block's only cover is its own: there are no planes, and nothing that could go on across joints.
void check_block_lattice(TableReader& in, const CoverSpec& cover) {
  if (cover.lattice != LatticeKind::block) return;
  for (const char* key : {"directions", "origin"})
    if (in.has(key)) in.wrong(key, "lattice = \"block\" has no planes, must be left out");
  if (cover.joints == JointTreatment::welded)
    in.wrong("joints",
             "lattice = \"block\" gives each block one cover of its own, must be "
             "\"separate\"");
}

}  // namespace

void read_cover(Draft& draft) {
  read_section(draft, "cover", [&](TableReader& in) {
    CoverSpec cover;
    cover.place = in.place();
    read_lattice(in, cover);
    read_spacing(in, cover);
    if (cover.lattice == LatticeKind::block) cover.order = 1;  // blocks turn
    in.read("order", cover.order, IntegerRange{.low = 0, .high = 2}, Need::optional);
    read_directions(in, cover);
    Vec3 origin{};
    if (in.read("origin", origin, coordinate(), Need::optional)) cover.origin = origin;
    if (in.choose("joints", {{"separate", "welded"}, {}}, Need::optional) == 1)
      cover.joints = JointTreatment::welded;
    if (in.choose("joint_tips", {{"keep", "extend"}, {}}, Need::optional) == 1)
      cover.joint_tips = JointTips::extend;
    in.read("max_elements", cover.max_elements, IntegerRange{.low = 1}, Need::optional);
    check_block_lattice(in, cover);
    draft.model.cover = cover;
  });
}

}  // namespace rockfold
