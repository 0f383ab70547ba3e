// Certificates of known factors are found right, and each way to spoil one is found.
#include "host/stability/verify.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "src/base/vector.hpp"
#include "tests/stability/certificates.hpp"

namespace rockfold::test {
namespace {

constexpr Real nan = std::numeric_limits<Real>::quiet_NaN();
constexpr Real pi = std::numbers::pi;
constexpr Real infinity = std::numeric_limits<Real>::infinity();

void expect_proof(const Certificate& certificate, Real factor) {
  const Verdict verdict = verify(certificate);
  EXPECT_EQ(verdict.wrong, "");
  EXPECT_LT(verdict.residual, 1e-15);
  EXPECT_NEAR(certificate.below.factor, factor, 2 * gap * factor);
  EXPECT_NEAR(certificate.above.factor, factor, 2 * gap * factor);
}

TEST(Verify, ABlockOnAPlane) {
  expect_proof(block_on_plane(), 0.7 * std::sqrt(3));
}

TEST(Verify, ABlockThatIsBonded) {
  expect_proof(bonded_block(), (0.7 * 27e3 * std::sqrt(3) / 2 + 5e3) / (27e3 / 2));
}

TEST(Verify, ABlockThatHangs) {
  expect_proof(hanging_block(), 40.0 / 27);
}

TEST(Verify, TwoSlabs) {
  expect_proof(two_slabs(), 0.7 * std::sqrt(3));
}

TEST(Verify, WithoutAStateOfSliding) {
  Certificate certificate = two_slabs();
  certificate.sliding_balance = {};
  certificate.sliding_mechanism = {};
  expect_proof(certificate, 0.7 * std::sqrt(3));
}

TEST(Verify, CornersMayGoEitherWayRound) {
  Certificate certificate = block_on_plane();
  for (Balance* balance : {&certificate.below, &certificate.sliding_balance})
    std::swap(balance->force[1], balance->force[3]);
  std::swap(certificate.mass.contacts[0].corner[1], certificate.mass.contacts[0].corner[3]);
  EXPECT_EQ(verify(certificate).wrong, "");
}

TEST(Verify, HeldRockMayStandFirst) {
  Certificate certificate = block_on_plane();
  ContactArea& area = certificate.mass.contacts[0];
  std::swap(area.body[0], area.body[1]);
  area.normal = -area.normal;
  for (Balance* balance : {&certificate.below, &certificate.sliding_balance})
    for (Vec3& force : balance->force) force = -force;
  EXPECT_EQ(verify(certificate).wrong, "");
}

/// Scaled velocities say the same, whatever the unit of time.
TEST(Verify, VelocitiesHaveNoScale) {
  for (const Real scale : {1e-12, 1e12}) {
    Certificate certificate = two_slabs();
    for (Mechanism* mechanism : {&certificate.above, &certificate.sliding_mechanism})
      for (BodyVelocity& v : mechanism->velocity) v.velocity = scale * v.velocity;
    EXPECT_EQ(verify(certificate).wrong, "");
  }
}

TEST(Verify, FarFromTheOriginToo) {
  Certificate certificate = block_on_plane();
  const Vec3 east{1 << 20, 1 << 22, 512};
  certificate.mass.bodies[0].centre += east;
  for (Vec3& x : certificate.mass.contacts[0].corner) x += east;
  EXPECT_EQ(verify(certificate).wrong, "");
}

TEST(Verify, TellsWhatIsLeftOver) {
  Certificate certificate = block_on_plane();
  certificate.mass.bodies[0].force[2] *= 1.01;
  const Verdict verdict = verify(certificate);
  EXPECT_FALSE(verdict.holds());
  EXPECT_GT(verdict.residual, 1e-3);
  EXPECT_LT(verdict.residual, 1e-2);
}

/// The weight of a block between two smooth walls, which press on it ten million times as much.
Certificate jammed_block() {
  Certificate certificate = hanging_block();
  ContactArea left{{0, none}, {1, 0, 0}, {{0, 0, 0}, {0, 1, 0}, {0, 1, 1}, {0, 0, 1}}, 0, 0,
                   0,         "wall"};
  ContactArea right = left;
  right.normal = {-1, 0, 0};
  for (Vec3& x : right.corner) x[0] = 1;
  certificate.mass.contacts = {left, right};
  certificate.below = {1, std::vector<Vec3>(4, {1e14, 0, 0}), {}};
  certificate.below.force.resize(8, {-1e14, 0, 0});
  return certificate;
}

/// Far faster slips of a body that needs no power would hide that another sinks into the floor.
Certificate hidden_overlap() {
  Certificate certificate = block_on_plane();
  RigidMass& mass = certificate.mass;
  ContactArea floor{{1, none}, {0, 0, 1}, {{9, 0, 0}, {10, 0, 0}, {10, 1, 0}, {9, 1, 0}}, 0, 0,
                    0,         "ice"};
  mass.bodies.push_back({9, {9.5, 0.5, 0.5}, {0, 0, -8}, {}});
  mass.contacts.push_back(floor);
  for (Balance* balance : {&certificate.below, &certificate.sliding_balance})
    balance->force.resize(8, {0, 0, 2});
  for (Mechanism* mechanism : {&certificate.above, &certificate.sliding_mechanism})
    mechanism->velocity = {{{0, 0, -1e-8}, {}}, {{1, 0, 0}, {}}};
  return certificate;
}

using Spoil = void (*)(Certificate&);

struct Spoiler {
  const char* name;
  Certificate (*certificate)();
  Spoil spoil;
  const char* says;  ///< a part of the message
};

void PrintTo(const Spoiler& spoiler, std::ostream* out) {
  *out << spoiler.name;
}

ContactArea& area(Certificate& c) {
  return c.mass.contacts[0];
}

RigidBody6& body(Certificate& c) {
  return c.mass.bodies[0];
}

const Spoiler spoilers[] = {
    // form
    {"block_missing", block_on_plane, [](Certificate& c) { body(c).block = none; },
     "body 1: names no block"},
    {"block_twice", two_slabs, [](Certificate& c) { c.mass.bodies[1].block = 3; },
     "block 4: is there twice"},
    {"centre_nan", block_on_plane, [](Certificate& c) { body(c).centre[1] = nan; },
     "block 7: its centre is not finite"},
    {"load_nan", block_on_plane, [](Certificate& c) { body(c).force[0] = nan; },
     "its load is not finite"},
    {"load_moment_infinite", block_on_plane, [](Certificate& c) { body(c).moment[2] = -infinity; },
     "its load is not finite"},
    {"body_out_of_range", block_on_plane, [](Certificate& c) { area(c).body[0] = 1; },
     "contact 1 (floor): body 2 of 1 is not there"},
    {"body_below_range", block_on_plane, [](Certificate& c) { area(c).body[0] = -2; },
     "body -1 of 1"},
    {"body_beyond_all", block_on_plane, [](Certificate& c) { area(c).body[0] = 2147483647; },
     "body 2147483648 of 1"},
    {"body_against_itself", block_on_plane, [](Certificate& c) { area(c).body[1] = 0; },
     "a body touches itself"},
    {"rock_against_rock", block_on_plane, [](Certificate& c) { area(c).body[0] = none; },
     "touches no body"},
    {"two_corners", block_on_plane, [](Certificate& c) { area(c).corner.resize(2); },
     "has 2 corners"},
    {"no_corners", block_on_plane, [](Certificate& c) { area(c).corner.clear(); }, "has 0 corners"},
    {"corner_nan", block_on_plane, [](Certificate& c) { area(c).corner[3][0] = nan; },
     "a corner is not finite"},
    {"normal_nan", block_on_plane, [](Certificate& c) { area(c).normal[0] = nan; },
     "its normal is not finite"},
    {"friction_negative", block_on_plane, [](Certificate& c) { area(c).friction = -0.7; },
     "its friction"},
    {"friction_nan", block_on_plane, [](Certificate& c) { area(c).friction = nan; },
     "its friction"},
    {"cohesion_infinite", bonded_block, [](Certificate& c) { area(c).cohesion = infinity; },
     "its cohesion"},
    {"tension_negative", bonded_block, [](Certificate& c) { area(c).tension = -1; },
     "its tensile strength"},
    {"below_factor_zero", block_on_plane, [](Certificate& c) { c.below.factor = 0; },
     "bound from below: its factor, 0,"},
    {"below_factor_infinite", block_on_plane, [](Certificate& c) { c.below.factor = infinity; },
     "its factor, inf,"},
    {"above_factor_negative", block_on_plane, [](Certificate& c) { c.above.factor = -1; },
     "bound from above: its factor, -1,"},
    {"above_factor_nan", block_on_plane, [](Certificate& c) { c.above.factor = nan; },
     "its factor, nan,"},
    {"force_missing", block_on_plane, [](Certificate& c) { c.below.force.pop_back(); },
     "has 3 forces for the 4 points"},
    {"force_too_many", bonded_block, [](Certificate& c) { c.below.force.push_back({}); },
     "has 9 forces for the 8 points"},
    {"forces_none", block_on_plane, [](Certificate& c) { c.below.force.clear(); }, "has 0 forces"},
    {"force_nan", block_on_plane, [](Certificate& c) { c.below.force[2][2] = nan; },
     "force 3 is not finite"},
    {"force_infinite", block_on_plane, [](Certificate& c) { c.below.force[0][1] = infinity; },
     "force 1 is not finite"},
    {"velocity_missing", two_slabs, [](Certificate& c) { c.above.velocity.pop_back(); },
     "has 1 velocities for 2 bodies"},
    {"velocity_too_many", two_slabs, [](Certificate& c) { c.above.velocity.push_back({}); },
     "has 3 velocities for 2 bodies"},
    {"velocity_nan", two_slabs, [](Certificate& c) { c.above.velocity[1].velocity[0] = nan; },
     "bound from above: block 9: its velocity is not finite"},
    {"spin_infinite", block_on_plane,
     [](Certificate& c) { c.above.velocity[0].spin[2] = infinity; }, "its velocity is not finite"},
    {"sliding_forces_missing", block_on_plane,
     [](Certificate& c) { c.sliding_balance.force.clear(); }, "sliding: has 0 forces"},
    {"sliding_velocity_nan", block_on_plane,
     [](Certificate& c) { c.sliding_mechanism.velocity[0].spin[0] = nan; }, "sliding: block 7"},
    // shape of areas
    {"normal_tilted", block_on_plane,
     [](Certificate& c) {
       area(c).normal = normalized(area(c).normal + Vec3{0, 1e-4, 0});
     },
     "off the plane across the normal"},
    {"normal_long", block_on_plane,
     [](Certificate& c) { area(c).normal = (1 + 1e-8) * area(c).normal; },
     "has not the length 1 but 1.00000001"},
    {"normal_zero", block_on_plane, [](Certificate& c) { area(c).normal = {}; },
     "has not the length 1 but 0"},
    {"corner_off_plane", block_on_plane,
     [](Certificate& c) { area(c).corner[1] += 1e-4 * area(c).normal; }, "off the plane"},
    {"corners_out_of_order", block_on_plane,
     [](Certificate& c) { std::swap(area(c).corner[0], area(c).corner[1]); },
     "its corners span no area"},
    {"corners_as_a_star", block_on_plane,
     [](Certificate& c) {
       const Vec3 along = area(c).corner[0] - area(c).corner[1],
                  across = area(c).corner[1] - area(c).corner[2];
       area(c).corner.clear();
       for (int i = 0; i < 5; ++i)
         area(c).corner.push_back(std::cos(i * 0.8 * pi) * along + std::sin(i * 0.8 * pi) * across);
       for (Balance* b : {&c.below, &c.sliding_balance}) b->force.resize(5);
     },
     "not convex, or its corners not in order"},
    {"corner_dented", block_on_plane,
     [](Certificate& c) {
       area(c).corner[2] =
           0.6 * area(c).corner[0] + 0.2 * area(c).corner[1] + 0.2 * area(c).corner[3];
     },
     "not convex"},
    {"corners_on_a_line", block_on_plane,
     [](Certificate& c) {
       area(c).corner = {{0, 0, 0}, {0, 1, 0}, {0, 2, 0}, {0, 3, 0}};
     },
     "span no area"},
    {"corners_twice_round", bonded_block,
     [](Certificate& c) {
       auto& corner = area(c).corner;
       corner.insert(corner.end(), {corner[0], corner[1], corner[2], corner[3]});
       for (Balance* b : {&c.below, &c.sliding_balance}) b->force.resize(16);
     },
     "go round it 2 times"},
    // balance
    {"force_changed", block_on_plane,
     [](Certificate& c) { c.below.force[0] = (1 + 1e-6) * c.below.force[0]; },
     "block 7: the forces do not balance"},
    {"force_changed_little", block_on_plane,
     [](Certificate& c) { c.below.force[3] = (1 + 1e-8) * c.below.force[3]; },
     "the forces do not balance"},
    {"forces_swapped", block_on_plane,
     [](Certificate& c) { std::swap(c.below.force[0], c.below.force[1]); },
     "the moments do not balance"},
    {"force_moved_on", two_slabs,
     [](Certificate& c) {
       c.below.force[5] += c.below.force[4];
       c.below.force[4] = {};
     },
     "block 4: the moments do not balance"},
    {"force_turned", block_on_plane, [](Certificate& c) { c.below.force[0] = -c.below.force[0]; },
     "the forces do not balance"},
    {"load_heavier", block_on_plane, [](Certificate& c) { body(c).force[2] *= 1 + 1e-6; },
     "the forces do not balance"},
    {"load_turned", block_on_plane, [](Certificate& c) { body(c).force[2] *= -1; },
     "the forces do not balance"},
    {"load_with_moment", block_on_plane, [](Certificate& c) { body(c).moment[1] = 1; },
     "the moments do not balance"},
    {"centre_moved", block_on_plane, [](Certificate& c) { body(c).centre[0] += 1e-4; },
     "the moments do not balance"},
    {"area_shifted", block_on_plane,
     [](Certificate& c) {
       for (Vec3& x : area(c).corner) x[1] += 1e-4;
     },
     "the moments do not balance"},
    {"bodies_swapped", two_slabs,
     [](Certificate& c) { std::swap(c.mass.contacts[1].body[0], c.mass.contacts[1].body[1]); },
     "the forces do not balance"},
    {"normal_turned", block_on_plane, [](Certificate& c) { area(c).normal = -area(c).normal; },
     "corner 1: the force pulls"},
    {"weight_hidden_by_jam", jammed_block, [](Certificate&) {},
     "block 1: the forces do not balance: 1 of its load is left over"},
    // strength
    {"below_factor_raised", block_on_plane, [](Certificate& c) { c.below.factor *= 1 + 1e-6; },
     "bound from below: contact 1 (floor), corner 1: the force lies outside the friction cone, by"},
    {"below_factor_raised_little", block_on_plane,
     [](Certificate& c) { c.below.factor *= 1 + 2e-8; }, "outside the friction cone"},
    {"friction_less", two_slabs, [](Certificate& c) { c.mass.contacts[0].friction *= 1 - 1e-6; },
     "contact 1 (floor), corner 1: the force lies outside"},
    {"friction_none", two_slabs, [](Certificate& c) { c.mass.contacts[1].friction = 0; },
     "contact 2 (bedding), corner 1: the force lies outside"},
    {"cone_left_at_two_corners", block_on_plane,
     [](Certificate& c) {
       const Vec3 aside{0, 1e-2 * norm(c.below.force[0]), 0};  // they cancel each other
       c.below.force[0] += aside;
       c.below.force[3] -= aside;
     },
     "corner 1: the force lies outside the friction cone"},
    {"pressure_negative", block_on_plane,
     [](Certificate& c) {
       const Vec3 more = 1e4 * area(c).normal;  // adds up to nothing
       for (const int i : {0, 2}) c.below.force[i] += more;
       for (const int i : {1, 3}) c.below.force[i] -= more;
     },
     "corner 2: the force pulls more than the tensile strength"},
    {"cohesion_less", bonded_block, [](Certificate& c) { area(c).cohesion *= 1 - 1e-6; },
     "bond), triangle 1: the force lies outside"},
    {"bond_factor_raised", bonded_block, [](Certificate& c) { c.below.factor *= 1 + 1e-6; },
     "bond), corner 1: the force lies outside"},
    {"corner_pulls", hanging_block,
     [](Certificate& c) {
       std::swap_ranges(c.below.force.begin(), c.below.force.begin() + 4,
                        c.below.force.begin() + 4);
     },
     "roof), corner 1: the force pulls"},
    {"tension_less", hanging_block, [](Certificate& c) { area(c).tension *= 1 - 1e-6; },
     "roof), triangle 1: the force pulls more than the tensile strength"},
    {"tension_beyond_the_cone", hanging_block, [](Certificate& c) { area(c).cohesion = 10e3; },
     "roof), triangle 1: the force pulls"},
    {"hanging_factor_raised", hanging_block, [](Certificate& c) { c.below.factor *= 1 + 1e-6; },
     "triangle 1: the force pulls"},
    // mechanism
    {"above_factor_lowered", block_on_plane, [](Certificate& c) { c.above.factor *= 1 - 1e-6; },
     "bound from above: contact 1 (floor), corner 1: the slip opens the area too little"},
    {"above_bond_factor_lowered", hanging_block, [](Certificate& c) { c.above.factor *= 1 - 1e-6; },
     "the power of the loads"},
    {"nothing_moves", block_on_plane, [](Certificate& c) { c.above.velocity[0] = {}; },
     "no body moves"},
    {"velocity_turned", block_on_plane,
     [](Certificate& c) { c.above.velocity[0].velocity = -c.above.velocity[0].velocity; },
     "opens the area too little"},
    {"velocity_dilates_less", block_on_plane,
     [](Certificate& c) { c.above.velocity[0].velocity -= 1e-6 * area(c).normal; },
     "opens the area too little"},
    {"velocity_dilates_more", block_on_plane,
     [](Certificate& c) { c.above.velocity[0].velocity += 1e-6 * area(c).normal; },
     "the power of the loads, -0.0"},
    {"velocity_across", block_on_plane,
     [](Certificate& c) { c.above.velocity[0].velocity[1] = 0.1; }, "opens the area too little"},
    {"velocity_of_one", two_slabs, [](Certificate& c) { c.above.velocity[1].velocity[0] *= 1.001; },
     "contact 2 (bedding), corner 1: the slip opens the area too little"},
    {"spin_added", block_on_plane, [](Certificate& c) { c.above.velocity[0].spin[1] = 1e-3; },
     "opens the area too little"},
    {"spin_of_one", two_slabs, [](Certificate& c) { c.above.velocity[1].spin[0] = 1e-5; },
     "contact 2 (bedding), corner 3: the slip opens the area too little"},
    {"floats_up", block_on_plane,
     [](Certificate& c) {
       c.above.velocity[0].velocity = {0, 0, 1};
     },
     "the power of the loads, -27000 W, is not over the 0 W"},
    {"friction_more", block_on_plane, [](Certificate& c) { area(c).friction *= 1 + 1e-6; },
     "opens the area too little"},
    {"cohesion_more", bonded_block, [](Certificate& c) { area(c).cohesion *= 1 + 1e-6; },
     "the power of the loads"},
    {"tension_more", hanging_block, [](Certificate& c) { area(c).tension *= 1 + 1e-6; },
     "the power of the loads"},
    {"overlap_hidden_by_speed", hidden_overlap, [](Certificate&) {},
     "slips that open areas too little may hide"},
    {"bounds_crossed", block_on_plane,
     [](Certificate& c) {  // each holds in its tolerance
       for (Vec3& force : c.below.force)
         force = force - 1e-9 * (force - dot(force, area(c).normal) * area(c).normal);
       c.below.factor = known_factor(c) * (1 + 9e-10);
       c.above = slips_at(c, known_factor(c) * (1 + 1e-10));
     },
     "is over the one from above, 1.21243556"},
    // sliding
    {"sliding_factors_differ", block_on_plane,
     [](Certificate& c) { c.sliding_mechanism.factor *= 1 + 1e-15; },
     "sliding: its forces are for the factor"},
    {"sliding_force_changed", block_on_plane,
     [](Certificate& c) { c.sliding_balance.force[0][2] *= 1 + 1e-6; },
     "sliding: block 7: the forces do not balance"},
    {"sliding_factor_raised", block_on_plane,
     [](Certificate& c) { c.sliding_balance.factor = c.sliding_mechanism.factor *= 1 + 1e-6; },
     "sliding: contact 1 (floor), corner 1: the force lies outside"},
    {"sliding_factor_lowered", block_on_plane,
     [](Certificate& c) { c.sliding_balance.factor = c.sliding_mechanism.factor *= 0.9; },
     "sliding: the forces are not at their strength on these slips: they lack 0.11"},
    {"sliding_at_rest", block_on_plane,
     [](Certificate& c) { c.sliding_mechanism.velocity[0] = {}; }, "sliding: no body moves"},
    {"sliding_uphill", block_on_plane,
     [](Certificate& c) {
       c.sliding_mechanism.velocity[0].velocity = -c.sliding_mechanism.velocity[0].velocity;
     },
     "sliding: the loads do no work"},
    {"sliding_into_the_floor", block_on_plane,
     [](Certificate& c) { c.sliding_mechanism.velocity[0].velocity -= 1e-5 * area(c).normal; },
     "sliding: contact 1 (floor), corner 1: the slip opens the area too little"},
    {"sliding_aside", block_on_plane,
     [](Certificate& c) { c.sliding_mechanism.velocity[0].velocity[1] = 0.1; },
     "sliding: the forces are not at their strength"},
    {"sliding_opens", block_on_plane,
     [](Certificate& c) { c.sliding_mechanism.velocity[0].velocity += 0.01 * area(c).normal; },
     "sliding: the forces are not at their strength"},
    {"sliding_overlap_hidden", hidden_overlap,
     [](Certificate& c) {
       c.above = block_on_plane().above;
       c.above.velocity.push_back({});
     },
     "sliding: the forces are not at their strength on these slips: they lack 0.75"},
};

class Spoiled : public testing::TestWithParam<Spoiler> {};

TEST_P(Spoiled, IsRefused) {
  const Spoiler& spoiler = GetParam();
  Certificate certificate = spoiler.certificate();
  spoiler.spoil(certificate);
  const Verdict verdict = verify(certificate);
  EXPECT_FALSE(verdict.holds());
  EXPECT_NE(verdict.wrong.find(spoiler.says), std::string::npos) << verdict.wrong;
  RecordProperty("wrong", verdict.wrong);
}

INSTANTIATE_TEST_SUITE_P(Certificates, Spoiled, testing::ValuesIn(spoilers),
                         [](const auto& spoiler) { return std::string(spoiler.param.name); });

}  // namespace
}  // namespace rockfold::test
