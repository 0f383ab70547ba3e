#include "perf/shared/run_benchmarks.hpp"

#include <cstdio>
#include <string>

#include <benchmark/benchmark.h>

#include "generated/version.hpp"
#include "kernels/device/bandwidth.hpp"
#include "kernels/device/device.hpp"

namespace rockfold {

int run_benchmarks(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  const DeviceScope device;
  triad = measure_triad();
  benchmark::AddCustomContext("rockfold", std::string(version) + " " + commit);
  benchmark::AddCustomContext("device", device_description());
  char text[40];
  std::snprintf(text, sizeof text, "%.1f", triad / 1e9);
  benchmark::AddCustomContext("triad GB/s", text);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace rockfold
