// Formulas of other parameters, as "0.5 * depth": evaluated by muParser.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold::sweep {

/// Whether a formula may use this name: a letter or '_', then letters, digits, '_'.
bool is_name(const std::string& text);

/// The names in a formula, each once. Throws std::invalid_argument with what is wrong in it.
std::vector<std::string> names_in(const std::string& formula);

/// Its value where the names have these; not finite where it has none. Throws std::invalid_argument for a name without one.
Real value_of(const std::string& formula, const std::map<std::string, Real>& names);

}  // namespace rockfold::sweep
