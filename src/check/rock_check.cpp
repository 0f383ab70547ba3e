#include "src/check/rock_check.hpp"

#include <fmt/format.h>

#include "host/cover/cover.hpp"
#include "host/cut/cut.hpp"
#include "src/base/place_text.hpp"

namespace rockfold {

namespace {

using At = UncutRock::At;

/// A point that must lie in rock; `rest` goes on behind its coordinates in the message.
struct GivenPoint {
  Vec3 point{};
  Place place;
  std::string rest = " is not in the rock";
  bool may_be_excavated = false;
};

Place with_key(Place place, const char* key) {
  place.key += key;
  return place;
}

/// The points that `run` looks for in the rock, which no stage has then removed. Without an [analysis] loads are those of block theory, of
/// blocks that a stage removes later too.
std::vector<GivenPoint> given_points(const Model& model) {
  std::vector<GivenPoint> points;
  for (const PointLoad& load : model.point_loads)
    points.push_back({.point = load.point,
                      .place = with_key(load.place, ".point"),
                      .may_be_excavated = !model.analysis});
  for (const Monitor& monitor : model.monitors) {
    if (!monitor.is_of_rock()) continue;  // the nearest place of the joint is watched
    points.push_back({monitor.point, with_key(monitor.place, ".point"),
                      " of monitor " + monitor.name + " is not in the rock"});
  }
  for (const InitialVelocity& start : model.initial_velocities)
    if (start.block_at)
      points.push_back(
          {.point = *start.block_at, .place = with_key(start.place, ".where.block_at")});
  for (const Fixed& fixed : model.fixed) {
    if (const auto* at = std::get_if<PointRegion>(&fixed.where))
      points.push_back({.point = at->point, .place = with_key(fixed.place, ".where.point")});
    if (const auto* at = std::get_if<BlockRegion>(&fixed.where))
      points.push_back({.point = at->point, .place = with_key(fixed.place, ".where.block_at")});
  }
  return points;
}

void require_in_rock(const std::vector<GivenPoint>& points, const std::vector<At>& at) {
  std::vector<Diagnostic> outside;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const GivenPoint& given = points[p];
    if (at[p] == At::stays || (at[p] == At::excavated && given.may_be_excavated)) continue;
    outside.push_back(
        {given.place,
         fmt::format("{}{}{}", given_place_text(given.point), given.rest,
                     at[p] == At::excavated ? ": an [[excavation]] removes it there" : "")});
  }
  if (!outside.empty()) throw Error(ErrorKind::model, std::move(outside));
}

}  // namespace

void check_rock(const Model& model, Real most_blocks) {
  const std::vector<GivenPoint> given = given_points(model);
  std::vector<Vec3> points;
  for (const GivenPoint& one : given) points.push_back(one.point);
  const UncutRock rock = check_cutting(model, points, most_blocks);
  require_in_rock(given, rock.of_point);
  if (model.cover) check_cover_size(*model.cover, rock.volume);
}

}  // namespace rockfold
