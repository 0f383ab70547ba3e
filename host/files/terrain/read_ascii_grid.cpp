#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "host/files/terrain/read_terrain.hpp"
#include "host/files/terrain/terrain_surface.hpp"
#include "host/files/text.hpp"
#include "src/base/vector.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

namespace {

struct Header {
  std::int64_t columns = 0, rows = 0;
  std::optional<Real> x_corner, x_center, y_corner, y_center;  ///< m
  std::optional<Real> dx, dy;                                  ///< m
  Real no_data = -9999;
  std::map<std::string, int> line_of_key;

  std::int64_t values() const { return columns * rows; }
};

/// As some programs write that there is no value.
bool is_null(std::string_view word) {
  return lower_case(word) == "null";
}

/// In single precision, which one of the two may have been rounded to.
bool is_same(Real a, Real b) {
  constexpr Real largest = std::numeric_limits<float>::max();
  return a == b || (std::isnan(a) && std::isnan(b)) ||
         (std::abs(a) <= largest && std::abs(b) <= largest &&
          static_cast<float>(a) == static_cast<float>(b));
}

class GridReader {
 public:
  GridReader(std::string_view text, Faults& faults)
      : lines_(text), words_(""), size_(text.size()), faults_(faults) {}

  PostGrid read() {
    read_header();
    PostGrid grid;
    read_values(grid.z);
    const auto columns = header_.columns, rows = header_.rows;
    for (std::int64_t low = 0, high = rows - 1; low < high; ++low, --high)  // south first
      std::swap_ranges(grid.z.begin() + low * columns, grid.z.begin() + (low + 1) * columns,
                       grid.z.begin() + high * columns);
    grid.x = places(header_.x_corner, header_.x_center, *header_.dx, columns, "x");
    grid.y = places(header_.y_corner, header_.y_center, *header_.dy, rows, "y");
    faults_.throw_if_any();
    check_steps(grid);
    return grid;
  }

 private:
  void check_steps(const PostGrid& grid) {
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (const Real z : grid.z)
      if (!std::isnan(z)) low = std::min(low, z), high = std::max(high, z);
    const Real least =
        least_post_distance({grid.x.back() - grid.x.front(), grid.y.back() - grid.y.front(),
                             std::max(0.0, high - low)});
    const auto check = [&](const char* key, Real step, std::size_t count) {
      if (count > 1 && step < least)
        faults_.fail(line_of_step(key), 0,
                     fmt::format("the cell size {} m is too small for this ground; posts nearer "
                                 "than {:.2g} m cannot be told apart",
                                 step, least));
    };
    check("dx", *header_.dx, grid.x.size());
    check("dy", *header_.dy, grid.y.size());
  }

  /// The words of all lines one after another; "" at the end.
  std::string_view next() {
    auto word = words_.next();
    while (word.empty() && lines_.next()) {
      words_ = Words(lines_.line());
      word = words_.next();
    }
    return word;
  }

  void add(std::string message) {
    faults_.add(lines_.number(), words_.column(), std::move(message));
  }

  /// Leaves the first value in first_value_.
  void read_header() {
    for (first_value_ = next();
         !first_value_.empty() && !parse_number(first_value_) && !is_null(first_value_);
         first_value_ = next())
      read_entry(first_value_);
    if (!header_.dy) header_.dy = header_.dx;
    if (!header_.dx) header_.dx = header_.dy;
    std::string missing;
    const auto need = [&](bool given, std::string_view key) {
      if (!given) missing += (missing.empty() ? "" : ", ") + std::string(key);
    };
    need(header_.columns > 0, "ncols");
    need(header_.rows > 0, "nrows");
    need(header_.x_corner || header_.x_center, "xllcorner");
    need(header_.y_corner || header_.y_center, "yllcorner");
    need(header_.dx.has_value(), "cellsize");
    if (!missing.empty() && faults_.empty())
      faults_.fail("an ESRI ASCII grid must have in its header: " + missing);
    faults_.throw_if_any();
  }

