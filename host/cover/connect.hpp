// Manifold elements and physical covers as connected components: pieces joined inside a tetrahedron are an element,
// elements joined inside the star of a lattice node are one physical cover of it (thesis 2.3).
#pragma once

#include "host/cover/piece_index.hpp"
#include "host/cover/pieces.hpp"
#include "host/cut/complex.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// Fills everything of `covers` but the lattice, and of `index` but its planes. `welded` joins across joints too.
/// O(n log n) in the number of cut pieces, O(n α) in regular lattice cells.
void connect(const Complex& complex, const Model& model, const Pieces& pieces, bool welded,
             CoverArrays& covers, PieceIndex& index);

}  // namespace rockfold
