#include "host/flatten/balance_contacts.hpp"

#include <algorithm>
#include <tuple>
#include <vector>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real rounding = 1e-9;     // of a face's area
constexpr Real least_facing = 0.9;  // −cos between the normals of faces in contact

class Balance {
 public:
  explicit Balance(BlockArrays& blocks) : blocks_(blocks), rest_(blocks.face_area) {
    for (const auto& shared : blocks.interfaces)
      for (const Index face : shared.face) rest_[face] -= shared.area;
  }

  void run() {
    find_crowded();
    if (crowded_.empty()) return;
    for (const auto& [face, entry] : entries_of_crowded()) relieve(face, entry);
    order();
  }

 private:
  bool is_crowded(Index face) const { return rest_[face] < -rounding * blocks_.face_area[face]; }

  void find_crowded() {
    for (Index b = 0; b < blocks_.block_count(); ++b)
      for (Index f = blocks_.face_begin[b]; f < blocks_.face_begin[b + 1]; ++f)
        if (is_crowded(f)) crowded_.push_back(f);
  }

  /// The interfaces of faces that have too much.
  std::vector<std::pair<Index, Index>> entries_of_crowded() const {
    std::vector<std::pair<Index, Index>> entries;
    for (Index i = 0; i < static_cast<Index>(blocks_.interfaces.size()); ++i)
      for (const Index face : blocks_.interfaces[i].face)
        if (std::binary_search(crowded_.begin(), crowded_.end(), face))
          entries.emplace_back(face, i);
    std::sort(entries.begin(), entries.end());
    return entries;
  }

  void relieve(Index face, Index entry) {
    const int side = blocks_.interfaces[entry].face[0] == face ? 0 : 1;
    const Index block = blocks_.interfaces[entry].block[side],
                opposite = blocks_.interfaces[entry].face[1 - side];
    while (is_crowded(face)) {
      const Index to = neediest(block, face, opposite);
      const Real area =
          to == none ? 0 : std::min({-rest_[face], rest_[to], blocks_.interfaces[entry].area});
      if (!(area > 0)) return;
      BlockArrays::Interface moved = blocks_.interfaces[entry];
      moved.face[side] = to;
      moved.area = area;
      blocks_.interfaces[entry].area -= area;
      blocks_.interfaces.push_back(moved);
      rest_[face] += area;
      rest_[to] -= area;
    }
  }

  /// Of a block's faces on the joint of `face` that look at `opposite`, the one that lacks most; none where none does.
  Index neediest(Index block, Index face, Index opposite) const {
    Index most = none;
    for (Index f = blocks_.face_begin[block]; f < blocks_.face_begin[block + 1]; ++f)
      if (blocks_.face_origin[f] == blocks_.face_origin[face] &&
          rest_[f] > rounding * blocks_.face_area[f] && (most == none || rest_[f] > rest_[most]) &&
          -dot(blocks_.face_normal[f], blocks_.face_normal[opposite]) > least_facing)
        most = f;
    return most;
  }

  /// As BlockArrays has them: one of each pair of faces.
  void order() {
    const auto key = [](const BlockArrays::Interface& i) {
      return std::tie(i.block[0], i.face[0], i.block[1], i.face[1]);
    };
    auto& all = blocks_.interfaces;
    std::stable_sort(all.begin(), all.end(),
                     [&](const auto& a, const auto& b) { return key(a) < key(b); });
    std::vector<BlockArrays::Interface> merged;
    for (const auto& shared : all) {
      if (!(shared.area > 0)) continue;
      if (!merged.empty() && key(merged.back()) == key(shared))
        merged.back().area += shared.area;
      else
        merged.push_back(shared);
    }
    all = std::move(merged);
  }

  BlockArrays& blocks_;
  std::vector<Real> rest_;      ///< [faces] m², of their areas what no interface has
  std::vector<Index> crowded_;  ///< faces that have more than their areas, ascending
};

}  // namespace

void balance_contacts(BlockArrays& blocks) {
  Balance(blocks).run();
}

}  // namespace rockfold
