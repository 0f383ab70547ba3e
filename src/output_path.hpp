// Where results go, decided and tried before any work is done.
#pragma once

#include <string>

#include "src/command_line.hpp"

namespace rockfold {

/// `-o`, or the model's path with its extension replaced by .vtkhdf; for the demo
/// rockfold_demo.vtkhdf in the current folder.
std::string result_path(const Options& options);

/// Throws Error where a result file cannot be written as `path`: it is the model itself (usage), a
/// folder, or its folder is missing or closed to us (io). An older result file there will be
/// replaced, when the new one is whole.
void check_result_path(const std::string& path, const std::string& model_path);

/// check_result_path for each export; two files of one name, or an export named as the result, are a usage error.
void check_export_paths(const Options& options, const std::string& result,
                        const std::string& model_path);

/// Writes a new text file. Throws Error(io), also where a file of that name is there already.
void write_new_file(const std::string& path, const std::string& text);

}  // namespace rockfold
