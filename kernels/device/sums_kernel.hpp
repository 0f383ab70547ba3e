// Sums that do not depend on the number of threads: chunks of fixed length are summed each in a fixed order,
// then the chunks' sums in a fixed order. (A parallel_reduce over all threads would round differently for each count.)
#pragma once

#include "kernels/device/device_kernel.hpp"

namespace rockfold::device {

/// K sums side by side.
template <int K>
struct Sums {
  Real value[K];
  KOKKOS_INLINE_FUNCTION Sums() {
    for (int k = 0; k < K; ++k) value[k] = 0;
  }
  KOKKOS_INLINE_FUNCTION Sums& operator+=(const Sums& other) {
    for (int k = 0; k < K; ++k) value[k] += other.value[k];
    return *this;
  }
};

/// Items of a chunk. Part of the result's definition: another length rounds differently.
inline constexpr Index chunk_length = 1024;

inline Index chunk_count(Index n) {
  return (n + chunk_length - 1) / chunk_length;
}

/// The sum of one chunk. On a core four interleaved sums hide the latency of an addition.
template <int K, class Add>
KOKKOS_INLINE_FUNCTION Sums<K> sum_of_chunk(Index begin, Index end, const Add& add) {
  Sums<K> lane[4];
  Index i = begin;
  for (; i + 4 <= end; i += 4)
    for (int l = 0; l < 4; ++l) add(i + l, lane[l]);
  for (int l = 0; i < end; ++i, ++l) add(i, lane[l]);
  lane[0] += lane[1];
  lane[2] += lane[3];
  return lane[0] += lane[2];
}

#ifdef ROCKFOLD_ON_GPU
}  // namespace rockfold::device
namespace Kokkos {
template <int K>
struct reduction_identity<rockfold::device::Sums<K>> {
  KOKKOS_FORCEINLINE_FUNCTION static rockfold::device::Sums<K> sum() { return {}; }
};
}  // namespace Kokkos
namespace rockfold::device {

/// On a GPU: a team of fixed size for each chunk, whose tree of additions is fixed too.
inline constexpr int team_size = 128;

template <int K, class Add>
void sum_chunks(const std::string& label, Index n, const Array<Real>& partial, const Add& add) {
  using Team = Kokkos::TeamPolicy<Exec>;
  Kokkos::parallel_for(
      label, Team(chunk_count(n), team_size), KOKKOS_LAMBDA(const Team::member_type& team) {
        const Index begin = team.league_rank() * chunk_length;
        const Index end = begin + chunk_length < n ? begin + chunk_length : n;
        Sums<K> total;
        Kokkos::parallel_reduce(
            Kokkos::TeamThreadRange(team, begin, end),
            [&](const Index i, Sums<K>& sum) { add(i, sum); }, Kokkos::Sum<Sums<K>>(total));
        Kokkos::single(Kokkos::PerTeam(team), [&] {
          for (int k = 0; k < K; ++k) partial(team.league_rank() * K + k) = total.value[k];
        });
      });
}

template <int K, class Then>
void sum_partials(const std::string& label, Index chunks, const Array<Real>& partial,
                  const Then& then) {
  using Team = Kokkos::TeamPolicy<Exec>;
  Kokkos::parallel_for(
      label, Team(1, team_size), KOKKOS_LAMBDA(const Team::member_type& team) {
        Sums<K> total;
        Kokkos::parallel_reduce(
            Kokkos::TeamThreadRange(team, 0, chunks),
            [&](const Index c, Sums<K>& sum) {
              for (int k = 0; k < K; ++k) sum.value[k] += partial(c * K + k);
            },
            Kokkos::Sum<Sums<K>>(total));
        Kokkos::single(Kokkos::PerTeam(team), [&] { then(total); });
      });
}

#else

template <int K, class Add>
void sum_chunks(const std::string& label, Index n, const Array<Real>& partial, const Add& add) {
  const auto sum_one = KOKKOS_LAMBDA(const Index c) {
    const Index begin = c * chunk_length;
    const Index end = begin + chunk_length < n ? begin + chunk_length : n;
    const Sums<K> sum = sum_of_chunk<K>(begin, end, add);
    for (int k = 0; k < K; ++k) partial(c * K + k) = sum.value[k];
  };
  if (chunk_count(n) == 1)
    sum_one(0);
  else
    Kokkos::parallel_for(label, Range(0, chunk_count(n)), sum_one);
}

template <int K, class Then>
void sum_partials(const std::string&, Index chunks, const Array<Real>& partial, const Then& then) {
  Exec().fence();
  Sums<K> total;
  for (Index c = 0; c < chunks; ++c)
    for (int k = 0; k < K; ++k) total.value[k] += partial(c * K + k);
  then(total);
}

#endif

/// Runs add(i, sums) for all i < n (it may also write item i), then then(total) once, on the device.
/// `partial` is work space of K·chunk_count(n) numbers.
template <int K, class Add, class Then>
void sum_then(const std::string& label, Index n, const Array<Real>& partial, const Add& add,
              const Then& then) {
  sum_chunks<K>(label, n, partial, add);
  sum_partials<K>(label + "_total", chunk_count(n), partial, then);
}

}  // namespace rockfold::device