  void read_entry(std::string_view key_as_written) {
    const std::string key = lower_case(key_as_written);
    constexpr std::array keys = {"ncols",     "nrows",    "xllcorner", "xllcenter", "yllcorner",
                                 "yllcenter", "cellsize", "dx",        "dy",        "nodata_value"};
    if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
      add(fmt::format("{} is no key of an ESRI ASCII grid{}", quoted(key_as_written),
                      suggestion(key, {keys.begin(), keys.end()}, "keys")));
      faults_.throw_if_any();  // what follows cannot be told apart
    }
    check_repeated(key);
    const auto word = next();
    if (word.empty())
      faults_.fail(lines_.number(), 0, fmt::format("ends where the value of {} must follow", key));
    if (key == "ncols" || key == "nrows") {
      const auto count = parse_integer(word);
      if (!count || *count < 1 || *count > std::numeric_limits<Index>::max())
        add(fmt::format("{} must be an integer >= 1, is {}", key, quoted(word)));
      else
        (key == "ncols" ? header_.columns : header_.rows) = *count;
      return;
    }
    const auto value = parse_number(word);
    if (key == "nodata_value") {
      if (value || is_null(word))
        header_.no_data = value.value_or(std::numeric_limits<Real>::quiet_NaN());
      else
        add("NODATA_value must be a number, is " + quoted(word));
      return;
    }
    const Real number = parse_coordinate(word, key, lines_.number(), words_.column(), faults_);
    if (key == "xllcorner") header_.x_corner = number;
    if (key == "xllcenter") header_.x_center = number;
    if (key == "yllcorner") header_.y_corner = number;
    if (key == "yllcenter") header_.y_center = number;
    if (key != "cellsize" && key != "dx" && key != "dy") return;
    if (value && !(number > 0)) add(fmt::format("{} must be > 0 (m), is {}", key, quoted(word)));
    if (key != "dy") header_.dx = number;
    if (key != "dx") header_.dy = number;
  }

  /// Each key once, and no two that say the same.
  void check_repeated(const std::string& key) {
    constexpr std::array<std::pair<const char*, const char*>, 4> same = {
        {{"xllcorner", "xllcenter"},
         {"yllcorner", "yllcenter"},
         {"cellsize", "dx"},
         {"cellsize", "dy"}}};
    auto& given = header_.line_of_key;
    if (const auto before = given.find(key); before != given.end())
      add(fmt::format("{} stands there twice, first in line {}", key, before->second));
    for (const auto& [a, b] : same)
      if (key == a || key == b)
        if (const auto other = given.find(key == a ? b : a); other != given.end())
          add(fmt::format("{} and {} of line {} say the same: one of them must go", key,
                          other->first, other->second));
    given.emplace(key, lines_.number());
  }

  /// Of the key that gives the size of the cells along x or y.
  int line_of_step(const std::string& key) const {
    const auto& given = header_.line_of_key;
    for (const std::string& name :
         {key, std::string("cellsize"), std::string("dx"), std::string("dy")})
      if (const auto found = given.find(name); found != given.end()) return found->second;
    return 0;
  }

  void read_values(std::vector<Real>& values) {
    const std::int64_t expected = header_.values();
    values.reserve(std::min(static_cast<std::size_t>(expected), size_ / 2 + 1));
    std::string_view word = first_value_;
    std::int64_t read = 0;
    for (; !word.empty() && read < expected; ++read, word = next()) values.push_back(value(word));
    if (read < expected)
      faults_.fail(lines_.number(), 0,
                   fmt::format("ends after {} of {} values (ncols = {}, nrows = {})", read,
                               expected, header_.columns, header_.rows));
    if (!word.empty())
      add(fmt::format("goes on after {} values (ncols = {}, nrows = {})", expected, header_.columns,
                      header_.rows));
    faults_.throw_if_any();
  }

  Real value(std::string_view word) {
    constexpr Real nothing = std::numeric_limits<Real>::quiet_NaN();
    const auto number = parse_number(word);
    if (is_null(word) && std::isnan(header_.no_data)) return nothing;
    if (!number) {
      add("an elevation must be a number, is " + quoted(word));
      return nothing;
    }
    if (is_same(*number, header_.no_data)) return nothing;
    const auto fault = coordinate_fault("the elevation", *number);
    if (fault.empty()) return *number + 0.0;
    add(fmt::format("{}; the NODATA_value is {}", fault, header_.no_data));
    return nothing;
  }

