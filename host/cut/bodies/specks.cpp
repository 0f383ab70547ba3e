#include "host/cut/bodies/specks.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "host/cut/bodies/connectivity.hpp"
#include "host/cut/bodies/union_find.hpp"
#include "src/base/sum.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Areas and volumes that differ by less are equal but for rounding.
constexpr Real rounding = 1e-9;

// A block beside a speck, and the area of joints between them.
struct Neighbour {
  Index block = none;
  Real area = 0;  // m²
};

// Blocks as they grow together. A group has the number of its lowest block.
class Growth {
 public:
  Growth(const Complex& complex, const NumberedBlocks& blocks, Real limit)
      : complex_(complex), of_cell_(blocks.of_cell), limit_(limit), group_(count(blocks)) {
    for (const CellMoments& m : blocks.moments) volume_.push_back(m.volume);
    find_continuing();
    find_areas();
  }

  // In rounds, all specks of one at once: so none depends on which of them comes first. A group that had no speck in it has no neighbour of
  // its own choice, so it never meets another such.
  std::vector<Index> run() {
    while (true) {
      const auto choices = choose();
      if (choices.empty()) break;
      for (const auto& [speck, other] : choices) join(speck, other);
      contract();
    }
    std::vector<Index> groups(volume_.size());
    for (Index b = 0; b < static_cast<Index>(groups.size()); ++b) groups[b] = group_.find(b);
    return groups;
  }

 private:
  using Pair = std::pair<Index, Index>;  // of groups, the lower first

  static Index count(const NumberedBlocks& blocks) {
    return static_cast<Index>(blocks.moments.size());
  }
  bool is_speck(Index group) const { return volume_[group] < limit_; }
  bool may_take(Index other, Index speck) const { return !continues_[speck] || continues_[other]; }

  void find_continuing() {
    continues_.assign(volume_.size(), false);
    const auto mark = [&](Index cell, Index origin) {
      if (complex_.is_sliver[cell] == 0 && origin != none && complex_.origins[origin].continues)
        continues_[of_cell_[cell]] = true;
    };
    for (const FreePart& f : complex_.free_parts) mark(f.cell, f.origin);
    for (const Beam& b : complex_.beams)
      if (b.cell[1] == none) mark(b.cell[0], b.origin);
  }

  bool counts(const Index (&cell)[2], Index joint) const {
    if (joint == none) return false;
    const Index one = of_cell_[cell[0]], two = of_cell_[cell[1]];
    if (one == two || !(is_speck(one) || is_speck(two))) return false;
    const Zone &here = complex_.zone(cell[0]), &there = complex_.zone(cell[1]);
    return here.solid == there.solid && here.stage == there.stage;
  }

  void find_areas() {
    const auto add = [&](const Index(&cell)[2], Real area) {
      area_[std::minmax(of_cell_[cell[0]], of_cell_[cell[1]])] += area;
    };
    for (const Fragment& f : complex_.fragments)
      if (counts(f.cell, f.joint) && !complex_.touches_sliver(f) &&
          width_of(complex_, f) >= complex_.planes.width_tolerance())
        add(f.cell, f.area);
    // Each beam is there twice, once from either end.
    for (const Beam& b : complex_.beams)
      if (b.cell[1] != none && !b.narrow && counts(b.cell, b.joint)) add(b.cell, b.area / 2);
  }

  // What each speck goes to, if anything.
  std::vector<Pair> choose() const {
    std::map<Index, std::vector<Neighbour>> neighbours;
    for (const auto& [pair, area] : area_)
      for (const auto& [speck, other] : {pair, Pair{pair.second, pair.first}})
        if (is_speck(speck) && may_take(other, speck)) neighbours[speck].push_back({other, area});
    std::vector<Pair> choices;
    for (auto& [speck, list] : neighbours) choices.emplace_back(speck, best_of(list));
    return choices;
  }

