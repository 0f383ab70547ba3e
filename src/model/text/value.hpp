// A TOML document as plain data, each value with the spot where it was written. What reads a model
// works on this tree; toml++ itself stays in parse_toml.cpp.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace rockfold {

/// Where something was written. Lines and columns count from 1; 0 = unknown.
struct Spot {
  int source = 0;  ///< 0 the model file, k the k-th --set
  int line = 0;
  int column = 0;
};

struct Value;
struct Entry;
using Array = std::vector<Value>;

struct Table {
  std::vector<Entry> entries;  ///< keys are unique

  Entry* find(std::string_view key);
  const Entry* find(std::string_view key) const;
};

/// Any of TOML's dates and times: no key of a model takes one.
struct DateTime {};

struct Value {
  std::variant<bool, std::int64_t, double, std::string, DateTime, Array, Table> data;
  Spot spot;
};

struct Entry {
  std::string key;
  Spot spot;  ///< of the key
  Value value;
};

/// How a message shows a value that it found: -1.0, "text", an array of 2 values, …
std::string described(const Value& value);

/// Shortest text that reads back as this number, always recognisable as a floating-point one: 1.0,
/// 1e9, nan.
std::string number_text(double number);

}  // namespace rockfold
