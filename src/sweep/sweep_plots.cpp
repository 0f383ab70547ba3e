#include "src/sweep/sweep_plots.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "src/printed/format.hpp"
#include "src/printed/plot.hpp"
#include "src/report/drawings/svg.hpp"
#include "src/sweep/statistics.hpp"

namespace rockfold::sweep {

namespace {

// px
constexpr Real width = 680, left = 62, right = 18, top = 34, bottom = 44;
constexpr Real bar_height = 22, mark_height = 15;
constexpr const char* low_colour = "#4477aa";
constexpr const char* high_colour = "#ee7733";
constexpr const char* mark_colour = "#b2182b";
constexpr std::size_t most_bars = 20;    // of a tornado plot
constexpr std::size_t most_marks = 4;    // that have room for their names
constexpr Real most_whole_numbers = 40;  // that have a class each
const Pen grid{.stroke = "#dddddd", .width = 0.8}, axis{.stroke = "#333333", .width = 1},
    percentile{.stroke = "#777777", .width = 1, .dash = "2 3"};

std::vector<Real> numbers_alone(std::vector<Real> values) {
  std::erase_if(values, [](Real v) { return !std::isfinite(v); });
  return values;
}

std::string with_unit(const std::string& name, const std::string& unit) {
  return name + (unit.empty() ? "" : ", " + unit);
}

/// The classes of a histogram: `count` of the same width from `low` to `high`.
struct Classes {
  Real low = 0, high = 1;
  std::size_t count = 1;
};

/// Of numbers that scatter by Freedman & Diaconis (1981): 2 · interquartile range / ∛n wide; where half of them are alike by Sturges (1926):
/// 1 + log₂ n of them. 4 to 40.
Classes classes_of(const std::vector<Real>& values, const Spread& spread) {
  const Real range = spread.max - spread.min;
  const bool whole =
      std::all_of(values.begin(), values.end(), [](Real v) { return v == std::floor(v); });
  if (whole && range < most_whole_numbers)
    return {spread.min - 0.5, spread.max + 0.5, static_cast<std::size_t>(range) + 1};
  if (!(range > 0)) {
    const Real half = std::max(std::abs(spread.min), 1.0) / 2;
    return {spread.min - half, spread.max + half, 1};
  }
  const Real runs = spread.count, size = 2 * (spread.p75 - spread.p25) / std::cbrt(runs);
  const Real count = size > 0 ? std::ceil(range / size) : 1 + std::ceil(std::log2(runs));
  return {spread.min, spread.max, static_cast<std::size_t>(std::clamp(count, 4.0, 40.0))};
}

/// A plot over the results of runs: what the histogram and the cumulated curve share.
struct ResultFrame {
  std::vector<Real> values;  ///< that are numbers, ascending
  Spread spread;
  Classes classes;
  ScaledUnit unit;
  std::vector<ResultPlot::Mark> marks;  ///< that lie in the plot, and for whose names there is room
  Real high = top, low = 0;             ///< px, of the plot's area
  Real most = 1;                        ///< the number at its top

