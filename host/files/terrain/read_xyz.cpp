#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "host/files/columns.hpp"
#include "host/files/terrain/post_columns.hpp"
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

/// Whether commas, semicolons and blanks part numbers alone, and no names.
bool holds_numbers_alone(std::string_view line) {
  Words words(line, separators);
  auto word = words.next();
  while (!word.empty() && word.front() != '#' && parse_number(word)) word = words.next();
  return word.empty() || word.front() == '#';
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
  const bool commas_alone =
      count == 1 && line.find('.') == std::string_view::npos && holds_numbers_alone(line);
  return commas_alone ? fmt::format(
                            "{}: these commas may separate numbers or decimals, use blanks "
                            "or semicolons between numbers",
                            expected)
                      : "";
}

/// The line up to a comment.
std::string_view without_comment(std::string_view line) {
  return line.substr(0, line.find('#'));
}

bool is_comment(std::string_view line) {
  return line.front() == '#' || line.starts_with("//");
}

/// What parts numbers whose thousands are parted by commas or apostrophes, if the line holds such numbers; else none.
std::optional<char> separator_of_grouped(std::string_view line) {
  for (const char separator : {';', '\t', ' '}) {
    if (line.find(separator) == std::string_view::npos) continue;
    Words words(line, ";");
    std::size_t numbers = 0, grouped = 0;
    for (auto word = words.next(); !word.empty(); word = words.next()) {
      const bool is_grouped = grouped_number(word).has_value();
      grouped += is_grouped;
      if (!is_grouped && !parse_number(word) && numbers < 3) return {};
      ++numbers;
    }
    return grouped > 0 ? std::optional(separator) : std::nullopt;
  }
  return {};
}

/// Reads x, y and z of each line. Other columns, as many as in the first line, are passed over with a warning.
class PostReader {
 public:
  PostReader(const Place& place, const std::vector<std::string>& columns, Faults& faults,
             std::vector<Diagnostic>* warnings)
      : place_(place), faults_(faults), warnings_(warnings) {
    std::string missing;
    if (columns.empty()) return;
    columns_ = columns_of_model(columns, missing);
    told_by_model_ = true;
    if (!columns_) faults_.fail(columns_fault(columns));
  }

  Posts read(std::string_view text) {
    text_ = text;
    for (Lines lines(text); lines.next();) {
      const auto line = trimmed(lines.line());
      if (line.empty()) continue;
      if (is_comment(line))
        read_comment(line, lines.number());
      else if (rows_begun_ || !is_before_rows(lines))
        read_row(lines);
    }
    faults_.throw_if_any();
    if (count_ && *count_ != static_cast<std::int64_t>(posts_.points.size()))
      faults_.fail(line_of_count_, 0,
                   fmt::format("says that there are {} posts, but {} follow", *count_,
                               posts_.points.size()));
    ask_of_point_numbers();
    return std::move(posts_);
  }

 private:
  /// CloudCompare and others write the heading behind "//" or '#'.
  void read_comment(std::string_view line, int number) {
    if (rows_begun_ || columns_) return;
    const auto begin = line.find_first_not_of("#/ \t");
    if (begin == std::string_view::npos) return;
    std::string missing;
    const auto heading = line.substr(begin);
    Faults unheard(place_);
    auto fields = split_fields(heading, separator_of(heading), number, unheard);
    for (Field& field : fields) field.column += static_cast<int>(begin);
    columns_ = columns_of_heading(std::move(fields), number, missing);
    is_of_comment_ = columns_.has_value();
    if (columns_) line_of_heading_ = number;
  }

  /// Words behind '#' that happen to name axes are no heading.
  void check_comment(std::size_t fields) {
    if (!is_of_comment_ || columns_->names.size() == fields) return;
    if (!columns_->is_plain())
      faults_.fail(
          line_of_heading_, 1,
          fmt::format("this comment names {}, the rows have {}: say in the model what "
                      "they are, as {}",
                      names_of(*columns_), counted(fields, "column"), suggested_columns(fields)));
    columns_.reset();
    is_of_comment_ = false;
  }

  /// Whether the line is a heading, its units or a count of the rows. Rows begin with the first line that is none of them.
  bool is_before_rows(const Lines& lines) {
    const auto line = trimmed(without_comment(lines.line()));
    Faults unheard(place_);  // they are told where the row is read
    const auto fields = split_fields(line, separator_of(line), lines.number(), unheard);
    if (fields.size() == 1 && parse_integer(fields[0].text) && !count_) {
      count_ = parse_integer(fields[0].text);
      line_of_count_ = lines.number();
      return true;
    }
    if (is_heading(line, fields)) {
      read_heading(fields, lines.number());
      return true;
    }
    if (columns_ && are_units(fields)) {
      take_units(*columns_, fields, lines.number());
      return true;
    }
    begin_rows(line, fields.size());
    return false;
  }

