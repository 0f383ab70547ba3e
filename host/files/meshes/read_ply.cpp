// Polygon File Format (Stanford): the elements vertex (x, y, z) and face (vertex_indices), as text or
// binary; other elements and properties are passed over.
#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "host/files/meshes/bytes.hpp"
#include "host/files/meshes/ply_header.hpp"
#include "host/files/meshes/polygon_soup.hpp"
#include "host/files/text.hpp"

namespace rockfold {

namespace {

/// The numbers of the body one after another. Doubles hold every PLY type exactly.
class PlyBody {
 public:
  PlyBody(const PlyHeader& header, Faults& faults)
      : encoding_(header.encoding),
        bytes_(header.body),
        lines_(header.body),
        header_lines_(header.lines),
        faults_(faults) {}

  /// Each item of an element is a line of a text file.
  void begin_item(const PlyElement& element, std::int64_t item) {
    element_ = &element;
    item_ = item;
    if (encoding_ != PlyEncoding::text) return;
    do {
      if (!lines_.next()) fail_truncated();
      words_ = Words(lines_.line());
    } while (trimmed(lines_.line()).empty());
  }
  void end_item() {
    if (encoding_ != PlyEncoding::text) return;
    const auto word = words_.next();
    if (!word.empty())
      faults_.add(line(), column(), "goes on where the line must end, with " + quoted(word));
  }

  Real next(PlyType type) {
    if (encoding_ == PlyEncoding::text) {
      const auto word = words_.next();
      const auto value = parse_number(word);
      if (!value || (is_integer(type) && !parse_integer(word)))
        faults_.fail(line(), column(),
                     word.empty()
                         ? "has too few numbers"
                         : fmt::format("must be {}, is {}",
                                       is_integer(type) ? "an integer" : "a number", quoted(word)));
      return *value;
    }
    if (bytes_.size() < size_of(type)) fail_truncated();
    const Real value = decoded(type);
    bytes_.remove_prefix(size_of(type));
    return value;
  }

  void end() {
    bool more = bytes_.find_first_not_of(" \t\r\n") != std::string_view::npos;
    if (encoding_ == PlyEncoding::text) {
      more = false;
      while (lines_.next() && !more) more = !trimmed(lines_.line()).empty();
    }
    if (more) faults_.add(line(), 0, "goes on after the elements of its header");
  }

  bool is_binary() const { return encoding_ != PlyEncoding::text; }
  int line() const { return encoding_ == PlyEncoding::text ? header_lines_ + lines_.number() : 0; }
  int column() const { return encoding_ == PlyEncoding::text ? words_.column() : 0; }

  [[noreturn]] void fail_truncated() {
    faults_.fail(
        line(), 0,
        fmt::format("ends within {} {} of {}", element_->name, item_ + 1, element_->count));
  }

 private:
  Real decoded(PlyType type) const {
    const bool big = encoding_ == PlyEncoding::big_endian;
    switch (type) {
      case PlyType::int8:
        return number_at<std::int8_t>(bytes_, big);
      case PlyType::uint8:
        return number_at<std::uint8_t>(bytes_, big);
      case PlyType::int16:
        return number_at<std::int16_t>(bytes_, big);
      case PlyType::uint16:
        return number_at<std::uint16_t>(bytes_, big);
      case PlyType::int32:
        return number_at<std::int32_t>(bytes_, big);
      case PlyType::uint32:
        return number_at<std::uint32_t>(bytes_, big);
      case PlyType::float32:
        return number_at<float>(bytes_, big);
      case PlyType::float64:
        break;
    }
    return number_at<double>(bytes_, big);
  }

