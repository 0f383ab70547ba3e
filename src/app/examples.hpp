// The example models, compiled into the program from tests/cases/NAME/model.toml and the files that
// it names (embed_examples.cmake).
#pragma once

#include <span>
#include <string_view>

namespace rockfold {

/// A file with geometry that an example's model names.
struct ExampleFile {
  std::string_view name;  ///< as in the model, without a folder
  std::string_view text;
};

struct Example {
  std::string_view name;     ///< the folder's name
  std::string_view summary;  ///< the model's first line, a comment
  std::string_view text;     ///< the model
  std::span<const ExampleFile> files;
};

/// All of them, by name.
std::span<const Example> examples();

/// Throws Error(usage) with the nearest name for one that is not there.
const Example& find_example(std::string_view name);

}  // namespace rockfold
