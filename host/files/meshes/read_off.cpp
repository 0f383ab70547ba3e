// Object File Format (Geomview): OFF with or without colours, normals and textures, as text.
#include <fmt/format.h>

#include "host/files/meshes/polygon_soup.hpp"
#include "host/files/text.hpp"

namespace rockfold {

namespace {

/// The next line that is not empty after '#' and what follows are cut off.
class OffLines {
 public:
  explicit OffLines(std::string_view text) : lines_(text) {}

  bool next() {
    while (lines_.next()) {
      line_ = trimmed(lines_.line().substr(0, lines_.line().find('#')));
      if (!line_.empty()) return true;
    }
    return false;
  }
  /// As it stands in the file, so that columns are right.
  std::string_view line() const { return lines_.line().substr(0, lines_.line().find('#')); }
  int number() const { return lines_.number(); }

 private:
  Lines lines_;
  std::string_view line_;
};

struct Counts {
  std::int64_t vertices = 0, faces = 0;
};

/// "OFF" or "STCNOFF" …; then the counts of vertices, faces and edges on this line or the next.
Counts read_header(OffLines& lines, Faults& faults) {
  if (!lines.next()) faults.fail("holds no OFF header");
  Words words(lines.line());
  const auto magic = words.next();
  std::string_view options = magic;
  if (!options.ends_with("OFF"))
    faults.fail(lines.number(), words.column(),
                fmt::format("an OFF file must begin with OFF, begins with {}", quoted(magic)));
  options.remove_suffix(3);
  for (const std::string_view option : {"ST", "C", "N"})
    if (options.substr(0, option.size()) == option) options.remove_prefix(option.size());
  if (!options.empty())
    faults.fail(
        lines.number(), words.column(),
        fmt::format("OFF files of other than three dimensions are not read: {}", quoted(magic)));
  auto word = words.next();
  if (word.empty()) {
    if (!lines.next())
      faults.fail(lines.number(), 0, "ends before the counts of vertices and faces");
    words = Words(lines.line());
    word = words.next();
  }
  if (lower_case(word) == "binary")
    faults.fail(lines.number(), words.column(), "binary OFF is not read: write it as text");
  Counts counts;
  for (auto* count : {&counts.vertices, &counts.faces}) {
    const auto value = parse_integer(word);
    if (!value || *value < 0)
      faults.fail(lines.number(), words.column(),
                  "counts of vertices and faces must be integers >= 0, not " + quoted(word));
    *count = *value;
    word = words.next();
  }
  return counts;
}

void read_face(std::string_view line, int number, const Counts& counts, PolygonSoup& soup,
               Faults& faults) {
  Words words(line);
  const auto size = parse_integer(words.next());
  if (!size || *size < 0) {
    faults.add(number, words.column(), "a face must begin with its number of corners");
    return;
  }
  const auto first = soup.corner.size();
  for (std::int64_t i = 0; i < *size; ++i) {
    const auto word = words.next();
    const auto vertex = parse_integer(word);
    if (!vertex || *vertex < 0 || *vertex >= counts.vertices) {
      faults.add(number, words.column(),
                 word.empty()
                     ? fmt::format("a face of {} corners names only {}", *size, i)
                     : fmt::format("a corner must be the number of a vertex, 0 to {}, is {}",
                                   counts.vertices - 1, quoted(word)));
      soup.corner.resize(first);
      return;
    }
    soup.corner.push_back(static_cast<Index>(*vertex));
  }
  end_polygon(soup, number, faults);  // what follows is the face's colour
}

}  // namespace

PolygonSoup read_off(std::string_view text, Faults& faults) {
  OffLines lines(text);
  const Counts counts = read_header(lines, faults);
  PolygonSoup soup;
  for (std::int64_t v = 0; v < counts.vertices; ++v) {
    if (!lines.next())
      faults.fail(lines.number(), 0,
                  fmt::format("ends after {} of {} vertices", v, counts.vertices));
    Words words(lines.line());
    soup.vertices.push_back(parse_point(words, lines.number(), faults));
  }
  check_size(soup, faults);
  for (std::int64_t f = 0; f < counts.faces; ++f) {
    if (!lines.next())
      faults.fail(lines.number(), 0, fmt::format("ends after {} of {} faces", f, counts.faces));
    read_face(lines.line(), lines.number(), counts, soup, faults);
  }
  if (lines.next())
    faults.add(lines.number(), 1,
               fmt::format("goes on after the {} vertices and {} faces of its header",
                           counts.vertices, counts.faces));
  check_size(soup, faults);
  faults.throw_if_any();
  return soup;
}

}  // namespace rockfold
