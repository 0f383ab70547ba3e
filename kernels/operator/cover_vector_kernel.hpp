#pragma once

#include "kernels/device/device_kernel.hpp"
#include "kernels/operator/cover_vector.hpp"

namespace rockfold {

struct CoverVector::Data {
  device::Field field;
};

}  // namespace rockfold
