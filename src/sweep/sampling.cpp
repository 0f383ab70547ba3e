#include "src/sweep/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace rockfold::sweep {

namespace {

constexpr std::int64_t most_runs = 10'000'000;

/// SplitMix64 (Steele, Lea & Flood 2014): equal on all machines.
std::uint64_t mixed(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27)) * 0x94d049bb133111eb;
  return x ^ (x >> 31);
}

/// The n-th number of a stream.
std::uint64_t number(std::uint64_t seed, std::uint64_t stream, std::uint64_t n) {
  return mixed(mixed(mixed(seed) + stream) + n);
}

/// In (0, 1).
Real fraction(std::uint64_t bits) {
  return (static_cast<Real>(bits >> 11) + 0.5) * 0x1p-53;
}

Real normal_share(Real z) {
  return std::erfc(-z / std::sqrt(2.0)) / 2;
}

/// By halving: 80 halvings of [−40, 40] are below rounding.
Real normal_quantile(Real share) {
  Real low = -40, high = 40;
  for (int i = 0; i < 80; ++i) {
    const Real middle = (low + high) / 2;
    (normal_share(middle) < share ? low : high) = middle;
  }
  return (low + high) / 2;
}

/// ln x is normal: its mean and deviation.
std::pair<Real, Real> of_logarithm(const Variable& v) {
  const Real ratio = v.standard_deviation / v.mean, variance = std::log1p(ratio * ratio);
  return {std::log(v.mean) - variance / 2, std::sqrt(variance)};
}

/// Share of all values below x.
Real share_below(const Variable& v, Real x) {
  using Kind = Variable::Kind;
  if (std::isinf(x)) return x > 0 ? 1 : 0;
  if (v.kind == Kind::normal) return normal_share((x - v.mean) / v.standard_deviation);
  if (x <= 0) return 0;
  if (v.kind == Kind::exponential) return -std::expm1(-x / v.mean);
  const auto [mean, deviation] = of_logarithm(v);
  return normal_share((std::log(x) - mean) / deviation);
}

Real power_law_quantile(const Variable& v, Real u) {
  const Real power = 1 - v.exponent;
  if (power == 0) return v.min * std::pow(v.max / v.min, u);
  const Real low = std::pow(v.min, power), high = std::pow(v.max, power);
  return std::pow(low + u * (high - low), 1 / power);
}

/// The order of the slices of one parameter (Fisher & Yates).
std::vector<Index> shuffled(Index count, std::uint64_t seed, std::uint64_t stream) {
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), 0);
  for (Index i = count - 1; i > 0; --i)
    std::swap(order[i], order[number(seed, stream, i) % static_cast<std::uint64_t>(i + 1)]);
  return order;
}

std::string text_at(const Parameter& parameter, Real u) {
  if (const auto* v = std::get_if<Variable>(&parameter.values))
    return v->integer ? fmt::format("{:.0f}", quantile(*v, u)) : fmt::format("{}", quantile(*v, u));
  const auto& list = std::get<std::vector<std::string>>(parameter.values);
  const auto i = static_cast<std::size_t>(u * static_cast<Real>(list.size()));
  return list[std::min(i, list.size() - 1)];
}

std::vector<std::vector<std::string>> combinations(const SweepSpec& spec) {
  std::int64_t count = 1;
  for (const Parameter& p : spec.parameters) {
    count *= std::ssize(std::get<std::vector<std::string>>(p.values));
    if (count > most_runs)
      throw Error(ErrorKind::model,
                  fmt::format("has more than {} combinations: draw some of them, by sampling = "
                              "\"latin_hypercube\"",
                              most_runs),
                  Place{spec.path, 0, 0, "parameter"});
  }
  std::vector<std::vector<std::string>> rows(count);
  for (std::int64_t r = 0; r < count; ++r) {
    rows[r].resize(spec.parameters.size());
    std::int64_t rest = r;
    for (std::size_t p = spec.parameters.size(); p-- > 0;) {
      const auto& list = std::get<std::vector<std::string>>(spec.parameters[p].values);
      rows[r][p] = list[rest % std::ssize(list)];
      rest /= std::ssize(list);
    }
  }
  return rows;
}

Real real_quantile(const Variable& v, Real u) {
  using Kind = Variable::Kind;
  if (v.kind == Kind::constant) return v.mean;
  if (v.kind == Kind::uniform) return v.min + u * (v.max - v.min);
  if (v.kind == Kind::power_law) return power_law_quantile(v, u);
  const Real low = share_below(v, v.min), high = share_below(v, v.max);
  const Real share = low + u * (high - low);
  Real x = 0;
  if (v.kind == Kind::normal) x = v.mean + v.standard_deviation * normal_quantile(share);
  if (v.kind == Kind::exponential) x = -v.mean * std::log1p(-share);
  if (v.kind == Kind::log_normal) {
    const auto [mean, deviation] = of_logarithm(v);
    x = std::exp(mean + deviation * normal_quantile(share));
  }
  return std::clamp(x, v.min, v.max);
}

}  // namespace

Real quantile(const Variable& v, Real u) {
  if (!v.integer) return real_quantile(v, u);
  if (v.kind == Variable::Kind::uniform)
    return std::min(v.min + std::floor(u * (v.max - v.min + 1)), v.max);
  return std::round(real_quantile(v, u));
}

std::vector<std::vector<std::string>> sample(const SweepSpec& spec) {
  if (spec.sampling == Sampling::all) return combinations(spec);
  std::vector<std::vector<std::string>> rows(spec.runs,
                                             std::vector<std::string>(spec.parameters.size()));
  for (std::size_t p = 0; p < spec.parameters.size(); ++p) {
    const bool latin = spec.sampling == Sampling::latin_hypercube;
    const std::vector<Index> slice =
        latin ? shuffled(spec.runs, spec.seed, 2 * p + 1) : std::vector<Index>{};
    for (Index r = 0; r < spec.runs; ++r) {
      const Real within = fraction(number(spec.seed, 2 * p, r));
      rows[r][p] = text_at(spec.parameters[p], latin ? (slice[r] + within) / spec.runs : within);
    }
  }
  return rows;
}

}  // namespace rockfold::sweep
