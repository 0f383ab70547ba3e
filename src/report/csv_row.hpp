// One line of comma-separated values.
#pragma once

#include <cmath>
#include <string>

#include <fmt/format.h>

#include "src/base/types.hpp"

namespace rockfold {

/// Numbers are written with as many digits as read back the same, texts in quotes; what is not finite is left empty.
class CsvRow {
 public:
  CsvRow& operator<<(Real x) { return add(std::isfinite(x) ? fmt::format("{}", x + 0.0) : ""); }
  CsvRow& operator<<(Index n) { return add(std::to_string(n)); }
  CsvRow& operator<<(bool yes) { return add(yes ? "yes" : "no"); }
  CsvRow& operator<<(const char* words) { return *this << std::string(words); }
  CsvRow& operator<<(const std::string& words) {
    std::string cell = "\"";
    for (const char c : words) cell += c == '"' ? "\"\"" : std::string(1, c);
    return add(cell + "\"");
  }
  CsvRow& operator<<(const Vec3& v) { return *this << v[0] << v[1] << v[2]; }
  CsvRow& empty(int cells) {
    for (int i = 0; i < cells; ++i) add("");
    return *this;
  }
  std::string line() const { return text_ + "\n"; }

 private:
  CsvRow& add(const std::string& cell) {
    text_ += (first_ ? "" : ",") + cell;
    first_ = false;
    return *this;
  }
  std::string text_;
  bool first_ = true;
};

}  // namespace rockfold