  ResultFrame(const ResultPlot& plot, Real height) {
    values = numbers_alone(plot.values);
    std::sort(values.begin(), values.end());
    spread = spread_of(values);
    if (values.empty()) return;
    classes = classes_of(values, spread);
    unit = unit_for(std::max(std::abs(spread.min), std::abs(spread.max)), plot.unit);
    for (const ResultPlot::Mark& mark : plot.marks)
      if (marks.size() < most_marks && classes.low < mark.at && mark.at < classes.high)
        marks.push_back(mark);
    high = top + mark_height * static_cast<Real>(marks.size());
    low = high + height;
  }
  Real x(Real v) const {
    return left + (v - classes.low) / (classes.high - classes.low) * (width - left - right);
  }
  Real y(Real n) const { return high + (1 - n / most) * (low - high); }
};

/// "2.5 MN"
std::string with_unit_behind(const ResultFrame& frame, Real value) {
  return digits(value / frame.unit.factor, 4) +
         (frame.unit.name.empty() ? "" : " " + frame.unit.name);
}

void draw_value_axis(Svg& svg, const ResultFrame& frame, const std::string& name) {
  const Real y = frame.y(0);
  svg.line({left, y}, {width - right, y}, axis);
  for (const Real v : axis_ticks(frame.classes.low / frame.unit.factor,
                                 frame.classes.high / frame.unit.factor, 8)) {
    const Real x = frame.x(v * frame.unit.factor);
    svg.line({x, y}, {x, y + 4}, axis);
    svg.text({x, y + 17}, digits(v, 4), {.size = 11, .anchor = "middle"});
  }
  svg.text({width - right, y + 34}, with_unit(name, frame.unit.name),
           {.size = 11, .anchor = "end"});
}

/// Lines where events compare the result with a number, their names in rows above the plot.
void draw_marks(Svg& svg, const ResultFrame& frame) {
  for (std::size_t i = 0; i < frame.marks.size(); ++i) {
    const auto& [event, sign, at] = frame.marks[i];
    const Real x = frame.x(at), y = top + mark_height * static_cast<Real>(i);
    svg.line({x, y - 10}, {x, frame.y(0)}, {.stroke = mark_colour, .width = 1.4});
    const std::string words = fmt::format("{}: {} {}", event, sign, with_unit_behind(frame, at));
    const bool flipped = x + 6 + text_width(words, 11) > width - right;
    svg.text(
        {x + (flipped ? -5 : 5), y}, words,
        {.size = 11, .anchor = flipped ? "end" : "start", .colour = mark_colour, .halo = true});
  }
}

/// Steps of 1/n; of more runs than pixels, those that differ on the paper.
std::vector<Point2> steps_of(const ResultFrame& frame) {
  std::vector<Point2> path{{left, frame.y(0)}};
  const Real runs = static_cast<Real>(frame.values.size());
  for (std::size_t i = 0; i < frame.values.size(); ++i) {
    if (i + 1 < frame.values.size() && frame.values[i + 1] == frame.values[i]) continue;
    const Point2 up{frame.x(frame.values[i]), frame.y(100 * static_cast<Real>(i + 1) / runs)};
    const bool last = i + 1 == frame.values.size();
    if (!last && up[0] - path.back()[0] < 0.3 && path.back()[1] - up[1] < 0.3) continue;
    path.push_back({up[0], path.back()[1]});
    path.push_back(up);
  }
  path.push_back({width - right, frame.y(100)});
  return path;
}

/// From the axis of shares to the curve, and down to the value.
void draw_percentile(Svg& svg, const ResultFrame& frame, Real share, Real value) {
  const Real x = frame.x(value), y = frame.y(share);
  svg.polyline({{left, y}, {x, y}, {x, frame.y(0)}}, percentile);
  svg.circle({x, y}, 2.6, {.stroke = "#ffffff", .width = 0.8, .fill = low_colour});
  const std::string words = fmt::format("{:g} %: {}", share, with_unit_behind(frame, value));
  const Real room = 8 + text_width(words, 11);
  // Above the curve on its left, else below it on its right.
  const bool before = share < 10 ? x - room > left : x + room > width - right;
  const bool above = before || share < 10;
  svg.text({x + (before ? -7 : 7), y + (above ? -6 : 13)}, words,
           {.size = 11, .anchor = before ? "end" : "start", .halo = true});
}

void draw_share_axis(Svg& svg, const ResultFrame& frame) {
  for (const Real share : axis_ticks(0, 100, 5)) {
    svg.line({left, frame.y(share)}, {width - right, frame.y(share)}, grid);
    svg.text({left - 6, frame.y(share) + 4}, fmt::format("{:g} %", share),
             {.size = 11, .anchor = "end"});
  }
}

void draw_bars(Svg& svg, const ResultFrame& frame, const std::vector<Index>& count) {
  const Real step =
      (frame.classes.high - frame.classes.low) / static_cast<Real>(frame.classes.count);
  for (std::size_t c = 0; c < count.size(); ++c) {
    if (count[c] == 0) continue;
    const Real a = frame.x(frame.classes.low + static_cast<Real>(c) * step),
               b = frame.x(frame.classes.low + static_cast<Real>(c + 1) * step),
               up = frame.y(static_cast<Real>(count[c]));
    svg.polygon({{{a, frame.y(0)}, {b, frame.y(0)}, {b, up}, {a, up}}},
                {.stroke = "#ffffff", .width = 0.8, .fill = low_colour});
  }
}

std::vector<Index> counts_of(const ResultFrame& frame) {
  const auto& [low, high, classes] = frame.classes;
  std::vector<Index> count(classes, 0);
  for (const Real v : frame.values) {
    const auto at = static_cast<std::size_t>((v - low) / (high - low) * static_cast<Real>(classes));
    ++count[std::min(at, classes - 1)];
  }
  return count;
}

/// What a tornado plot lies between, and the room that its names take.
struct TornadoFrame {
  Real low, high, begin, end;
  Real x(Real v) const { return begin + (v - low) / (high - low) * (end - begin); }
};

TornadoFrame tornado_frame(const std::vector<Swing>& swings, std::size_t bars, Real mean) {
  TornadoFrame frame{mean, mean, 0, width - 70};
  Real names = 0;
  for (std::size_t i = 0; i < bars; ++i) {
    frame.low = std::min({frame.low, swings[i].low, swings[i].high});
    frame.high = std::max({frame.high, swings[i].low, swings[i].high});
    names = std::max(names, text_width(swings[i].parameter, 11.5));
  }
  frame.begin = std::min(names + 16, width / 2);
  return frame;
}

void draw_swing(Svg& svg, const TornadoFrame& frame, const Swing& swing, Real mean, Real y) {
  const Real up = y + 3, down = y + bar_height - 3;
  const auto bar = [&](Real to, const char* colour) {
    svg.polygon(
        {{{frame.x(mean), up}, {frame.x(to), up}, {frame.x(to), down}, {frame.x(mean), down}}},
        {.stroke = "none", .fill = colour});
  };
  bar(swing.low, low_colour);
  bar(swing.high, high_colour);
  svg.text({frame.begin - 8, down - 3}, swing.parameter, {.size = 11.5, .anchor = "end"});
  if (std::isfinite(swing.rank_correlation))
    svg.text({width - 8, down - 3}, fmt::format("r {:+.2f}", swing.rank_correlation),
             {.size = 11, .anchor = "end"});
}

}  // namespace

std::string histogram_svg(const ResultPlot& plot) {
  ResultFrame frame(plot, 150);
  if (frame.values.empty()) return "";
  const std::vector<Index> count = counts_of(frame);
  frame.most = static_cast<Real>(*std::max_element(count.begin(), count.end()));
  Svg svg(width, frame.low + bottom);
  svg.text({left, 18}, plot.name, {.size = 13, .bold = true});
  svg.text({left - 6, 18}, "runs", {.size = 11, .anchor = "end"});
  for (const Real n : axis_ticks(0, frame.most, 5)) {
    if (n != std::floor(n)) continue;  // runs are whole
    svg.line({left, frame.y(n)}, {width - right, frame.y(n)}, grid);
    svg.text({left - 6, frame.y(n) + 4}, digits(n), {.size = 11, .anchor = "end"});
  }
  draw_bars(svg, frame, count);
  draw_value_axis(svg, frame, plot.name);
  for (const Real v : {frame.spread.p5, frame.spread.p50, frame.spread.p95})
    svg.line({frame.x(v), frame.high}, {frame.x(v), frame.y(0)}, percentile);
  const Real mean = frame.x(frame.spread.mean);
  svg.line({mean, frame.high}, {mean, frame.y(0)},
           {.stroke = "#222222", .width = 1.4, .dash = "5 3"});
  draw_marks(svg, frame);
  return svg.document(plot.name);
}

std::string cumulated_svg(const ResultPlot& plot) {
  ResultFrame frame(plot, 170);
  if (frame.values.empty()) return "";
  frame.most = 100;
  Svg svg(width, frame.low + bottom);
  svg.text({left, 18}, plot.name + ": share of the runs with no more", {.size = 13, .bold = true});
  draw_share_axis(svg, frame);
  draw_value_axis(svg, frame, plot.name);
  draw_marks(svg, frame);
  svg.polyline(steps_of(frame), {.stroke = low_colour, .width = 1.8});
  draw_percentile(svg, frame, 5, frame.spread.p5);
  draw_percentile(svg, frame, 50, frame.spread.p50);
  draw_percentile(svg, frame, 95, frame.spread.p95);
  return svg.document(plot.name + ", cumulated");
}

std::string tornado_svg(const std::string& name, const std::string& unit,
                        const std::vector<Swing>& swings, Real mean) {
  if (swings.empty()) return "";
  const std::size_t bars = std::min(swings.size(), most_bars);
  const TornadoFrame frame = tornado_frame(swings, bars, mean);
  if (!(frame.high > frame.low)) return "";
  const ScaledUnit scale = unit_for(std::max(std::abs(frame.low), std::abs(frame.high)), unit);
  const Real down = top + static_cast<Real>(bars) * bar_height;
  Svg svg(width, down + bottom);
  svg.text({frame.begin, 18}, "What " + name + " depends on", {.size = 13, .bold = true});
  for (std::size_t i = 0; i < bars; ++i)
    draw_swing(svg, frame, swings[i], mean, top + static_cast<Real>(i) * bar_height);
  svg.line({frame.x(mean), top - 4}, {frame.x(mean), down}, axis);
  svg.line({frame.begin, down}, {frame.end, down}, axis);
  for (const Real v : axis_ticks(frame.low / scale.factor, frame.high / scale.factor, 6)) {
    const Real x = frame.x(v * scale.factor);
    svg.line({x, down}, {x, down + 4}, axis);
    svg.text({x, down + 17}, digits(v, 4), {.size = 11, .anchor = "middle"});
  }
  svg.text({frame.end, down + 34}, with_unit("mean of " + name, scale.name),
           {.size = 11, .anchor = "end"});
  return svg.document(name);
}

}  // namespace rockfold::sweep
