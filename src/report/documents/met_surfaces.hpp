// Which surfaces have met without a joint of the cut between them, and whose law held: as JSON, and in words.
#pragma once

#include <string>
#include <vector>

#include "src/model/model.hpp"
#include "src/report/documents/documents.hpp"
#include "src/run/run_result.hpp"

namespace rockfold {

/// A list of `between` (two names), `material` (null: the model has none) and `by`: "own", "contact_pair", "weaker", "contact.material",
/// "first".
Json met_json(const Model& model, const std::vector<MetSurfaces>& met);

/// "rough on concrete: wet (the weaker of the two)".
std::string met_text(const Json& met);

}  // namespace rockfold
