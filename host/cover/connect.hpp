// Manifold elements and physical covers as connected components: pieces joined inside a part of a lattice cell are an
// element, elements joined inside the star of a lattice node are one physical cover of it (thesis 2.3).
#pragma once

#include "host/cover/lattice/piece_index.hpp"
#include "host/cover/lattice/pieces.hpp"
#include "host/cut/cells/complex.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Whether covers go on across dead ends, joints with one block on both sides. They do where blocks touch each other: contact is between
/// blocks, so that the sides of a dead end would part and pass through each other, and initial stress would have nothing to press against.
bool heals_dead_ends(const Complex& complex, const Model& model);

/// Fills everything of `covers` but the lattice and the order, and of `index` but its planes. Welded joints join too, and dead ends that heal.
/// O(n log n) in the number of cut pieces, O(n α) in regular lattice cells. Throws Error(model) if there are more than
/// cover.max_elements elements.
void connect(const Complex& complex, const Model& model, const Pieces& pieces, CoverArrays& covers,
             PieceIndex& index);

/// Throws Error(model) if that many elements are more than cover.max_elements.
void refuse_elements(const CoverSpec& cover, Real elements, bool at_least);

}  // namespace rockfold
