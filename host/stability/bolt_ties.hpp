// Bolts as ties between rigid bodies.
#pragma once

#include <vector>

#include "host/stability/rigid_mass.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// What the model's [[bolt]]s and [[bolt_pattern]]s pass between bodies, where they stand after all stages of excavation. `body_of` [B]: none =
/// held or gone.
///
/// A bolt holds each body that it crosses on the last one, in which it ends, with what axial_capacity() says of its length in both and, of the
/// first, of its plate. Together they bear no more than the bolt and its far end do: those nearest to the collar take first, as `support` counts
/// bolts. Its shear capacity is left out.
std::vector<BoltTie> bolt_ties(const BlockArrays& blocks, const Model& model,
                               const std::vector<Index>& body_of);

}  // namespace rockfold
