#include "tests/cut/models/nasty_body.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "tests/cut/oracles/exact_volume.hpp"

namespace rockfold::test {

NastyBody::NastyBody(unsigned seed, bool single) : draw(seed) {
  choose_frame();
  add_boxes(single);
}

// Oblique maps stretch by up to some 5 and shear by up to some 60°.
void NastyBody::choose_frame() {
  straight_ = draw.chance(0.5);
  far_ = draw.chance(0.3);
  prisms_ = draw.chance(0.3);
  const Real size = far_ ? draw.pick({10.0, 100.0, 730.0}) : draw.pick({1.0, 10.0, 100.0, 0.37});
  if (straight_) {
    for (int d = 0; d < 3; ++d) map_.column[d] = (d == 1 ? 0.75 * size : size) * map_.column[d];
  } else {
    do
      for (Vec3& c : map_.column) c = size * draw.uniform(0.5, 2) * draw.direction();
    while (std::abs(map_.determinant()) < 0.3 * size * size * size);
  }
  if (far_)
    map_.shift = {500000.25, 4200000.5, 300};
  else if (draw.chance(0.5))
    map_.shift = size * draw.within(-2, 2);
  result_.size = size;
}

Solid NastyBody::solid(const Vec3& low, const Vec3& high, bool add) {
  const std::string name = std::string("s").append(std::to_string(result_.model.solids.size() + 1));
  if (straight_) return box_solid(name, map_(low), map_(high), add);
  Solid solid = box_solid(name, {}, {}, add);
  if (prisms_) {
    PrismShape prism;
    for (const auto& [x, y] :
         {std::pair{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}})
      prism.base.push_back(map_({x, y, low[2]}));
    prism.extrude = (high[2] - low[2]) * map_.column[2];
    solid.shape = prism;
    return solid;
  }
  HalfspacesShape shape;
  for (int d = 0; d < 3; ++d) {
    const bool right_handed = map_.determinant() > 0;
    shape.planes.push_back({{map_.square(d), map_(low)}, right_handed});
    shape.planes.push_back({{map_.square(d), map_(high)}, !right_handed});
  }
  solid.shape = shape;
  return solid;
}

void NastyBody::add_boxes(bool single) {
  const auto add = [&](const Vec3& low, const Vec3& high, bool rock) {
    result_.model.solids.push_back(solid(low, high, rock));
    unit_boxes_.push_back(box_solid("", low, high, rock));
  };
  add({0, 0, 0}, {1, 1, 1}, true);
  if (single) return;
  add_regions();
  switch (draw.integer(0, 9)) {
    case 0: {  // beside the first, a hair away from it or in it
      const Real gap = tiny();
      add({1 + gap, 0, 0}, {1.5, 1, 1}, true);
      break;
    }
    case 1:  // the same, but for a step of a hair all round
      add({1, tiny(), tiny()}, {1.5, 1 + tiny(), 1 + tiny()}, true);
      break;
    case 2:
      add({0.3, 0.3, 0.3}, {0.6, 0.7, 0.65}, false);
      break;
    case 3:  // leaves a flake on the faces
      add({tiny(), tiny(), 0.4}, {0.5, 0.5, 0.6}, false);
      break;
    case 4:  // refilled but for a hair
      add({0.3, 0.3, -0.1}, {0.6, 0.7, 1.1}, false);
      add({0.3 + tiny(), 0.3, -0.1}, {0.6, 0.7 + tiny(), 1.1}, true);
      break;
    default:
      break;
  }
}

// An excavation flush with the rock's floor but for a hair; a region in which joints are healed; a solid with an interface.
void NastyBody::add_regions() {
  Model& m = result_.model;
  if (draw.chance(0.1)) {
    Excavation excavation;
    excavation.name = "pit";
    excavation.stage = 1;
    excavation.shape = solid({tiny(), 0.3, tiny()}, {0.4, 0.7, 0.5}, true).shape;
    m.excavations.push_back(std::move(excavation));
  }
  if (draw.chance(0.1)) {
    const Vec3 low = map_({0.5, 0.4, 0.4}), high = low + result_.size * draw.within(0.1, 0.5);
    m.merges.push_back({BoxRegion{low, high}, {}});
  }
  if (draw.chance(0.1)) {
    m.joint_materials.resize(1);
    m.joint_materials[0].name = "contact";
    const Vec3 low{0.6, tiny(), 0.2}, high{1 + tiny(), 0.5, 0.5};
    m.solids.push_back(solid(low, high, true));
    m.solids.back().interface = 0;
    unit_boxes_.push_back(box_solid("", low, high));
  }
}

NastyModel NastyBody::take(std::string kind) {
  result_.kind = std::move(kind) +
                 (straight_ ? ", straight"
                  : prisms_ ? ", oblique prism"
                            : ", oblique") +
                 (far_ ? ", map" : "");
  if (straight_) {
    result_.volume = volume_of_boxes(result_.model.solids);
  } else {  // corners are rounded, at map coordinates to some 1e-9 m
    result_.volume = volume_of_boxes(unit_boxes_) * std::abs(map_.determinant());
    result_.volume_error = far_ ? 1e-8 : 1e-11;
  }
  // Faces of several solids that coincide to 1e-10 of the size are one (rule 2).
  if (result_.model.solids.size() > 1)
    result_.volume_error = std::max<Real>(result_.volume_error, 1e-9);
  return std::move(result_);
}

void NastyBody::plane(const Vec3& normal, const Vec3& point) {
  Vec3 mapped{};
  for (int d = 0; d < 3; ++d) mapped += normal[d] * map_.square(d);
  add_joint(result_.model, (1 / result_.size / result_.size) * mapped, map_(point));
}

void NastyBody::polygon(const std::vector<Vec3>& corners) {
  std::vector<Vec3> mapped;
  for (const Vec3& p : corners) mapped.push_back(map_(p));
  Vec3 normal{};
  for (std::size_t i = 1; i + 1 < mapped.size(); ++i)
    normal += cross(mapped[i] - mapped[0], mapped[i + 1] - mapped[0]);
  add_joint(result_.model, normalized(normal), mapped[0]);
  result_.model.joints.back().polygon = std::move(mapped);
}

void NastyBody::dipping(const DipOrientation& orientation, const Vec3& point) {
  add_joint(result_.model, orientation, map_(point));
}

void NastyBody::disc(const Vec3& normal, const Vec3& centre, Real radius) {
  plane(normal, centre);
  result_.model.joints.back().radius = radius * result_.size;
}

Vec3 NastyBody::off(Vec3 x, Real by) {
  for (Real& c : x) c += draw.uniform(-by, by);
  return x;
}

Real NastyBody::tiny() {
  return draw.chance(0.1) ? 0 : draw.sign() * draw.power(-16, -7);
}

}  // namespace rockfold::test
