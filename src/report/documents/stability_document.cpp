#include <nlohmann/json.hpp>

#include "src/report/documents/document_parts.hpp"
#include "src/report/documents/documents.hpp"
#include "src/report/stability_words.hpp"

namespace rockfold {

namespace {

Json mechanism_json(const RigidMass& mass, const std::vector<MovingBlock>& moving) {
  Json list = Json::array();
  for (const MovingBlock& m : moving) {
    Json pushed_by = Json::array();
    for (const Index b : m.pushed_by) pushed_by.push_back(mass.bodies[b].block + 1);
    list.push_back({{"block", mass.bodies[m.body].block + 1},
                    {"velocity", m.velocity},
                    {"spin", m.spin},
                    {"slides_on", m.slides_on},
                    {"parts_from", m.parts_from},
                    {"pushed_by", std::move(pushed_by)}});
  }
  return list;
}

const char* answer_text(Sliding::Answer answer) {
  switch (answer) {
    case Sliding::Answer::fails:
      return "fails";
    case Sliding::Answer::falls:
      return "falls";
    case Sliding::Answer::stands:
      return "stands";
    case Sliding::Answer::not_found:
      break;
  }
  return "not found";
}

}  // namespace

Json stability_json(const StabilityReport& report) {
  Json bound{
      {"factor", report.bound.factor},  // infinite is written as null
      {"below", report.bound.below.factor},
      {"proved", report.bound_proved},
      {"above", report.bound.above.velocity.empty() ? Json() : Json(report.bound.above.factor)},
      {"mechanism", mechanism_json(report.mass, report.at_bound)}};
  if (report.bound.below.force.empty()) bound["below"] = nullptr;
  const Sliding& sliding = report.sliding;
  const bool found = sliding.answer != Sliding::Answer::not_found;
  return {{"in_words", whole_mass_words(report)},
          {"bound", std::move(bound)},
          {"sliding",
           {{"factor", found ? Json(sliding.factor) : Json()},
            {"answer", answer_text(sliding.answer)},
            {"proved", sliding.proved()},
            {"stands_below", sliding.stands_below},
            {"mechanism", mechanism_json(report.mass, report.at_sliding)}}}};
}

Json stability_document(const DocumentHead& head, const BlockArrays& blocks,
                        const StabilityReport& report) {
  Json document = head_json(head);
  document["totals"] = {{"blocks", blocks.block_count()},
                        {"movable", report.mass.bodies.size()},
                        {"contact_areas", report.mass.contacts.size()},
                        {"linear_programs", report.bound.programs}};
  document["stability"] = stability_json(report);
  document["partly_held"] = ids_json(report.partly_held);
  return document;
}

}  // namespace rockfold
