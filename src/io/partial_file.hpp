// A file that is written aside, as NAME.partial-PID, and takes its name when it is whole; and what becomes of such files
// where a signal ends the program at once.
#pragma once

#include <csignal>
#include <string>
#include <utility>

namespace rockfold {

class PartialFile {
 public:
  /// Creates nothing, but removes what an earlier program may have left there.
  explicit PartialFile(std::string path);
  PartialFile(const PartialFile&) = delete;
  PartialFile& operator=(const PartialFile&) = delete;
  /// Removes the file if it has not taken its name.
  ~PartialFile();

  const std::string& path() const { return path_; }    ///< its name once it is whole
  const std::string& aside() const { return aside_; }  ///< where it is written until then

  /// Throws Error(io).
  void take_name();

  /// Whether the file, as it stands, is worth its name should the program end at once. At first it is not. Change it where
  /// signals wait (SignalsWait), so that it never says so of a file that is being written.
  void set_worth_keeping(bool worth) { worth_keeping_ = worth; }
  /// A file that goes with an older one of the same name, and goes away with it.
  void set_companion(std::string path) { companion_ = std::move(path); }

 private:
  friend bool settle_partial_files() noexcept;

  std::string path_, aside_, companion_;
  volatile bool worth_keeping_ = false;
  bool named_ = false;
};

/// For signal handlers, before _exit(): files worth keeping take their names, others are removed. Whether any took its name.
bool settle_partial_files() noexcept;

/// While it lives, SIGINT, SIGTERM and SIGALRM wait in this thread.
class SignalsWait {
 public:
  SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
  ~SignalsWait();

 private:
  sigset_t before_;
};

}  // namespace rockfold
