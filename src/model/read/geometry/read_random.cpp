#include "src/model/read/geometry/read_random.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/vector.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

/// Values outside [min, max] are drawn again: rarer ones would make the drawing last.
constexpr Real least_accepted = 1e-3;

/// Share of an exponential distribution up to x.
Real exponential_share(const Distribution& d, Real x) {
  return -std::expm1(-x / d.mean);
}

/// Likewise of a log-normal one: ln x is normal with variance ln(1 + (s/m)²), mean ln m − variance/2.
Real log_normal_share(const Distribution& d, Real x) {
  const Real ratio = d.standard_deviation / d.mean;
  const Real variance = std::log1p(ratio * ratio);
  const Real mean = std::log(d.mean) - variance / 2;
  return x > 0 ? std::erfc((mean - std::log(x)) / std::sqrt(2 * variance)) / 2 : 0;
}

Real accepted_share(const Distribution& d) {
  const auto share =
      d.kind == Distribution::Kind::exponential ? exponential_share : log_normal_share;
  return (std::isfinite(d.max) ? share(d, d.max) : 1) - share(d, d.min);
}

bool read_limits(TableReader& in, Distribution& d) {
  const bool power_law = d.kind == Distribution::Kind::power_law;
  const Need need = power_law ? Need::required : Need::optional;
  Range low = length();
  low.low_open = power_law;
  const bool min = in.read("min", d.min, low, need) || !in.has("min");
  const bool max = in.read("max", d.max, length(), need) || !in.has("max");
  if (!min || !max) return false;
  if (d.min < d.max) return true;
  in.wrong("max",
           "found " + number_text(d.max) + ", must be > min's " + number_text(d.min) + " (m)");
  return false;
}

/// The keys of the distribution's kind.
bool read_parameters(TableReader& in, Distribution& d) {
  using Kind = Distribution::Kind;
  if (d.kind == Kind::constant) return in.read("mean", d.mean, length());
  if (d.kind == Kind::power_law) {
    const bool exponent = in.read("exponent", d.exponent, positive(""));
    return read_limits(in, d) && exponent && in.has("min") && in.has("max");
  }
  const bool mean = in.read("mean", d.mean, length());
  const bool deviation =
      d.kind != Kind::log_normal || in.read("standard_deviation", d.standard_deviation, length());
  if (!read_limits(in, d) || !mean || !deviation) return false;
  if (accepted_share(d) >= least_accepted) return true;
  in.wrong(in.has("min") ? "min" : "max",
           "less than " + number_text(least_accepted) +
               " of the distribution's values lie between min and max; widen them");
  return false;
}

/// A number, or a table that says how it scatters.
bool read_distribution(TableReader& in, const std::string& key,
                       std::optional<Distribution>& target) {
  const auto* value = in.find(key);
  if (!value) return false;
  Distribution d;
  if (!std::holds_alternative<Table>(value->data)) {
    const auto* number = std::get_if<Array>(&value->data);
    const bool text = std::holds_alternative<std::string>(value->data);
    if (number || text) {
      in.wrong(key, "found " + described(*value) +
                        ", must be a number (m) or a table {distribution, mean, …}");
      return false;
    }
    const auto mean = real_from(*value, in.path_of(key), length(), in.out());
    if (!mean) return false;
    d.mean = *mean;
    target = d;
    return true;
  }
  TableReader table(*value, in.path_of(key), in.out());
  const auto kind =
      table.choose("distribution", {{"constant", "exponential", "log_normal", "power_law"}, {}});
  if (!kind) {
    table.give_up();
    return false;
  }
  d.kind = static_cast<Distribution::Kind>(*kind);
  if (!read_parameters(table, d)) return false;
  target = d;
  return true;
}

void read_seed(TableReader& in, std::uint64_t& seed) {
  const auto* value = in.find("seed");
  if (!value) return;
  const auto* number = std::get_if<std::int64_t>(&value->data);
  if (number && *number >= 0) {
    seed = static_cast<std::uint64_t>(*number);
  } else {
    in.wrong("seed", "found " + described(*value) + ", must be an integer >= 0");
  }
}

void read_scanline(TableReader& in, RandomSet& random) {
  const auto* value = in.find(
      "scanline", in.has("p10") ? "must be 2 points [[x, y, z], [x, y, z]] (m) for p10" : "");
  const auto ends =
      value ? two_points_from(*value, in.path_of("scanline"), "points", in.out()) : std::nullopt;
  if (value && !in.has("p10")) in.wrong("scanline", "belongs to p10, which is not given");
  if (!ends) return;
  random.scanline = *ends;
  if (norm((*ends)[1] - (*ends)[0]) == 0)
    in.wrong("scanline", "its two points are equal, must be the ends of a line");
}

/// How many joints there are: exactly one way to say it.
void read_amount(TableReader& in, bool discs, RandomSet& random) {
  std::vector<std::string> given;
  for (const char* key : {"spacing", "p32", "p10", "count"})
    if (in.has(key)) given.emplace_back(key);
  if (given.empty())
    in.missing({"", "spacing", "p32", "p10", "count"},
               "says not how many joints: must have one of spacing, p32, p10 or count");
  for (std::size_t i = 1; i < given.size(); ++i)
    in.wrong(given[i],
             "has both " + given[0] + " and " + given[i] +
                 ", must have one of spacing, p32, p10 or count" +
                 (given[0] == "spacing" && given[i] == "count"
                      ? "; the count of joints at random spacings stands in the set itself"
                      : ""));
  read_distribution(in, "spacing", random.spacing);
  in.read("p32", random.p32, positive("m2/m3"));
  in.read("p10", random.p10, positive("1/m"));
  Index count = 0;
  if (in.read("count", count, IntegerRange{.low = 1}, Need::optional)) random.count = count;
  if (in.choose("location", {{"uniform"}, {}}, Need::optional) && in.has("spacing"))
    in.wrong("location", "belongs to p32, p10 and count: spacing itself says where joints lie");
  if (!discs && given.size() == 1 && given[0] != "spacing")
    in.wrong(given[0], "needs a radius: planes without one are given by spacing");
}

}  // namespace

RandomSet read_random(TableReader& set, std::uint64_t default_seed) {
  RandomSet random;
  random.seed = default_seed;
  TableReader in(*set.find("random"), set.path_of("random"), set.out());
  if (!in.is_table()) return random;
  read_seed(in, random.seed);
  in.read("fisher_kappa", random.fisher_kappa, positive(""), Need::optional);
  read_distribution(in, "radius", random.radius);
  read_amount(in, set.has("radius") || in.has("radius"), random);
  read_scanline(in, random);
  return random;
}

}  // namespace rockfold
