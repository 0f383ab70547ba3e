// What the user asks for: the command line as a struct (docs/user_guide.md, Commands and options).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

enum class Command {
  demo,
  check,
  cut,
  support,
  stability,
  verify,
  theory,
  sets,
  run,
  resume,
  sweep,
  view,
  report,
  info,
  examples,
  serve
};

struct Options {
  Command command = Command::demo;
  std::string input;   ///< the model, the result file or the example's name; empty = none given
  std::string output;  ///< -o; empty = the default
  std::vector<std::string> exports;  ///< --export FILE, each of a known format
  Index every = 1;                   ///< view: each N-th state
  bool surface_only = false;         ///< view: without blocks inside the rock
  bool json = false;                 ///< one JSON document on stdout, nothing else there
  bool quiet = false;                ///< no progress and no summary; warnings and errors stay
  int threads = 0;                   ///< 0 = as many as the machine offers
  /// each random set gets seed_of_set() of it and of its number; recorded in the JSON
  std::optional<std::uint64_t> seed;
  std::vector<std::string> overrides;  ///< --set key.path=value, in order
  std::vector<std::string> ignored;    ///< --ignore KEY: loads that the command need not use
  std::string certificate;             ///< --certificate of stability; empty = none
  std::string table;                   ///< --table: the key blocks as CSV; empty = none
  std::string json_file;               ///< --json-file; empty = none
  std::string log_file;                ///< --log; empty = none
  int progress_descriptor = 0;         ///< --progress-fd; 0 = none
  bool report = false;                 ///< --report: of support and run, the printable report too
  bool no_result = false;              ///< --no-result: no result file, the answer alone
  bool yes = false;                    ///< --yes: as many blocks as the model makes are meant
  bool force = false;                  ///< replace a result that holds states of a run
  Real max_time = 0;                   ///< --max-time, s of wall time; 0: no limit
  Real max_memory = 0;                 ///< --max-memory, bytes in memory; 0: no limit
  bool estimate = false;               ///< check: with what a run will take
  bool hashes = false;                 ///< info: with a hash of each state
  int workers = 0;                     ///< sweep: runs at a time; 0: as SWEEP.toml says
  std::pair<Index, Index> part{};      ///< sweep: this part of so many, from 1; 0: the whole
  int slurm_tasks = 0;  ///< sweep: write scripts for a job array of so many tasks, compute nothing
  bool gather = false;  ///< sweep: the table of what parts have computed
  std::optional<std::pair<Real, Real>> scanline;  ///< sets: trend and plunge, deg
  Real blind_zone = 15;                           ///< sets: deg
  bool find_sets = false;                ///< sets: among the poles, whatever the table calls them
  std::optional<std::size_t> set_count;  ///< sets: so many are looked for
  bool left_hand = false;                ///< sets: planes dip to the left of their strikes
  std::string picture;                   ///< sets: --picture; empty = none
  /// What stands in the model file, where `input` need not be there any more (resume).
  std::optional<std::string> model_text = {};
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
