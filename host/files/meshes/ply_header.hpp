// The header of a PLY file.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "host/files/faults.hpp"

namespace rockfold {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
  return type != PlyType::float32 && type != PlyType::float64;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  bool is_list = false;
  PlyType count_type = PlyType::uint8;  ///< of lists
};

struct PlyElement {
  std::string name;
  std::int64_t count = 0;
  std::vector<PlyProperty> properties;  ///< at least one, unless count is 0

  /// Its place in `properties`; −1 = none of this name and kind.
  int find(std::string_view property_name, bool is_list) const;
};

enum class PlyEncoding { text, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  int lines = 0;          ///< of the header
  std::string_view body;  ///< what follows it
};

PlyHeader read_ply_header(std::string_view bytes, Faults& faults);

}  // namespace rockfold
