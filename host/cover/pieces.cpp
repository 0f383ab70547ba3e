#include "host/cover/pieces.hpp"

#include <algorithm>
#include <atomic>
#include <tuple>

#include "host/parallel.hpp"
#include "src/base/error.hpp"
#include "src/base/interrupt.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

PieceRecord make_record(const Lattice& lattice, const PlaneTable& planes, Index lattice_cell,
                        int part, Index rock, const CellView& cell) {
  PieceRecord r;
  r.lattice_cell = lattice_cell;
  r.rock = rock;
  r.part = part;
  r.vertex_count = static_cast<std::int32_t>(cell.vertices.size());
  r.face_count = static_cast<std::int32_t>(cell.faces.size());
  const Vec3 centre = lattice.cell_centre(r.lattice_cell) - planes.centre();
  r.vertices.reserve(cell.vertices.size());
  for (const Vertex& v : cell.vertices) r.vertices.push_back(v.x - centre);
  r.triangles.reserve(cell.corners.size() - 2 * cell.faces.size());
  for (const auto& f : cell.faces)
    for (std::int32_t k = 1; k + 1 < f.count; ++k)
      r.triangles.push_back({cell.corners[f.begin].vertex, cell.corners[f.begin + k].vertex,
                             cell.corners[f.begin + k + 1].vertex});
  return r;
}

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

// A piece thinner than rounding has no volume to integrate; the rock it stands for is below 1e-15 of a lattice cell.
Real volume6(const PieceRecord& r) {
  Real v = 0;
  const Vec3 o = r.vertices.front();
  for (const auto& t : r.triangles)
    v += dot(r.vertices[t[0]] - o, cross(r.vertices[t[1]] - o, r.vertices[t[2]] - o));
  return v;
}

void sort_pieces(std::vector<PieceRecord>& pieces) {
  std::sort(pieces.begin(), pieces.end(), [](const PieceRecord& a, const PieceRecord& b) {
    return std::tie(a.lattice_cell, a.part, a.rock) < std::tie(b.lattice_cell, b.part, b.rock);
  });
}

}  // namespace

Pieces cut_pieces(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                  Progress& progress) {
  const Index n = complex.cells.size();
  std::vector<Pieces> parts(n);
  std::atomic<std::int64_t> done{0};
  progress.begin("covering", n, "cells");
  parallel_for(n, 4, [&](std::int64_t c) {
    const auto rock = static_cast<Index>(c);
    if (complex.zone(rock).stage != 0) return;  // excavated before the analysis starts
    LatticeWalker walker(lattice, planes);
    Pieces& out = parts[c];
    CellVisitor visitor;
    visitor.whole = [&](const LatticeBox& box) {
      for (Index k = box.low[2]; k < box.high[2]; ++k)
        for (Index j = box.low[1]; j < box.high[1]; ++j)
          for (Index i = box.low[0]; i < box.high[0]; ++i)
            out.regular.push_back({lattice.lattice().cell_index(i, j, k), rock});
    };
    visitor.piece = [&](const std::array<Index, 3>& ijk, int part, const CellView& piece) {
      PieceRecord r =
          make_record(lattice.lattice(), planes,
                      lattice.lattice().cell_index(ijk[0], ijk[1], ijk[2]), part, rock, piece);
      r.open_facets = open_facets(lattice, ijk, part, piece);
      if (volume6(r) > 0) out.pieces.push_back(std::move(r));
    };
    walker.walk(complex.cells[rock], visitor);
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
  for (Pieces& p : parts) {
    all.regular.insert(all.regular.end(), p.regular.begin(), p.regular.end());
    std::move(p.pieces.begin(), p.pieces.end(), std::back_inserter(all.pieces));
    p = {};
  }
  std::sort(all.regular.begin(), all.regular.end(),
            [](const auto& a, const auto& b) { return a.lattice_cell < b.lattice_cell; });
  sort_pieces(all.pieces);
  return all;
}

Pieces block_pieces(const Complex& complex, const Lattice& lattice) {
  Pieces all;
  for (Index rock = 0; rock < complex.cells.size(); ++rock) {
    if (complex.zone(rock).stage != 0) continue;
    PieceRecord r = make_record(lattice, complex.planes, complex.cell_block[rock], 0, rock,
                                complex.cells[rock]);
    if (volume6(r) > 0) all.pieces.push_back(std::move(r));
  }
  sort_pieces(all.pieces);
  return all;
}

}  // namespace rockfold
