// Other processes of the same sweep, where mpirun (or another launcher of MPI) started several. The program itself does not link MPI: a small
// plug-in beside it does (src/sweep/mpi), and is loaded only then.
#pragma once

#include <memory>
#include <optional>
#include <string>

namespace rockfold::sweep {

/// What the plug-in hands out (mpi/plugin.cpp). Messages are short texts.
struct MpiFunctions {
  int rank = 0, size = 1;
  void (*send)(int to, const char* text, int length) = nullptr;
  /// Length of the message that waits, and from whom; −1: none.
  int (*waiting)(int* from) = nullptr;
  void (*receive)(int from, char* text, int length) = nullptr;
  /// All processes must come to it.
  void (*finish)() = nullptr;
};

class MpiLink {
 public:
  /// Nothing where this process was started alone. Throws Error(usage) where it was not and there is no plug-in: each process would
  /// do the whole sweep.
  static std::unique_ptr<MpiLink> open();
  MpiLink(const MpiLink&) = delete;
  MpiLink& operator=(const MpiLink&) = delete;
  /// Waits for the others, but not where an exception ends the program: then the launcher ends them.
  ~MpiLink();

  int rank() const { return functions_->rank; }
  int size() const { return functions_->size; }

  struct Message {
    int from = 0;
    std::string text;
  };
  void send(int to, const std::string& text);
  std::optional<Message> receive();

 private:
  explicit MpiLink(const MpiFunctions* functions);

  const MpiFunctions* functions_;
  int exceptions_;
};

}  // namespace rockfold::sweep
