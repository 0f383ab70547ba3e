#include "host/cover/lattice/pieces.hpp"

#include <algorithm>
#include <atomic>

#include "host/cut/bodies/width.hpp"
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

void sort_pieces(Pieces& pieces) {
  const auto by_key = [](const auto& a, const auto& b) { return a.key() < b.key(); };
  std::stable_sort(pieces.pieces.begin(), pieces.pieces.end(), by_key);
  std::sort(pieces.slivers.begin(), pieces.slivers.end(), by_key);
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

ConvexCell clip_to_part(const Complex& complex, const LatticePlanes& lattice,
                        const PlaneTable& planes, const PieceRecord& piece) {
  const auto ijk = lattice.lattice().cell_ijk(piece.lattice_cell);
  std::vector<HalfSpaceId> inside;
  for (const PartFacet& facet : lattice.form(ijk).facet[piece.part])
    inside.push_back(lattice.inside(ijk, facet));
  inside.insert(inside.end(), piece.cuts.begin(), piece.cuts.end());
  return clip(planes, complex.cells[piece.rock], inside);
}

namespace {

// Of the model's size: a lattice that means to run along a face misses it by as much at most, for rounding. Such pieces of a
// wide cell are left out: beside 3 L/s lattice planes of spacing s they come to 1e-12 of the rock for s = L/300.
constexpr Real negligible_width = 1e-15;

class CellCutter {
 public:
  CellCutter(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes)
      : complex_(complex), lattice_(lattice), planes_(planes) {}

  void cut(Index rock, Pieces& out) const {
    LatticeWalker walker(lattice_, planes_);
    CellVisitor visitor;
    visitor.whole = [&](const LatticeBox& box) {
      for (Index k = box.low[2]; k < box.high[2]; ++k)
        for (Index j = box.low[1]; j < box.high[1]; ++j)
          for (Index i = box.low[0]; i < box.high[0]; ++i)
            out.regular.push_back({lattice_.lattice().cell_index(i, j, k), rock});
    };
    visitor.piece = [&](const std::array<Index, 3>& ijk, int part, const CellView& piece) {
      add(ijk, part, rock, piece, out);
    };
    walker.walk(complex_.cells[rock], visitor);
  }

 private:
  void add(const std::array<Index, 3>& ijk, int part, Index rock, const CellView& piece,
           Pieces& out) const {
    PieceRecord record =
        make_record(lattice_, planes_, lattice_.lattice().cell_index(ijk[0], ijk[1], ijk[2]), part,
                    rock, piece);
    const bool of_sliver = complex_.is_sliver[rock] != 0;
    const Real width = of_sliver ? 0 : measure_cell(piece, planes_).width;
    if (width >= planes_.width_tolerance()) {
      out.pieces.push_back(std::move(record));
      return;
    }
    Sliver sliver;
    sliver.piece = std::move(record);
    sliver.left_out = !of_sliver && width < negligible_width * planes_.model_size();
    const auto& facets = lattice_.form(ijk).facet[part];
    for (std::size_t a = 0; a < facets.size(); ++a)
      for (const auto& face : piece.faces)
        if (face.inside == lattice_.inside(ijk, facets[a]))
          sliver.facet_area.emplace_back(static_cast<int>(a), face_area(piece, face));
    out.slivers.push_back(std::move(sliver));
  }

  const Complex& complex_;
  const LatticePlanes& lattice_;
  const PlaneTable& planes_;
};

}  // namespace

Pieces cut_pieces(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                  Progress& progress) {
  const Index n = complex.cells.size();
  std::vector<Pieces> cells(n);
  std::atomic<std::int64_t> done{0};
  progress.begin("covering", n, "cells");
  const CellCutter cutter(complex, lattice, planes);
  parallel_for(n, 4, [&](std::int64_t c) {
    const auto rock = static_cast<Index>(c);
    if (!complex.is_analysed(rock)) return;  // excavated before the analysis starts
    cutter.cut(rock, cells[c]);
    const auto count = done.fetch_add(1) + 1;
    if (interrupt_signal != 0)
      throw Error(ErrorKind::analysis, "interrupted while covering; nothing was written");
    if (count % 64 == 0) {
#pragma omp critical(rockfold_progress)
      progress.done(count);
    }
  });
  progress.end();
  Pieces all;
  for (Pieces& p : cells) {
    all.regular.insert(all.regular.end(), p.regular.begin(), p.regular.end());
    std::move(p.pieces.begin(), p.pieces.end(), std::back_inserter(all.pieces));
    std::move(p.slivers.begin(), p.slivers.end(), std::back_inserter(all.slivers));
    p = {};
  }
  std::sort(all.regular.begin(), all.regular.end(),
            [](const auto& a, const auto& b) { return a.lattice_cell < b.lattice_cell; });
  sort_pieces(all);
  return all;
}

Pieces block_pieces(const Complex& complex, const LatticePlanes& lattice) {
  Pieces all;
  for (Index rock = 0; rock < complex.cells.size(); ++rock) {
    if (!complex.is_analysed(rock)) continue;
    PieceRecord record = make_record(lattice, complex.planes, complex.cell_block[rock], 0, rock,
                                     complex.cells[rock]);
    if (complex.is_sliver[rock] != 0)
      all.slivers.emplace_back().piece = std::move(record);
    else
      all.pieces.push_back(std::move(record));
  }
  sort_pieces(all);
  return all;
}

}  // namespace rockfold
