// The analysis of a model whose covers are laid: static, quasi-static or dynamic.
#pragma once

#include <functional>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/base/progress.hpp"
#include "src/io/element_mesh.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// What the analysis reads; the points come from host/cover.
struct RunInput {
  const Model& model;  ///< `analysis` must be set
  const CoverArrays& covers;
  const BlockArrays& blocks;
  const FixedPoints& fixed;
  const MaterialPoints& monitors;  ///< one for each of Model::monitors, all in the rock
  const LoadPoints& loads;
  const QuietPoints& quiet;
  const std::vector<RigidVelocity>& velocities;  ///< that blocks start with
  const MaterialPoints& block_vertices;          ///< in the order of BlockArrays::vertex
  const ElementMesh* mesh = nullptr;             ///< at whose points stress is averaged, if any
};

/// Called for each state to be stored, in time order, so that the result file is written as the run goes.
using StoreState = std::function<void(const StoredState&)>;

/// Runs Model::analysis. The device must have been started (kernels/device/device.hpp).
///
/// Throws Error(analysis) where a solve does not converge (naming step, time and residual), where a static system leaves
/// a part free to move, where blocks are turned inside out or numbers leave their range, and where max_displacement_ratio would
/// need more than 1024 substeps. A signal (src/base/interrupt.hpp) ends the run at once: the last step done is stored.
RunResult run_analysis(const RunInput& input, const StoreState& store, Progress& progress);

}  // namespace rockfold
