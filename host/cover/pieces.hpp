// All rock as whole lattice cells and convex pieces of lattice cells' parts, in lattice order.
#pragma once

#include <cstdint>
#include <vector>

#include "host/cover/cover_planes.hpp"
#include "host/cover/lattice_walk.hpp"
#include "host/cut/complex.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

struct PieceRecord {
  Index lattice_cell = none;
  Index rock = none;               ///< cell of the complex
  std::int32_t part = 0;           ///< into the lattice cell's split
  std::uint32_t open_facets = 0;   ///< bit a: the piece has an area on facet a, which lies on the
                                   ///< lattice cell's boundary
  std::vector<HalfSpaceId> faces;  ///< that bound it, on its side
  /// Planes of joints prolonged through the piece's element, or along its facets (joint_tips), on the piece's side; several
  /// pieces of one cell of the complex in a part differ in them.
  std::vector<HalfSpaceId> cuts;
  std::vector<Vec3> vertices;                   ///< m, from the lattice cell's centre
  std::vector<std::array<Index, 3>> triangles;  ///< outward
};

struct Pieces {
  struct Regular {
    Index lattice_cell, rock;
  };
  std::vector<Regular> regular;     ///< ordered by lattice cell
  std::vector<PieceRecord> pieces;  ///< ordered by lattice cell, part, rock, cuts
};

/// Cuts the cells of a complex by the lattice, in parallel over cells. Says in `planes` which cells arithmetic decides.
/// Throws Error(model) where neither the rules of intent nor arithmetic make pieces that have the volume of a cell.
Pieces cut_pieces(const Complex& complex, const CoverSpec& cover, const LatticePlanes& lattice,
                  CoverPlanes& planes, Progress& progress);

/// Kind `block`: the cells of the complex as they are.
Pieces block_pieces(const Complex& complex, const LatticePlanes& lattice);

void sort_pieces(std::vector<PieceRecord>& pieces);  ///< in the order of Pieces, but for cuts

PieceRecord make_record(const LatticePlanes& lattice, const PlaneTable& planes, Index lattice_cell,
                        int part, Index rock, const CellView& cell);
/// Thinner than rounding, a piece has no volume to integrate; the rock it stands for is below 1e-15 of a lattice cell.
bool has_volume(const PieceRecord& piece);
/// m³
Real volume_of(const PieceRecord& piece);

/// What a cell of the complex has of a part of a lattice cell, within the cuts.
ConvexCell clip_to_part(const Complex& complex, const LatticePlanes& lattice,
                        const CoverPlanes& planes, const PieceRecord& piece);

}  // namespace rockfold
