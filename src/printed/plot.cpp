#include "src/printed/plot.hpp"

#include <algorithm>
#include <cmath>

#include "src/printed/format.hpp"
#include "src/report/drawings/svg.hpp"

namespace rockfold {

namespace {

// px
constexpr Real width = 680, height = 250, left = 62, right = 18, top = 34, bottom = 34;
constexpr Real key_height = 18;

/// Limits of the values, with zero.
struct Range {
  Real low = 0, high = 0;
};

Range range_of(const Plot& plot) {
  Range range;
  for (const PlotCurve& curve : plot.curves)
    for (const Real v : curve.values)
      if (std::isfinite(v))
        range.low = std::min(range.low, v), range.high = std::max(range.high, v);
  if (!(range.high > range.low)) range.high = range.low + 1;
  return range;
}

/// From times or places and values to the paper.
struct Frame {
  Real t0, t1;
  Range range;
  Real x(Real t) const {
    return left + (t1 > t0 ? (t - t0) / (t1 - t0) : 0) * (width - left - right);
  }
  Real y(Real v) const {
    return top + (range.high - v) / (range.high - range.low) * (height - top - bottom);
  }
};

void draw_axes(Svg& svg, const Frame& frame, const ScaledUnit& unit, const std::string& axis_name) {
  const Pen grid{.stroke = "#dddddd", .width = 0.8}, axis{.stroke = "#333333", .width = 1};
  for (const Real v :
       axis_ticks(frame.range.low / unit.factor, frame.range.high / unit.factor, 5)) {
    const Real y = frame.y(v * unit.factor);
    svg.line({left, y}, {width - right, y}, v == 0 ? axis : grid);
    svg.text({left - 6, y + 4}, digits(v, 4), {.size = 11, .anchor = "end"});
  }
  const Real low = height - bottom;
  svg.line({left, low}, {width - right, low}, axis);
  for (const Real t : axis_ticks(frame.t0, frame.t1, 8)) {
    svg.line({frame.x(t), low}, {frame.x(t), low + 4}, axis);
    svg.text({frame.x(t), low + 17}, digits(t, 4), {.size = 11, .anchor = "middle"});
  }
  svg.text({width - right, low + 31}, axis_name, {.size = 11, .anchor = "end"});
}

/// Of more points than pixels, the least and greatest of each pixel.
std::vector<Point2> path_of(const Frame& frame, const std::vector<Real>& time,
                            const std::vector<Real>& values, std::size_t from, std::size_t to) {
  std::vector<Point2> path;
  for (std::size_t i = from; i < to;) {
    const auto column = std::floor(frame.x(time[i]));
    std::size_t least = i, most = i, end = i;
    for (; end < to && std::floor(frame.x(time[end])) == column; ++end) {
      if (values[end] < values[least]) least = end;
      if (values[end] > values[most]) most = end;
    }
    const auto [first, second] = std::minmax(least, most);
    path.push_back({frame.x(time[first]), frame.y(values[first])});
    if (second != first) path.push_back({frame.x(time[second]), frame.y(values[second])});
    i = end;
  }
  return path;
}

void draw_curve(Svg& svg, const Frame& frame, const std::vector<Real>& time,
                const std::vector<Real>& values, const char* colour) {
  std::size_t i = 0;
  while (i < values.size()) {
    if (!std::isfinite(values[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < values.size() && std::isfinite(values[end])) ++end;
    svg.polyline(path_of(frame, time, values, i, end), {.stroke = colour, .width = 1.8});
    i = end;
  }
}

/// Names of the curves in rows below the plot; returns how many rows, drawing them where `svg` is given.
int keys(const Plot& plot, Svg* svg) {
  Real x = left;
  int row = 0;
  for (std::size_t i = 0; i < plot.curves.size(); ++i) {
    const Real room = 30 + text_width(plot.curves[i].name, 11.5);
    if (x > left && x + room > width - right) x = left, ++row;
    if (svg) {
      const Real y = height + 14 + row * key_height;
      svg->line({x, y - 4}, {x + 18, y - 4}, {.stroke = series_colour(i), .width = 2.4});
      svg->text({x + 23, y}, plot.curves[i].name, {.size = 11.5});
    }
    x += room + 12;
  }
  return row + 1;
}

}  // namespace

std::vector<Real> axis_ticks(Real low, Real high, int most) {
  if (!(high > low)) return {low};
  const Real raw = (high - low) / most, power = std::pow(10, std::floor(std::log10(raw)));
  Real step = 10 * power;
  for (const Real f : {5.0, 2.0, 1.0})
    if (f * power >= raw * 0.9999) step = f * power;
  std::vector<Real> ticks;
  for (Real i = std::ceil(low / step - 1e-6); i * step <= high + 1e-6 * step; ++i)
    ticks.push_back(i * step + 0.0);
  return ticks;
}

std::string plot_svg(const Plot& plot) {
  if (plot.curves.empty() || plot.at.size() < 2) return "";
  Svg svg(width, height + 8 + keys(plot, nullptr) * key_height);
  const Frame frame{plot.at.front(), plot.at.back(), range_of(plot)};
  const ScaledUnit unit = unit_for(std::max(-frame.range.low, frame.range.high), plot.unit);
  svg.text({left, 18}, plot.title + (unit.name.empty() ? "" : ", " + unit.name),
           {.size = 13, .bold = true});
  draw_axes(svg, frame, unit, plot.axis);
  for (std::size_t i = 0; i < plot.curves.size(); ++i)
    draw_curve(svg, frame, plot.at, plot.curves[i].values, series_colour(i));
  keys(plot, &svg);
  return svg.document(plot.title);
}

}  // namespace rockfold
