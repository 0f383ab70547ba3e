#include <nlohmann/json.hpp>

#include "src/report/documents/document_parts.hpp"
#include "src/report/documents/documents.hpp"

namespace rockfold {

namespace {

Json mechanism_json(const StabilityReport& report) {
  Json list = Json::array();
  for (const MovingBlock& m : report.moving)
    list.push_back({{"block", report.mass.bodies[m.body].block + 1},
                    {"velocity", m.velocity},
                    {"spin", m.spin},
                    {"slides_on", m.slides_on},
                    {"parts_from", m.parts_from}});
  return list;
}

}  // namespace

Json stability_json(const StabilityReport& report) {
  Json bound{
      {"factor", report.bound.factor},  // infinite is written as null
      {"below", report.bound.below.factor},
      {"above", report.bound.above.velocity.empty() ? Json() : Json(report.bound.above.factor)},
      {"mechanism", mechanism_json(report)}};
  if (report.bound.below.force.empty()) bound["below"] = nullptr;
  return {{"bound", std::move(bound)}};
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
