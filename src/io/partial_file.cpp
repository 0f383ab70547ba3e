#include "src/io/partial_file.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include <unistd.h>

#include "src/base/error.hpp"

namespace rockfold {

namespace {

/// More than are ever written at a time: the result, and a text beside it. A file beyond them is not settled.
std::array<std::atomic<const PartialFile*>, 8> under_way{};

void replace(const PartialFile* old, const PartialFile* by) {
  for (auto& slot : under_way) {
    const PartialFile* expected = old;
    if (slot.compare_exchange_strong(expected, by)) return;
  }
}

}  // namespace

PartialFile::PartialFile(std::string path)
    : path_(std::move(path)), aside_(path_ + ".partial-" + std::to_string(getpid())) {
  std::remove(aside_.c_str());
  replace(nullptr, this);
}

PartialFile::~PartialFile() {
  if (!named_) std::remove(aside_.c_str());
  replace(this, nullptr);
}

void PartialFile::take_name() {
  if (std::rename(aside_.c_str(), path_.c_str()) != 0)
    throw Error(ErrorKind::io,
                std::string("cannot rename the finished file: ") + std::strerror(errno),
                Place{path_, 0, 0, {}});
  named_ = true;
  replace(this, nullptr);
}

// rename() and unlink() alone: both may be called in a signal handler.
bool settle_partial_files() noexcept {
  bool kept = false;
  for (const auto& slot : under_way) {
    const PartialFile* file = slot.load();
    if (file == nullptr) continue;
    if (!file->worth_keeping_) {
      unlink(file->aside_.c_str());
    } else if (std::rename(file->aside_.c_str(), file->path_.c_str()) == 0) {
      kept = true;
      if (!file->companion_.empty()) unlink(file->companion_.c_str());
    }
  }
  return kept;
}

SignalsWait::SignalsWait() {
  sigset_t all;
  sigemptyset(&all);
  sigaddset(&all, SIGINT);
  sigaddset(&all, SIGTERM);
  sigaddset(&all, SIGALRM);
  pthread_sigmask(SIG_BLOCK, &all, &before_);
}

SignalsWait::~SignalsWait() {
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

}  // namespace rockfold
