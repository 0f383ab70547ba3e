#include "tests/stability/certificates.hpp"

#include <cmath>
#include <utility>

#include "src/base/vector.hpp"

namespace rockfold::test {

namespace {

constexpr Real weight = 27e3;   // N, of 1 m³
constexpr Real friction = 0.7;  // tan φ
const Real cosine = std::sqrt(3) / 2;
constexpr Real sine = 0.5;

// The plane: down its dip, along its strike, and out of it.
const Vec3 down{-cosine, 0, -sine};
const Vec3 strike{0, 1, 0};
const Vec3 out{-sine, 0, cosine};

/// `height` above the plane, on its axis.
Vec3 above_plane(Real height) {
  return height * out;
}

RigidBody6 slab(Index block, Real bottom, Real height) {
  return {block, above_plane(bottom + height / 2), {0, 0, -weight * height}, {0, 0, 0}};
}

/// 1 m × 1 m, counter-clockwise seen from above.
ContactArea unit_area(Index above, Index below, Real height, Real tangent, const char* joint) {
  ContactArea area{{above, below}, out, {}, tangent, 0, 0, joint};
  for (const auto& [x, y] : {std::pair{0.5, 0.5}, {-0.5, 0.5}, {-0.5, -0.5}, {0.5, -0.5}})
    area.corner.push_back(above_plane(height) + x * down + y * strike);
  return area;
}

/// What holds a load that hangs at `arm` above an area on its axis: pressure that grows down dip, friction that is the same share of it.
void press_corners(Balance& balance, const ContactArea& area, Real load, Real held, Real arm) {
  const Real pressure = load * cosine, shear = load * sine - held;
  const Vec3 middle = 0.25 * (area.corner[0] + area.corner[1] + area.corner[2] + area.corner[3]);
  for (const Vec3& x : area.corner) {
    const Real lever = dot(x - middle, down);  // ± 0.5 m
    const Real share = 0.25 + lever * arm * (sine / cosine);
    balance.force.push_back(share * (pressure * out - shear * down));
  }
}

/// All blocks go down the plane at 1 m/s and rise by `dilation` of it.
Mechanism translation(const Certificate& certificate, Real factor, Real dilation) {
  const Vec3 velocity = down + dilation * out;
  return {factor, std::vector<BodyVelocity>(certificate.mass.bodies.size(), {velocity, {}})};
}

void add_mechanisms(Certificate& certificate, Real factor) {
  certificate.above = slips_at(certificate, factor * (1 + gap));
  certificate.sliding_balance = certificate.below;
  certificate.sliding_mechanism = translation(certificate, certificate.below.factor, 0);
}

}  // namespace

Mechanism slips_at(const Certificate& certificate, Real factor) {
  return translation(certificate, factor, friction / factor);
}

Real known_factor(const Certificate& certificate) {
  const ContactArea& lowest = certificate.mass.contacts[0];
  return (friction * weight * cosine + lowest.cohesion) / (weight * sine);
}

Certificate block_on_plane() {
  Certificate certificate;
  certificate.mass = {{slab(6, 0, 1)}, {unit_area(0, none, 0, friction, "floor")}, {}};
  const Real factor = known_factor(certificate);
  certificate.below.factor = factor * (1 - gap);
  press_corners(certificate.below, certificate.mass.contacts[0], weight, 0, 0.5);
  add_mechanisms(certificate, factor);
  return certificate;
}

Certificate bonded_block() {
  Certificate certificate;
  certificate.mass = {{slab(6, 0, 1)}, {unit_area(0, none, 0, friction, "bond")}, {}};
  ContactArea& area = certificate.mass.contacts[0];
  area.cohesion = 5e3;
  area.tension = 2e3;
  const Real factor = known_factor(certificate);
  certificate.below.factor = factor * (1 - gap);
  const Real held = area.cohesion / factor;  // N on 1 m²
  press_corners(certificate.below, area, weight, held, 0.5);
  for (int i = 0; i < 4; ++i) certificate.below.force.push_back(-0.25 * held * down);
  add_mechanisms(certificate, factor);
  return certificate;
}

Certificate hanging_block() {
  Certificate certificate;
  ContactArea roof{{0, none}, {0, 0, -1}, {{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}},
                   friction,  100e3,      40e3,
                   "roof"};
  certificate.mass = {{{0, {0.5, 0.5, 0.5}, {0, 0, -weight}, {}}}, {roof}, {}};
  const Real factor = roof.tension / weight;
  certificate.below = {factor * (1 - gap), std::vector<Vec3>(4), {}};
  certificate.below.force.resize(8, {0, 0, weight / 4});
  certificate.above = {factor * (1 + gap), {{{0, 0, -1}, {}}}};
  certificate.sliding_balance = certificate.below;
  certificate.sliding_mechanism = {certificate.below.factor, {{{0, 0, -1}, {}}}};
  return certificate;
}

Certificate two_slabs() {
  Certificate certificate;
  certificate.mass = {
      {slab(3, 0, 0.5), slab(8, 0.5, 0.5)},
      {unit_area(0, none, 0, friction, "floor"), unit_area(1, 0, 0.5, 0.9, "bedding")},
      {}};
  const Real factor = known_factor(certificate);
  certificate.below.factor = factor * (1 - gap);
  press_corners(certificate.below, certificate.mass.contacts[0], weight, 0, 0.5);
  press_corners(certificate.below, certificate.mass.contacts[1], weight / 2, 0, 0.25);
  add_mechanisms(certificate, factor);
  return certificate;
}

}  // namespace rockfold::test
