// All rock as whole lattice cells and convex pieces of lattice cells' parts, in lattice order.
#pragma once

#include <cstdint>
#include <tuple>
#include <vector>

#include "host/cover/lattice/lattice_walk.hpp"
#include "host/cut/cells/complex.hpp"
#include "src/base/progress.hpp"

namespace rockfold {

/// Where a piece is.
struct PieceKey {
  Index lattice_cell = none;
  int part = 0;
  Index rock = none;
  auto all() const { return std::tie(lattice_cell, part, rock); }
  bool operator==(const PieceKey& other) const { return all() == other.all(); }
  bool operator<(const PieceKey& other) const { return all() < other.all(); }
};

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
  PieceKey key() const { return {lattice_cell, part, rock}; }
};

/// A piece narrower than the tolerance has no functions of its own: those of its owner, continued, move it.
struct Sliver {
  PieceRecord piece;
  bool left_out = false;  ///< so narrow that its volume is rounding: its owner is all that counts
  std::vector<std::pair<int, Real>> facet_area;  ///< m², on the facets of its part
  PieceKey owner;                                ///< of a piece that is no sliver
  PieceKey key() const { return piece.key(); }
};

struct Pieces {
  struct Regular {
    Index lattice_cell, rock;
  };
  std::vector<Regular> regular;     ///< ordered by lattice cell
  std::vector<PieceRecord> pieces;  ///< ordered by lattice cell, part, rock, cuts
  std::vector<Sliver> slivers;      ///< ordered by lattice cell, part, rock
};

/// Cuts the cells of a complex by the lattice, in parallel over cells. Slivers have no owners yet.
Pieces cut_pieces(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                  Progress& progress);

/// Kind `block`: the cells of the complex as they are; part 0 of lattice cell b is all of block b.
Pieces block_pieces(const Complex& complex, const LatticePlanes& lattice);

void sort_pieces(Pieces& pieces);  ///< in the order of Pieces

PieceRecord make_record(const LatticePlanes& lattice, const PlaneTable& planes, Index lattice_cell,
                        int part, Index rock, const CellView& cell);
/// m³
Real volume_of(const PieceRecord& piece);

/// What a cell of the complex has of a part of a lattice cell, within the cuts.
ConvexCell clip_to_part(const Complex& complex, const LatticePlanes& lattice,
                        const PlaneTable& planes, const PieceRecord& piece);

}  // namespace rockfold
