// Stereolithography: triangles one by one, as text or binary. Their normals are passed over: the
// order of the corners says which side is outside.
#include <limits>

#include <fmt/format.h>

#include "host/files/meshes/bytes.hpp"
#include "host/files/meshes/polygon_soup.hpp"
#include "host/files/text.hpp"

namespace rockfold {

namespace {

constexpr std::size_t header_size = 84;  // 80 bytes of anything, 4 of the count
constexpr std::size_t facet_size = 50;   // normal and corners, 12 floats; 2 bytes of anything

/// The words of a text whatever its lines.
class StlWords {
 public:
  explicit StlWords(std::string_view text) : lines_(text), words_("") {}

  /// "" at the end of the file.
  std::string_view next() {
    auto word = words_.next();
    while (word.empty() && lines_.next()) {
      words_ = Words(lines_.line());
      word = words_.next();
    }
    return word;
  }
  void skip_line() { words_ = Words(""); }
  int line() const { return lines_.number(); }
  int column() const { return words_.column(); }

 private:
  Lines lines_;
  Words words_;
};

/// The next word must be `keyword`.
void expect(StlWords& words, std::string_view keyword, Faults& faults) {
  const auto word = words.next();
  if (lower_case(word) == keyword) return;
  if (word.empty())
    faults.fail(words.line(), 0, fmt::format("ends where '{}' must follow", keyword));
  faults.fail(words.line(), words.column(),
              fmt::format("'{}' must follow, not {}", keyword, quoted(word)));
}

/// What follows the word "facet".
void read_facet(StlWords& words, PolygonSoup& soup, Faults& faults) {
  const int line = words.line();
  expect(words, "normal", faults);
  for (int i = 0; i < 3; ++i) words.next();
  expect(words, "outer", faults);
  expect(words, "loop", faults);
  for (int i = 0; i < 3; ++i) {
    expect(words, "vertex", faults);
    Vec3 point{};
    for (std::size_t d = 0; d < 3; ++d) {
      const auto word = words.next();
      point[d] = parse_coordinate(word, std::string_view("xyz").substr(d, 1), words.line(),
                                  words.column(), faults);
    }
    soup.corner.push_back(static_cast<Index>(soup.vertices.size()));
    soup.vertices.push_back(point);
  }
  expect(words, "endloop", faults);
  expect(words, "endfacet", faults);
  end_polygon(soup, line, faults);
}

PolygonSoup read_text(std::string_view text, Faults& faults) {
  PolygonSoup soup;
  StlWords words(text);
  for (auto word = words.next(); !word.empty(); word = words.next()) {
    if (lower_case(word) != "solid")
      faults.fail(words.line(), words.column(), "'solid' must follow, not " + quoted(word));
    words.skip_line();  // the solid's name
    for (word = words.next(); lower_case(word) == "facet"; word = words.next()) {
      check_size(soup, faults);
      read_facet(words, soup, faults);
    }
    if (lower_case(word) != "endsolid")
      faults.fail(words.line(), word.empty() ? 0 : words.column(),
                  word.empty()
                      ? "ends where 'facet' or 'endsolid' must follow"
                      : fmt::format("'facet' or 'endsolid' must follow, not {}", quoted(word)));
    words.skip_line();
  }
  return soup;
}

PolygonSoup read_binary(std::string_view bytes, std::size_t count, Faults& faults) {
  PolygonSoup soup;
  soup.single_precision = true;
  soup.vertices.reserve(3 * count);
  for (std::size_t t = 0; t < count; ++t) {
    const auto facet = bytes.substr(header_size + t * facet_size, facet_size);
    for (std::size_t i = 0; i < 3; ++i) {
      Vec3 point{};
      for (std::size_t d = 0; d < 3; ++d) {
        const auto name = std::string_view("xyz").substr(d, 1);
        point[d] = number_at<float>(facet.substr(12 + 12 * i + 4 * d)) + 0.0;
        const auto fault = coordinate_fault(name, point[d]);
        if (!fault.empty())
          faults.add(0, 0, fmt::format("corner {} of triangle {}: {}", i + 1, t + 1, fault));
      }
      soup.corner.push_back(static_cast<Index>(soup.vertices.size()));
      soup.vertices.push_back(point);
    }
    end_polygon(soup, 0, faults);
  }
  return soup;
}

}  // namespace

PolygonSoup read_stl(std::string_view bytes, Faults& faults) {
  const bool has_header = bytes.size() >= header_size;
  const std::size_t count = has_header ? number_at<std::uint32_t>(bytes.substr(80)) : 0;
  const bool is_binary = has_header && bytes.size() == header_size + facet_size * count;
  // Binary files may begin with "solid" too, but no text has zeros.
  const bool has_zeros = bytes.find('\0') != std::string_view::npos;
  PolygonSoup soup;
  if (is_binary && count <= std::numeric_limits<Index>::max() / 3) {
    soup = read_binary(bytes, count, faults);
  } else if (!has_zeros) {
    soup = read_text(bytes, faults);
  } else if (has_header) {
    faults.fail(fmt::format("has {} bytes: a binary STL file of {} must have {}", bytes.size(),
                            counted(count, "triangle"), header_size + facet_size * count));
  } else {
    faults.fail("is too short for a binary STL file and is no text either");
  }
  check_size(soup, faults);
  faults.throw_if_any();
  return soup;
}

}  // namespace rockfold
