// Where results go, decided and tried before any work is done.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "src/app/command_line.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// `-o`, or the model's path with its extension replaced by .vtkhdf; for the demo
/// rockfold_demo.vtkhdf in the current folder.
std::string result_path(const Options& options);

/// Where `view` writes: `-o`, or the result's path with .html; of the demo, beside its result.
std::string page_path(const Options& options);
/// Where `report` writes: `-o`, or the result's path with .report.html; of `--report`, beside its result.
std::string report_path(const Options& options);
/// Throws Error where the page of `view` would overwrite the result (usage) or cannot be written (io).
void check_page_path(const Options& options);
/// Likewise of `report`.
void check_report_path(const Options& options);

/// Throws Error where an output of the command (the result, the .xdmf beside it, each export, each drawing and table) is the model, a
/// file that the model reads or another output, by any of its names: usage, or model at the key where the model names the output.
/// Of `check`: those that the model names, for a result without -o.
void check_output_names(const Options& options, const Model& model);

/// Likewise; and where an output is a folder, or its folder is missing or closed to us (io). Older outputs will be replaced, when the
/// new ones are whole.
void check_output_paths(const Options& options, const Model& model);

/// Throws Error(usage) where a command without an analysis would replace the states of one; --force lets it.
void require_states_replaced_knowingly(const Options& options, const std::string& path);

/// Writes new text files, given by path and text: all or none. Throws Error(io), also where a file
/// of such a name is there already.
void write_new_files(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace rockfold
