// Bodies of mesh files whose coordinates are rounded: fitted together as they are read, before anything is cut exactly.
#pragma once

#include "src/model/model.hpp"

namespace rockfold {

/// Of the solids from meshes that are added: where surfaces of two are nearer than twice the tolerance (either may be off by it), corners
/// become one point, faces that share an area become one plane, and each corner comes to lie on all of its faces. Convex bodies become the
/// half-spaces of their planes, so that neighbours share a plane to the last digit; of others corners move. Bodies that touch
/// no other stay as they are. Fills Model::body_fit; does nothing where it is filled. Throws Error(model) where a given tolerance is
/// no rounding, but of a body's size; adds warnings.
void fit_bodies(Model& model);

}  // namespace rockfold
