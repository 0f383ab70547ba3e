// Wavefront OBJ: v and f, and what objects and groups are called; materials, normals and textures are passed over.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "host/files/meshes/polygon_soup.hpp"
#include "host/files/text.hpp"

namespace rockfold {

namespace {

constexpr std::array passed_over = {"vt", "vn", "vp", "s", "usemtl", "mtllib", "l", "p"};

struct Reference {
  std::int64_t vertex = 0;  ///< from 1; made absolute
  int line = 0, column = 0;
};

/// The corners of one line "f 1/2/3 4//5 -1 …".
void read_face(Words& words, int line, PolygonSoup& soup, std::vector<Reference>& last_used,
               Faults& faults) {
  const auto vertices = static_cast<std::int64_t>(soup.vertices.size());
  const auto first = soup.corner.size();
  for (auto word = words.next(); !word.empty(); word = words.next()) {
    auto vertex = parse_integer(word.substr(0, word.find('/')));
    if (vertex && *vertex < 0) vertex = *vertex + vertices + 1;
    if (!vertex || *vertex < 1 || *vertex > std::numeric_limits<Index>::max()) {
      faults.add(line, words.column(),
                 fmt::format("a corner must be the number of a vertex (from 1; negative: counted "
                             "back), is {}",
                             quoted(word)));
      soup.corner.resize(first);
      return;
    }
    // Faces may stand before their vertices: the largest number is checked at the end.
    if (*vertex > vertices && (last_used.empty() || last_used.back().vertex < *vertex))
      last_used.push_back({*vertex, line, words.column()});
    soup.corner.push_back(static_cast<Index>(*vertex - 1));
  }
  end_polygon(soup, line, faults);
}

/// What follows "o" or "g", up to the line's end.
void read_label(bool object, std::string_view name, PolygonSoup& soup) {
  auto label = soup.labels.empty() ? PolygonSoup::Label{} : soup.labels.back();
  label.first = soup.polygon_count();
  (object ? label.object_name : label.group_name) = name;
  if (object) {
    ++label.object;
    label.group_name.clear();
  }
  soup.labels.push_back(std::move(label));
}

void read_vertex(Words& words, int line, PolygonSoup& soup, Faults& faults) {
  soup.vertices.push_back(parse_point(words, line, faults));
  for (auto word = words.next(); !word.empty(); word = words.next())  // a weight or a colour
    if (!parse_number(word))
      faults.add(line, words.column(), "a vertex must have numbers only, has " + quoted(word));
}

}  // namespace

PolygonSoup read_obj(std::string_view text, Faults& faults) {
  PolygonSoup soup;
  std::vector<Reference> last_used;
  for (Lines lines(text, '\\'); lines.next();) {
    Words words(lines.line(), "\\\r\n");
    const auto keyword = words.next();
    if (keyword == "v")
      read_vertex(words, lines.number(), soup, faults);
    else if (keyword == "f")
      read_face(words, lines.number(), soup, last_used, faults);
    else if (keyword == "o" || keyword == "g")
      read_label(keyword == "o", words.rest(), soup);
    else if (!keyword.empty() && keyword.front() != '#' &&
             std::find(passed_over.begin(), passed_over.end(), keyword) == passed_over.end())
      faults.add(lines.number(), words.column(),
                 fmt::format("unknown OBJ keyword {} (v and f are read)", quoted(keyword)));
  }
  check_size(soup, faults);
  for (const auto& reference : last_used)
    if (reference.vertex > static_cast<std::int64_t>(soup.vertices.size()))
      faults.add(reference.line, reference.column,
                 fmt::format("vertex {} of a face does not exist: the file has {}",
                             reference.vertex, soup.vertices.size()));
  faults.throw_if_any();
  return soup;
}

}  // namespace rockfold
