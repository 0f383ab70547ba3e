#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "host/files/terrain/read_terrain.hpp"
#include "host/files/terrain/terrain_surface.hpp"
#include "host/files/text.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/model/text/numbers/decimal_comma.hpp"

namespace rockfold {

namespace {

struct Posts {
  std::vector<Vec3> points;  ///< m
  std::vector<int> line;
};

constexpr std::string_view separators = ",;";

/// The words that follow in a line, up to a comment.
std::size_t count_rest(Words words) {
  std::size_t count = 0;
  for (auto word = words.next(); !word.empty() && word.front() != '#'; word = words.next()) ++count;
  return count;
}

/// Of a line with more than three numbers: why commas in it may stand for decimal points; "" if they do not.
std::string comma_fault(std::string_view line) {
  constexpr const char* expected =
      "a line must hold three numbers x, y, z (decimals behind a point)";
  if (line.find(',') == std::string_view::npos) return "";
  Words words(line, ";");
  std::size_t count = 0;
  for (auto word = words.next(); !word.empty() && word.front() != '#'; word = words.next(), ++count)
    if (has_decimal_comma(word)) return expected + decimal_comma_hint(word);
  const bool commas_alone = count == 1 && line.find('.') == std::string_view::npos;
  return commas_alone ? fmt::format(
                            "{}: these commas may separate numbers or decimals, use blanks "
                            "or semicolons between numbers",
                            expected)
                      : "";
}

/// Reads x, y and z of each line. Columns behind them, as many as in the first one, are passed over with a warning.
class PostReader {
 public:
  PostReader(const Place& place, Faults& faults, std::vector<Diagnostic>* warnings)
      : place_(place), faults_(faults), warnings_(warnings) {}

  Posts read(std::string_view text) {
    bool may_be_heading = true;
    for (Lines lines(text); lines.next();) {
      Words words(lines.line(), separators);
      Words first = words;
      const auto word = first.next();
      if (word.empty() || word.front() == '#') continue;
      const bool is_heading = may_be_heading && !parse_number(word);
      may_be_heading = false;
      if (is_heading) continue;
      read_line(lines, words);
    }
    faults_.throw_if_any();
    return std::move(posts_);
  }

 private:
  void read_line(const Lines& lines, Words words) {
    const Vec3 point = parse_point(words, lines.number(), faults_);
    const std::size_t more = count_rest(words);
    if (posts_.points.empty()) look_at_columns(lines, words, more);
    if (more > columns_passed_over_) {
      for (std::size_t k = 0; k < columns_passed_over_; ++k) words.next();
      const auto word = words.next();
      const auto fault = comma_fault(lines.line());
      faults_.add(lines.number(), words.column(),
                  !fault.empty() ? fault
                                 : "a line must hold three numbers x, y, z (decimals behind a "
                                   "point), goes on with " +
                                       quoted(word));
    }
    posts_.points.push_back(point);
    posts_.line.push_back(lines.number());
  }

  /// The first line says how many columns there are.
  void look_at_columns(const Lines& lines, Words words, std::size_t more) {
    if (more == 0 || !comma_fault(lines.line()).empty()) return;
    columns_passed_over_ = more;
    if (!warnings_) return;
    Place place = place_;
    place.line = lines.number();
    const auto word = words.next();
    place.column = words.column();
    warnings_->push_back(
        {place, fmt::format("{} behind x, y and z {} passed over, here from {}",
                            counted(more, "column"), more == 1 ? "is" : "are", quoted(word))});
  }

  const Place& place_;
  Faults& faults_;
  std::vector<Diagnostic>* warnings_;
  Posts posts_;
  std::size_t columns_passed_over_ = 0;
};

/// Numbers of the posts by x, then y, then line.
std::vector<std::size_t> sorted_by_place(const std::vector<Vec3>& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vec3 &p = points[a], &q = points[b];
    if (p[0] != q[0]) return p[0] < q[0];
    return p[1] != q[1] ? p[1] < q[1] : a < b;
  });
  return order;
}

