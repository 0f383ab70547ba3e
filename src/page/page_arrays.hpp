// The numbers of a page: each array is shuffled, deflated and written as base64 into an element of its own.
#pragma once

#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace rockfold {

/// One array as the page's script finds it. Bytes of equal significance stand together ("shuffled"): all first bytes
/// of the little-endian numbers, then all second ones, ….
struct PageArray {
  std::string name;   ///< "point_xyz"
  std::string type;   ///< "uint8", "uint16", "int16", "uint32", "float32", "float64"
  std::size_t count;  ///< numbers in all
  bool differences;   ///< each number less the one before it, modulo the type's range
  std::vector<std::uint8_t> shuffled;
};

class PageArrays {
 public:
  template <typename T>
  void add(const std::string& name, const std::vector<T>& values) {
    add(name, type_name<T>(), values.data(), values.size(), sizeof(T), false);
  }
  /// For whole numbers that change little from one to the next: their differences are smaller when deflated.
  template <typename T>
  void add_smooth(const std::string& name, const std::vector<T>& values) {
    std::vector<T> differences(values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      differences[i] = static_cast<T>(values[i] - (i > 0 ? values[i - 1] : 0));
    add(name, type_name<T>(), differences.data(), differences.size(), sizeof(T), true);
  }
  const std::vector<PageArray>& list() const { return list_; }
  std::size_t bytes() const;  ///< before they are compressed

 private:
  template <typename T>
  static const char* type_name() {
    if constexpr (std::is_same_v<T, std::uint8_t>) return "uint8";
    if constexpr (std::is_same_v<T, std::uint16_t>) return "uint16";
    if constexpr (std::is_same_v<T, std::int16_t>) return "int16";
    if constexpr (std::is_same_v<T, std::uint32_t>) return "uint32";
    if constexpr (std::is_same_v<T, float>) return "float32";
    if constexpr (std::is_same_v<T, double>) return "float64";
  }
  void add(const std::string& name, const char* type, const void* data, std::size_t count,
           std::size_t size, bool differences);

  std::vector<PageArray> list_;
};

}  // namespace rockfold
