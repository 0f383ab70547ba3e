#include "src/system/coarse_covers.hpp"

#include <algorithm>
#include <utility>

namespace rockfold::solve {
namespace {

/// Joined sets; each is named by its smallest member, so that names do not depend on the order of joining.
class JoinedSets {
 public:
  explicit JoinedSets(std::size_t count) : parent_(count) {
    for (std::size_t i = 0; i < count; ++i) parent_[i] = static_cast<Index>(i);
  }
  Index find(Index i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void join(Index a, Index b) {
    a = find(a);
    b = find(b);
    if (a != b) parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

/// A level seen from the next coarser one.
struct Level {
  std::vector<HalfPlace> place;            ///< [P] of the covers
  std::vector<std::array<Index, 3>> cell;  ///< [E] lattice cell of each element
  std::vector<Index> begin;                ///< [E+1]
  std::vector<Index> cover;                ///< of each element
};

Level finest_level(const CoverArrays& covers) {
  Level level;
  level.place = half_places(covers);
  const int nodes = covers.nodes_per_cell(), part_nodes = covers.nodes_per_part();
  level.cover = covers.regular_cover;
  level.cover.insert(level.cover.end(), covers.element_cover.begin(), covers.element_cover.end());
  level.begin.push_back(0);
  for (Index cell : covers.regular_cell) {
    level.cell.push_back(covers.lattice.cell_ijk(cell));
    level.begin.push_back(level.begin.back() + nodes);
  }
  for (Index cell : covers.element_cell) {
    level.cell.push_back(covers.lattice.cell_ijk(cell));
    level.begin.push_back(level.begin.back() + part_nodes);
  }
  return level;
}

/// Coarse cells have edges of four half edges of the finer level. A place on their common boundary lies in two (a bit says which),
/// any other in one, in each direction.
struct Around {
  HalfPlace lower{};  ///< the lowest coarse cell that holds the place
  int boundary = 0;   ///< directions in which there is a second one, as bits
  HalfPlace
      offset{};  ///< of the place, in quarters of a coarse edge, from the lower corner of cell `inner`

  explicit Around(const HalfPlace& place) {
    for (int d = 0; d < 3; ++d) {
      lower[d] = place[d] / 4;
      offset[d] = place[d] % 4;
      if (offset[d] == 0) {
        boundary |= 1 << d;
        --lower[d];
      }
    }
  }
  /// Which of them is coarse cell `cell`, 0 … 7.
  int which(const std::array<Index, 3>& cell) const {
    int bits = 0;
    for (int d = 0; d < 3; ++d) bits |= (cell[d] - lower[d]) << d;
    return bits;
  }
  /// Calls visit(k, corner, weight) for each coarse node of weight: its number 0 … 7 among those of the place, and which corner
  /// of coarse cell `which` it is.
  template <class Visit>
  void for_each_node(int which, Visit visit) const {
    for (int k = 0; k < 8; ++k) {
      if ((k & boundary) != 0) continue;
      int corner = 0;
      float weight = 1;
      for (int d = 0; d < 3; ++d) {
        const int bit = 1 << d;
        if ((boundary & bit) != 0) {
          if ((which & bit) == 0) corner |= bit;
        } else {
          corner |= k & bit;
          weight *= 0.25F * static_cast<float>((k & bit) != 0 ? offset[d] : 4 - offset[d]);
        }
      }
      visit(k, corner, weight);
    }
  }
};

std::array<Index, 3> coarse_cell(const std::array<Index, 3>& cell) {
  return {cell[0] / 2, cell[1] / 2, cell[2] / 2};
}

/// The coarse elements.
struct Joined {
  std::vector<std::array<Index, 3>> cell;  ///< [F]
  std::vector<Index>
      at;  ///< [P][8] the one that holds cover p in each coarse cell around it, or none
};

Joined join_elements(const Level& fine) {
  const std::size_t elements = fine.cell.size();
  JoinedSets sets(elements);
  Joined joined;
  joined.at.assign(8 * fine.place.size(), none);
  for (std::size_t e = 0; e < elements; ++e) {
    const auto cell = coarse_cell(fine.cell[e]);
    for (Index i = fine.begin[e]; i < fine.begin[e + 1]; ++i) {
      const std::size_t p = fine.cover[i];
      Index& first = joined.at[8 * p + Around(fine.place[p]).which(cell)];
      if (first == none)
        first = static_cast<Index>(e);
      else
        sets.join(first, static_cast<Index>(e));
    }
  }
  std::vector<Index> number(elements, none);
  for (std::size_t e = 0; e < elements; ++e) {
    const Index root = sets.find(static_cast<Index>(e));
    if (number[root] != none) continue;
    number[root] = static_cast<Index>(joined.cell.size());
    joined.cell.push_back(coarse_cell(fine.cell[root]));
  }
  for (Index& e : joined.at)
    if (e != none) e = number[sets.find(e)];
  return joined;
}

/// Slot 8·e + corner stands for the coarse cover of a corner of coarse element e.
struct Slots {
  JoinedSets sets;
  std::vector<Index> of_parent;  ///< the slot of each parent
};

Slots join_slots(const Level& fine, const Joined& joined, CoarseCovers& coarse) {
  Slots slots{JoinedSets(8 * joined.cell.size()), {}};
  coarse.parent_begin.push_back(0);
  for (std::size_t p = 0; p < fine.place.size(); ++p) {
    const Around around(fine.place[p]);
    std::array<Index, 8> first{};
    first.fill(none);
    std::array<float, 8> weights{};
    for (int w = 0; w < 8; ++w) {
      const Index e = joined.at[8 * p + w];
      if (e == none) continue;
      around.for_each_node(w, [&](int k, int corner, float weight) {
        weights[k] = weight;
        const Index slot = 8 * e + corner;
        if (first[k] == none)
          first[k] = slot;
        else
          slots.sets.join(first[k], slot);
      });
    }
    for (int k = 0; k < 8; ++k)
      if (first[k] != none) {
        slots.of_parent.push_back(first[k]);
        coarse.weight.push_back(weights[k]);
      }
    coarse.parent_begin.push_back(static_cast<Index>(slots.of_parent.size()));
  }
  return slots;
}

/// Numbers the joined slots by place and says what each slot's cover is, none where no finer cover needs it.
std::vector<Index> number_covers(const Joined& joined, Slots& slots, CoarseCovers& coarse) {
  std::vector<Index> cover(8 * joined.cell.size(), none);
  std::vector<std::pair<HalfPlace, Index>> found;  // (z, y, x), slot
  for (Index slot : slots.of_parent) {
    const Index root = slots.sets.find(slot);
    if (cover[root] != none) continue;
    cover[root] = 0;
    const auto& cell = joined.cell[root / 8];
    found.push_back({{2 * (cell[2] + (root >> 2 & 1)), 2 * (cell[1] + (root >> 1 & 1)),
                      2 * (cell[0] + (root & 1))},
                     root});
  }
  std::sort(found.begin(), found.end());
  for (std::size_t c = 0; c < found.size(); ++c) {
    const HalfPlace& p = found[c].first;
    coarse.place.push_back({p[2], p[1], p[0]});
    cover[found[c].second] = static_cast<Index>(c);
  }
  for (Index slot : slots.of_parent) coarse.parent.push_back(cover[slots.sets.find(slot)]);
  for (std::size_t s = 0; s < cover.size(); ++s)
    cover[s] = cover[slots.sets.find(static_cast<Index>(s))];
  return cover;
}

void find_columns(const Level& level, CoarseCovers& coarse) {
  std::vector<Index> begin(coarse.place.size() + 1, 0), element(level.cover.size());
  for (Index p : level.cover) ++begin[p + 1];
  for (std::size_t p = 0; p < coarse.place.size(); ++p) begin[p + 1] += begin[p];
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for (std::size_t e = 0; e < level.cell.size(); ++e)
    for (Index i = level.begin[e]; i < level.begin[e + 1]; ++i)
      element[end[level.cover[i]]++] = static_cast<Index>(e);

  std::vector<Index> seen_by(coarse.place.size(), none);
  coarse.column_begin.push_back(0);
  for (Index p = 0; p < coarse.count(); ++p) {
    for (Index k = begin[p]; k < begin[p + 1]; ++k)
      for (Index i = level.begin[element[k]]; i < level.begin[element[k] + 1]; ++i)
        if (seen_by[level.cover[i]] != p) {
          seen_by[level.cover[i]] = p;
          coarse.column.push_back(level.cover[i]);
        }
    std::sort(coarse.column.begin() + coarse.column_begin.back(), coarse.column.end());
    coarse.column_begin.push_back(static_cast<Index>(coarse.column.size()));
  }
}

/// The next coarser covers; `level` becomes theirs.
CoarseCovers coarsen(Level& level) {
  CoarseCovers coarse;
  Joined joined = join_elements(level);
  Slots slots = join_slots(level, joined, coarse);
  const std::vector<Index> cover = number_covers(joined, slots, coarse);
  Level next;
  next.place = coarse.place;
  next.cell = std::move(joined.cell);
  next.begin.push_back(0);
  for (std::size_t e = 0; e < next.cell.size(); ++e) {
    for (int corner = 0; corner < 8; ++corner)
      if (cover[8 * e + corner] != none) next.cover.push_back(cover[8 * e + corner]);
    next.begin.push_back(static_cast<Index>(next.cover.size()));
  }
  level = std::move(next);
  find_columns(level, coarse);
  return coarse;
}

}  // namespace

std::vector<HalfPlace> half_places(const CoverArrays& covers) {
  const Lattice& lattice = covers.lattice;
  std::vector<HalfPlace> places;
  if (lattice.kind == LatticeKind::block) return places;
  places.reserve(covers.cover_node.size());
  for (Index node : covers.cover_node) {
    const Index sort =
        node /
        lattice.grid();  // 0: corner; 1 … 3: centre of a face across an axis; 4: centre of a cell
    const auto n = lattice.node_ijk(node % lattice.grid());
    HalfPlace place{};
    for (int d = 0; d < 3; ++d) place[d] = 2 * n[d] + (sort > 0 && d != sort - 1 ? 1 : 0);
    places.push_back(place);
  }
  return places;
}

std::vector<Index> connected_parts(const CoarseCovers& covers) {
  JoinedSets sets(covers.place.size());
  for (Index p = 0; p < covers.count(); ++p)
    for (Index k = covers.column_begin[p]; k < covers.column_begin[p + 1]; ++k)
      sets.join(p, covers.column[k]);
  std::vector<Index> part(covers.place.size());
  for (Index p = 0; p < covers.count(); ++p) part[p] = sets.find(p);
  return part;
}

Index largest_part(const CoarseCovers& covers) {
  std::vector<Index> size(covers.place.size(), 0);
  for (Index part : connected_parts(covers)) ++size[part];
  return size.empty() ? 0 : *std::max_element(size.begin(), size.end());
}

std::vector<CoarseCovers> coarsen_covers(const CoverArrays& covers, Index small) {
  std::vector<CoarseCovers> levels;
  if (covers.lattice.kind == LatticeKind::block || covers.cover_count() == 0) return levels;
  Level level = finest_level(covers);
  do {
    CoarseCovers next = coarsen(level);
    if (!levels.empty() &&
        10 * std::int64_t{next.count()} > 9 * std::int64_t{levels.back().count()})
      break;
    levels.push_back(std::move(next));
  } while (largest_part(levels.back()) > small);
  return levels;
}

}  // namespace rockfold::solve
