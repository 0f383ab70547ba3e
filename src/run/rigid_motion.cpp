#include "src/run/rigid_motion.hpp"

#include <cmath>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {
namespace {

/// Which blocks a velocity moves, as flags.
std::vector<std::uint8_t> flags_of(const RigidVelocity& velocity, const CoverArrays& covers) {
  Index blocks = 0;
  for (const Index b : covers.regular_block) blocks = std::max(blocks, b + 1);
  for (const Index b : covers.piece_block) blocks = std::max(blocks, b + 1);
  std::vector<std::uint8_t> moved(blocks, 0);
  for (const Index b : velocity.blocks)
    if (b < blocks) moved[b] = 1;
  return moved;
}

Vec3 mass_centre(const CoverArrays& covers, const PieceMoments& moments,
                 const std::vector<ElasticMaterial>& materials,
                 const std::vector<std::uint8_t>& moved) {
  const Mat3& edge = covers.lattice.edge;
  const Real cell_volume = std::abs(dot(edge[0], cross(edge[1], edge[2])));
  const Real share = cell_split(covers.lattice.kind).share;
  Real mass = 0;
  Vec3 moment{};
  for (Index r = 0; r < covers.regular_count(); ++r) {
    if (!moved[covers.regular_block[r]]) continue;
    const Real m = materials[covers.regular_material[r]].density * cell_volume;
    mass += m;
    moment += m * covers.lattice.cell_centre(covers.regular_cell[r]);
  }
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const Real density = share * materials[covers.element_material[e]].density;
    const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[e]);
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
      if (!moved[covers.piece_block[q]]) continue;
      mass += density * moments.volume[q];
      moment += density * (moments.volume[q] * centre + moments.first[q]);
    }
  }
  return mass > 0 ? (1 / mass) * moment : Vec3{};
}

/// The covers of the blocks, as flags.
std::vector<std::uint8_t> covers_of(const CoverArrays& covers,
                                    const std::vector<std::uint8_t>& moved) {
  std::vector<std::uint8_t> of_blocks(covers.cover_count(), 0);
  const std::size_t per_cell = covers.nodes_per_cell(), per_part = covers.nodes_per_part();
  for (std::size_t i = 0; i < covers.regular_cover.size(); ++i)
    if (moved[covers.regular_block[i / per_cell]]) of_blocks[covers.regular_cover[i]] = 1;
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      if (moved[covers.piece_block[q]])
        for (std::size_t a = 0; a < per_part; ++a)
          of_blocks[covers.element_cover[per_part * e + a]] = 1;
  return of_blocks;
}

void require_turning(const CoverArrays& covers, const RigidVelocity& velocity) {
  if (covers.lattice.kind == LatticeKind::block && covers.order == 0 &&
      velocity.angular_velocity != Vec3{})
    throw Error(ErrorKind::analysis,
                "initial_velocity: found an angular_velocity, but the covers of lattice = "
                "\"block\" with order = 0 "
                "cannot turn; must be order 1 or 2 (cover.order)");
}

}  // namespace

std::vector<Vec3> rigid_arms(const CoverArrays& covers) {
  const Index count = covers.cover_count();
  std::vector<Vec3> arms(covers.unknown_count());
  for (Index p = 0; p < count; ++p) {
    arms[p] = function_origin(covers, p);
    for (int d = 0; d < 3 && covers.order > 0; ++d)
      arms[(1 + d) * count + p] = covers.reach * covers.lattice.edge[d];
  }
  return arms;
}

StateArrays initial_motion(const CoverArrays& covers, const PieceMoments& moments,
                           const std::vector<ElasticMaterial>& materials,
                           const std::vector<RigidVelocity>& velocities) {
  StateArrays state;
  state.displacement.resize(covers.unknown_count());
  state.velocity.resize(covers.unknown_count());
  state.acceleration.resize(covers.unknown_count());
  const Index count = covers.cover_count();
  const std::vector<Vec3> arms = rigid_arms(covers);
  for (const RigidVelocity& given : velocities) {
    require_turning(covers, given);
    const auto moved = flags_of(given, covers);
    const Vec3 centre = mass_centre(covers, moments, materials, moved);
    const auto of_blocks = covers_of(covers, moved);
    for (Index u = 0; u < covers.unknown_count(); ++u) {
      if (!of_blocks[u % count]) continue;
      state.velocity[u] = u < count
                              ? given.velocity + cross(given.angular_velocity, arms[u] - centre)
                              : cross(given.angular_velocity, arms[u]);
    }
  }
  return state;
}

std::vector<Reaction> sum_reactions(const CoverArrays& covers, const FixedPoints& fixed,
                                    const std::vector<Vec3>& reactions,
                                    const std::vector<Vec3>& displacement, Index conditions) {
  std::vector<Reaction> sums(conditions);
  if (fixed.condition.empty()) return sums;
  std::vector<Vec3> arms = rigid_arms(covers);
  for (std::size_t u = 0; u < displacement.size(); ++u) arms[u] += displacement[u];
  for (std::size_t n = 0; n < reactions.size(); ++n) {
    // The work on a rigid motion: force and moment whatever the point's weights are.
    Real share = 0;
    Vec3 arm{};
    for (Index i = fixed.points.begin[n]; i < fixed.points.begin[n + 1]; ++i) {
      if (fixed.points.unknown[i] < covers.cover_count()) share += fixed.points.weight[i];
      arm += fixed.points.weight[i] * arms[fixed.points.unknown[i]];
    }
    Reaction& sum = sums[fixed.condition[n]];
    sum.force += share * reactions[n];
    sum.moment += cross(arm, reactions[n]);
  }
  return sums;
}

}  // namespace rockfold
