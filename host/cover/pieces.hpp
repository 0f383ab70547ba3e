// All rock as whole lattice cells and convex pieces of lattice cells' parts, in lattice order.
#pragma once

#include <cstdint>
#include <vector>

#include "host/cover/lattice_walk.hpp"
#include "host/cut/complex.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

struct PieceRecord {
  Index lattice_cell = none;
  Index rock = none;              ///< cell of the complex
  std::int32_t part = 0;          ///< into the lattice cell's split
  std::uint32_t open_facets = 0;  ///< bit a: the piece has an area on facet a, which lies on the
                                  ///< lattice cell's boundary
  std::int32_t vertex_count = 0, face_count = 0;
  std::vector<Vec3> vertices;                   ///< m, from the lattice cell's centre
  std::vector<std::array<Index, 3>> triangles;  ///< outward
};

struct Pieces {
  struct Regular {
    Index lattice_cell, rock;
  };
  std::vector<Regular> regular;     ///< ordered by lattice cell
  std::vector<PieceRecord> pieces;  ///< ordered by lattice cell, part, rock
};

/// Cuts the cells of a complex by the lattice, in parallel over cells.
Pieces cut_pieces(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                  Progress& progress);

/// Kind `block`: the cells of the complex as they are.
Pieces block_pieces(const Complex& complex, const Lattice& lattice);

}  // namespace rockfold
