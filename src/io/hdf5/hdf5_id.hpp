#pragma once

#include <cstdint>

namespace rockfold::hdf5 {

/// An HDF5 identifier that closes itself.
class Id {
 public:
  Id(std::int64_t id, int (*close)(std::int64_t)) : id_(id), close_(close) {}
  Id(const Id&) = delete;
  Id& operator=(const Id&) = delete;
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  operator std::int64_t() const { return id_; }

 private:
  std::int64_t id_;
  int (*close_)(std::int64_t);
};

}  // namespace rockfold::hdf5
