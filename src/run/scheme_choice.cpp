#include "src/run/scheme_choice.hpp"

namespace rockfold {

bool may_choose(const Model& model, const AnalysisStage& stage) {
  const Analysis& analysis = *model.analysis;
  return stage.scheme == Scheme::automatic && stage.type == AnalysisType::dynamic &&
         stage.dynamic_ratio == 1 && model.cover->lattice == LatticeKind::block &&
         model.cover->order == 1 && analysis.large() && analysis.rayleigh_beta == 0 &&
         analysis.newmark_beta == 0.25 && analysis.newmark_gamma == 0.5;
}

}  // namespace rockfold
