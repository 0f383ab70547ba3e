#include "kernels/device/device.hpp"

#include "kernels/device/device_kernel.hpp"

namespace rockfold {

DeviceScope::DeviceScope(int threads) {
  if (Kokkos::is_initialized()) return;
#if KOKKOS_VERSION >= 30700
  Kokkos::InitializationSettings settings;
  if (threads > 0) settings.set_num_threads(threads);
  settings.set_disable_warnings(true);
#else
  Kokkos::InitArguments settings;
  if (threads > 0) settings.num_threads = threads;
  settings.disable_warnings = true;
#endif
  Kokkos::initialize(settings);
  owns_ = true;
}

DeviceScope::~DeviceScope() {
  if (owns_) Kokkos::finalize();
}

void wait_for_device() {
  Kokkos::fence();
}

std::string device_description() {
  const int version = KOKKOS_VERSION;
  return std::string(device::Exec::name()) + ", concurrency " +
         std::to_string(device::Exec().concurrency()) + ", Kokkos " +
         std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
         std::to_string(version % 100);
}

}  // namespace rockfold
