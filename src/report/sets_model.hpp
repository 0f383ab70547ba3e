// Joint sets of a survey as a part of a model file.
#pragma once

#include <string>

#include "host/survey/joint_sets.hpp"

namespace rockfold {

/// The first line of every such file, as far as the table's name.
inline constexpr const char* sets_model_begins = "# Joint sets of ";

/// `[[joint_set]]`s with `[joint_set.random]`: mean dip and dip direction, Fisher's κ, and spacings that are exponential where they are
/// known (Priest & Hudson, Int. J. Rock Mech. Min. Sci. 13, 1976). What is not known stands there as a comment.
std::string sets_model(const SurveyReport& report, const std::string& table);

}  // namespace rockfold
