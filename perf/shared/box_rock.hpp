// A cube of lattice cells for benchmarks, with some layers of cells stored as cut elements though they are whole: the same
// rock, so that every variant must give the same answer.
#pragma once

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// n³ cells of side 1/n. In each three layers the last `cut_layers` (0 … 3) are stored as cut elements.
CoverArrays box_rock(Index n, int cut_layers);

/// The same with joints on the upper faces of every third layer, open over a third of each: squares of `square` cells in
/// changing places. A lattice node inside an open joint has two covers.
CoverArrays jointed_rock(Index n, int cut_layers, Index square);

}  // namespace rockfold
