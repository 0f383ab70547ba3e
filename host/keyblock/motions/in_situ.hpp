// What the in-situ normal stress on joints adds to a block's resistance, once the block's own motion
// has relieved it. docs/block_theory.md, "In-situ stress".
#pragma once

#include <span>

#include "host/keyblock/motions/sliding.hpp"

namespace rockfold {

/// The movement with the resistance of the joints that the stress clamps. The block moves by d along
/// s: a joint that opens at the rate a = −s·n keeps N(d) = max(0, N₀ − k_n A a d) and holds
/// S(d) = min(S₀ + k_s A t d, N tan φ + c A) against its tangential part t = √(1 − a²); the planes that
/// the block slides on carry what N pushes them by. A joint holds until it has opened: at N = 0 its S
/// is the limit from before, min(S₀ + k_s A t d, c A). The d with the least sliding force counts
/// (Crawford & Bray 1983). S₀ is what the rock held along the joint before the block moved; 0 under
/// far-field stress (as 3DEC's falling wedge has it).
/// Planes without clamping, or without stiffness, are left out; without any the movement is returned
/// as it is.
Movement with_in_situ_stress(std::span<const ContactPlane> planes, const Movement& movement,
                             const Vec3& r);

}  // namespace rockfold
