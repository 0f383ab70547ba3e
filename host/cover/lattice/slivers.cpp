#include "host/cover/lattice/slivers.hpp"

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "host/cover/lattice/occupied_cells.hpp"

namespace rockfold {

namespace {

class OwnerFinder {
 public:
  OwnerFinder(const Complex& complex, const LatticePlanes& lattice, Pieces& pieces)
      : complex_(complex), lattice_(lattice), pieces_(pieces), cells_(lattice.lattice(), pieces) {
    for (const Fragment& f : complex.fragments)
      if (complex.touches_sliver(f) &&
          complex.cell_block[f.cell[0]] == complex.cell_block[f.cell[1]])
        for (int side = 0; side < 2; ++side)
          if (complex.is_sliver[f.cell[side]] != 0)
            beside_[f.cell[side]].emplace(f.joint != none, f.cell[1 - side]);
  }

  // Round by round: what was found in the rounds before may own too.
  void run() {
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < pieces_.slivers.size(); ++i)
      if (pieces_.slivers[i].owner.rock == none) open.push_back(i);
    for (bool found = true; found;) {
      found = false;
      std::vector<std::pair<std::size_t, PieceKey>> owners;
      std::erase_if(open, [&](std::size_t i) {
        const auto owner = find(pieces_.slivers[i]);
        if (owner) owners.emplace_back(i, *owner);
        return owner.has_value();
      });
      for (const auto& [i, owner] : owners) pieces_.slivers[i].owner = owner;
      found = !owners.empty();
    }
  }

 private:
  using Owner = std::optional<PieceKey>;

  // What stands for a cell of the complex in a part.
  Owner owner_at(Index lattice_cell, int part, Index rock) const {
    if (cells_.find(lattice_cell, part, rock).any()) return PieceKey{lattice_cell, part, rock};
    const Sliver* sliver = find_sliver(pieces_.slivers, lattice_cell, part, rock);
    if (sliver != nullptr && sliver->owner.rock != none) return sliver->owner;
    return {};
  }

  Owner across(const Sliver& s, int facet, Index rock) const {
    auto ijk = lattice_.lattice().cell_ijk(s.piece.lattice_cell);
    const PartFacet& f = lattice_.form(ijk).facet[s.piece.part][facet];
    if (f.axis >= 0) {
      ijk[f.axis] += f.step;
      if (ijk[f.axis] < 0 || ijk[f.axis] >= lattice_.lattice().cells[f.axis]) return {};
    }
    return owner_at(lattice_.lattice().cell_index(ijk[0], ijk[1], ijk[2]), f.other, rock);
  }

  Owner find(const Sliver& s) const {
    const Index rock = s.piece.rock;
    if (complex_.is_sliver[rock] != 0)
      if (const auto beside = beside_.find(rock); beside != beside_.end())
        for (const auto& [joint, other] : beside->second)
          if (const Owner o = owner_at(s.piece.lattice_cell, s.piece.part, other)) return o;
    auto facets = s.facet_area;
    std::stable_sort(facets.begin(), facets.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    for (const auto& [facet, area] : facets)
      if (const Owner o = across(s, facet, rock)) return o;
    if (complex_.is_sliver[rock] != 0)
      if (const auto beside = beside_.find(rock); beside != beside_.end())
        for (const auto& [facet, area] : facets)
          for (const auto& [joint, other] : beside->second)
            if (const Owner o = across(s, facet, other)) return o;
    return {};
  }

  const Complex& complex_;
  const LatticePlanes& lattice_;
  Pieces& pieces_;
  const OccupiedCells cells_;
  std::map<Index, std::set<std::pair<bool, Index>>>
      beside_;  // of rock that is a sliver: glue first
};

}  // namespace

const Sliver* find_sliver(const std::vector<Sliver>& slivers, Index lattice_cell, int part,
                          Index rock) {
  const PieceKey key{lattice_cell, part, rock};
  const auto found =
      std::lower_bound(slivers.begin(), slivers.end(), key,
                       [](const Sliver& s, const PieceKey& k) { return s.key() < k; });
  return found != slivers.end() && found->key() == key ? &*found : nullptr;
}

void split_regular(const Complex& complex, const LatticePlanes& lattice, const PlaneTable& planes,
                   const std::vector<bool>& which, Pieces& pieces) {
  std::vector<Pieces::Regular> kept;
  for (std::size_t r = 0; r < which.size(); ++r) {
    const auto [lattice_cell, rock] = pieces.regular[r];
    if (!which[r]) {
      kept.push_back(pieces.regular[r]);
      continue;
    }
    const int parts = lattice.lattice().split(lattice_cell).part_count();
    PieceRecord p;
    p.lattice_cell = lattice_cell;
    p.rock = rock;
    for (p.part = 0; p.part < parts; ++p.part)
      pieces.pieces.push_back(make_record(lattice, planes, lattice_cell, p.part, rock,
                                          clip_to_part(complex, lattice, planes, p)));
  }
  if (kept.size() == which.size()) return;
  pieces.regular = std::move(kept);
  sort_pieces(pieces);
}

namespace {

// `of_slivers`: also of cells that are slivers themselves.
bool is_alone(const Sliver& s, const Complex& complex, bool of_slivers) {
  return s.owner.rock == none && (of_slivers || complex.is_sliver[s.piece.rock] == 0);
}

}  // namespace

void give_slivers_owners(const Complex& complex, const LatticePlanes& lattice,
                         const PlaneTable& planes, Pieces& pieces) {
  if (pieces.slivers.empty()) return;
  // Slivers that nothing is beside are pieces: first those of wide cells, which may then own what a sliver has beside them.
  for (const bool of_slivers : {false, true}) {
    OwnerFinder(complex, lattice, pieces).run();
    for (const Sliver& s : pieces.slivers)
      if (is_alone(s, complex, of_slivers)) pieces.pieces.push_back(s.piece);
    std::erase_if(pieces.slivers,
                  [&](const Sliver& s) { return is_alone(s, complex, of_slivers); });
    sort_pieces(pieces);
  }
  std::vector<bool> owning(pieces.regular.size(), false);
  for (const Sliver& s : pieces.slivers) {
    if (s.left_out) continue;
    const auto found =
        std::lower_bound(pieces.regular.begin(), pieces.regular.end(), s.owner.lattice_cell,
                         [](const auto& r, Index cell) { return r.lattice_cell < cell; });
    if (found != pieces.regular.end() && found->lattice_cell == s.owner.lattice_cell)
      owning[found - pieces.regular.begin()] = true;
  }
  split_regular(complex, lattice, planes, owning, pieces);
}

}  // namespace rockfold