  PlyEncoding encoding_;
  std::string_view bytes_;  ///< what has not been read of a binary body
  Lines lines_;             ///< of a body of text
  Words words_{""};
  int header_lines_;
  const PlyElement* element_ = nullptr;
  std::int64_t item_ = 0;
  Faults& faults_;
};

/// Reads the property and forgets it, but for a list that is `kept`.
void read_property(const PlyProperty& property, PlyBody& body, std::vector<Real>* kept,
                   Faults& faults) {
  if (!property.is_list) {
    body.next(property.type);
    return;
  }
  const Real count = body.next(property.count_type);
  if (count < 0) faults.fail(body.line(), body.column(), "the length of a list must be >= 0");
  for (Real i = 0; i < count; ++i) {  // each number must be there: the file's size bounds the loop
    const Real value = body.next(property.type);
    if (kept) kept->push_back(value);
  }
}

void read_vertices(const PlyElement& element, PlyBody& body, PolygonSoup& soup, Faults& faults) {
  const std::array places = {element.find("x", false), element.find("y", false),
                             element.find("z", false)};
  for (std::size_t d = 0; d < 3; ++d)
    if (places[d] < 0) faults.fail(fmt::format("its vertices have no property {}", "xyz"[d]));
  for (const int place : places)
    soup.single_precision |=
        body.is_binary() &&
        element.properties[static_cast<std::size_t>(place)].type == PlyType::float32;
  for (std::int64_t v = 0; v < element.count; ++v) {
    body.begin_item(element, v);
    Vec3 point{};
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i) {
      const auto& property = element.properties[static_cast<std::size_t>(i)];
      const auto d =
          static_cast<std::size_t>(std::find(places.begin(), places.end(), i) - places.begin());
      if (d == 3) {
        read_property(property, body, nullptr, faults);
        continue;
      }
      point[d] = body.next(property.type) + 0.0;
      const auto fault = coordinate_fault(property.name, point[d]);
      if (!fault.empty())
        faults.add(body.line(), body.column(), fmt::format("vertex {}: {}", v, fault));
    }
    body.end_item();
    soup.vertices.push_back(point);
  }
}

void read_faces(const PlyElement& element, std::int64_t vertices, PlyBody& body, PolygonSoup& soup,
                Faults& faults) {
  int place = element.find("vertex_indices", true);
  if (place < 0) place = element.find("vertex_index", true);
  if (place < 0 || !is_integer(element.properties[static_cast<std::size_t>(place)].type))
    faults.fail("its faces have no list of integers vertex_indices");
  std::vector<Real> corners;
  for (std::int64_t f = 0; f < element.count; ++f) {
    body.begin_item(element, f);
    corners.clear();
    for (int i = 0; i < static_cast<int>(element.properties.size()); ++i)
      read_property(element.properties[static_cast<std::size_t>(i)], body,
                    i == place ? &corners : nullptr, faults);
    body.end_item();
    bool good = true;
    for (const Real corner : corners) {
      if (corner >= 0 && corner < static_cast<Real>(vertices)) continue;
      faults.add(body.line(), 0,
                 fmt::format("face {} names vertex {}: they are numbered 0 to {}", f, corner,
                             vertices - 1));
      good = false;
      break;
    }
    if (!good) continue;
    for (const Real corner : corners) soup.corner.push_back(static_cast<Index>(corner));
    end_polygon(soup, body.line(), faults);
  }
}

}  // namespace

PolygonSoup read_ply(std::string_view bytes, Faults& faults) {
  const PlyHeader header = read_ply_header(bytes, faults);
  PolygonSoup soup;
  std::int64_t vertices = -1;
  bool has_faces = false;
  for (const auto& element : header.elements) {
    if (element.name != "vertex") continue;
    if (vertices >= 0) faults.fail("has two elements 'vertex'");
    vertices = element.count;
  }
  if (vertices < 0) faults.fail("has no element 'vertex'");
  if (vertices >= std::numeric_limits<Index>::max())
    faults.fail(fmt::format("its header claims {} vertices", vertices));
  PlyBody body(header, faults);
  for (const auto& element : header.elements) {
    if (element.name == "vertex") {
      read_vertices(element, body, soup, faults);
    } else if (element.name == "face" && !has_faces) {
      has_faces = true;
      read_faces(element, vertices, body, soup, faults);
    } else {
      for (std::int64_t i = 0; i < element.count; ++i) {
        body.begin_item(element, i);
        for (const auto& property : element.properties)
          read_property(property, body, nullptr, faults);
        body.end_item();
      }
    }
  }
  if (!has_faces) faults.fail("has no element 'face'");
  body.end();
  check_size(soup, faults);
  faults.throw_if_any();
  return soup;
}

}  // namespace rockfold
