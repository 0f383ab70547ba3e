#include "src/model/read_shapes.hpp"

#include "src/base/vector.hpp"
#include "src/model/draft.hpp"
#include "src/model/prism_base.hpp"
#include "src/model/read_value.hpp"

namespace rockfold {

namespace {

constexpr const char* axes = "xyz";

std::optional<Shape> read_box(TableReader& in) {
  BoxShape box;
  const bool low = in.read("min", box.min, coordinate());
  const bool high = in.read("max", box.max, coordinate());
  if (!low || !high) return {};
  bool good = true;
  for (int d = 0; d < 3; ++d) {
    if (box.min[d] < box.max[d]) continue;
    in.wrong("max", std::string("found ") + axes[d] + " = " + number_text(box.max[d]) +
                        ", must be > min's " + number_text(box.min[d]) + " (m)");
    good = false;
  }
  return good ? std::optional<Shape>(box) : std::nullopt;
}

std::optional<HalfSpace> read_half_space(const Value& value, const std::string& path,
                                         Diagnostics& out) {
  TableReader in(value, path, out);
  HalfSpace half;
  const bool plane = read_plane(in, half.plane);
  const auto keep = in.choose("keep", {{"below", "above"}, {}});
  half.keep_above = keep == 1;
  return plane && keep ? std::optional(half) : std::nullopt;
}

std::optional<Shape> read_halfspaces(TableReader& in, bool add) {
  const std::size_t least = add ? 4 : 1;
  const std::string what =
      add ? "4 or more planes {…}: fewer bound no solid" : "one or more planes {…}";
  const auto* value = in.find("planes", "must be " + what);
  const auto* planes =
      value ? array_from(*value, in.path_of("planes"), least, what, in.out()) : nullptr;
  if (!planes) return {};
  HalfspacesShape shape;
  for (std::size_t i = 0; i < planes->size(); ++i)
    if (const auto half =
            read_half_space((*planes)[i], item_path(in.path_of("planes"), i), in.out()))
      shape.planes.push_back(*half);
  return shape.planes.size() == planes->size() ? std::optional<Shape>(shape) : std::nullopt;
}

std::optional<Shape> read_prism(TableReader& in) {
  PrismShape prism;
  const auto* value = in.find("base", "must be 3 or more points [x, y, z] (m)");
  const auto base = value ? points_from(*value, in.path_of("base"), 3, in.out()) : std::nullopt;
  const bool extruded = in.read("extrude", prism.extrude, coordinate());
  if (!base) return {};
  const auto problem = base_problem(*base);
  if (!problem.empty()) in.wrong("base", problem);
  const bool moves = extruded && norm(prism.extrude) > 0;
  if (extruded && !moves) in.wrong("extrude", "found [0, 0, 0], must not be zero");
  if (!problem.empty() || !moves) return {};
  if (!leaves_plane(*base, prism.extrude)) {
    in.wrong("extrude", "lies in the plane of the base, must leave it");
    return {};
  }
  prism.base = *base;
  return prism;
}

}  // namespace

std::optional<Shape> read_shape(TableReader& in, bool add) {
  const auto shape = in.choose(
      "shape", {{"box", "halfspaces", "prism"},
                {"pyramid", "frustum", "cylinder", "sphere", "tunnel", "mesh", "terrain"}});
  if (!shape) {
    in.give_up();
    return {};
  }
  if (*shape == 0) return read_box(in);
  return *shape == 1 ? read_halfspaces(in, add) : read_prism(in);
}

}  // namespace rockfold
