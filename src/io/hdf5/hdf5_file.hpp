// The few HDF5 operations that result files need, with paths instead of handles and errors as
// exceptions. Everything written is independent of time, host and process: the same calls give the
// same bytes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/types.hpp"

namespace rockfold::hdf5 {

enum class Type { uint8, int32, int64, float32, float64 };

/// A row of a data set: how many numbers of which type.
template <typename T>
struct Row;
template <>
struct Row<std::uint8_t> {
  static constexpr Type type = Type::uint8;
  static constexpr int width = 1;
};
template <>
struct Row<std::int32_t> {
  static constexpr Type type = Type::int32;
  static constexpr int width = 1;
};
template <>
struct Row<std::int64_t> {
  static constexpr Type type = Type::int64;
  static constexpr int width = 1;
};
template <>
struct Row<float> {
  static constexpr Type type = Type::float32;
  static constexpr int width = 1;
};
template <>
struct Row<double> {
  static constexpr Type type = Type::float64;
  static constexpr int width = 1;
};
template <typename T, std::size_t n>
struct Row<std::array<T, n>> {
  static constexpr Type type = Row<T>::type;
  static constexpr int width = static_cast<int>(n) * Row<T>::width;
};

using Shape = std::vector<std::int64_t>;

/// One data set as `info` shows it.
struct DatasetInfo {
  std::string path, type;
  Shape shape;
  std::int64_t bytes = 0;
};

/// An open HDF5 file. Groups of a path are made as needed. All functions throw Error(io) that names
/// `shown_as`.
class File {
 public:
  enum class Mode { create, extend, read };
  File(const std::string& path, Mode mode, std::string shown_as);
  File(const File&) = delete;
  File& operator=(const File&) = delete;
  ~File();

  /// Writes what is left and closes; errors of the last bytes come from here.
  void close();

  /// Makes sure that `bytes` more can be written, in this call or in those until the next
  /// reserve().
  void reserve(std::int64_t bytes);

  void make_group(const std::string& path);
  bool exists(const std::string& path) const;

  /// A whole data set, [n] or [n][width]; large ones are compressed without loss.
  template <typename T>
  void write(const std::string& path, const std::vector<T>& rows) {
    write_rows(path, Row<T>::type, shape_of<T>(rows.size()), rows.data());
  }
  /// The same for numbers that form rows of `width`.
  template <typename T>
  void write_wide(const std::string& path, const std::vector<T>& numbers, std::int64_t width) {
    write_rows(path, Row<T>::type, {static_cast<std::int64_t>(numbers.size()) / width, width},
               numbers.data());
  }
  void write_text(const std::string& path, std::string_view text);
  void write_names(const std::string& path, const std::vector<std::string>& names);

  /// Data sets that grow and are made from now on are deflated at this level, 1 to 9; 0: those only that repeat much.
  void deflate_growing(unsigned level) { growing_level_ = level; }

  /// Appends rows at the end of a data set, which the first call makes; every call adds the same
  /// number of rows. Compressed is for rows that repeat much.
  template <typename T>
  void append(const std::string& path, std::span<const T> rows, bool compressed = false) {
    append_block(path, Row<T>::type, shape_of<T>(rows.size()), rows.data(), compressed);
  }
  /// Appends one entry [n][width] to a data set [S][n][width].
  template <typename T>
  void append_entry(const std::string& path, std::span<const T> rows) {
    append_block(path, Row<T>::type, {1, static_cast<std::int64_t>(rows.size()), Row<T>::width},
                 rows.data(), false);
  }

  /// A data set whose values are `rows` rows of another one, from row `first` on.
  void write_virtual_rows(const std::string& path, const std::string& source, std::int64_t first,
                          std::int64_t rows);

  void hard_link(const std::string& existing, const std::string& path);
  void soft_link(const std::string& existing, const std::string& path);

  void set_text(const std::string& object, const std::string& name, std::string_view text);
  void set_integers(const std::string& object, const std::string& name,
                    const std::vector<std::int64_t>& values);
  void set_real(const std::string& object, const std::string& name, double value);

  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  double number_attribute(const std::string& object, const std::string& name) const;
  std::string read_text(const std::string& path) const;
  std::vector<double> read_numbers(const std::string& path) const;
  std::vector<std::int64_t> read_integers(const std::string& path) const;
  std::vector<std::byte> read_bytes(const std::string& path) const;
  /// Rows `first` to `first + rows` of a data set, whatever is in a row, one after the other.
  std::vector<float> read_rows(const std::string& path, std::int64_t first,
                               std::int64_t rows) const;
  std::vector<std::string> read_names(const std::string& path) const;
  Shape shape(const std::string& path) const;
  /// Every data set in these groups once, ordered by path.
  std::vector<DatasetInfo> datasets(const std::vector<std::string>& groups) const;

 private:
  template <typename T>
  static Shape shape_of(std::size_t rows) {
    const auto n = static_cast<std::int64_t>(rows);
    return Row<T>::width == 1 ? Shape{n} : Shape{n, Row<T>::width};
  }
  void write_rows(const std::string& path, Type type, const Shape& shape, const void* data);
  void append_block(const std::string& path, Type type, const Shape& block, const void* data,
                    bool compressed);
  void make_growing(const std::string& path, Type type, const Shape& block, bool compressed);
  void write_attribute(const std::string& object, const std::string& name,
                       std::int64_t type_in_file, std::int64_t type_in_memory, std::int64_t space,
                       const void* value);
  template <typename T>
  std::vector<T> read_all(const std::string& path, std::int64_t memory_type) const;
  std::int64_t check(std::int64_t result, const char* action) const;
  Error failure(std::string message) const {
    return {ErrorKind::io, std::move(message), Place{shown_as_, 0, 0, {}}};
  }

  std::string path_, shown_as_;
  std::int64_t id_ = -1;
  bool reserved_ = false;
  unsigned growing_level_ = 0;
};

}  // namespace rockfold::hdf5
