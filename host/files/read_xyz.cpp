#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "host/files/read_terrain.hpp"
#include "host/files/terrain_surface.hpp"
#include "host/files/text.hpp"

namespace rockfold {

namespace {

struct Posts {
  std::vector<Vec3> points;  ///< m
  std::vector<int> line;
};

Posts read_posts(std::string_view text, Faults& faults) {
  constexpr std::string_view separators = ",;";
  Posts posts;
  bool may_be_heading = true;
  for (Lines lines(text); lines.next();) {
    Words words(lines.line(), separators);
    Words first = words;
    const auto word = first.next();
    if (word.empty() || word.front() == '#') continue;
    const bool is_heading = may_be_heading && !parse_number(word);
    may_be_heading = false;
    if (is_heading) continue;
    const Vec3 point = parse_point(words, lines.number(), faults);
    const auto more = words.next();
    if (!more.empty() && more.front() != '#')
      faults.add(lines.number(), words.column(),
                 "a line must hold three numbers x, y, z (decimals behind a point), goes on with " +
                     quoted(more));
    posts.points.push_back(point);
    posts.line.push_back(lines.number());
  }
  faults.throw_if_any();
  return posts;
}

/// Sorted by x, then y; one post a place.
std::vector<Vec3> distinct_posts(const Posts& posts, Faults& faults) {
  std::vector<std::size_t> order(posts.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vec3 &p = posts.points[a], &q = posts.points[b];
    if (p[0] != q[0]) return p[0] < q[0];
    return p[1] != q[1] ? p[1] < q[1] : a < b;
  });
  std::vector<Vec3> distinct;
  int first_line = 0;
  for (const auto i : order) {
    const Vec3& post = posts.points[i];
    if (distinct.empty() || distinct.back()[0] != post[0] || distinct.back()[1] != post[1]) {
      distinct.push_back(post);
      first_line = posts.line[i];
    } else if (distinct.back()[2] != post[2]) {
      faults.add(
          posts.line[i], 0,
          fmt::format("{} lies over the post of line {}, whose z is {:.10g}: a ground has one "
                      "elevation at a place",
                      point_text(post), first_line, distinct.back()[2]));
    }
  }
  faults.throw_if_any();
  return distinct;
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

TriangleSurface read_xyz(std::string_view text, const Place& place) {
  Faults faults(place);
  std::vector<Vec3> posts = distinct_posts(read_posts(text, faults), faults);
  if (posts.size() < 3)
    faults.fail(fmt::format("a ground needs three posts at least, has {}", posts.size()));
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
