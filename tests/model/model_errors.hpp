// What tests of the model reader share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "src/model/read/read_model.hpp"

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

/// A wrong model, where its only error is found, what the key is called and what the message says.
struct Wrong {
  const char* text;
  int line, column;  ///< column 0: not compared
  const char* key;
  const char* part;  ///< of the message
};

/// Exactly one error, so that none has a follow-up.
inline void expect_error(const Wrong& wrong, Purpose purpose = Purpose::cut) {
  const auto errors = errors_of(wrong.text, {}, purpose);
  SCOPED_TRACE(std::string(wrong.text) + "\nsays:\n" + listed(errors) +
               "should say: " + wrong.part);
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_EQ(errors[0].place.file, "m.toml");
  EXPECT_EQ(errors[0].place.line, wrong.line);
  if (wrong.column > 0) {
    EXPECT_EQ(errors[0].place.column, wrong.column);
  }
  EXPECT_EQ(errors[0].place.key, wrong.key);
  EXPECT_NE(errors[0].message.find(wrong.part), std::string::npos);
}

/// A rock of 5 lines that a case can go on from.
#define ROCK "[[solid]]\nname = 'rock'\nshape = 'box'\nmin = [0, 0, 0]\nmax = [4, 4, 4]\n"

/// One of every entry and every key that is supported, none at its default.
extern const char* const complete_model;

}  // namespace rockfold
