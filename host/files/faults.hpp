// What is wrong with one data file, collected and thrown together.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/types.hpp"

namespace rockfold {

class Faults {
 public:
  /// `place` has the file's name and the key that names it; lines and columns come with each fault.
  explicit Faults(Place place) : place_(std::move(place)) {}

  /// Line and column count from 1; 0 = the file as a whole.
  void add(int line, int column, std::string message);
  /// Adds and throws: for what makes it useless to read on.
  [[noreturn]] void fail(int line, int column, std::string message);
  [[noreturn]] void fail(std::string message) { fail(0, 0, std::move(message)); }

  bool empty() const { return found_.empty(); }
  /// Throws Error(model) with the first 20 and the number of the others, if there are any.
  void throw_if_any();

 private:
  Place place_;
  std::vector<Diagnostic> found_;
  std::size_t left_out_ = 0;
};

/// A word of a file in quotes, cut after 40 bytes; what cannot be shown is replaced by '?'.
std::string quoted(std::string_view word);

/// "(1, 2.5, 3)", with the digits that map coordinates need.
std::string point_text(const Vec3& point);

/// "1 line", "2 lines".
std::string counted(std::size_t count, std::string_view noun);

}  // namespace rockfold
