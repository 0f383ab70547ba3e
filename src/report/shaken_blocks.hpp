// Blocks under a record of the ground: how far each has come in the analysis, and how far Newmark's rigid block slides.
#pragma once

#include <optional>
#include <vector>

#include "src/report/documents/documents.hpp"

namespace rockfold {

/// Of one block that nothing holds, or several that fail together. Displacements count from the last `reset_displacement`.
struct ShakenBlock {
  std::vector<Index> members;  ///< ascending
  Real volume = 0;             ///< m³
  Vec3 displacement{};         ///< m, in the analysis, mean of the volume
  const Keyblock* mode =
      nullptr;  ///< what block theory says of it; null: nothing, or it is not removable
  /// m, of the rigid block; none where it does not slide on one joint or two.
  std::optional<Real> newmark;
  bool lifts =
      false;  ///< it would leave a joint for a time, so that Newmark's block says less of it
};

/// Whether the base is accelerated and blocks may come apart.
bool is_shaken(const RunReport& report);
/// Those that move furthest first, in the analysis or as rigid blocks.
std::vector<ShakenBlock> shaken_blocks(const RunReport& report);

}  // namespace rockfold
