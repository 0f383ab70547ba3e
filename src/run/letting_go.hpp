// How a run lets go what excavated rock had pressed its walls with: how far the blocks go meanwhile, of which Settling judges when they have settled.
#pragma once

#include <vector>

#include "src/run/run_analysis.hpp"
#include "src/run/settling.hpp"

namespace rockfold {

/// Whether a stage takes rock away that is let go before it goes on: in motion, unless the model says how it is.
bool lets_go(const AnalysisStage& stage, const BlockArrays& blocks);

class LettingGo {
 public:
  LettingGo(const RunInput& input, const PieceMoments& moments)
      : input_(input), moments_(moments) {}

  /// Before the first step, which begins with this displacement of the covers, m.
  void begin(const AnalysisStage& stage, std::vector<Vec3> displacement);
  /// A step has led there; it was divided into so many parts.
  void add(std::vector<Vec3> displacement, Index parts);
  const Settling& settling() const { return settling_; }
  void pass(Archive& archive);

 private:
  std::vector<Vec3> block_ways(const std::vector<Vec3>& from, const std::vector<Vec3>& to) const;

  const RunInput& input_;
  const PieceMoments& moments_;
  Settling settling_;
  std::vector<Vec3> start_;   ///< m, displacement of the covers as it began …
  std::vector<Vec3> before_;  ///< … and as the step under way did: a checkpoint may lie within it
};

}  // namespace rockfold
