// The JSON document of `sets`.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "host/survey/joint_sets.hpp"

namespace rockfold {

/// What reports say of a survey beside what was found.
struct SetsHead {
  std::string table;         ///< as the user calls it
  std::string name_heading;  ///< the column of the table's own sets
  Real blind_zone = 15;      ///< deg
};

/// Angles in degrees, lengths in metres; what cannot be known is null.
nlohmann::ordered_json sets_document(const SetsHead& head, const SurveyReport& report);

}  // namespace rockfold