/// Sorted by x, then y; one post a place. Line numbers likewise.
Posts distinct_posts(const Posts& posts, Faults& faults) {
  Posts distinct;
  for (const auto i : sorted_by_place(posts.points)) {
    const Vec3& post = posts.points[i];
    if (distinct.points.empty() || distinct.points.back()[0] != post[0] ||
        distinct.points.back()[1] != post[1]) {
      distinct.points.push_back(post);
      distinct.line.push_back(posts.line[i]);
    } else if (distinct.points.back()[2] != post[2]) {
      faults.add(
          posts.line[i], 0,
          fmt::format("{} lies over the post of line {}, whose z is {:.10g}: a ground has one "
                      "elevation at a place",
                      point_text(post), distinct.line.back(), distinct.points.back()[2]));
    }
  }
  faults.throw_if_any();
  return distinct;
}

/// Reports posts, sorted by x, that are nearer to each other in plan than what can be told apart.
void check_distances(const Posts& posts, Faults& faults) {
  Vec3 low = posts.points.front(), high = low;
  for (const Vec3& p : posts.points)
    for (std::size_t d = 0; d < 3; ++d)
      low[d] = std::min(low[d], p[d]), high[d] = std::max(high[d], p[d]);
  const Real least = least_post_distance(high - low);
  const auto& points = posts.points;
  const std::size_t n = points.size();
  std::vector<std::size_t> strip;  // posts between two gaps along x, by y
  for (std::size_t begin = 0, end = 1; begin < n; begin = end++) {
    while (end < n && points[end][0] - points[end - 1][0] < least) ++end;
    strip.resize(end - begin);
    std::iota(strip.begin(), strip.end(), begin);
    std::stable_sort(strip.begin(), strip.end(),
                     [&](std::size_t a, std::size_t b) { return points[a][1] < points[b][1]; });
    for (std::size_t i = 0; i < strip.size(); ++i)
      for (std::size_t j = i + 1; j < strip.size(); ++j) {
        const Vec3 apart = points[strip[j]] - points[strip[i]];
        if (apart[1] >= least) break;
        if (std::hypot(apart[0], apart[1]) >= least) continue;
        const int a = posts.line[strip[i]], b = posts.line[strip[j]];
        faults.add(std::max(a, b), 0,
                   fmt::format("{} lies {:.2g} m beside the post of line {}: on this ground posts "
                               "nearer than {:.2g} m cannot be told apart",
                               point_text(points[strip[a > b ? i : j]]),
                               std::hypot(apart[0], apart[1]), std::min(a, b), least));
      }
  }
  faults.throw_if_any();
}

std::vector<Real> distinct_values(const std::vector<Vec3>& posts, std::size_t axis) {
  std::vector<Real> values;
  for (const auto& post : posts)
    if (values.empty() || values.back() != post[axis]) values.push_back(post[axis]);
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

}  // namespace

TriangleSurface read_xyz(std::string_view text, const Place& place,
                         std::vector<Diagnostic>* warnings) {
  Faults faults(place);
  Posts distinct = distinct_posts(PostReader(place, faults, warnings).read(text), faults);
  if (distinct.points.size() < 3)
    faults.fail(fmt::format("a ground needs three posts at least, has {}", distinct.points.size()));
  check_distances(distinct, faults);
  std::vector<Vec3> posts = std::move(distinct.points);
  PostGrid grid{distinct_values(posts, 0), distinct_values(posts, 1), {}};
  const std::size_t columns = grid.x.size(), rows = grid.y.size();
  // Distinct posts at known x and y are all of the grid's if they are as many.
  if (columns < 2 || rows < 2 || posts.size() / columns != rows || posts.size() % columns != 0)
    return ground_of_posts(std::move(posts), faults);
  grid.z.resize(posts.size());
  for (std::size_t i = 0; i < posts.size(); ++i)
    grid.z[i % rows * columns + i / rows] = posts[i][2];
  return ground_of_grid(grid, faults);
}

}  // namespace rockfold
