// `sets` for people.
#pragma once

#include <string>

#include "src/report/documents/sets_document.hpp"

namespace rockfold {

/// How the sets were found, and a table of them.
std::string sets_summary(const SetsHead& head, const SurveyReport& report);

}  // namespace rockfold
