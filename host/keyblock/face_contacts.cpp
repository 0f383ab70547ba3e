#include "host/keyblock/face_contacts.hpp"

#include <algorithm>
#include <numeric>

namespace rockfold {

FaceContacts::FaceContacts(const BlockArrays& blocks)
    : face_begin_(blocks.face_begin), contact_begin_(blocks.face_area.size() + 1, 0) {
  for (const auto& interface : blocks.interfaces)
    for (Index face : interface.face) ++contact_begin_[static_cast<std::size_t>(face) + 1];
  std::partial_sum(contact_begin_.begin(), contact_begin_.end(), contact_begin_.begin());
  contact_.resize(2 * blocks.interfaces.size());
  std::vector<Index> next(contact_begin_.begin(), contact_begin_.end() - 1);
  for (const auto& interface : blocks.interfaces)
    for (int side = 0; side < 2; ++side) {
      const auto face = static_cast<std::size_t>(interface.face[side]);
      contact_[static_cast<std::size_t>(next[face]++)] = {interface.block[1 - side],
                                                          interface.face[1 - side], interface.area};
    }
}

std::span<const FaceContacts::Contact> FaceContacts::of_face(Index face) const {
  const auto f = static_cast<std::size_t>(face);
  return std::span(contact_).subspan(
      static_cast<std::size_t>(contact_begin_[f]),
      static_cast<std::size_t>(contact_begin_[f + 1] - contact_begin_[f]));
}

Real FaceContacts::area(Index face, const std::vector<Index>& batch) const {
  Real sum = 0;  // summed anew, not reduced: exactly zero when nothing is left
  for (const Contact& contact : of_face(face)) {
    if (batch[static_cast<std::size_t>(contact.block)] == 0) sum += contact.area;
  }
  return sum;
}

std::vector<Index> FaceContacts::neighbours(const std::vector<Index>& of,
                                            const std::vector<Index>& batch) const {
  std::vector<Index> found;
  for (Index block : of) {
    const auto b = static_cast<std::size_t>(block);
    const auto begin = static_cast<std::size_t>(face_begin_[b]);
    const auto end = static_cast<std::size_t>(face_begin_[b + 1]);
    for (Index c = contact_begin_[begin]; c < contact_begin_[end]; ++c) {
      const Index neighbour = contact_[static_cast<std::size_t>(c)].block;
      if (batch[static_cast<std::size_t>(neighbour)] == 0) found.push_back(neighbour);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace rockfold
