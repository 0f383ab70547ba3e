// Whether a static system has one answer: every connected part of the rock must be held against its six rigid motions.
#pragma once

#include <string>
#include <vector>

#include "src/arrays/cover_arrays.hpp"

namespace rockfold {

/// A connected part (covers joined through elements) that may still move as a rigid body.
struct LoosePart {
  std::vector<Index> blocks;  ///< ascending, from 0
  std::vector<std::string>
      motions;  ///< each free rigid motion, in words; empty = nothing at all holds it
  bool cut_off =
      false;  ///< whether other parts have rock of its blocks too: prolonged joints cut through these
};

/// The parts whose fixed components leave a rigid motion free, in the order of their blocks.
std::vector<LoosePart> find_loose_parts(const CoverArrays& covers, const FixedPoints& fixed);

/// Throws Error(analysis) that names the blocks of loose parts, by ids from 1, and what they are free to do.
void require_no_loose_parts(const CoverArrays& covers, const FixedPoints& fixed);

}  // namespace rockfold
