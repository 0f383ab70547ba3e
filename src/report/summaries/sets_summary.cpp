#include "src/report/summaries/sets_summary.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/report/summaries/summary.hpp"
#include "src/report/summaries/table.hpp"

namespace rockfold {

namespace {

/// "-" of what cannot be known.
std::string number(Real x, int decimals) {
  return std::isnan(x) ? "-" : std::isinf(x) ? "inf" : fixed_text(x, decimals);
}

std::string weights_text(const SetsHead& head, const SurveyReport& report) {
  if (report.lines.empty()) return "";
  std::string lines;
  constexpr std::size_t most_lines = 4;
  for (std::size_t i = 0; i < std::min(report.lines.size(), most_lines); ++i)
    lines += fmt::format("{}{:g}/{:g}", i > 0 ? ", " : "", report.lines[i].trend,
                         report.lines[i].plunge);
  if (report.lines.size() > most_lines)
    lines += fmt::format(" and {} more", report.lines.size() - most_lines);
  return fact("scanline", fmt::format("{}  (trend/plunge; Terzaghi's weights 1/|cos d|, blind "
                                      "zone {:g} deg)",
                                      lines, head.blind_zone));
}

std::string grouping_text(const SetsHead& head, const SurveyReport& report) {
  return fact("sets", report.by_column
                          ? fmt::format("{}, as column \"{}\" has them", report.sets.size(),
                                        head.name_heading)
                          : fmt::format("{}, found among the poles (Fisher's distributions and "
                                        "uniform poles)",
                                        report.sets.size()));
}

/// Columns that no set has anything in are left out.
std::string table_of_sets(const SurveyReport& report) {
  const auto any = [&](const auto& has) {
    return std::any_of(report.sets.begin(), report.sets.end(), has);
  };
  const bool spacings = any([](const MeasuredSet& set) { return set.spacing.has_value(); });
  const bool extents = any([](const MeasuredSet& set) { return set.extents > 0; });
  std::vector<Column> columns{
      {"set", "", true}, {"plane", "dip/dir", true}, {"joints", ""},     {"share", "%"},
      {"kappa", ""},     {"95 % cone", "deg"},       {"half in", "deg"}, {"95 % in", "deg"}};
  if (spacings) {
    columns.push_back({"along line", "m"});
    columns.push_back({"spacing", "m"});
  }
  if (extents) columns.push_back({"extent", "m"});
  std::vector<std::vector<std::string>> rows;
  for (const MeasuredSet& set : report.sets) {
    rows.push_back({set.name, fmt::format("{:02.0f}/{:03.0f}", set.dip, set.dip_direction),
                    fmt::format("{}", set.count), fixed_text(100 * set.share, 1),
                    number(set.fisher.kappa, 1), number(set.fisher.confidence_cone, 1),
                    number(set.half_cone, 1), number(set.most_cone, 1)});
    if (spacings) {
      rows.back().push_back(set.spacing ? number(set.spacing->along, 2) : "-");
      rows.back().push_back(set.spacing ? number(set.spacing->normal, 2) : "-");
    }
    if (extents) rows.back().push_back(set.extents > 0 ? fixed_text(set.mean_extent, 2) : "-");
  }
  return rows.empty() ? "" : "\n" + table_text(columns, rows);
}

std::string explanation(const SurveyReport& report) {
  if (report.sets.empty()) return "";
  std::string text =
      "  95 % cone: about the mean, holds the true mean; half in, 95 % in: hold the poles\n";
  if (std::any_of(report.sets.begin(), report.sets.end(),
                  [](const MeasuredSet& set) { return set.spacing.has_value(); }))
    text += "  spacing: mean along the set's normal\n";
  return text;
}

}  // namespace

std::string sets_summary(const SetsHead& head, const SurveyReport& report) {
  const auto of_none = std::count(report.set_of_row.begin(), report.set_of_row.end(), none);
  std::string text = head.table + "\n\n" + fact("joints", fmt::format("{}", report.poles.size()));
  text += weights_text(head, report) + grouping_text(head, report);
  text +=
      fact("of no set", fmt::format("{}  ({:.1f} % by weight)", of_none, 100 * report.background));
  text += table_of_sets(report) + explanation(report);
  return text;
}

}  // namespace rockfold
