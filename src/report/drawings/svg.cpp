#include "src/report/drawings/svg.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

namespace rockfold {

namespace {

/// Up to two decimals, never −0.
std::string number(Real x) {
  std::string text = fmt::format("{:.2f}", x);
  while (text.back() == '0') text.pop_back();
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string escaped(const std::string& words) {
  std::string text;
  for (const char c : words) {
    if (c == '<')
      text += "&lt;";
    else if (c == '>')
      text += "&gt;";
    else if (c == '&')
      text += "&amp;";
    else if (static_cast<unsigned char>(c) < 0x20)
      text += ' ';
    else
      text += c;
  }
  return text;
}

std::string attributes(const Pen& pen) {
  std::string text = fmt::format(" fill=\"{}\" stroke=\"{}\"", pen.fill, pen.stroke);
  if (pen.stroke != "none") text += fmt::format(" stroke-width=\"{}\"", number(pen.width));
  if (pen.opacity < 1) text += fmt::format(" opacity=\"{}\"", number(pen.opacity));
  if (!pen.dash.empty()) text += fmt::format(" stroke-dasharray=\"{}\"", pen.dash);
  return text;
}

std::string clipped(const std::string& clip) {
  return clip.empty() ? "" : fmt::format(" clip-path=\"url(#{})\"", clip);
}

std::string path(const std::vector<Point2>& points) {
  std::string text;
  for (const Point2& p : points)
    text += fmt::format("{}{} {}", text.empty() ? "M" : "L", number(p[0]), number(p[1]));
  return text;
}

}  // namespace

Real text_width(const std::string& words, Real size) {
  Real ems = 0;
  for (const char c : words) {
    if ((static_cast<unsigned char>(c) & 0xC0) == 0x80) continue;  // the rest of a letter
    if (std::string_view(" ijl.,:;'|!()[]/ftI-").find(c) != std::string_view::npos)
      ems += 0.36;
    else if (std::string_view("mwMW%@").find(c) != std::string_view::npos)
      ems += 0.95;
    else
      ems += c >= 'A' && c <= 'Z' ? 0.73 : 0.6;
  }
  return ems * size;
}

Svg::Svg(Real width, Real height) : width_(width), height_(height) {}

void Svg::line(const Point2& a, const Point2& b, const Pen& pen) {
  body_ += fmt::format("<path d=\"{}\"{}/>\n", path({a, b}), attributes(pen));
}

void Svg::polyline(const std::vector<Point2>& points, const Pen& pen) {
  if (points.size() > 1)
    body_ += fmt::format("<path d=\"{}\" stroke-linejoin=\"round\"{}/>\n", path(points),
                         attributes(pen));
}

void Svg::polygon(const std::vector<std::vector<Point2>>& loops, const Pen& pen,
                  const std::string& clip) {
  std::string d;
  for (const auto& loop : loops) d += path(loop) + "Z";
  body_ += fmt::format("<path d=\"{}\" fill-rule=\"evenodd\"{}{}/>\n", d, attributes(pen),
                       clipped(clip));
}

void Svg::circle(const Point2& centre, Real radius, const Pen& pen, const std::string& clip) {
  body_ += fmt::format("<circle cx=\"{}\" cy=\"{}\" r=\"{}\"{}{}/>\n", number(centre[0]),
                       number(centre[1]), number(radius), attributes(pen), clipped(clip));
}

void Svg::square(const Point2& centre, Real half, const Pen& pen) {
  const auto [x, y] = centre;
  polygon(
      {{{x - half, y - half}, {x + half, y - half}, {x + half, y + half}, {x - half, y + half}}},
      pen);
}

void Svg::text(const Point2& at, const std::string& words, const Font& font) {
  const Real long_way = text_width(words, font.size) * (font.bold ? 1.08 : 1);
  const Real before = font.anchor == "start" ? 0 : font.anchor == "end" ? 1 : 0.5;
  left_ = std::min(left_, at[0] - before * long_way);
  right_ = std::max(right_, at[0] + (1 - before) * long_way);
  std::string style = fmt::format(" font-size=\"{}\" text-anchor=\"{}\" fill=\"{}\"",
                                  number(font.size), font.anchor, font.colour);
  if (font.bold) style += " font-weight=\"bold\"";
  if (font.halo)
    style +=
        " stroke=\"white\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\"";
  body_ += fmt::format("<text x=\"{}\" y=\"{}\"{}>{}</text>\n", number(at[0]), number(at[1]), style,
                       escaped(words));
}

void Svg::clip_circle(const std::string& id, const Point2& centre, Real radius) {
  body_ += fmt::format("<clipPath id=\"{}\"><circle cx=\"{}\" cy=\"{}\" r=\"{}\"/></clipPath>\n",
                       id, number(centre[0]), number(centre[1]), number(radius));
}

void Svg::clip_rectangle(const std::string& id, const Point2& low, const Point2& high) {
  body_ += fmt::format(
      "<clipPath id=\"{}\"><rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/></clipPath>\n", id,
      number(low[0]), number(low[1]), number(high[0] - low[0]), number(high[1] - low[1]));
}

std::string Svg::document(const std::string& title) const {
  constexpr Real rim = 12;  // px beside texts that reach beyond the drawing
  const Real left = left_ < 0 ? left_ - rim : 0;
  const Real width = std::max(width_, right_ > width_ - rim ? right_ + rim : 0) - left;
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
             "viewBox=\"{3} 0 {0} {1}\" font-family=\"Helvetica, Arial, sans-serif\">\n"
             "<title>{2}</title>\n<rect x=\"{3}\" width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
             number(width), number(height_), escaped(title), number(left)) +
         body_ + "</svg>\n";
}

const char* series_colour(std::size_t number) {
  constexpr std::array<const char*, 8> colours{"#2166ac", "#b2182b", "#1b7837", "#e08214",
                                               "#762a83", "#01665e", "#8c510a", "#525252"};
  return colours[number % colours.size()];
}

}  // namespace rockfold
