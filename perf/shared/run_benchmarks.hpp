// What the benchmarks on the device have in common: the yardstick, and what every record carries.
#pragma once

namespace rockfold {

/// Bytes a second of STREAM's triad, measured before the first benchmark.
inline double triad = 0;

/// main() of a benchmark: starts the device, measures the triad, prints version, commit and device.
int run_benchmarks(int argc, char** argv);

}  // namespace rockfold
