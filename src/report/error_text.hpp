// An error as lines for people, and as the JSON document (docs/user_guide.md).
#pragma once

#include <cstdio>
#include <string>
#include <vector>

#include "src/base/error.hpp"

namespace rockfold {

/// "slope.toml:12:3: joint_set[2].spacing: …"
std::string diagnostic_line(const Diagnostic& diagnostic);

/// The same for each diagnostic, then how many there are if more
/// than one.
std::vector<std::string> error_lines(const Error& error);

void print_error_document(std::FILE* stream, const Error& error);
/// The same on one line.
std::string error_document_text(const Error& error);

}  // namespace rockfold