  std::vector<Real> places(const std::optional<Real>& corner, const std::optional<Real>& center,
                           Real step, std::int64_t count, std::string_view name) {
    std::vector<Real> result;
    result.reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      const auto steps = static_cast<Real>(i);
      result.push_back(center ? *center + steps * step : *corner + (steps + 0.5) * step);
    }
    const auto fault = coordinate_fault(name, result.back());
    if (!fault.empty()) faults_.add(0, 0, fmt::format("the last post: {}", fault));
    if (std::adjacent_find(result.begin(), result.end(), std::greater_equal<>()) != result.end())
      faults_.add(line_of_step("d" + std::string(name)), 0,
                  fmt::format("the cell size {} is too small to be added to {} = {}", step, name,
                              result.front()));
    return result;
  }

  Lines lines_;
  Words words_;
  std::size_t size_;
  Faults& faults_;
  Header header_;
  std::string_view first_value_;
};

}  // namespace

TriangleSurface read_ascii_grid(std::string_view text, const Place& place) {
  Faults faults(place);
  return ground_of_grid(GridReader(text, faults).read(), faults);
}

TriangleSurface read_terrain(std::string_view text, const Place& place,
                             std::vector<Diagnostic>* warnings,
                             const std::vector<std::string>& columns) {
  Lines lines(text);
  while (lines.next()) {
    const auto word = lower_case(Words(lines.line()).next());
    if (word.empty()) continue;
    // Keys of the grid's header: none of them is the name of a column.
    const bool is_grid = word == "ncols" || word == "nrows" || word.rfind("xll", 0) == 0 ||
                         word.rfind("yll", 0) == 0 || word == "cellsize" || word == "nodata_value";
    if (!is_grid) return read_xyz(text, place, warnings, columns);
    if (!columns.empty())
      Faults(place).fail("is an ESRI ASCII grid: `columns` belongs to tables of posts");
    return read_ascii_grid(text, place);
  }
  Faults(place).fail("holds nothing but blanks");
}

void check_above(const TriangleSurface& ground, Real base, const Place& place) {
  const auto lowest = std::min_element(ground.vertices.begin(), ground.vertices.end(),
                                       [](const Vec3& a, const Vec3& b) { return a[2] < b[2]; });
  if ((*lowest)[2] > base) return;
  const auto count =
      static_cast<std::size_t>(std::count_if(ground.vertices.begin(), ground.vertices.end(),
                                             [&](const Vec3& post) { return !(post[2] > base); }));
  Faults(place).fail(fmt::format(
      "the ground must lie above base = {:.10g} m everywhere: {} not, "
      "the lowest at {}",
      base, counted(count, "post") + (count == 1 ? " does" : " do"), point_text(*lowest)));
}

void check_fine_posts(const TriangleSurface& ground, Real base, const Place& place) {
  Vec3 low = ground.vertices.front(), high = low;
  for (const Vec3& post : ground.vertices)
    for (std::size_t d = 0; d < 3; ++d) {
      low[d] = std::min(low[d], post[d]);
      high[d] = std::max(high[d], post[d]);
    }
  low[2] = base;
  const Real least = least_post_distance(high - low);
  for (const auto& triangle : ground.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3& a = ground.vertices[static_cast<std::size_t>(triangle[i])];
      const Vec3& b = ground.vertices[static_cast<std::size_t>(triangle[(i + 1) % 3])];
      const Real apart = std::hypot(b[0] - a[0], b[1] - a[1]);
      if (apart < least)
        Faults(place).fail(
            fmt::format("the posts {} and {} are {:.2g} m apart in plan; on rock of this size "
                        "posts nearer than "
                        "{:.2g} m cannot be told apart",
                        point_text(a), point_text(b), apart, least));
    }
}

}  // namespace rockfold
