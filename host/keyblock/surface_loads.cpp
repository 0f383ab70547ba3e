#include "host/keyblock/surface_loads.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "host/keyblock/face_shape.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Of the model's size: corners that close to a region's boundary lie on it.
constexpr Real relative_slack = 1e-9;

Real size_of(const BlockArrays& blocks) {
  Vec3 low = blocks.vertex.front(), high = low;
  for (const Vec3& x : blocks.vertex)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  return norm(high - low);
}

/// One traction: pressure times a direction, where its region holds.
class Loader {
 public:
  Loader(const BlockArrays& blocks, const Model& model, const Traction& traction)
      : blocks_(blocks), traction_(traction), slack_(relative_slack * size_of(blocks)) {
    const Vec3 value = traction.table.empty() ? traction.value : traction.table.at(time_of_statics);
    const Real gravity = norm(model.gravity);
    if (traction.head) {
      const Real weight = traction.density * gravity;
      pressure_ = {.at_origin = weight * *traction.head,
                   .gradient = (traction.density) * model.gravity};
    } else if (traction.pressure) {
      sign_ = value[0] < 0 ? -1 : 1;
      pressure_.at_origin = std::abs(value[0]);
    } else {
      vector_ = value;
      pressure_.at_origin = 1;
    }
  }

  const LinearPressure& pressure() const { return pressure_; }

  /// Whether the region holds any of the face; adds its load.
  bool add(Index face, FaceLoad& load) const {
    if (!holds(face)) return false;
    const auto* box = std::get_if<BoxRegion>(&traction_.where);
    const LinearPressure one{.at_origin = 1, .gradient = {}};
    const Real area = pressure_force(blocks_, face, one, box, slack_).force;
    if (!(area > slack_ * slack_)) return false;
    const PressureForce push = pressure_force(blocks_, face, pressure_, box, slack_);
    const Vec3 along = traction_.pressure ? -sign_ * blocks_.face_normal[face] : vector_;
    load.force += push.force * along;
    load.moment += cross(push.first_moment, along);
    return true;
  }

 private:
  bool holds(Index face) const {
    if (const auto* region = std::get_if<FaceRegion>(&traction_.where))
      return region->holds(blocks_.origins[blocks_.face_origin[face]]);
    const auto* plane = std::get_if<PlaneRegion>(&traction_.where);
    if (plane == nullptr) return true;
    const auto corners = outer_loop(blocks_, face);
    return std::all_of(corners.begin(), corners.end(), [&](const Vec3& x) {
      return std::abs(dot(plane->normal, x - plane->point)) <= std::max(plane->tolerance, slack_);
    });
  }

  const BlockArrays& blocks_;
  const Traction& traction_;
  Real slack_, sign_ = 1;
  LinearPressure pressure_;
  Vec3 vector_{};
};

}  // namespace

SurfaceLoads::SurfaceLoads(const BlockArrays& blocks, const Model& model) {
  if (model.tractions.empty() || !has_polygons(blocks)) return;
  const auto count = static_cast<Index>(blocks.face_area.size());
  load_.resize(blocks.face_area.size());
  water_.resize(blocks.face_area.size());
  for (const Traction& traction : model.tractions) {
    const Loader loader(blocks, model, traction);
    bool any = false;
    for (Index face = 0; face < count; ++face)
      if (blocks.origins[blocks.face_origin[face]].kind != FaceOrigin::Kind::joint &&
          loader.add(face, load_[static_cast<std::size_t>(face)])) {
        any = true;
        add_water(traction, loader.pressure(), face);
      }
    if (!any)
      refuse(traction.place, traction.place.key + ".where", "holds no free face of the rock");
  }
}

void SurfaceLoads::add_water(const Traction& traction, const LinearPressure& pressure, Index face) {
  FaceWater& water = water_[static_cast<std::size_t>(face)];
  if (!traction.head)
    water.closed = water.closed || traction.pressure;
  else if (!water.pond || pressure.at_origin > water.pond->at_origin)
    water.pond = pressure;
}

}  // namespace rockfold
