#include "src/report/documents/sets_document.hpp"

#include <cmath>

#include <nlohmann/json.hpp>

#include "src/report/documents/documents.hpp"

namespace rockfold {

namespace {

Json number_or_null(Real x) {
  return std::isfinite(x) ? Json(x) : Json();
}

/// The normal that points down, as nets of the lower hemisphere show it.
Json pole_json(const MeasuredSet& set) {
  return {{"trend", std::fmod(set.dip_direction + 180, 360)}, {"plunge", 90 - set.dip}};
}

Json spacing_json(const SetSpacing& spacing) {
  return {{"intervals", spacing.intervals},
          {"along_line", spacing.along},
          {"normal", number_or_null(spacing.normal)},
          {"blind", spacing.blind}};
}

Json set_json(const MeasuredSet& set) {
  const FisherStatistics& fisher = set.fisher;
  return {{"name", set.name},
          {"dip", set.dip},
          {"dip_direction", set.dip_direction},
          {"normal", fisher.mean},
          {"pole", pole_json(set)},
          {"count", set.count},
          {"share", set.share},
          {"effective_count", fisher.effective_count},
          {"resultant", fisher.resultant},
          {"kappa", number_or_null(fisher.kappa)},
          {"kappa_unbiased", number_or_null(fisher.kappa_unbiased)},
          {"confidence_cone", number_or_null(fisher.confidence_cone)},
          {"half_cone", number_or_null(set.half_cone)},
          {"cone_of_95", number_or_null(set.most_cone)},
          {"eigenvalues", fisher.eigenvalues},
          {"spacing", set.spacing ? spacing_json(*set.spacing) : Json()},
          {"mean_extent", set.extents > 0 ? Json(set.mean_extent) : Json()},
          {"extents", set.extents}};
}

Json rows_json(const SurveyReport& report) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < report.poles.size(); ++i) {
    const Index set = report.set_of_row[i];
    rows.push_back({{"set", set == none ? Json() : Json(report.sets[set].name)},
                    {"weight", report.weight[i]}});
  }
  return rows;
}

}  // namespace

Json sets_document(const SetsHead& head, const SurveyReport& report) {
  Json document = head_json({"sets", "", {}});
  document["table"] = head.table;
  Index of_none = 0;
  for (const Index set : report.set_of_row) of_none += set == none;
  document["totals"] = {{"joints", report.poles.size()},
                        {"sets", report.sets.size()},
                        {"of_no_set", of_none},
                        {"share_of_no_set", report.background},
                        {"effective_count", report.effective_count},
                        {"blind", report.blind}};
  document["grouping"] = report.by_column ? "column" : "poles";
  if (report.by_column) document["column"] = head.name_heading;
  if (!report.by_column) document["criteria"] = report.criteria;
  document["blind_zone"] = head.blind_zone;
  Json& lines = document["scanlines"] = Json::array();
  for (const LineDirection& line : report.lines)
    lines.push_back({{"trend", line.trend}, {"plunge", line.plunge}});
  Json& sets = document["sets"] = Json::array();
  for (const MeasuredSet& set : report.sets) sets.push_back(set_json(set));
  document["rows"] = rows_json(report);
  return document;
}

}  // namespace rockfold
