// Seeds of streams of random numbers that have nothing in common, however close the numbers are that they follow from.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rockfold {

/// The bits of a number spread over 64, one to one: SplitMix64's step and finaliser (Steele, Lea & Flood, "Fast splittable
/// pseudorandom number generators", OOPSLA 2014, after Stafford's variant 13). Equal on all machines.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

/// What --seed gives a joint set, set 1 being the model's first. Below 2^53: a JSON reader has it exactly, and a model file may say
/// it. Of 10,000 networks of ten sets two draw one set alike with a probability of 6e-7: (1e5)²/2 pairs over 2^53.
constexpr std::uint64_t seed_of_set(std::uint64_t seed, std::size_t set) {
  return mixed(mixed(seed) + set) >> 11;
}

}  // namespace rockfold
