// Sums of many terms: equal terms added naively to a growing sum round the same way each time.
#pragma once

#include <cmath>

#include "src/base/types.hpp"

namespace rockfold {

/// Compensated sum (Neumaier 1974): as if added in twice the precision.
class Sum {
 public:
  Sum& operator+=(Real term) {
    const Real total = total_ + term;
    lost_ += std::abs(total_) >= std::abs(term) ? (total_ - total) + term : (term - total) + total_;
    total_ = total;
    return *this;
  }
  Real value() const { return total_ + lost_; }

 private:
  Real total_ = 0, lost_ = 0;
};

}  // namespace rockfold
