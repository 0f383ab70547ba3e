#include "host/files/meshes/ply_header.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include <fmt/format.h>

#include "host/files/text.hpp"

namespace rockfold {

namespace {

struct TypeName {
  std::string_view name;
  PlyType type;
};
constexpr std::array type_names = {
    TypeName{"char", PlyType::int8},      TypeName{"int8", PlyType::int8},
    TypeName{"uchar", PlyType::uint8},    TypeName{"uint8", PlyType::uint8},
    TypeName{"short", PlyType::int16},    TypeName{"int16", PlyType::int16},
    TypeName{"ushort", PlyType::uint16},  TypeName{"uint16", PlyType::uint16},
    TypeName{"int", PlyType::int32},      TypeName{"int32", PlyType::int32},
    TypeName{"uint", PlyType::uint32},    TypeName{"uint32", PlyType::uint32},
    TypeName{"float", PlyType::float32},  TypeName{"float32", PlyType::float32},
    TypeName{"double", PlyType::float64}, TypeName{"float64", PlyType::float64},
};

PlyType read_type(Words& words, int line, bool integer, Faults& faults) {
  const auto word = words.next();
  for (const auto& [name, type] : type_names)
    if (name == word && (!integer || is_integer(type))) return type;
  faults.fail(line, words.column(),
              fmt::format("must be {} type, is {}", integer ? "an integer" : "a", quoted(word)));
}

PlyProperty read_property(Words& words, int line, Faults& faults) {
  PlyProperty property;
  Words look_ahead = words;
  property.is_list = look_ahead.next() == "list";
  if (property.is_list) {
    words = look_ahead;
    property.count_type = read_type(words, line, true, faults);
  }
  property.type = read_type(words, line, false, faults);
  property.name = words.next();
  return property;
}

PlyElement read_element(Words& words, int line, Faults& faults) {
  PlyElement element;
  element.name = words.next();
  const auto word = words.next();
  const auto count = parse_integer(word);
  if (!count || *count < 0)
    faults.fail(line, words.column(),
                "the count of an element must be an integer >= 0, is " + quoted(word));
  element.count = *count;
  return element;
}

PlyEncoding read_encoding(Words& words, int line, Faults& faults) {
  const auto word = words.next();
  if (word == "ascii") return PlyEncoding::text;
  if (word == "binary_little_endian") return PlyEncoding::little_endian;
  if (word == "binary_big_endian") return PlyEncoding::big_endian;
  faults.fail(
      line, words.column(),
      "the format must be ascii, binary_little_endian or binary_big_endian, is " + quoted(word));
}

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

int PlyElement::find(std::string_view property_name, bool is_list) const {
  for (std::size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property_name && properties[i].is_list == is_list)
      return static_cast<int>(i);
  return -1;
}

PlyHeader read_ply_header(std::string_view bytes, Faults& faults) {
  PlyHeader header;
  Lines lines(bytes);
  if (!lines.next() || trimmed(lines.line()) != "ply")
    faults.fail(1, 1, "a PLY file must begin with a line 'ply'");
  std::optional<PlyEncoding> encoding;
  while (true) {
    if (!lines.next()) faults.fail(lines.number(), 0, "ends within its header (no 'end_header')");
    Words words(lines.line());
    const auto keyword = words.next();
    if (keyword == "end_header") break;
    if (keyword.empty() || keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "format")
      encoding = read_encoding(words, lines.number(), faults);
    else if (keyword == "element")
      header.elements.push_back(read_element(words, lines.number(), faults));
    else if (keyword == "property" && !header.elements.empty())
      header.elements.back().properties.push_back(read_property(words, lines.number(), faults));
    else
      faults.fail(lines.number(), words.column(),
                  quoted(keyword) + " has no place here in a PLY header");
  }
  if (!encoding) faults.fail("has no line 'format' in its header");
  header.encoding = *encoding;
  for (const auto& element : header.elements)
    if (element.properties.empty() && element.count > 0)
      faults.fail(fmt::format("element {} has no properties", quoted(element.name)));
  header.lines = lines.number();
  header.body = lines.rest();
  return header;
}

}  // namespace rockfold
