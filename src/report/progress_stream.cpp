#include "src/report/progress_stream.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "src/base/error.hpp"

namespace rockfold {

namespace {

constexpr double tell_every = 0.1;  // s

std::FILE* opened(int descriptor) {
  const int flags = fcntl(descriptor, F_GETFL);
  const bool writes = flags != -1 && (flags & O_ACCMODE) != O_RDONLY;
  std::FILE* stream = writes ? fdopen(descriptor, "w") : nullptr;
  if (!stream)
    throw Error(ErrorKind::usage, fmt::format("--progress-fd: file descriptor {} is not open for "
                                              "writing",
                                              descriptor));
  return stream;
}

}  // namespace

ProgressStream::ProgressStream(int descriptor) : stream_(opened(descriptor)) {}

ProgressStream::~ProgressStream() {
  std::fclose(stream_);
}

void ProgressStream::tell(const PhaseView& view) {
  if (view.count == 0 || since_last_.seconds() >= tell_every) write(view, false);
}

void ProgressStream::tell_end(const PhaseView& view) {
  write(view, true);
}

void ProgressStream::write(const PhaseView& view, bool ended) {
  nlohmann::ordered_json line{{"phase", view.phase},     {"unit", view.unit},
                              {"done", view.count},      {"total", nullptr},
                              {"seconds", view.seconds}, {"ended", ended}};
  if (view.total > 0) line["total"] = view.total;
  std::fprintf(stream_, "%s\n", line.dump().c_str());
  std::fflush(stream_);
  since_last_ = Timer();
}

}  // namespace rockfold
