#include "host/keyblock/water/wet_faces.hpp"

#include <algorithm>
#include <map>

#include "host/keyblock/bodies.hpp"

namespace rockfold {

std::vector<std::vector<LinearPressure>> water_on_faces(const BlockArrays& blocks,
                                                        const Model& model,
                                                        const std::vector<Water>& waters,
                                                        const std::vector<Index>& gone,
                                                        const std::vector<Index>& wanted) {
  const Bodies bodies(blocks, model, model.support.value_or(SupportSpec{}), waters);
  std::map<Index, std::map<Index, std::size_t>> of_block;  // its faces, and where they are wanted
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto next =
        std::upper_bound(blocks.face_begin.begin(), blocks.face_begin.end(), wanted[i]);
    of_block[static_cast<Index>(next - blocks.face_begin.begin()) - 1][wanted[i]] = i;
  }
  std::vector<std::vector<LinearPressure>> found(wanted.size());
  for (const auto& [block, faces] : of_block) {
    const RockBody body = bodies.body({block}, gone);
    auto pressures = bodies.water_in_joints(body);
    for (std::size_t f = 0; f < body.face_id.size(); ++f)
      if (const auto at = faces.find(body.face_id[f]); at != faces.end())
        found[at->second] = std::move(pressures[f]);
  }
  return found;
}

}  // namespace rockfold
