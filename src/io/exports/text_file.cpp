#include "src/io/exports/text_file.hpp"

#include <cerrno>
#include <cstring>

#include <unistd.h>

#include "src/base/error.hpp"

namespace rockfold {

TextFile::TextFile(std::string path) : target_(std::move(path)) {
  file_ = std::fopen(target_.aside().c_str(), "wb");
  if (file_ == nullptr) fail(errno);
}

TextFile::~TextFile() {
  if (file_ != nullptr) std::fclose(file_);
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
  if (!closed) fail(error);
  target_.take_name();
}

void TextFile::fail(int error) const {
  throw Error(ErrorKind::io, std::string("cannot be written: ") + std::strerror(error),
              Place{target_.path(), 0, 0, {}});
}

}  // namespace rockfold
