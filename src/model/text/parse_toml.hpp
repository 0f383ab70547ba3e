// TOML text → value tree. The only place that knows the TOML library.
#pragma once

#include <string>
#include <string_view>

#include "src/model/text/value.hpp"

namespace rockfold {

/// Parses a document; every spot gets this `source`, `name` stands for the document in messages.
/// Throws Error(model) with the line, the column and the parser's description at the first error of
/// syntax.
Value parse_toml(std::string_view text, int source, const std::string& name);

}  // namespace rockfold
