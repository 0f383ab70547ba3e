// Numbers of binary files.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>

namespace rockfold {

/// The number in the first bytes, which must be there; little-endian unless `big_endian`.
template <typename Number>
Number number_at(std::string_view bytes, bool big_endian = false) {
  // Of a machine that is big-endian itself neither CGAL's packages nor ours have been tried.
  std::array<char, sizeof(Number)> buffer{};
  std::copy_n(bytes.data(), sizeof(Number), buffer.data());
  if (big_endian) std::reverse(buffer.begin(), buffer.end());
  Number value;
  std::memcpy(&value, buffer.data(), sizeof(Number));
  return value;
}

}  // namespace rockfold
