// The analysis of a model whose covers are laid: static, quasi-static or dynamic.
#pragma once

#include <functional>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/arrays/surface_arrays.hpp"
#include "src/base/progress.hpp"
#include "src/base/stage_keys.hpp"
#include "src/io/viewers/element_mesh.hpp"
#include "src/model/model.hpp"
#include "src/run/run_result.hpp"
#include "src/run/run_state.hpp"

namespace rockfold {

class JointWater;
struct BoltElements;

StageKeys keys_of_analysis(const Model& model);

/// The blocks' surfaces and their vertices in the rock.
struct ContactSurfaces {
  SurfaceArrays surfaces;
  MaterialPoints points;  ///< in the order of SurfaceArrays::vertex
};

/// What the analysis reads; the points come from host/cover.
struct RunInput {
  const Model& model;  ///< `analysis` must be set
  const CoverArrays& covers;
  const BlockArrays& blocks;
  const FixedPoints& fixed;
  const MaterialPoints& monitors;  ///< of those of Model::monitors without a joint, all in the rock
  const LoadPoints& loads;
  const QuietPoints& quiet;
  const std::vector<RigidVelocity>& velocities;  ///< that blocks start with
  const MaterialPoints& block_vertices;          ///< in the order of BlockArrays::vertex
  const ElementMesh* mesh = nullptr;             ///< at whose points stress is averaged, if any
  const ContactSurfaces* contact =
      nullptr;                          ///< where blocks touch each other (has_contact), else null
  const JointWater* water = nullptr;    ///< in their joints, if there is any
  const BoltElements* bolts = nullptr;  ///< that hold it, if there are any
};

/// Called for each state to be stored, in time order, so that the result file is written as the run goes.
using StoreState = std::function<void(const StoredState&)>;

/// An analysis after one of its steps.
struct StepDone {
  Index stage, step;                       ///< steps of that stage which are done
  Real time;                               ///< s
  const std::vector<ContactPoint>& start;  ///< contact points at step 0
  const std::vector<Vec3>& displacement;   ///< of the covers, m
  const PieceMoments& moments;
};

/// What comes after a step that was looked at: an analysis, or a stage of it, that has shown what it was for ends there.
enum class Then : std::uint8_t { go_on, end_stage, end };
using Watch = std::function<Then(const StepDone&)>;

/// Runs Model::analysis. The device must have been started (kernels/device/device.hpp).
///
/// Throws Error(analysis) where a solve does not converge (naming step, time and residual), where a static system leaves
/// a part free to move, where blocks are turned inside out or numbers leave their range, and where max_displacement_ratio would
/// need more than 1024 substeps. A signal (src/base/interrupt.hpp) ends the run at once: the last step done is stored.
/// With `checkpoints` it leaves such, or goes on from one: then it does what it would have done without the interruption, bit
/// by bit. Throws Error(usage) where the analysis has become another than that of the checkpoint, Error(io) where those are not
/// its bytes.
RunResult run_analysis(const RunInput& input, const StoreState& store, Progress& progress,
                       const Checkpoints& checkpoints = {}, const Watch& watch = {});

}  // namespace rockfold
