#include "src/app/examples.hpp"

#include <string>
#include <vector>

#include <fmt/format.h>

#include "src/base/error.hpp"
#include "src/model/text/nearest.hpp"

namespace rockfold {

const Example& find_example(std::string_view name) {
  std::vector<std::string> names;
  for (const auto& example : examples()) {
    if (example.name == name) return example;
    names.emplace_back(example.name);
  }
  throw Error(ErrorKind::usage, fmt::format("no example is called '{}'{}", name,
                                            suggestion(name, names, "the examples are")));
}

}  // namespace rockfold
