#include "src/run/letting_go.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "src/base/vector.hpp"
#include "src/run/records/block_motion.hpp"
#include "src/run/records/rest.hpp"

namespace rockfold {

bool lets_go(const AnalysisStage& stage, const BlockArrays& blocks) {
  return stage.excavate != 0 && stage.type == AnalysisType::dynamic && stage.release.empty() &&
         std::count(blocks.stage.begin(), blocks.stage.end(), stage.excavate) > 0;
}

void LettingGo::begin(const AnalysisStage& stage, std::vector<Vec3> displacement) {
  const Model& model = input_.model;
  const bool loaded = !model.tractions.empty() || !model.point_loads.empty();
  const Real gravity = norm(model.gravity);
  settling_.begin(stage.time_step, mean_block_size(input_), gravity,
                  loaded ? std::numeric_limits<Real>::infinity() : gravity,
                  way_of_rounding(input_));
  start_ = displacement;
  before_ = std::move(displacement);
}

void LettingGo::add(std::vector<Vec3> displacement, Index parts) {
  settling_.add(block_ways(before_, displacement), block_ways(start_, displacement), parts);
  before_ = std::move(displacement);
}

void LettingGo::pass(Archive& archive) {
  settling_.pass(archive);
  archive.all(start_, before_);
}

/// [B] m: how far the blocks have gone between two displacements of the covers.
std::vector<Vec3> LettingGo::block_ways(const std::vector<Vec3>& from,
                                        const std::vector<Vec3>& to) const {
  std::vector<Vec3> covers(to.size());
  for (std::size_t p = 0; p < to.size(); ++p) covers[p] = to[p] - from[p];
  std::vector<Vec3> ways;
  for (const BlockMotion& block :
       average_block_motion(input_.covers, moments_, covers, input_.blocks.block_count()))
    ways.push_back(block.displacement);
  return ways;
}

}  // namespace rockfold
