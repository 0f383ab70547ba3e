// Rigid motions of the rock in terms of the covers' unknowns: what blocks start with, and what reactions turn about.
#pragma once

#include <vector>

#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// The unknowns of the velocity field v + ω × (x − c) are, with a the arm of an unknown, v + ω × (a − c) for constant functions (the
/// first P), ω × a for linear ones and 0 for quadratic ones: exact in every lattice, but for the rotation of a block of order 0.
/// [U] m
std::vector<Vec3> rigid_arms(const CoverArrays& covers);

/// At rest but for the blocks that are given a velocity, about the common mass centre of each one's blocks. Where a cover belongs
/// to several of them (welded joints), the last counts. Throws Error(analysis) where blocks would have to turn that cannot.
StateArrays initial_motion(const CoverArrays& covers, const PieceMoments& moments,
                           const std::vector<ElasticMaterial>& materials,
                           const std::vector<RigidVelocity>& velocities);

/// The sum of the forces of each condition's fixed points, and of their moments about the origin. `reactions`: [N] N, of each point.
/// `displacement`: [U] of the rock that they act on; empty: none that counts.
std::vector<Reaction> sum_reactions(const CoverArrays& covers, const FixedPoints& fixed,
                                    const std::vector<Vec3>& reactions,
                                    const std::vector<Vec3>& displacement, Index conditions);

}  // namespace rockfold
