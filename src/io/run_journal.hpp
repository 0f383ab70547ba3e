// What a run keeps beside its result until that is whole, so that it can be killed at any moment:
//
//   NAME.vtkhdf.journal      what the run was started with, and each stored state; only ever appended to
//   NAME.vtkhdf.checkpoint   the whole state of the run at one step; written aside and renamed
//
// The journal is "RFJRNL01" and records: kind (u64, 1 origin, 2 state), length (u64), hash of what follows (u64), that many
// bytes. A record that a kill cut short is no record. The checkpoint is "RFCHKP01", the hash of the journal's first record,
// length and hash of its bytes, these. Both are of this machine: little-endian, for a program of the same version.
// docs/decisions/0016-checkpoints.md says why.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

/// What a run was started with.
struct RunOrigin {
  /// A file that the model reads.
  struct Input {
    std::string path;
    std::uint64_t bytes = 0, hash = 0;
  };
  std::string version, commit;  ///< of the program
  std::string command;          ///< "run", "demo"
  std::string model;            ///< path of the model as given, …
  std::string folder;           ///< … from this absolute one
  std::string text;             ///< of the model file
  std::vector<std::string> overrides, ignored, exports;
  std::string table;    ///< of --table; empty = none
  bool report = false;  ///< --report
  std::optional<std::uint64_t> seed;
  std::vector<Input> inputs;
  std::vector<std::byte> search;  ///< what a strength reduction found before it
};

std::vector<std::byte> packed(const RunOrigin& origin);
/// Throws std::runtime_error.
RunOrigin unpacked_origin(std::span<const std::byte> bytes);

/// Size and hash of a file. Throws Error(io) where it cannot be read.
RunOrigin::Input fingerprint(const std::string& path);

/// A state of the journal.
struct JournalState {
  Index step = 0;
  Real time = 0;                       ///< s
  std::uint64_t hash = 0;              ///< of its motion
  std::int64_t begin = 0, length = 0;  ///< of its bytes in the file
};

/// What stands in a journal and its checkpoint; both may be those of a run under way.
struct JournalContents {
  RunOrigin origin;
  std::vector<JournalState> states;
  std::int64_t end = 0;                              ///< of the last whole record
  std::optional<std::vector<std::byte>> checkpoint;  ///< none was written yet
};

std::string journal_path(const std::string& result);
std::string checkpoint_path(const std::string& result);

/// Nothing where there is no journal beside `result`. Throws Error(io) where it is none of ours, or damaged at its start.
std::optional<JournalContents> read_journal(const std::string& result);

/// The bytes of one of its states. Throws Error(io).
std::vector<std::byte> read_state(const std::string& result, const JournalState& state);

/// The journal of a run under way. All functions throw Error(io) where something cannot be written; what was written before
/// is whole then.
class RunJournal {
 public:
  /// A new one; what an earlier run left is removed.
  RunJournal(std::string result, const RunOrigin& origin);
  /// Goes on with that of an earlier run, of which `states` remain.
  RunJournal(std::string result, const JournalContents& contents, std::size_t states);
  RunJournal(const RunJournal&) = delete;
  RunJournal& operator=(const RunJournal&) = delete;
  ~RunJournal();

  void add_state(Index step, Real time, std::uint64_t hash, std::span<const std::byte> bytes);
  /// Replaces the checkpoint; it survives a crash of the machine, and so do the states before it.
  void save_checkpoint(std::span<const std::byte> bytes);
  /// The result is whole: both files go away.
  void remove();

 private:
  void open(int flags);
  void append(std::uint64_t kind, std::span<const std::byte> bytes);

  std::string result_;
  int file_ = -1;
  std::int64_t end_ = 0;
  std::uint64_t name_ = 0;  ///< hash of the first record
};

}  // namespace rockfold
