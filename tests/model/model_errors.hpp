// What tests of the model reader share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "src/base/error.hpp"
#include "src/model/read_model.hpp"

namespace rockfold {

/// The errors of a model called "m.toml"; empty if it is right.
inline std::vector<Diagnostic> errors_of(std::string_view text,
                                         const std::vector<std::string>& overrides = {},
                                         Purpose purpose = Purpose::cut) {
  try {
    parse_model(text, "m.toml", overrides, purpose);
  } catch (const Error& error) {
    return error.diagnostics();
  }
  return {};
}

/// "m.toml:3:5: key: message" a line, for messages of failed tests.
inline std::string listed(const std::vector<Diagnostic>& errors) {
  std::string text;
  for (const auto& [place, message] : errors)
    text += place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
            ": " + place.key + ": " + message + "\n";
  return text;
}

/// A rock of 5 lines that a case can go on from.
#define ROCK "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [4, 4, 4]\n"

/// One of every entry and every key that is supported, none at its default.
extern const char* const complete_model;

}  // namespace rockfold
