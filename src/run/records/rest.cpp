#include "src/run/records/rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "src/base/vector.hpp"
#include "src/run/records/contact_samples.hpp"

namespace rockfold {
namespace {

/// Share of √(g h) below which blocks are at rest.
constexpr Real resting = 1e-3;

/// Share of gravity with which blocks that begin at rest are left to themselves: as where excavated rock is let go (settling.cpp).
constexpr Real balanced = 1e-2;

/// Of the model's extent: places, frames, gaps and tractions are rounded one after the other (contact::rounding: 4 ε of a place as far off as
/// the model is large), and what a million points add up to at random is a thousand times as much: 4 · 2.2e-16 · 1e3.
constexpr Real rounding = 1e-12;

void take_larger(Real value, Index joint, const Index (&block)[2], LargestAtJoint& largest) {
  if (value <= largest.value) return;
  largest = {value, joint, {block[0], block[1]}};
}

/// By the vector that is axis times angle (Rodrigues).
Vec3 rotated(const Vec3& v, const Vec3& rotation) {
  const Real angle = norm(rotation);
  if (!(angle > 0)) return v;
  const Vec3 axis = (1 / angle) * rotation;
  return std::cos(angle) * v + std::sin(angle) * cross(axis, v) +
         ((1 - std::cos(angle)) * dot(axis, v)) * axis;
}

}  // namespace

Real mean_block_size(const RunInput& input) {
  const auto& volume = input.blocks.volume;
  const Real rock = std::accumulate(volume.begin(), volume.end(), Real{0});
  return std::cbrt(rock / static_cast<Real>(volume.size()));
}

Real way_of_rounding(const RunInput& input) {
  Real extent = 0;
  for (std::size_t d = 0; d < 3; ++d) {
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const Vec3& v : input.blocks.vertex) {
      low = std::min(low, v[d]);
      high = std::max(high, v[d]);
    }
    extent = std::max(extent, high - low);
  }
  return rounding * extent;
}

Real resting_speed(const RunInput& input) {
  return resting * std::sqrt(norm(input.model.gravity) * mean_block_size(input));
}

Real largest_speed(const std::vector<BlockMotion>& velocity) {
  Real largest = 0;
  for (const BlockMotion& block : velocity) largest = std::max(largest, norm(block.displacement));
  return largest;
}

Rest find_rest(const RunInput& input, const std::vector<BlockMotion>& counted,
               const std::vector<BlockMotion>& whole, const std::vector<BlockMotion>& velocity,
               const std::vector<BlockMotion>& acceleration, const std::vector<ContactPoint>& start,
               const std::vector<Vec3>& covers, const std::vector<std::uint8_t>& gone) {
  Rest rest;
  const auto& volume = input.blocks.volume;
  for (std::size_t b = 0; b < counted.size(); ++b) {
    rest.moved += has_moved(counted[b].displacement, volume[b]);
  }
  const auto& block_of = input.contact->surfaces.vertex_block;
  for (const ContactPoint& p : start) {
    if (p.joint == none) continue;
    const Index block[2] = {block_of[p.vertex[0]], block_of[p.vertex[3]]};
    if (!gone.empty() && (gone[block[0]] != 0 || gone[block[1]] != 0)) continue;
    const Vec3 normal = rotated({p.normal[0], p.normal[1], p.normal[2]}, whole[block[1]].rotation);
    const Vec3 apart = way_apart(input, p, covers);
    const Real opening = dot(normal, apart);
    take_larger(opening, p.joint, block, rest.opening);
    take_larger(norm(apart - opening * normal), p.joint, block, rest.slip);
  }
  for (LargestAtJoint* largest : {&rest.slip, &rest.opening})
    if (largest->value <= way_of_rounding(input)) *largest = {};
  rest.speed = largest_speed(velocity);
  const Real limit = resting_speed(input);
  const Real free = balanced * norm(input.model.gravity);
  const auto accelerates = [&](std::size_t b) {
    return !acceleration.empty() && free > 0 && norm(acceleration[b].displacement) > free &&
           (gone.empty() || gone[b] == 0);
  };
  for (std::size_t b = 0; b < velocity.size(); ++b)
    if (norm(velocity[b].displacement) > limit || accelerates(b))
      rest.moving.push_back(static_cast<Index>(b));
  rest.at_rest = rest.moving.empty();
  return rest;
}

Unbalanced find_unbalanced(const RunInput& input, const std::vector<BlockMotion>& acceleration,
                           const std::vector<Reaction>& conditions,
                           const std::vector<std::uint8_t>& gone) {
  Unbalanced found;
  Real sum = 0, weight = 0, carried = 0;
  for (std::size_t b = 0; b < acceleration.size(); ++b) {
    if (!gone.empty() && gone[b] != 0) continue;
    const Real mass = input.blocks.mass[b];
    const Real force = mass * norm(acceleration[b].displacement);
    sum += force;
    weight += mass * norm(input.model.gravity);
    if (force <= found.force) continue;
    found.force = force;
    found.block = static_cast<Index>(b);
  }
  for (const Reaction& condition : conditions) carried += norm(condition.force);
  const Real scale = std::max(weight, carried);
  if (scale > 0) found.share = sum / scale;
  return found;
}

}  // namespace rockfold
