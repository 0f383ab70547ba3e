#include "src/report/documents/settled.hpp"

#include <fmt/format.h>

#include "src/report/documents/document_parts.hpp"

namespace rockfold {
namespace {

Json block_json(Index block) {
  return block == none ? Json() : Json(block + 1);
}

std::string moved_text(const Json& entry) {
  if (entry.at("block").is_null()) return "nothing moved";
  return fmt::format("block {} moved {:.3g} m, most of all", entry.at("block").get<Index>(),
                     entry.at("largest_displacement").get<Real>());
}

std::string rest_text(const Json& settled) {
  if (!settled.at("settled").get<bool>()) return "not all of the rock came to rest";
  if (settled.at("at_rest").get<bool>()) return "all came to rest";
  const auto moving = settled.at("moving_blocks").get<Index>();
  return fmt::format("{} {} on, block {} first of all", moving,
                     moving == 1 ? "block moves" : "blocks move",
                     settled.at("fastest_block").get<Index>());
}

}  // namespace

Json settling_json(const Settled& s, const AnalysisStage& stage) {
  return {{"step", stage.name},
          {"stage", stage.excavate},
          {"quasi_static_steps", s.steps},
          {"largest_displacement", s.largest},
          {"block", block_json(s.block)}};
}

Json settled_json(const Settled& s, const AnalysisStage& stage) {
  Json entry = settling_json(s, stage);
  entry["moving_blocks"] = s.moving;
  entry["fastest_block"] = block_json(s.fastest);
  entry["at_rest"] = s.moving == 0;
  entry["settled"] = s.ended;
  return entry;
}

std::string settled_text(const Json& settled) {
  return fmt::format(
      "stage {} let go over {} quasi-static steps before \"{}\" goes on: {}; {}",
      settled.at("stage").get<Index>(), settled.at("quasi_static_steps").get<Index>(),
      settled.at("step").get<std::string>(), moved_text(settled), rest_text(settled));
}

std::string settling_text(const Json& settling) {
  return fmt::format(
      "interrupted after {} quasi-static steps in which stage {} is let go before \"{}\" goes on: "
      "{}; blocks, contacts, energies and reactions are of then, monitors and stored states end "
      "before",
      settling.at("quasi_static_steps").get<Index>(), settling.at("stage").get<Index>(),
      settling.at("step").get<std::string>(), moved_text(settling));
}

}  // namespace rockfold
