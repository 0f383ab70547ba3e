// Orientations and planes as a model gives them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"
#include "src/model/draft.hpp"
#include "src/model/read_value.hpp"

namespace rockfold {

namespace {

Range dip_range() {
  return between(0, 90, "deg");
}
Range dip_direction_range() {
  return between(0, 360, "deg clockwise from north");
}

}  // namespace

bool read_dip(TableReader& in, DipOrientation& target, Need need) {
  const bool dip = in.read("dip", target.dip, dip_range(), need);
  const bool direction =
      in.read("dip_direction", target.dip_direction, dip_direction_range(), need);
  return dip && direction;
}

bool read_dip_pair(const Value& value, const std::string& path, DipOrientation& target,
                   Diagnostics& out) {
  const auto* pair = std::get_if<Array>(&value.data);
  if (!pair || pair->size() != 2) {
    out.add(value.spot, path,
            "found " + described(value) + ", must be 2 numbers [dip, dip direction] (deg)");
    return false;
  }
  const auto dip = real_from((*pair)[0], item_path(path, 0), dip_range(), out);
  const auto direction = real_from((*pair)[1], item_path(path, 1), dip_direction_range(), out);
  if (!dip || !direction) return false;
  target = {*dip, *direction};
  return true;
}

bool read_orientation(TableReader& in, Orientation& target) {
  bool good = false;
  const bool by_dip = in.has("dip") || in.has("dip_direction");
  const bool by_normal = in.has("normal");
  if (by_dip && by_normal) {
    in.wrong("normal", "a plane has either a normal or dip and dip_direction, not both");
    DipOrientation ignored;
    read_dip(in, ignored, Need::optional);
  } else if (by_normal) {
    Vec3 normal{};
    good = in.read_direction("normal", normal);
    target = normal;
  } else if (by_dip) {
    DipOrientation orientation;
    good = read_dip(in, orientation);
    target = orientation;
  } else {
    in.missing({"dip", "dip_direction", "normal"},
               "is missing: a plane needs dip and dip_direction (deg), or normal");
  }
  return good;
}

bool read_plane(TableReader& in, GivenPlane& target) {
  const bool good = read_orientation(in, target.orientation);
  return in.read("point", target.point, coordinate()) && good;
}

Vec3 unit_normal(const Orientation& orientation) {
  if (const auto* dip = std::get_if<DipOrientation>(&orientation)) return unit_normal(*dip);
  // Divided first: the square of a long normal would overflow.
  const auto [x, y, z] = std::get<Vec3>(orientation);
  const Real size = std::max({std::abs(x), std::abs(y), std::abs(z)});
  return normalized(Vec3{x / size, y / size, z / size});
}

Vec3 unit_normal(const DipOrientation& orientation) {
  constexpr Real degree = std::numbers::pi / 180;
  const Real dip = orientation.dip * degree, direction = orientation.dip_direction * degree;
  return {std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction), std::cos(dip)};
}

}  // namespace rockfold
