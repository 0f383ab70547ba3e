// What the kernels share: where arrays live and how they get there. Also the only place that knows what differs
// between the versions of Kokkos (3.4 to 5) that Rockfold builds with.
#pragma once

#include <array>
#include <string>
#include <vector>

#include <Kokkos_Core.hpp>

#include "src/base/types.hpp"

// nvcc 12.9 and 13 give [[no_unique_address]] members other places in lambdas on the device than on the host: every kernel would read
// its arrays' addresses from the wrong bytes (https://github.com/kokkos/mdspan/pull/434 and 435; Kokkos 5.0 leaves the attribute out).
#if defined(__NVCC__) && !defined(KOKKOS_ENABLE_IMPL_VIEW_LEGACY) && \
    defined(MDSPAN_IMPL_USE_ATTRIBUTE_NO_UNIQUE_ADDRESS) &&          \
    !defined(MDSPAN_IMPL_USE_FAKE_ATTRIBUTE_NO_UNIQUE_ADDRESS) &&    \
    __CUDACC_VER_MAJOR__ * 100 + __CUDACC_VER_MINOR__ >= 1209
#error \
    "nvcc 12.9 and newer need Kokkos 5.0 or newer (kokkos/mdspan pull request 434), or Kokkos_ENABLE_IMPL_VIEW_LEGACY=ON"
#endif

namespace rockfold::device {

#if KOKKOS_VERSION >= 30700
namespace math = Kokkos;
#else
namespace math = Kokkos::Experimental;
#endif

using Exec = Kokkos::DefaultExecutionSpace;
using Memory = Exec::memory_space;

// Kernels run on the processor's own cores, where rows go to SIMD lanes, or on a GPU, where they go to a warp's threads.
#if defined(KOKKOS_ENABLE_CUDA) || defined(KOKKOS_ENABLE_HIP) || defined(KOKKOS_ENABLE_SYCL)
#define ROCKFOLD_ON_GPU
inline constexpr bool on_gpu = true;
#else
inline constexpr bool on_gpu = false;
#endif

template <class T>
using Array = Kokkos::View<T*, Memory>;

/// A vector quantity of the covers: (p, d) with all x, then all y, then all z, so that neighbouring covers load as one.
using Field = Kokkos::View<Real* [3], Kokkos::LayoutLeft, Memory>;

using Range = Kokkos::RangePolicy<Exec, Kokkos::IndexType<Index>>;

/// Loops shorter than this are done by the calling thread: waking the others takes a few microseconds, and, where other
/// programs hold the cores, milliseconds. No result depends on it.
inline constexpr Index serial_limit = on_gpu ? 0 : 1024;

/// f(i) for all i < n, in any order. `work`: of one f(i), where that is much more than a few numbers' worth.
template <class F>
void for_each(const char* label, Index n, const F& f, Index work = 1) {
  if constexpr (!on_gpu) {
    if (n <= serial_limit / work) {
      for (Index i = 0; i < n; ++i) f(i);
      return;
    }
  }
  Kokkos::parallel_for(label, Range(0, n), f);
}

/// The largest f(i), at least 0, over all i < n; NaN counts for nothing.
template <class F>
Real largest(const char* label, Index n, const F& f) {
  Real most = 0;
  if (n <= serial_limit && !on_gpu) {
    for (Index i = 0; i < n; ++i) most = f(i) > most ? f(i) : most;
    return most;
  }
  Kokkos::parallel_reduce(
      label, Range(0, n),
      KOKKOS_LAMBDA(const Index i, Real& found) {
        const Real value = f(i);
        if (value > found) found = value;
      },
      Kokkos::Max<Real>(most));
  return most > 0 ? most : 0;
}

template <class T>
using Unmanaged = Kokkos::View<T*, Kokkos::HostSpace, Kokkos::MemoryTraits<Kokkos::Unmanaged>>;

template <class T>
Array<T> allocate(const std::string& label, std::size_t size) {
  return Array<T>(Kokkos::view_alloc(Kokkos::WithoutInitializing, "rockfold::" + label), size);
}

/// Room for n; what was there is lost where it grows, by half as much again, so that what comes and goes allocates seldom.
template <class T>
void grow(Array<T>& array, const char* label, std::size_t n) {
  if (array.extent(0) < n) array = allocate<T>(label, n + n / 2);
}

inline Field make_field(const std::string& label, Index covers) {
  return Field("rockfold::" + label, covers);
}

template <class T>
Array<T> to_device(const std::string& label, const std::vector<T>& host) {
  Array<T> result = allocate<T>(label, host.size());
  Kokkos::deep_copy(result, Unmanaged<T>(const_cast<T*>(host.data()), host.size()));
  return result;
}

template <class T>
std::vector<T> to_host(const Array<T>& array) {
  std::vector<T> host(array.extent(0));
  Kokkos::deep_copy(Unmanaged<T>(host.data(), host.size()), array);
  return host;
}

inline void copy_to_device(const std::vector<Vec3>& host, const Field& field) {
  const auto mirror = Kokkos::create_mirror_view(field);
  for (std::size_t p = 0; p < host.size(); ++p)
    for (int d = 0; d < 3; ++d) mirror(p, d) = host[p][d];
  Kokkos::deep_copy(field, mirror);
}

inline std::vector<Vec3> copy_to_host(const Field& field) {
  const auto mirror = Kokkos::create_mirror_view(field);
  Kokkos::deep_copy(mirror, field);
  std::vector<Vec3> host(field.extent(0));
  for (std::size_t p = 0; p < host.size(); ++p)
    for (int d = 0; d < 3; ++d) host[p][d] = mirror(p, d);
  return host;
}

}  // namespace rockfold::device
