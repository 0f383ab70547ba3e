// How rock that a step takes away was let go before it went on, as a document and in words.
#pragma once

#include <string>

#include "src/model/model.hpp"
#include "src/report/documents/documents.hpp"
#include "src/run/settling.hpp"

namespace rockfold {

/// An entry of `excavation.settled`.
Json settled_json(const Settled& settled, const AnalysisStage& stage);
/// `excavation.settling`: of rock that was still being let go when the run was interrupted.
Json settling_json(const Settled& settling, const AnalysisStage& stage);

/// Of such an entry: "stage 1 let go over 13 quasi-static steps before "heading" goes on: …".
std::string settled_text(const Json& settled);
std::string settling_text(const Json& settling);

}  // namespace rockfold
