#include "src/sweep/sampling.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

#include <fmt/format.h>

#include "src/base/seeds.hpp"
#include "src/sweep/formula.hpp"
#include "src/sweep/statistics.hpp"

namespace rockfold::sweep {

namespace {

constexpr std::int64_t most_runs = 10'000'000;

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
  if (v.kind == Kind::exponential && v.mean < 0) return x < 0 ? std::exp(-x / v.mean) : 1;
  if (x <= 0) return 0;
  if (v.kind == Kind::weibull) return -std::expm1(-std::pow(x / v.scale, v.shape));
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

Real triangular_quantile(const Variable& v, Real u) {
  const Real width = v.max - v.min, left = v.mode - v.min, right = v.max - v.mode;
  return u * width < left ? v.min + std::sqrt(u * width * left)
                          : v.max - std::sqrt((1 - u) * width * right);
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

/// Of normal variables whose ranks have Spearman's correlation: Pearson's is 2 sin(π/6 of it) (Pearson 1907), and so that of a second one
/// made of the first and of one of its own.
Real correlated_share(Real rank, Real of_first, Real own) {
  const Real pearson = std::clamp(2 * std::sin(std::numbers::pi / 6 * rank), -1.0, 1.0);
  return normal_share(pearson * normal_quantile(of_first) +
                      std::sqrt(1 - pearson * pearson) * normal_quantile(own));
}

/// The place of each among all.
std::vector<Index> ranks_of(const std::vector<Real>& values) {
  std::vector<Index> order(values.size()), rank(values.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](Index a, Index b) { return values[a] < values[b]; });
  for (std::size_t k = 0; k < order.size(); ++k) rank[order[k]] = static_cast<Index>(k);
  return rank;
}

/// [runs] of one parameter: the share of its values that lies below the one that is drawn. `before`: of those before it.
std::vector<Real> drawn_shares(const SweepSpec& spec, std::size_t p,
                               const std::vector<std::vector<Real>>& before) {
  const auto& correlation = spec.parameters[p].correlation;
  const bool latin = spec.sampling == Sampling::latin_hypercube;
  std::vector<Real> share;
  for (Index r = 0; r < spec.runs; ++r) share.push_back(fraction(number(spec.seed, 2 * p, r)));
  const std::vector<Real> within = share;
  if (correlation)
    for (Index r = 0; r < spec.runs; ++r)
      share[r] = correlated_share(correlation->rank, before[correlation->with][r], share[r]);
  if (!latin) return share;
  const std::vector<Index> slice =
      correlation ? ranks_of(share) : shuffled(spec.runs, spec.seed, 2 * p + 1);
  for (Index r = 0; r < spec.runs; ++r) share[r] = (slice[r] + within[r]) / spec.runs;
  return share;
}

std::int64_t list_length(const Parameter& parameter) {
  const auto* list = std::get_if<std::vector<std::string>>(&parameter.values);
  return list == nullptr ? 1 : std::ssize(*list);
}

/// Of one run, in their order: each may use what stands before it.
void evaluate_expressions(const SweepSpec& spec, std::vector<std::string>& row) {
  std::map<std::string, Real> before;
  for (std::size_t p = 0; p < row.size(); ++p) {
    const Parameter& parameter = spec.parameters[p];
    if (const auto* expression = std::get_if<Expression>(&parameter.values))
      row[p] = fmt::format("{}", value_of(expression->formula, before));
    Real number = 0;
    const auto [end, fault] = std::from_chars(row[p].data(), row[p].data() + row[p].size(), number);
    if (fault == std::errc{} && is_name(parameter.key)) before[parameter.key] = number;
  }
}

std::vector<std::vector<std::string>> combinations(const SweepSpec& spec) {
  std::int64_t count = 1;
  for (const Parameter& p : spec.parameters) {
    count *= list_length(p);
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
      const auto* list = std::get_if<std::vector<std::string>>(&spec.parameters[p].values);
      if (list == nullptr) continue;
      rows[r][p] = (*list)[rest % std::ssize(*list)];
      rest /= std::ssize(*list);
    }
    evaluate_expressions(spec, rows[r]);
  }
  return rows;
}

Real real_quantile(const Variable& v, Real u) {
  using Kind = Variable::Kind;
  if (v.kind == Kind::constant) return v.mean;
  if (v.kind == Kind::uniform) return v.min + u * (v.max - v.min);
  if (v.kind == Kind::power_law) return power_law_quantile(v, u);
  if (v.kind == Kind::triangular) return triangular_quantile(v, u);
  if (v.kind == Kind::beta) return v.min + (v.max - v.min) * beta_quantile(v.alpha, v.beta, u);
  const Real low = share_below(v, v.min), high = share_below(v, v.max);
  const Real share = low + u * (high - low);
  Real x = 0;
  if (v.kind == Kind::normal) x = v.mean + v.standard_deviation * normal_quantile(share);
  if (v.kind == Kind::exponential)
    x = -v.mean * (v.mean > 0 ? std::log1p(-share) : std::log(share));
  if (v.kind == Kind::weibull) x = v.scale * std::pow(-std::log1p(-share), 1 / v.shape);
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
  std::vector<std::vector<Real>> shares;
  for (std::size_t p = 0; p < spec.parameters.size(); ++p) {
    shares.push_back(drawn_shares(spec, p, shares));
    if (std::holds_alternative<Expression>(spec.parameters[p].values)) continue;
    for (Index r = 0; r < spec.runs; ++r) rows[r][p] = text_at(spec.parameters[p], shares[p][r]);
  }
  for (auto& row : rows) evaluate_expressions(spec, row);
  return rows;
}

}  // namespace rockfold::sweep
