// What a model's loads are in terms of the covers: points of the material that forces and dashpots act on.
#pragma once

#include "host/cover/cover.hpp"
#include "host/cover/points/free_faces.hpp"
#include "src/arrays/load_arrays.hpp"

namespace rockfold {

/// Degree of the functions of an element on a plane.
int function_degree(const CoverArrays& covers);

/// The [[point_load]] and [[traction]] of a model: point loads first, in their order. A traction becomes points whose shares of the
/// area integrate it times the functions of each element exactly, so that the forces of a face sum to its area times the traction.
/// Throws Error(model): a point that is not in the rock, a traction where no free face is.
LoadPoints load_points(const Cutting& cutting, const Covering& covering, const Model& model);

/// What making free faces does to rock under an in-situ stress σ: the traction −σ n, exact for a stress that is linear. Added to σ, the
/// stress that it causes leaves the faces free.
LoadPoints unloading_points(const Cutting& cutting, const Covering& covering,
                            const InitialStress& stress, const FacesOf& made_free);

/// The dashpots of [[quiet_boundary]], exact for products of two functions of an element. Throws Error(model) where no free face is.
QuietPoints quiet_points(const Cutting& cutting, const Covering& covering, const Model& model);

/// [[initial_velocity]]. Throws Error(model) where block_at is not in the rock.
std::vector<RigidVelocity> rigid_velocities(const Covering& covering, Index blocks,
                                            const Model& model);

}  // namespace rockfold
