// Drawings as SVG text. Coordinates are pixels, y down, rounded to hundredths: the same drawing gives the same bytes.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

using Point2 = std::array<Real, 2>;

/// How a shape is drawn. Colours are CSS, "none" for none.
struct Pen {
  std::string stroke = "#333333";
  Real width = 1;
  std::string fill = "none";
  Real opacity = 1;
  std::string dash = {};  ///< "4 3"
};

/// How a text is drawn.
struct Font {
  Real size = 12;
  std::string anchor = "start";  ///< or "middle", "end"
  std::string colour = "#222222";
  bool bold = false;
  bool halo = false;  ///< a white rim, for texts over drawings
};

class Svg {
 public:
  Svg(Real width, Real height);

  void line(const Point2& a, const Point2& b, const Pen& pen);
  void polyline(const std::vector<Point2>& points, const Pen& pen);
  /// Closed loops; holes by the even-odd rule.
  void polygon(const std::vector<std::vector<Point2>>& loops, const Pen& pen,
               const std::string& clip = {});
  void circle(const Point2& centre, Real radius, const Pen& pen, const std::string& clip = {});
  void square(const Point2& centre, Real half, const Pen& pen);
  void text(const Point2& at, const std::string& words, const Font& font = {});
  /// Clips what names `id` to a circle, or to a rectangle.
  void clip_circle(const std::string& id, const Point2& centre, Real radius);
  void clip_rectangle(const std::string& id, const Point2& low, const Point2& high);

  /// The whole document, at least as wide as its texts; `title` is what a viewer calls it.
  std::string document(const std::string& title) const;

 private:
  Real width_, height_;
  Real left_ = 0, right_ = 0;  ///< that texts reach
  std::string body_;
};

/// px that words take at most in a font without serifs, by rough widths of its letters.
Real text_width(const std::string& words, Real size);

/// Colours that are told apart by most eyes, in print too; over and over again.
const char* series_colour(std::size_t number);

}  // namespace rockfold
