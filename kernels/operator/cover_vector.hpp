// A vector quantity of all physical covers that stays on the device.
#pragma once

#include <memory>
#include <vector>

#include "src/base/types.hpp"

namespace rockfold {

class CoverVector {
 public:
  explicit CoverVector(Index covers);
  explicit CoverVector(const std::vector<Vec3>& values);
  ~CoverVector();
  CoverVector(CoverVector&&) noexcept;
  CoverVector& operator=(CoverVector&&) noexcept;

  void set(const std::vector<Vec3>& values);
  std::vector<Vec3> get() const;

  struct Data;
  Data& data() { return *data_; }
  const Data& data() const { return *data_; }

 private:
  std::unique_ptr<Data> data_;
};

}  // namespace rockfold
