#include "src/io/exports/text_file.hpp"

#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "src/base/error.hpp"

namespace rockfold {

TextFile::TextFile(std::string path)
    : path_(std::move(path)), partial_(path_ + ".partial-" + std::to_string(getpid())) {
  file_ = std::fopen(partial_.c_str(), "wb");
  if (file_ == nullptr) fail(errno);
}

TextFile::~TextFile() {
  if (file_ == nullptr) return;
  std::fclose(file_);
  std::remove(partial_.c_str());
}

void TextFile::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), file_) != buffer_.size()) fail(errno);
  buffer_.clear();
}

void TextFile::finish() {
  flush();
  if (std::fflush(file_) != 0) fail(errno);
  if (fsync(fileno(file_)) != 0 && errno != EINVAL && errno != EROFS) fail(errno);
  const bool closed = std::fclose(file_) == 0;
  const int error = errno;
  file_ = nullptr;
  if (closed && std::rename(partial_.c_str(), path_.c_str()) == 0) return;
  const int reason = closed ? errno : error;
  std::remove(partial_.c_str());
  fail(reason);
}

void TextFile::fail(int error) const {
  throw Error(ErrorKind::io, std::string("cannot be written: ") + std::strerror(error),
              Place{path_, 0, 0, {}});
}

}  // namespace rockfold
