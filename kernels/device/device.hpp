// The device that the kernels run on: started once, before any kernel, and stopped after the last array is gone.
#pragma once

#include <string>

namespace rockfold {

/// Holds the device while it lives. A second one, or one inside a program that has started Kokkos itself, does nothing.
class DeviceScope {
 public:
  /// `threads` = 0 takes OMP_NUM_THREADS, or all cores. On a GPU it has no meaning.
  explicit DeviceScope(int threads = 0);
  ~DeviceScope();
  DeviceScope(const DeviceScope&) = delete;
  DeviceScope& operator=(const DeviceScope&) = delete;

 private:
  bool owns_ = false;
};

/// Returns when all kernels that were started have ended: for clocks.
void wait_for_device();

/// For records: "OpenMP, 2 threads, Kokkos 3.4.01".
std::string device_description();

}  // namespace rockfold
