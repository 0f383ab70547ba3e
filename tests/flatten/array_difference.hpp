// Whether two cuttings gave the same blocks, bit for bit.
#pragma once

#include <string>
#include <tuple>
#include <vector>

#include "src/arrays/block_arrays.hpp"

namespace rockfold::test {

/// The names of the origins of all faces: ids follow the order in which the model lists its joints.
inline std::vector<std::string> origin_names(const BlockArrays& a) {
  std::vector<std::string> names;
  for (const Index origin : a.face_origin) names.push_back(a.origins[origin].name);
  return names;
}

/// The first array that differs, or "" if none does. Origins are compared by name.
inline std::string first_difference(const BlockArrays& a, const BlockArrays& b) {
  const auto key = [](const BlockArrays& arrays) {
    std::vector<std::tuple<Index, Index, Index, Index, Real>> list;
    for (const auto& i : arrays.interfaces)
      list.emplace_back(i.block[0], i.block[1], i.face[0], i.face[1], i.area);
    return list;
  };
#define ROCKFOLD_COMPARE(array) \
  if (a.array != b.array) return #array
  ROCKFOLD_COMPARE(volume);
  ROCKFOLD_COMPARE(centroid);
  ROCKFOLD_COMPARE(face_begin);
  ROCKFOLD_COMPARE(vertex_begin);
  ROCKFOLD_COMPARE(edge_count);
  ROCKFOLD_COMPARE(shell_count);
  ROCKFOLD_COMPARE(genus);
  ROCKFOLD_COMPARE(convex);
  ROCKFOLD_COMPARE(finite);
  ROCKFOLD_COMPARE(material);
  ROCKFOLD_COMPARE(loop_begin);
  ROCKFOLD_COMPARE(face_normal);
  ROCKFOLD_COMPARE(face_area);
  ROCKFOLD_COMPARE(face_up);
  ROCKFOLD_COMPARE(face_plane);
  ROCKFOLD_COMPARE(corner_begin);
  ROCKFOLD_COMPARE(corner_vertex);
  ROCKFOLD_COMPARE(vertex);
#undef ROCKFOLD_COMPARE
  if (origin_names(a) != origin_names(b)) return "face_origin";
  if (key(a) != key(b)) return "interfaces";
  return "";
}

}  // namespace rockfold::test
