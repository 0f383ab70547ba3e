// A text file that is written aside and takes its name when it is whole.
#pragma once

#include <cstdio>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "src/base/types.hpp"
#include "src/io/partial_file.hpp"

namespace rockfold {

/// Buffers what is written. Every function throws Error(io) where the disk is full, the folder is missing, …; without
/// finish() nothing is left behind.
class TextFile {
 public:
  explicit TextFile(std::string path);
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  ~TextFile();

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() > chunk) flush();
  }
  /// Gives the file its final name.
  void finish();

 private:
  static constexpr std::size_t chunk = std::size_t{1} << 20;
  void flush();
  [[noreturn]] void fail(int error) const;

  PartialFile target_;
  fmt::memory_buffer buffer_;
  std::FILE* file_ = nullptr;
};

/// "x y z" with as many digits as read back the same numbers.
inline std::string spaced(const Vec3& x) {
  return fmt::format("{} {} {}", x[0], x[1], x[2]);
}

}  // namespace rockfold