  /// The first line but comments, if it does not begin with a number.
  bool is_heading(std::string_view line, const std::vector<Field>& fields) {
    if (heading_passed_ || fields.empty()) return false;
    heading_passed_ = true;
    if (columns_ && holds_post(fields)) return false;
    return !parse_number(Words(line, separators).next()) && !parse_number(fields[0].text) &&
           !grouped_number(fields[0].text);
  }

  /// Whether numbers stand where the columns say.
  bool holds_post(const std::vector<Field>& fields) const {
    return std::all_of(columns_->at.begin(), columns_->at.end(), [&](std::size_t at) {
      return at < fields.size() &&
             (parse_number(fields[at].text) || grouped_number(fields[at].text));
    });
  }

  void read_heading(const std::vector<Field>& fields, int number) {
    if (told_by_model_) return;
    const auto numbers = static_cast<std::size_t>(std::count_if(
        fields.begin(), fields.end(),
        [](const Field& field) { return parse_number(field.text) || grouped_number(field.text); }));
    if (numbers > 2)
      faults_.fail(number, 1,
                   fmt::format("begins with {}, a name: nothing says what the columns are. Put a "
                               "heading above them, or say it in the model, as {}",
                               quoted(fields[0].text), suggested_columns(fields.size())));
    std::string missing;
    const auto named = columns_of_heading(fields, number, missing);
    if (!named && columns_) return;  // a comment has said it
    columns_ = named;
    is_of_comment_ = false;
    line_of_heading_ = number;
    if (columns_) return;
    if (!missing.starts_with("names")) faults_.fail(number, 1, std::move(missing));
    std::string found;
    for (std::size_t i = 0; i < std::min<std::size_t>(fields.size(), 8); ++i)
      found += (i == 0 ? "" : ", ") + quoted(fields[i].text);
    faults_.fail(number, 1,
                 fmt::format("the heading {} (it is {}). Name them x, y, z or easting, northing, "
                             "elevation, or say in the model what the columns are, as {} (a title "
                             "stands behind '#')",
                             missing, found, suggested_columns(fields.size())));
  }

  /// Decides by the first row how rows are read.
  void begin_rows(std::string_view line, std::size_t fields) {
    rows_begun_ = true;
    check_comment(fields);
    if (columns_) settle_units(*columns_, faults_);
    faults_.throw_if_any();
    if (count_ && !columns_)  // a number alone, and no heading that tells of a count
      faults_.fail(line_of_count_, 1,
                   "holds one number: there must be three numbers, x, y and z, in a line");
    const auto grouped = separator_of_grouped(line);
    separator_ = grouped.value_or(separator_of(line));
    by_fields_ =
        grouped || line.find('"') != std::string_view::npos || (columns_ && !columns_->is_plain());
    if (!columns_ || told_by_model_ || !warnings_) return;
    if (by_fields_) tell_of_others();
    tell_of_units();
  }

  void warn(std::string message) {
    Place place = place_;
    place.line = line_of_heading_;
    warnings_->push_back({std::move(place), std::move(message)});
  }

  void tell_of_others() {
    const auto others = columns_->others();
    if (!others.empty())
      warn(fmt::format(
          "{} passed over: {}",
          others.size() == 1 ? "a column is" : counted(others.size(), "column") + " are",
          fmt::join(others, ", ")));
  }

  void tell_of_units() {
    for (std::size_t d = 0; d < 3; ++d)
      if (columns_->factor[d] != 1)
        warn(fmt::format("{} is converted to metres, times {:g}",
                         columns_->names[columns_->at[d]].text, columns_->factor[d]));
  }

  void read_row(const Lines& lines) {
    const auto line = without_comment(lines.line());
    const bool has_empty = columns_ && (line.find(",,") != std::string_view::npos ||
                                        line.find(";;") != std::string_view::npos);
    if (by_fields_ || has_empty)
      read_fields(line, lines.number());
    else
      read_words(lines, Words(lines.line(), separators));
  }

  /// Three numbers, parted by whatever parts numbers.
  void read_words(const Lines& lines, Words words) {
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
    add(point, lines.number(), columns_passed_over_ > 0 ? point[0] : 0);
  }

  /// Fields where the columns say, which may be quoted, empty or have thousands parted.
  void read_fields(std::string_view line, int number) {
    const PostColumns plain;
    const PostColumns& columns = columns_ ? *columns_ : plain;
    auto fields = split_fields(line, separator_, number, faults_);
    if (columns_ && separator_ == '\t' && fields.size() != columns.names.size())
      fields = split_fields(line, ' ', number, faults_);
    if (fields.empty()) return;
    if (fields.size() <= columns.last())
      return faults_.add(
          number, 0,
          fmt::format("has {}, must have {}: {}", counted(fields.size(), "field"),
                      std::max<std::size_t>(columns.names.size(), 3), names_of(columns)));
    if (columns.has_gap() && fields.size() > columns.names.size())
      return faults_.add(
          number, 0,
          fmt::format("has {}, must have {}: {} (quote a field that holds what parts fields)",
                      counted(fields.size(), "field"), columns.names.size(), names_of(columns)));
    Vec3 point{};
    for (std::size_t d = 0; d < 3; ++d)
      point[d] = coordinate_in(fields[columns.at[d]], d, columns.factor[d], number);
    if (!columns_ && posts_.points.empty() && fields.size() > 3 && warnings_) {
      line_of_heading_ = number;
      warn(fmt::format("{} behind x, y and z {} passed over", counted(fields.size() - 3, "column"),
                       fields.size() == 4 ? "is" : "are"));
    }
    add(point, number, columns_ || fields.size() < 4 ? 0 : point[0]);
  }

