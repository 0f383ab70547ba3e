// In-situ stress on joints round openings: support.stress = "elastic". docs/block_theory.md, "In-situ stress".
#pragma once

#include <string>
#include <vector>

#include "src/app/continuum.hpp"
#include "src/arrays/block_arrays.hpp"
#include "src/arrays/face_tractions.hpp"
#include "src/base/progress.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// What the redistribution was computed on, for reports.
struct ContinuumFacts {
  Index stage = 0;     ///< that was excavated last
  Real radius = 0;     ///< m, Openings::radius
  Real spacing = 0;    ///< m
  Index unknowns = 0;  ///< of the displacement
  bool coarser = false;
};

struct JointStressReport {
  FaceTractions tractions;
  std::vector<ContinuumFacts> stages;  ///< those that have openings
};

/// The stress σ of [initial_stress] holds everywhere before anything is open. Openings free their walls: their tractions σ n are taken away,
/// and what that strains, with the rock as one elastic body on springs far off (2G/R), is added to σ. Each stage by itself, linear in all
/// before. Means over faces are sums over triangles no larger than the lattice's cells. The device must have been started. Throws
/// Error(analysis) where the body does not come to equilibrium. Independent of the number of threads.
JointStressReport find_joint_stress(const BlockArrays& blocks, const Model& model,
                                    Progress& progress, const ContinuumRule& rule = {});

/// What of it is not to be relied on: faces beyond which the rock goes on that are nearer to openings than three radii and do not meet them,
/// and lattices coarser than the rule asks for. Of far-field stress: blocks nearer than three radii.
std::vector<std::string> joint_stress_warnings(const BlockArrays& blocks, const Model& model,
                                               const JointStressReport* report);

}  // namespace rockfold
