#include "host/keyblock/face_interfaces.hpp"

#include <algorithm>
#include <numeric>

namespace rockfold {

FaceInterfaces::FaceInterfaces(const BlockArrays& blocks)
    : face_begin_(blocks.face_begin), neighbour_begin_(blocks.face_area.size() + 1, 0) {
  for (const auto& interface : blocks.interfaces)
    for (Index face : interface.face) ++neighbour_begin_[static_cast<std::size_t>(face) + 1];
  std::partial_sum(neighbour_begin_.begin(), neighbour_begin_.end(), neighbour_begin_.begin());
  neighbour_.resize(2 * blocks.interfaces.size());
  std::vector<Index> next(neighbour_begin_.begin(), neighbour_begin_.end() - 1);
  for (const auto& interface : blocks.interfaces)
    for (int side = 0; side < 2; ++side) {
      const auto face = static_cast<std::size_t>(interface.face[side]);
      neighbour_[static_cast<std::size_t>(next[face]++)] = {
          interface.block[1 - side], interface.face[1 - side], interface.area};
    }
}

std::span<const FaceInterfaces::Neighbour> FaceInterfaces::of_face(Index face) const {
  const auto f = static_cast<std::size_t>(face);
  return std::span(neighbour_)
      .subspan(static_cast<std::size_t>(neighbour_begin_[f]),
               static_cast<std::size_t>(neighbour_begin_[f + 1] - neighbour_begin_[f]));
}

Real FaceInterfaces::area(Index face, const std::vector<Index>& batch) const {
  Real sum = 0;  // summed anew, not reduced: exactly zero when nothing is left
  for (const Neighbour& next : of_face(face)) {
    if (batch[static_cast<std::size_t>(next.block)] == 0) sum += next.area;
  }
  return sum;
}

std::vector<Index> FaceInterfaces::neighbours(const std::vector<Index>& of,
                                              const std::vector<Index>& batch) const {
  std::vector<Index> found;
  for (Index block : of) {
    const auto b = static_cast<std::size_t>(block);
    const auto begin = static_cast<std::size_t>(face_begin_[b]);
    const auto end = static_cast<std::size_t>(face_begin_[b + 1]);
    for (Index c = neighbour_begin_[begin]; c < neighbour_begin_[end]; ++c) {
      const Index neighbour = neighbour_[static_cast<std::size_t>(c)].block;
      if (batch[static_cast<std::size_t>(neighbour)] == 0) found.push_back(neighbour);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace rockfold
