// What each command needs of a model, beyond every single entry being right.
#pragma once

#include <vector>

#include "src/base/error.hpp"
#include "src/model/model.hpp"

namespace rockfold {

enum class Purpose {
  cut,      ///< a solid
  support,  ///< and densities, joint materials for joints, something that drives blocks
  run,      ///< and [cover], [analysis], densities, elastic constants; for "static" a [[fixed]];
            ///< what support needs too where the model has [support]
  theory,   ///< [block_theory], joint sets and their materials, a density; no solid
  check,    ///< cut, and support or run where the model has [support] or [analysis]
};

/// Everything that the model lacks for the purpose. What is missing as a whole is placed at the
/// file's begin.
std::vector<Diagnostic> missing_for(const Model& model, Purpose purpose);

/// Throws Error(model) with all of it, if anything is missing.
void check_for(const Model& model, Purpose purpose);

}  // namespace rockfold