  Index best_of(std::vector<Neighbour>& list) const {
    const auto keep_largest = [&](const auto& size) {
      Real largest = 0;
      for (const Neighbour& n : list) largest = std::max(largest, size(n));
      std::erase_if(list, [&](const Neighbour& n) { return size(n) < (1 - rounding) * largest; });
    };
    keep_largest([](const Neighbour& n) { return n.area; });
    keep_largest([&](const Neighbour& n) { return volume_[n.block]; });
    return std::min_element(
               list.begin(), list.end(),
               [](const Neighbour& a, const Neighbour& b) { return a.block < b.block; })
        ->block;
  }

  void join(Index one, Index two) {
    one = group_.find(one), two = group_.find(two);
    if (one == two) return;
    group_.join(one, two);
    const auto [lower, upper] = std::minmax(one, two);
    volume_[lower] += volume_[upper];
    continues_[lower] = continues_[lower] || continues_[upper];
  }

  void contract() {
    std::map<Pair, Real> areas;
    for (const auto& [pair, area] : area_) {
      const Index one = group_.find(pair.first), two = group_.find(pair.second);
      if (one != two && (is_speck(one) || is_speck(two))) areas[std::minmax(one, two)] += area;
    }
    area_ = std::move(areas);
  }

  const Complex& complex_;
  const std::vector<Index>& of_cell_;
  const Real limit_;
  UnionFind group_;
  std::vector<Real> volume_;     // [blocks] m³, of the group with that number
  std::vector<bool> continues_;  // [blocks] likewise
  std::map<Pair, Real> area_;    // m²
};

Real limit_of(const CutSpec& spec, const NumberedBlocks& blocks) {
  if (spec.min_volume) return *spec.min_volume;
  Sum volume;
  for (const CellMoments& m : blocks.moments) volume += m.volume;
  return speck_share * volume.value() / static_cast<Real>(blocks.moments.size());
}

// Joints between blocks of one group become virtual; walls of excavations stay.
void open_groups(Complex& complex, const std::vector<Index>& of_cell,
                 const std::vector<Index>& group) {
  const auto open = [&](auto& area) {
    const Index one = of_cell[area.cell[0]], two = of_cell[area.cell[1]];
    if (area.joint == none || one == two || group[one] != group[two] ||
        complex.zone(area.cell[0]).stage != complex.zone(area.cell[1]).stage)
      return;
    area.joint = area.instance = none;
  };
  for (Fragment& f : complex.fragments) open(f);
  for (Beam& b : complex.beams)
    if (b.cell[1] != none) open(b);
}

}  // namespace

SpeckReport merge_specks(Complex& complex, const CutSpec& spec, NumberedBlocks& blocks) {
  SpeckReport report;
  report.limit = limit_of(spec, blocks);
  report.limit_is_given = spec.min_volume.has_value();
  const std::vector<Index> group = Growth(complex, blocks, report.limit).run();
  const auto count = static_cast<Index>(group.size());
  std::vector<Index> members(count, 0), block_of_group(count, none);
  for (const Index g : group) ++members[g];
  open_groups(complex, blocks.of_cell, group);

  std::vector<Index> part;
  part.reserve(blocks.of_cell.size());
  for (const Index b : blocks.of_cell) part.push_back(group[b]);
  NumberedBlocks merged = number_blocks(complex, part);
  for (std::size_t c = 0; c < part.size(); ++c) block_of_group[part[c]] = merged.of_cell[c];

  for (Index b = 0; b < count; ++b) {
    const CellMoments& m = blocks.moments[b];
    if (m.volume < report.limit && members[group[b]] > 1)
      report.merged.push_back({b, m.volume, (1 / m.volume) * m.first + complex.planes.centre(),
                               block_of_group[group[b]]});
  }
  for (std::size_t b = 0; b < merged.moments.size(); ++b)
    if (merged.moments[b].volume < report.limit) report.left.push_back(static_cast<Index>(b));
  blocks = std::move(merged);
  return report;
}

}  // namespace rockfold
