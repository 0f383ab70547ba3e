// The memory bandwidth of the device, as STREAM's triad measures it: the yardstick of kernels that only move numbers.
#pragma once

namespace rockfold {

/// Bytes a second of a[i] = b[i] + s·c[i], 24 bytes an element as STREAM counts (McCalpin 1995), the best of several passes over
/// arrays that no cache holds. Throws Error(analysis) where the answer is wrong.
double measure_triad();

}  // namespace rockfold
