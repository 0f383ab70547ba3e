#include "src/base/sha256.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

namespace rockfold {

namespace {

constexpr std::array<int, 64> primes{
    2,   3,   5,   7,   11,  13,  17,  19,  23,  29,  31,  37,  41,  43,  47,  53,
    59,  61,  67,  71,  73,  79,  83,  89,  97,  101, 103, 107, 109, 113, 127, 131,
    137, 139, 149, 151, 157, 163, 167, 173, 179, 181, 191, 193, 197, 199, 211, 223,
    227, 229, 233, 239, 241, 251, 257, 263, 269, 271, 277, 281, 283, 293, 307, 311};

/// The first 32 bits of the fraction of a root below 18: 37 of the 53 bits that doubles have.
std::uint32_t fraction_bits(double root) {
  return static_cast<std::uint32_t>(std::ldexp(root - std::floor(root), 32));
}

/// FIPS 180-4 §4.2.2: from the cube roots of the first 64 primes.
std::array<std::uint32_t, 64> round_constants() {
  std::array<std::uint32_t, 64> k{};
  for (std::size_t i = 0; i < k.size(); ++i) k[i] = fraction_bits(std::cbrt(primes[i]));
  return k;
}

std::uint32_t rotations(std::uint32_t x, int a, int b, int c) {
  return std::rotr(x, a) ^ std::rotr(x, b) ^ std::rotr(x, c);
}

using State = std::array<std::uint32_t, 8>;

/// §6.2.2, of one block of 64 bytes.
void digest(State& state, std::string_view block) {
  static const auto k = round_constants();
  std::array<std::uint32_t, 64> w{};
  for (std::size_t t = 0; t < 64; ++t)
    if (t < 16)
      for (std::size_t i = 0; i < 4; ++i)
        w[t] = w[t] << 8 | static_cast<unsigned char>(block[4 * t + i]);
    else
      w[t] = (std::rotr(w[t - 2], 17) ^ std::rotr(w[t - 2], 19) ^ w[t - 2] >> 10) + w[t - 7] +
             (std::rotr(w[t - 15], 7) ^ std::rotr(w[t - 15], 18) ^ w[t - 15] >> 3) + w[t - 16];
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t t = 0; t < 64; ++t) {
    const std::uint32_t one = h + rotations(e, 6, 11, 25) + ((e & f) ^ (~e & g)) + k[t] + w[t];
    const std::uint32_t two = rotations(a, 2, 13, 22) + ((a & b) ^ (a & c) ^ (b & c));
    h = g, g = f, f = e, e = d + one, d = c, c = b, b = a, a = one + two;
  }
  const State last{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < 8; ++i) state[i] += last[i];
}

/// §5.1.1: a one, zeros, and the length in bits, to a multiple of 64 bytes.
std::string padded(std::string_view text) {
  std::string all(text);
  all += '\x80';
  while (all.size() % 64 != 56) all += '\0';
  const std::uint64_t bits = 8 * static_cast<std::uint64_t>(text.size());
  for (int shift = 56; shift >= 0; shift -= 8) all += static_cast<char>(bits >> shift & 0xFF);
  return all;
}

}  // namespace

std::string sha256(std::string_view text) {
  State state{};  // §5.3.3: from the square roots of the first eight primes
  for (std::size_t i = 0; i < 8; ++i) state[i] = fraction_bits(std::sqrt(primes[i]));
  const std::string all = padded(text);
  for (std::size_t i = 0; i < all.size(); i += 64)
    digest(state, std::string_view(all).substr(i, 64));
  std::string digits;
  for (const std::uint32_t word : state)
    for (int shift = 28; shift >= 0; shift -= 4) digits += "0123456789abcdef"[word >> shift & 0xF];
  return digits;
}

}  // namespace rockfold
