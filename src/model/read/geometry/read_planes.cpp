// Orientations and planes as a model gives them.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "src/base/vector.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/read_value.hpp"
#include "src/model/strike.hpp"

namespace rockfold {

namespace {

Range dip_range() {
  return between(0, 90, "deg");
}
Range dip_direction_range() {
  return between(0, 360, "deg clockwise from north");
}

/// Of a plane that dips to the right, or to the left, of its strike.
bool read_strike(TableReader& in, DipOrientation& target) {
  if (in.has("dip_direction"))
    in.wrong("strike", "a plane has either a strike or a dip_direction, not both");
  Real strike = 0;
  const bool good = in.read("strike", strike, dip_direction_range());
  target.dip_direction = dip_direction_of(strike, is_left_hand(in));
  return good;
}

/// By the pole: the normal that points down.
bool read_pole(TableReader& in, DipOrientation& target) {
  Real trend = 0, plunge = 0;
  const bool good = in.read("trend", trend, dip_direction_range());
  const bool down = in.read("plunge", plunge, between(0, 90, "deg below the horizontal"));
  target = {90 - plunge, turned(trend - 180)};
  return good && down;
}

}  // namespace

bool is_left_hand(TableReader& in) {
  return in.choose("rule", {.words = {"right_hand", "left_hand"}, .not_yet = {}}, Need::optional)
             .value_or(0) == 1;
}

bool read_dip(TableReader& in, DipOrientation& target, Need need) {
  const bool dip = in.read("dip", target.dip, dip_range(), need);
  const bool direction = in.has("strike") ? read_strike(in, target)
                                          : in.read("dip_direction", target.dip_direction,
                                                    dip_direction_range(), need);
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
  const bool by_dip = in.has("dip") || in.has("dip_direction") || in.has("strike");
  const bool by_pole = in.has("trend") || in.has("plunge");
  const bool by_normal = in.has("normal");
  if (by_dip + by_pole + by_normal > 1) {
    in.wrong(by_normal ? "normal" : "trend",
             by_pole ? "a plane has one of dip and dip_direction, trend and plunge, or normal"
                     : "a plane has either a normal or dip and dip_direction, not both");
    DipOrientation ignored;
    read_dip(in, ignored, Need::optional);
    return false;
  }
  if (by_normal) {
    Vec3 normal{};
    const bool good = in.read_direction("normal", normal);
    target = normal;
    return good;
  }
  if (by_dip || by_pole) {
    DipOrientation orientation;
    const bool good = by_pole ? read_pole(in, orientation) : read_dip(in, orientation);
    target = orientation;
    return good;
  }
  in.missing({"dip", "dip_direction", "normal"},
             "is missing: a plane needs dip and dip_direction (deg), or normal");
  return false;
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
