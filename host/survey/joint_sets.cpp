#include "host/survey/joint_sets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "host/survey/mixture.hpp"
#include "host/survey/spacing.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;

Vec3 upward_normal(const DipOrientation& plane) {
  const Real dip = plane.dip * degree, direction = plane.dip_direction * degree;
  return {std::sin(dip) * std::sin(direction), std::sin(dip) * std::cos(direction), std::cos(dip)};
}

DipOrientation plane_of(const Vec3& upward) {
  const Real across = std::hypot(upward[0], upward[1]);
  Real direction = across > 0 ? std::atan2(upward[0], upward[1]) / degree : 0;
  if (direction < 0) direction += 360;
  return {std::atan2(across, upward[2]) / degree, direction};
}

/// How surely each row belongs to each set.
struct Grouping {
  std::vector<std::string> names;
  std::vector<std::vector<Real>> chance;  ///< [sets][rows]
};

Grouping own_groups(const Survey& survey, SurveyReport& report) {
  Grouping groups;
  for (const JointTable::Row& row : survey.rows) {
    const auto known = std::find(groups.names.begin(), groups.names.end(), row.name);
    const auto set = static_cast<Index>(known - groups.names.begin());
    report.set_of_row.push_back(row.name.empty() ? none : set);
    if (known == groups.names.end() && !row.name.empty()) groups.names.push_back(row.name);
  }
  groups.chance.assign(groups.names.size(), std::vector<Real>(survey.rows.size(), 0));
  for (std::size_t i = 0; i < survey.rows.size(); ++i)
    if (report.set_of_row[i] != none) groups.chance[report.set_of_row[i]][i] = 1;
  return groups;
}

/// Each row is taken for what it most probably is.
Grouping found_groups(const SurveyRules& rules, SurveyReport& report) {
  const SetSearch search = find_axial_sets(report.poles, report.weight, rules.count);
  report.criteria = search.criteria;
  const std::size_t sets = search.found.sets.size();
  Grouping groups;
  groups.chance.assign(sets, {});
  for (std::size_t k = 0; k < sets; ++k) groups.names.push_back("set" + std::to_string(k + 1));
  for (const Vec3& pole : report.poles) {
    const std::vector<Real> chance = search.found.memberships(pole);
    for (std::size_t k = 0; k < sets; ++k) groups.chance[k].push_back(chance[k]);
    const auto best = std::max_element(chance.begin(), chance.end()) - chance.begin();
    report.set_of_row.push_back(static_cast<std::size_t>(best) < sets ? static_cast<Index>(best)
                                                                      : none);
  }
  return groups;
}

void weigh(const Survey& survey, const SurveyRules& rules, const LinePlaces& places,
           SurveyReport& report) {
  const Real least = std::sin(rules.blind_zone * degree);
  Real sum = 0, squares = 0;
  for (std::size_t i = 0; i < report.poles.size(); ++i) {
    Real w = survey.columns.weight.empty() ? 1 : survey.columns.weight[i];
    if (const auto cosine = cosine_to_line(places, i, report.poles[i])) {
      report.blind += *cosine < least;
      w /= std::max(*cosine, least);
    }
    report.weight.push_back(w);
    sum += w, squares += w * w;
  }
  report.effective_count = sum * sum / squares;
}

/// The mean of what rows of a set say of how far its joints reach.
void measure_extents(const Survey& survey, const std::vector<std::size_t>& rows, MeasuredSet& set) {
  Real sum = 0;
  for (const std::size_t row : rows) {
    const Real radius = survey.rows[row].radius;
    if (!std::isfinite(radius)) continue;
    sum += 2 * radius;
    ++set.extents;
  }
  if (set.extents > 0) set.mean_extent = sum / set.extents;
}

MeasuredSet measure_set(const Survey& survey, const SurveyRules& rules, const LinePlaces& places,
                        const SurveyReport& report, Index number, const std::vector<Real>& chance) {
  MeasuredSet set;
  std::vector<std::size_t> rows;
  Real mine = 0, all = 0;
  for (std::size_t i = 0; i < chance.size(); ++i) {
    mine += report.weight[i] * chance[i];
    all += report.weight[i];
    if (report.set_of_row[i] == number) rows.push_back(i);
  }
  set.count = static_cast<Index>(rows.size());
  set.share = mine / all;
  set.fisher = fisher_statistics(report.poles, report.weight, chance);
  const DipOrientation plane = plane_of(set.fisher.mean);
  set.dip = plane.dip;
  set.dip_direction = plane.dip_direction;
  set.half_cone = cone_of_share(set.fisher.kappa, 0.5);
  set.most_cone = cone_of_share(set.fisher.kappa, 0.95);
  set.spacing = spacing_of(places, rows, set.fisher.mean, rules.blind_zone);
  measure_extents(survey, rows, set);
  return set;
}

}  // namespace

Vec3 direction_vector(const LineDirection& line) {
  const Real trend = line.trend * degree, plunge = line.plunge * degree;
  return {std::cos(plunge) * std::sin(trend), std::cos(plunge) * std::cos(trend),
          -std::sin(plunge)};
}

SurveyReport find_joint_sets(const Survey& survey, const SurveyRules& rules) {
  SurveyReport report;
  for (const JointTable::Row& row : survey.rows)
    report.poles.push_back(upward_normal(row.orientation));
  const LinePlaces places = places_on_lines(survey, rules.scanline);
  report.lines = places.lines;
  weigh(survey, rules, places, report);
  report.by_column = rules.own_sets && survey.columns.names_sets;
  const Grouping groups =
      report.by_column ? own_groups(survey, report) : found_groups(rules, report);
  report.background = 1;
  for (std::size_t k = 0; k < groups.names.size(); ++k) {
    report.sets.push_back(
        measure_set(survey, rules, places, report, static_cast<Index>(k), groups.chance[k]));
    report.sets.back().name = groups.names[k];
    report.background -= report.sets.back().share;
  }
  report.background = std::max(report.background, Real{0});
  return report;
}

}  // namespace rockfold
