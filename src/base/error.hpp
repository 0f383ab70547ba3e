// What can go wrong, as one exception type that the command line turns into a message, a JSON document
// and an exit status. Libraries throw; only src/app/main.cpp prints.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace rockfold {

/// The `kind` of an error in JSON documents, and its exit status.
enum class ErrorKind {
  usage,     ///< the command line is wrong: exit 2
  model,     ///< the model is wrong: exit 2
  io,        ///< a file could not be read or written: exit 3
  analysis,  ///< the analysis failed, e.g. did not converge: exit 1
};

/// Where in the input an error was found. Lines and columns count from 1; 0 = unknown.
struct Place {
  std::string file;
  int line = 0;
  int column = 0;
  std::string key;  ///< full key path, e.g. "joint_set[2].spacing"
};

struct Diagnostic {
  Place place;
  std::string message;  ///< what was found, what is expected; no place, no trailing newline
};

/// One error or, for a model, all of its errors at once (never empty).
class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, std::string message, Place place = {})
      : Error(kind, {Diagnostic{std::move(place), std::move(message)}}) {}
  Error(ErrorKind kind, std::vector<Diagnostic> diagnostics)
      : std::runtime_error(diagnostics.front().message),
        kind_(kind),
        diagnostics_(std::move(diagnostics)) {}

  ErrorKind kind() const { return kind_; }
  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  ErrorKind kind_;
  std::vector<Diagnostic> diagnostics_;
};

}  // namespace rockfold
