#include "src/store/output_path.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "host/files/load_files.hpp"
#include "src/base/error.hpp"
#include "src/check/needs.hpp"
#include "src/io/result_file.hpp"
#include "src/store/design_files.hpp"

namespace fs = std::filesystem;

namespace rockfold {

namespace {

[[noreturn]] void fail(ErrorKind kind, const std::string& path, const std::string& what) {
  throw Error(kind, what, Place{path, 0, 0, ""});
}

std::string reason() {
  return std::strerror(errno);
}

void write_new_file(const std::string& path, const std::string& text) {
  const int file = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL, 0666);
  if (file < 0) {
    if (errno == EEXIST)
      fail(ErrorKind::io, path,
           "is there already and is left as it is; move it or work in another folder");
    fail(ErrorKind::io, path, "cannot be written: " + reason());
  }
  const bool written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  const std::string why = written ? "" : reason();
  if (close(file) != 0 || !written) {
    unlink(path.c_str());
    fail(ErrorKind::io, path, "cannot be written: " + why);
  }
}

// A file that is read: `what` stands in messages.
struct InputFile {
  std::string path, what;
};
// A file that will be written; `remedy`: what to do if it must not be. `place`: where the model names it, if it does.
struct OutputFile {
  std::string path, what, remedy;
  std::optional<Place> place = {};
};

// What is wrong with the name of an output: the model's mistake where the model gives it.
[[noreturn]] void refuse(const OutputFile& output, const std::string& what) {
  if (output.place) throw Error(ErrorKind::model, what, *output.place);
  fail(ErrorKind::usage, output.path, what);
}

std::vector<InputFile> inputs_of(const Options& options, const Model& model) {
  std::vector<InputFile> inputs;
  if (!options.input.empty()) inputs.push_back({options.input, "the model"});
  for (const std::string& file : files_named_by(model))
    inputs.push_back({file, fmt::format("'{}', which the model reads", file)});
  return inputs;
}

std::vector<OutputFile> outputs_of(const Options& options, const Model& model) {
  const std::string result = result_path(options);
  const std::string of_result = "name another file with -o, one that ends in .vtkhdf";
  std::vector<OutputFile> outputs;
  if (options.command != Command::theory && !options.no_result)
    outputs = {{result, "the result", of_result},
               {xdmf_path(result), "the .xdmf file that goes with the result", of_result}};
  if (!options.json_file.empty())
    outputs.push_back({options.json_file, "the document", "give --json-file another name"});
  if (!options.log_file.empty())
    outputs.push_back({options.log_file, "the log", "give --log another name"});
  if (options.command == Command::demo)
    outputs.push_back({page_path(options), "the page", of_result});
  if (options.report) outputs.push_back({report_path(options), "the report", of_result});
  for (const std::string& path : options.exports)
    outputs.push_back({path, "the export", "give each --export a name of its own"});
  if (!options.certificate.empty())
    outputs.push_back({options.certificate, "the certificate", "give --certificate another name"});
  const bool check = options.command == Command::check;
  const Made made{check || wants_support(options, model), check || wants_run(options)};
  for (const DesignFile& file : design_files(model, result, made))
    if (file.place.file.empty())
      outputs.push_back({file.path, "the table of key blocks", "give --table another name"});
    else
      outputs.push_back({file.path, "the drawing or table",
                         "give each [[drawing]] and [[table]] a name of its own", file.place});
  return outputs;
}

// By any of its names: relative, through links, or of a file that is not there yet.
bool same_file(const std::string& a, const std::string& b) {
  std::error_code ignored;
  if (fs::equivalent(a, b, ignored)) return true;
  return fs::weakly_canonical(fs::absolute(a, ignored), ignored) ==
         fs::weakly_canonical(fs::absolute(b, ignored), ignored);
}

void check_writable(const std::string& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored))
    fail(ErrorKind::io, path, "cannot be written: it is a folder; the name of a file is needed");
  // The whole file is renamed to its final name, which would put a file in the place of a device.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    fail(ErrorKind::io, path, "cannot be written: it is there already and no regular file");
  const auto parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::is_directory(folder, ignored))
    fail(ErrorKind::io, path, fmt::format("cannot be written: there is no folder '{}'", folder));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    fail(ErrorKind::io, path, fmt::format("cannot be written: folder '{}': {}", folder, reason()));
}

/// What is made of a result must not take its place.
void check_beside_result(const std::string& result, const std::string& path, const char* what) {
  for (const std::string& file : {result, xdmf_path(result)})
    if (same_file(path, file))
      fail(ErrorKind::usage, path,
           fmt::format("the {} would overwrite '{}'; name another file with -o", what, file));
  check_writable(path);
}

}  // namespace

std::string result_path(const Options& options) {
  if (!options.output.empty()) return options.output;
  if (options.command == Command::demo) return "rockfold_demo.vtkhdf";
  return fs::path(options.input).replace_extension(".vtkhdf").string();
}

std::string page_path(const Options& options) {
  if (options.command == Command::view && !options.output.empty()) return options.output;
  const std::string result =
      options.command == Command::view ? options.input : result_path(options);
  return fs::path(result).replace_extension(".html").string();
}

std::string report_path(const Options& options) {
  if (options.command == Command::report && !options.output.empty()) return options.output;
  const std::string result =
      options.command == Command::report ? options.input : result_path(options);
  return fs::path(result).replace_extension(".report.html").string();
}

void check_page_path(const Options& options) {
  check_beside_result(options.input, page_path(options), "page");
}

void check_report_path(const Options& options) {
  check_beside_result(options.input, report_path(options), "report");
}

void check_output_names(const Options& options, const Model& model) {
  const std::vector<OutputFile> outputs = outputs_of(options, model);
  const std::vector<InputFile> inputs = inputs_of(options, model);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const OutputFile& output = outputs[i];
    if (options.command == Command::check && !output.place) continue;
    for (const InputFile& input : inputs)
      if (same_file(output.path, input.path))
        refuse(output, fmt::format("{}{} would overwrite {}; {}", output.what,
                                   output.place ? " '" + output.path + "'" : "", input.what,
                                   output.remedy));
    for (std::size_t j = 0; j < i; ++j)
      if (same_file(output.path, outputs[j].path))
        refuse(output, fmt::format("{} would overwrite {} '{}': two files of one name; {}",
                                   output.what, outputs[j].what, outputs[j].path, output.remedy));
  }
}

void check_output_paths(const Options& options, const Model& model) {
  check_output_names(options, model);
  for (const OutputFile& output : outputs_of(options, model)) check_writable(output.path);
}

void require_states_replaced_knowingly(const Options& options, const std::string& path) {
  std::error_code ignored;
  if (options.force || wants_run(options) || !fs::exists(path, ignored)) return;
  std::size_t states = 0;
  try {
    states = read_result_info(path).step.size();
  } catch (const Error&) {
    return;  // no result of this program
  }
  if (states > 0)
    fail(ErrorKind::usage, path,
         fmt::format("holds {} states of a run, which `{}` would replace; name another file with "
                     "-o, or add --force",
                     states, command_name(options.command)));
}

void write_new_files(const std::vector<std::pair<std::string, std::string>>& files) {
  std::size_t written = 0;
  try {
    for (; written < files.size(); ++written)
      write_new_file(files[written].first, files[written].second);
  } catch (const Error&) {
    while (written > 0) unlink(files[--written].first.c_str());
    throw;
  }
}

}  // namespace rockfold
