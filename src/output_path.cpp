#include "src/output_path.hpp"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <set>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include "src/base/error.hpp"

namespace fs = std::filesystem;

namespace rockfold {

namespace {

[[noreturn]] void fail(ErrorKind kind, const std::string& path, const std::string& what) {
  throw Error(kind, what, Place{path, 0, 0, ""});
}

std::string reason() {
  return std::strerror(errno);
}

}  // namespace

std::string result_path(const Options& options) {
  if (!options.output.empty()) return options.output;
  if (options.command == Command::demo) return "rockfold_demo.vtkhdf";
  return fs::path(options.input).replace_extension(".vtkhdf").string();
}

void check_result_path(const std::string& path, const std::string& model_path) {
  std::error_code ignored;
  if (fs::equivalent(path, model_path, ignored))
    fail(ErrorKind::usage, path, "the result would overwrite the model; name another file with -o");
  if (fs::is_directory(path, ignored))
    fail(ErrorKind::io, path, "cannot be written: it is a folder; -o takes the name of a file");
  // The whole result is renamed to its final name, which would put a file in the place of a device.
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))
    fail(ErrorKind::io, path, "cannot be written: it is there already and no regular file");
  const auto parent = fs::path(path).parent_path();
  const std::string folder = parent.empty() ? "." : parent.string();
  if (!fs::is_directory(folder, ignored))
    fail(ErrorKind::io, path, fmt::format("cannot be written: there is no folder '{}'", folder));
  if (access(folder.c_str(), W_OK | X_OK) != 0)
    fail(ErrorKind::io, path, fmt::format("cannot be written: folder '{}': {}", folder, reason()));
}

void check_export_paths(const Options& options, const std::string& result,
                        const std::string& model_path) {
  const auto whole_name = [](const std::string& name) {
    return fs::weakly_canonical(fs::absolute(name));
  };
  std::set<fs::path> taken{whole_name(result)};
  for (const auto& path : options.exports) {
    check_result_path(path, model_path);
    if (!taken.insert(whole_name(path)).second)
      fail(ErrorKind::usage, path, "is named for two files; give each --export a name of its own");
  }
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

}  // namespace rockfold
