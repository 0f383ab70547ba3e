#include "src/run/gone_rock.hpp"

#include <algorithm>

#include "src/space/shape_functions.hpp"

namespace rockfold {

GoneRock gone_rock(const RunInput& input, Index stage) {
  const auto& stages = input.model.analysis->stages;
  GoneRock gone;
  for (const Index of_block : input.blocks.stage)
    gone.block.push_back(of_block != 0 && std::any_of(stages.begin(), stages.begin() + stage + 1,
                                                      [&](const AnalysisStage& step) {
                                                        return step.excavate == of_block;
                                                      }));
  if (std::count(gone.block.begin(), gone.block.end(), 1) == 0) return {};
  const CoverArrays& covers = input.covers;
  gone.cover.resize(covers.cover_count());
  for (Index e = 0; e < covers.element_count(); ++e) {
    gone.element.push_back(gone.block[block_of(covers, e)]);
    if (gone.element.back() == 0) continue;
    const ElementNodes nodes = element_nodes(covers, e);
    for (int a = 0; a < covers.nodes_per_part(); ++a) gone.cover[nodes.cover[a]] = 1;
  }
  return gone;
}

}  // namespace rockfold
