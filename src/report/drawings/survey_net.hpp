// The stereonet of a survey.
#pragma once

#include <string>

#include "host/survey/joint_sets.hpp"

namespace rockfold {

/// SVG, lower hemisphere, equal area: contours of the poles' density, poles in the colours of their sets, mean poles with their cones of
/// confidence, mean planes as great circles with dip and dip direction.
std::string survey_net(const SurveyReport& report, const std::string& title);

}  // namespace rockfold
