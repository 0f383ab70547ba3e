#include "host/cover/pieces.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

std::uint32_t open_facets(const LatticePlanes& lattice, const std::array<Index, 3>& ijk, int part,
                          const CellView& cell) {
  std::uint32_t open = 0;
  const auto& facets = lattice.form(ijk).facet[part];
  for (std::size_t a = 0; a < facets.size(); ++a) {
    if (facets[a].axis < 0) continue;
    const HalfSpaceId h = lattice.inside(ijk, facets[a]);
    for (const auto& face : cell.faces)
      if (face.inside == h) open |= 1u << a;
  }
  return open;
}

}  // namespace

void sort_pieces(std::vector<PieceRecord>& pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const PieceRecord& a, const PieceRecord& b) {
    return std::tie(a.lattice_cell, a.part, a.rock) < std::tie(b.lattice_cell, b.part, b.rock);
  });
}

PieceRecord make_record(const LatticePlanes& lattice, const PlaneTable& planes, Index lattice_cell,
                        int part, Index rock, const CellView& cell) {
  PieceRecord r;
  r.lattice_cell = lattice_cell;
  r.rock = rock;
  r.part = part;
  r.open_facets = open_facets(lattice, lattice.lattice().cell_ijk(lattice_cell), part, cell);
  r.faces.reserve(cell.faces.size());
  for (const auto& f : cell.faces) r.faces.push_back(f.inside);
  const Vec3 centre = lattice.lattice().cell_centre(lattice_cell) - planes.centre();
  r.vertices.reserve(cell.vertices.size());
  for (const Vertex& v : cell.vertices) r.vertices.push_back(v.x - centre);
  r.triangles.reserve(cell.corners.size() - 2 * cell.faces.size());
  for (const auto& f : cell.faces)
    for (std::int32_t k = 1; k + 1 < f.count; ++k)
      r.triangles.push_back({cell.corners[f.begin].vertex, cell.corners[f.begin + k].vertex,
                             cell.corners[f.begin + k + 1].vertex});
  return r;
}

Real volume_of(const PieceRecord& r) {
  Real six = 0;
  const Vec3 o = r.vertices.front();
  for (const auto& t : r.triangles)
    six += dot(r.vertices[t[0]] - o, cross(r.vertices[t[1]] - o, r.vertices[t[2]] - o));
  return six / 6;
}

bool has_volume(const PieceRecord& r) {
  return volume_of(r) > 0;
}

ConvexCell clip_to_part(const Complex& complex, const LatticePlanes& lattice,
                        const CoverPlanes& planes, const PieceRecord& piece) {
  const auto ijk = lattice.lattice().cell_ijk(piece.lattice_cell);
  std::vector<HalfSpaceId> inside;
  for (const PartFacet& facet : lattice.form(ijk).facet[piece.part])
    inside.push_back(lattice.inside(ijk, facet));
  inside.insert(inside.end(), piece.cuts.begin(), piece.cuts.end());
  return clip(planes.of(piece.rock), complex.cells[piece.rock], inside);
}

namespace {

// What one cell of the complex is cut into, and what to think of it.
struct CutCell {
  Pieces pieces;
  bool cut = true;     // no contradiction met
  bool whole = true;   // the pieces have the cell's volume
  bool close = false;  // planes nearly meet
  Real volume = 0;     // m³, of the pieces

  bool sound() const { return cut && whole; }
};

class CellCutter {
 public:
  CellCutter(const Complex& complex, const CoverSpec& cover, const LatticePlanes& lattice,
             const PlaneTable& planes)
      : complex_(complex),
        cell_volume_(lattice_cell_volume(cover)),
        share_(cell_split(cover.lattice).share),
        lattice_(lattice),
        planes_(planes) {}

  // Pieces of at most `negligible` times the volume of the lattice cell or of the rock are left out.
  CutCell cut(Index rock, Real negligible) const {
    CutCell result;
    Pieces& out = result.pieces;
    const Real volume = complex_.moments[rock].volume;
    const Real least = negligible * std::min(cell_volume_, volume);
    LatticeWalker walker(lattice_, planes_);
    CellVisitor visitor;
    visitor.whole = [&](const LatticeBox& box) {
      for (Index k = box.low[2]; k < box.high[2]; ++k)
        for (Index j = box.low[1]; j < box.high[1]; ++j)
          for (Index i = box.low[0]; i < box.high[0]; ++i) {
            out.regular.push_back({lattice_.lattice().cell_index(i, j, k), rock});
            result.volume += cell_volume_;
          }
    };
    visitor.piece = [&](const std::array<Index, 3>& ijk, int part, const CellView& piece) {
      PieceRecord r =
          make_record(lattice_, planes_, lattice_.lattice().cell_index(ijk[0], ijk[1], ijk[2]),
                      part, rock, piece);
      const Real own = volume_of(r);
      if (own <= least) return;
      result.volume += share_ * own;
      out.pieces.push_back(std::move(r));
    };
    try {
      walker.walk(complex_.cells[rock], visitor);
    } catch (const std::logic_error&) {  // planes that nearly meet contradict each other
      result.cut = false;
    }
    result.close = walker.cell_intent().close_calls > 0;
    const Real off = std::abs(result.volume - volume);
    result.whole = off <= 1e-12 * volume || off <= slack(rock);
    return result;
  }

