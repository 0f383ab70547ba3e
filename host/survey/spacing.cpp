#include "host/survey/spacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;

/// The part of a line from the first to the last of some joints.
struct Reach {
  Real low = std::numeric_limits<Real>::infinity(), high = -low;
  Index joints = 0;
};

}  // namespace

LinePlaces places_on_lines(const Survey& survey, const std::optional<LineDirection>& scanline) {
  LinePlaces places;
  const SurveyColumns& columns = survey.columns;
  const bool by_column = !columns.line_trend.empty();
  for (std::size_t i = 0; i < survey.rows.size() && (scanline || by_column); ++i) {
    const LineDirection line =
        scanline ? *scanline : LineDirection{columns.line_trend[i], columns.line_plunge[i]};
    const auto known = std::find(places.lines.begin(), places.lines.end(), line);
    places.line_of_row.push_back(static_cast<Index>(known - places.lines.begin()));
    if (known == places.lines.end()) places.lines.push_back(line);
  }
  places.distance = columns.distance;
  if (!places.distance.empty() || !columns.has_places || places.lines.empty()) return places;
  for (std::size_t i = 0; i < survey.rows.size(); ++i)
    places.distance.push_back(
        dot(direction_vector(places.lines[places.line_of_row[i]]), survey.rows[i].center));
  return places;
}

std::optional<Real> cosine_to_line(const LinePlaces& places, std::size_t row, const Vec3& pole) {
  if (places.lines.empty()) return {};
  return std::abs(dot(direction_vector(places.lines[places.line_of_row[row]]), pole));
}

std::optional<SetSpacing> spacing_of(const LinePlaces& places, const std::vector<std::size_t>& rows,
                                     const Vec3& mean, Real blind_zone) {
  if (places.distance.empty()) return {};
  std::vector<Reach> reaches(std::max<std::size_t>(places.lines.size(), 1));
  for (const std::size_t row : rows) {
    Reach& reach = reaches[places.lines.empty() ? 0 : places.line_of_row[row]];
    reach.low = std::min(reach.low, places.distance[row]);
    reach.high = std::max(reach.high, places.distance[row]);
    ++reach.joints;
  }
  SetSpacing spacing;
  Real along = 0, normal = 0;
  spacing.blind = !places.lines.empty();
  for (std::size_t k = 0; k < reaches.size(); ++k) {
    const Reach& reach = reaches[k];
    if (reach.joints < 2 || !(reach.high > reach.low)) continue;
    const Real cosine = places.lines.empty()
                            ? std::numeric_limits<Real>::quiet_NaN()
                            : std::abs(dot(direction_vector(places.lines[k]), mean));
    spacing.intervals += reach.joints - 1;
    along += reach.high - reach.low;
    normal += (reach.high - reach.low) * cosine;
    spacing.blind = spacing.blind && cosine < std::sin(blind_zone * degree);
  }
  if (spacing.intervals == 0) return {};
  spacing.along = along / spacing.intervals;
  spacing.normal = normal / spacing.intervals;
  return spacing;
}

}  // namespace rockfold