  static std::string names_of(const PostColumns& columns) {
    std::string text;
    for (const Field& field : columns.names) text += (text.empty() ? "" : ", ") + field.text;
    return text.empty() ? "x, y, z" : text;
  }

  Real coordinate_in(const Field& field, std::size_t axis, Real factor, int number) {
    const auto name = std::string_view("xyz").substr(axis, 1);
    auto value = parse_number(field.text);
    if (!value) value = grouped_number(field.text, !has_sure_groups(field.text));
    if (!value) {
      faults_.add(number, field.column,
                  fmt::format("{} must be a number, is {}{}", name, quoted(field.text),
                              decimal_comma_hint(field.text)));
      return 0;
    }
    const auto fault = coordinate_fault(name, *value * factor);
    if (fault.empty()) return *value * factor + 0.0;
    faults_.add(number, field.column, fault);
    return 0;
  }

  /// Whether a number elsewhere in the file tells that commas part thousands, where `text` could be either.
  bool has_sure_groups(std::string_view text) {
    if (!grouped_number(text, false)) return false;
    if (!sure_groups_) {
      sure_groups_ = false;
      Faults unheard(place_);
      for (Lines lines(text_); lines.next() && !*sure_groups_;)
        for (const Field& field :
             split_fields(without_comment(lines.line()), separator_, 0, unheard))
          sure_groups_ = *sure_groups_ || grouped_number(field.text).has_value();
    }
    return *sure_groups_;
  }

  void add(const Vec3& point, int number, Real first) {
    posts_.points.push_back(point);
    posts_.line.push_back(number);
    const bool counts =
        first == std::floor(first) && (posts_.points.size() == 1 || first > last_first_);
    runs_up_ = runs_up_ && counts;
    last_first_ = first;
  }

  /// Of four columns and more without a heading: whole numbers that rise from line to line number the points.
  void ask_of_point_numbers() {
    if (columns_ || !runs_up_ || posts_.points.size() < 3) return;
    Faults unheard(place_);
    std::size_t count = 4;
    for (Lines lines(text_); lines.next();)
      if (lines.number() == posts_.line.front()) {
        const auto line = without_comment(lines.line());
        count = split_fields(line, separator_, 0, unheard).size();
      }
    faults_.fail(posts_.line.front(), 1,
                 fmt::format("the first column runs {:.10g}, {:.10g}, {:.10g} …, as numbers of "
                             "points do, and no heading says what the columns are. Put one above "
                             "them, or say it in the model, as {}, or [\"x\", \"y\", \"z\", …]",
                             posts_.points[0][0], posts_.points[1][0], posts_.points[2][0],
                             suggested_columns(count)));
  }

  /// The first line says how many columns there are.
  void look_at_columns(const Lines& lines, Words words, std::size_t more) {
    if (more == 0 || !comma_fault(lines.line()).empty()) return;
    columns_passed_over_ = more;
    if (!warnings_ || told_by_model_) return;
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
  std::string_view text_;
  Posts posts_;
  std::optional<PostColumns> columns_;  ///< none: x, y and z stand first
  bool told_by_model_ = false, is_of_comment_ = false;
  bool heading_passed_ = false, rows_begun_ = false;
  int line_of_heading_ = 0;
  std::optional<std::int64_t> count_;  ///< of the rows, as CloudCompare writes it
  int line_of_count_ = 0;
  bool by_fields_ = false;
  char separator_ = ' ';
  std::size_t columns_passed_over_ = 0;  ///< behind x, y and z
  std::optional<bool> sure_groups_;
  bool runs_up_ = true;  ///< the first column, in whole numbers
  Real last_first_ = 0;
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

std::string columns_fault(const std::vector<std::string>& columns) {
  std::string missing;
  if (columns.empty() || columns_of_model(columns, missing)) return "";
  return fmt::format("{}; must name x, y and z once each, as {}", missing, suggested_columns(5));
}

TriangleSurface read_xyz(std::string_view text, const Place& place,
                         std::vector<Diagnostic>* warnings, const std::vector<std::string>& names) {
  Faults faults(place);
  Posts distinct = distinct_posts(PostReader(place, names, faults, warnings).read(text), faults);
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