 private:
  // A lattice plane lies within the tolerance of the face that it is taken to be.
  Real slack(Index rock) const {
    const CellView cell = complex_.cells[rock];
    Real area = 0;
    for (const auto& face : cell.faces) area += face_area(cell, face);
    return 3 * planes_.tolerance() * area;
  }

  const Complex& complex_;
  const Real cell_volume_, share_;
  const LatticePlanes& lattice_;
  const PlaneTable& planes_;
};

[[noreturn]] void refuse_pieces(const Complex& complex, const CoverSpec& cover, Index rock,
                                const CutCell& found) {
  const CellMoments& m = complex.moments[rock];
  const Vec3 x = (1 / m.volume) * m.first + complex.planes.centre();
  throw Error(
      ErrorKind::model,
      fmt::format(
          "the lattice's planes nearly coincide with the faces of the rock about ({:.9g}, "
          "{:.9g}, {:.9g}) and cut it into pieces of {:.9g} m³ where it has {:.9g} m³: move "
          "the lattice's origin, or change its spacing, by more than {:.1g} m",
          x[0], x[1], x[2], found.volume, m.volume, 1e3 * complex.planes.tolerance()),
      Place{cover.place.file, cover.place.line, cover.place.column, "cover.origin"});
}

constexpr Real negligible = 1e-15;  // of the rock that arithmetic alone cuts off

// Cuts those cells again by arithmetic alone. What rules of intent moved when the rock was cut may contradict it: then the
// pieces at hand stay, if they are sound.
void cut_exactly(const Complex& complex, const CoverSpec& cover, const LatticePlanes& lattice,
                 CoverPlanes& planes, const std::vector<Index>& which,
                 std::vector<CutCell>& cells) {
  std::vector<bool> by_arithmetic(cells.size(), false);
  for (const Index rock : which) by_arithmetic[rock] = true;
  planes.decide_by_arithmetic(std::move(by_arithmetic));
  const CellCutter exact(complex, cover, lattice, *planes.exact());
  std::vector<char> failed(which.size(), 0);
  parallel_for(static_cast<Index>(which.size()), 4, [&](std::int64_t i) {
    CutCell again = exact.cut(which[i], negligible);
    if (again.sound())
      cells[which[i]] = std::move(again);
    else
      failed[i] = 1;
  });
  for (std::size_t i = 0; i < which.size(); ++i) {
    if (failed[i] == 0) continue;
    const Index rock = which[i];
    if (!cells[rock].sound()) refuse_pieces(complex, cover, rock, cells[rock]);
    planes.decide_by_intent(rock);
  }
}

}  // namespace

Pieces cut_pieces(const Complex& complex, const CoverSpec& cover, const LatticePlanes& lattice,
                  CoverPlanes& planes, Progress& progress) {
  const Index n = complex.cells.size();
  std::vector<CutCell> cells(n);
  std::atomic<std::int64_t> done{0};
  progress.begin("covering", n, "cells");
  const CellCutter cutter(complex, cover, lattice, planes.table);
  parallel_for(n, 4, [&](std::int64_t c) {
    const auto rock = static_cast<Index>(c);
    if (complex.zone(rock).stage != 0) return;  // excavated before the analysis starts
    cells[c] = cutter.cut(rock, 0);
    const auto count = done.fetch_add(1) + 1;
    if (interrupt_signal != 0)
      throw Error(ErrorKind::analysis, "interrupted while covering; nothing was written");
    if (count % 64 == 0) {
#pragma omp critical(rockfold_progress)
      progress.done(count);
    }
  });
  progress.end();
  std::vector<Index> again;
  for (Index c = 0; c < n; ++c)
    if (cells[c].close || !cells[c].sound()) again.push_back(c);
  if (!again.empty()) cut_exactly(complex, cover, lattice, planes, again, cells);

  Pieces all;
  for (CutCell& cell : cells) {
    Pieces& p = cell.pieces;
    all.regular.insert(all.regular.end(), p.regular.begin(), p.regular.end());
    std::move(p.pieces.begin(), p.pieces.end(), std::back_inserter(all.pieces));
    p = {};
  }
  std::sort(all.regular.begin(), all.regular.end(),
            [](const auto& a, const auto& b) { return a.lattice_cell < b.lattice_cell; });
  sort_pieces(all.pieces);
  return all;
}

Pieces block_pieces(const Complex& complex, const LatticePlanes& lattice) {
  Pieces all;
  for (Index rock = 0; rock < complex.cells.size(); ++rock) {
    if (complex.zone(rock).stage != 0) continue;
    PieceRecord r = make_record(lattice, complex.planes, complex.cell_block[rock], 0, rock,
                                complex.cells[rock]);
    if (has_volume(r)) all.pieces.push_back(std::move(r));
  }
  sort_pieces(all.pieces);
  return all;
}

}  // namespace rockfold
