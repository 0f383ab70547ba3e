// What the user asks for: the command line as a struct (INTERFACE: commands, common options).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace rockfold {

enum class Command { demo, check, cut, support, theory, run, info, examples };

struct Options {
  Command command = Command::demo;
  std::string input;   ///< the model, the result file or the example's name; empty = none given
  std::string output;  ///< -o; empty = the default
  std::vector<std::string> exports;  ///< --export FILE, each of a known format
  bool json = false;                 ///< one JSON document on stdout, nothing else there
  bool quiet = false;                ///< no progress and no summary; warnings and errors stay
  int threads = 0;                   ///< 0 = as many as the machine offers
  /// of the first joint set; the n-th one gets seed + n − 1; recorded in the JSON
  std::optional<std::uint64_t> seed;
  std::vector<std::string> overrides;  ///< --set key.path=value, in order
};

/// "cut" for Command::cut.
std::string command_name(Command command);

/// A text that the command line asks for (--help, --version) instead of a command.
struct Notice {
  std::string text;
};

/// Reads the command line. Throws Notice for --help and --version, Error(usage) for what is wrong,
/// with the nearest command or option named.
Options parse_command_line(int argc, const char* const* argv);

/// Whether --json stands on the command line, even if the rest of it is wrong: decides how an error
/// is told.
bool wants_json(int argc, const char* const* argv);

}  // namespace rockfold
