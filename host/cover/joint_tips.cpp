#include "host/cover/joint_tips.hpp"

#include <algorithm>
#include <utility>

#include "host/cover/glue.hpp"
#include "host/cover/lattice/slivers.hpp"
#include "host/cut/bodies/union_find.hpp"

namespace rockfold {

namespace {

// Calls visit(area) for what touches within a block across joints, or where there are none.
template <class Visit>
void visit_glue_areas(const Complex& complex, GlueFinder& glue, bool joints, Visit visit) {
  for (const Fragment& f : complex.fragments) {
    if ((f.joint != none) != joints || complex.touches_sliver(f) || f.narrow) continue;
    if (joints && !f.dead_end) continue;
    if (!complex.is_analysed(f.cell[0]) || !complex.is_analysed(f.cell[1])) continue;
    glue.visit(f, visit);
  }
}

// Regular lattice cells that joints within a block touch become pieces, which can have cuts.
void split_touched(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                   Pieces& pieces) {
  const OccupiedCells cells(lattice.lattice(), pieces);
  GlueFinder glue(complex, lattice, planes, cells);
  std::vector<bool> touched(pieces.regular.size(), false);
  visit_glue_areas(complex, glue, true, [&](const GlueArea& c) {
    for (const Index r : {c.one.regular, c.two.regular})
      if (r != none) touched[r] = true;
  });
  split_regular(complex, lattice, planes, touched, pieces);
}

class TipExtender {
 public:
  TipExtender(const Complex& complex, const Model& model, const LatticePlanes& lattice,
              const PlaneTable& planes, Pieces& pieces)
      : complex_(complex),
        model_(model),
        lattice_(lattice),
        planes_(planes),
        pieces_(pieces),
        cells_(lattice.lattice(), pieces),
        glue_(complex, lattice, planes, cells_),
        splitter_(planes) {}

  void run() {
    find_elements();
    find_tips();
    if (!tips_.empty()) cut_elements();
  }

 private:
  Index material(Index rock) const { return model_.solids[complex_.zone(rock).solid].material; }

  void find_elements() {
    UnionFind parts(static_cast<Index>(pieces_.pieces.size()));
    visit_glue_areas(complex_, glue_, false, [&](const GlueArea& c) {
      const Index one = c.one.piece_begin, two = c.two.piece_begin;
      if (c.facet != nullptr || c.one.regular != none || c.two.regular != none ||
          c.touches_sliver())
        return;
      if (material(pieces_.pieces[one].rock) == material(pieces_.pieces[two].rock))
        parts.join(one, two);
    });
    element_ = parts.components();
  }

  // No lattice cell with a joint on or in it is regular any more.
  void find_tips() {
    visit_glue_areas(complex_, glue_, true, [&](const GlueArea& c) {
      if (c.touches_sliver()) return;
      const Index one = element_[c.one.piece_begin], two = element_[c.two.piece_begin];
      if (c.facet == nullptr && one != two) return;
      for (const Index element : {one, two}) tips_.emplace_back(element, c.polygon.plane);
    });
    std::sort(tips_.begin(), tips_.end());
    tips_.erase(std::unique(tips_.begin(), tips_.end()), tips_.end());
  }

  void cut_elements() {
    std::vector<PieceRecord> result;
    result.reserve(pieces_.pieces.size());
    for (std::size_t i = 0; i < pieces_.pieces.size(); ++i) {
      auto tip = std::lower_bound(tips_.begin(), tips_.end(), std::pair{element_[i], Index{0}});
      if (tip == tips_.end() || tip->first != element_[i]) {
        result.push_back(std::move(pieces_.pieces[i]));
        continue;
      }
      const auto first = tip;
      while (tip != tips_.end() && tip->first == element_[i]) ++tip;
      const PieceRecord& piece = pieces_.pieces[i];
      cut(clip_to_part(complex_, lattice_, planes_, piece), piece, first, tip, {}, result);
    }
    pieces_.pieces = std::move(result);
  }

  using Tip = std::vector<std::pair<Index, Index>>::const_iterator;
  void cut(const ConvexCell& cell, const PieceRecord& whole, Tip tip, Tip end,
           const std::vector<HalfSpaceId>& cuts, std::vector<PieceRecord>& result) {
    if (tip == end) {
      PieceRecord r =
          make_record(lattice_, planes_, whole.lattice_cell, whole.part, whole.rock, cell);
      r.cuts = cuts;
      if (volume_of(r) > 0) result.push_back(std::move(r));
      return;
    }
    const Index plane = tip->second;
    const CellSide side = splitter_.classify(cell, plane);
    ConvexCell below, above;
    if (side == CellSide::split) splitter_.split(cell, plane, &below, &above);
    for (const bool up : {false, true}) {
      if (side == (up ? CellSide::below : CellSide::above)) continue;
      auto own = cuts;
      own.push_back(half_space(plane, up));
      cut(side == CellSide::split ? (up ? above : below) : cell, whole, tip + 1, end, own, result);
    }
  }

  const Complex& complex_;
  const Model& model_;
  const LatticePlanes& lattice_;
  const PlaneTable& planes_;
  Pieces& pieces_;
  const OccupiedCells cells_;
  GlueFinder glue_;
  CellSplitter splitter_;
  std::vector<Index> element_;                 // of each piece
  std::vector<std::pair<Index, Index>> tips_;  // element, plane of a joint that ends inside it
};

}  // namespace

void extend_joint_tips(const Complex& complex, const Model& model, const LatticePlanes& lattice,
                       const PlaneTable& planes, Pieces& pieces) {
  split_touched(complex, lattice, planes, pieces);
  TipExtender(complex, model, lattice, planes, pieces).run();
}

}  // namespace rockfold
