#include "host/keyblock/theory/monte_carlo.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>

#include <fmt/format.h>

#include "host/joints/disc.hpp"
#include "host/joints/random_stream.hpp"
#include "host/keyblock/theory/tunnel_block.hpp"
#include "host/parallel.hpp"
#include "host/refuse.hpp"
#include "src/base/seeds.hpp"
#include "src/base/sum.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr std::size_t most_planes = 20'000;  // of a set in a realisation

/// What is drawn of a set, and how.
struct SetLaw {
  PlaneFrame frame;
  Real kappa = 0;  ///< infinite: no scatter
  Distribution spacing;
  Real friction_angle = 0;  ///< deg
  Real friction_deviation = 0;
  Distribution cohesion;  ///< mean 0: none
  std::string name;
};

/// A set in one realisation.
struct DrawnSet {
  TheorySet set;
  std::vector<Real> planes;  ///< n·x, ascending
};

/// The box in which apexes are looked for, along the frame's axes.
struct Window {
  Real reach = 0, length = 0;

  /// Half the extent of n·x in it, and its middle.
  std::pair<Real, Real> along(const TunnelFrame& frame, const Vec3& n) const {
    const Real axial = dot(n, frame.axis) * length / 2;
    return {axial,
            std::abs(axial) + reach * (std::abs(dot(n, frame.right)) + std::abs(dot(n, frame.up)))};
  }
};

/// Standard normal, by Box & Muller; two uniform numbers.
Real draw_normal(RandomStream& random) {
  const Real u = random.uniform(), v = random.uniform();
  return std::sqrt(-2 * std::log1p(-u)) * std::cos(2 * std::numbers::pi * v);
}

DrawnSet draw_set(const SetLaw& law, const TunnelFrame& frame, const Window& window,
                  RandomStream& random) {
  DrawnSet drawn;
  drawn.set.name = law.name;
  drawn.set.upward = std::isinf(law.kappa) ? law.frame.normal
                                           : normalized(draw_fisher(law.frame, law.kappa, random));
  Real angle = law.friction_angle;
  if (law.friction_deviation > 0) {
    do angle = law.friction_angle + law.friction_deviation * draw_normal(random);
    while (angle < 0 || angle >= 89);
  }
  drawn.set.friction = std::tan(angle * std::numbers::pi / 180);
  drawn.set.cohesion = law.cohesion.mean > 0 ? draw(law.cohesion, random) : 0;
  const auto [middle, half] = window.along(frame, drawn.set.upward);
  Real at = middle - half - random.uniform() * draw(law.spacing, random);
  while (at <= middle + half && drawn.planes.size() <= most_planes) {
    if (at >= middle - half) drawn.planes.push_back(at);
    at += draw(law.spacing, random);
  }
  return drawn;
}

struct Interval {
  Real low = -std::numeric_limits<Real>::infinity();
  Real high = std::numeric_limits<Real>::infinity();

  /// Keeps t with at + rate t ≥ 0.
  void keep(Real at, Real rate) {
    if (rate > 0)
      low = std::max(low, -at / rate);
    else if (rate < 0)
      high = std::min(high, -at / rate);
    else if (at < 0)
      high = -std::numeric_limits<Real>::infinity();
  }
};

/// The apexes of one joint pyramid of three drawn sets: where one plane of each meet.
class ApexSearch {
 public:
  ApexSearch(const TunnelFrame& frame, const Window& window,
             const std::array<const DrawnSet*, 3>& sets, const std::array<Real, 3>& sides)
      : frame_(frame), window_(window), sets_(sets), sides_(sides) {
    // The set with most planes last: its planes are searched, those of the others tried.
    for (std::size_t i = 0; i < 2; ++i)
      if (sets_[i]->planes.size() > sets_[2]->planes.size()) {
        std::swap(sets_[i], sets_[2]);
        std::swap(sides_[i], sides_[2]);
      }
    const Vec3 &a = normal(0), &b = normal(1), &c = normal(2);
    const Real determinant = dot(a, cross(b, c));
    basis_ = {(1 / determinant) * cross(b, c), (1 / determinant) * cross(c, a),
              (1 / determinant) * cross(a, b)};
  }

  /// The largest finite block.
  std::optional<TheoryShape> largest(const TunnelPyramid& pyramid) const {
    std::optional<TheoryShape> best;
    for (const Real first : planes_near(0, pyramid))
      for (const Real second : planes_near(1, pyramid)) {
        const auto apex = farthest(pyramid, first * basis_[0] + second * basis_[1]);
        if (!apex) continue;
        auto shape = pyramid.block_at(*apex);
        if (shape && (!best || shape->volume > best->volume)) best = std::move(shape);
      }
    return best;
  }

 private:
  const Vec3& normal(std::size_t i) const { return sets_[i]->set.upward; }

  /// The planes of a set that come between the maximum block's apex and the section.
  std::span<const Real> planes_near(std::size_t i, const TunnelPyramid& pyramid) const {
    const Vec3& n = normal(i);
    const Real axial = dot(n, frame_.axis) * window_.length;
    const auto at = [&](const Point2& q) { return dot(n, frame_.lifted(q)); };
    Real low = at(pyramid.apex()), high = low;
    for (const Point2& q : frame_.section) {
      low = std::min(low, at(q));
      high = std::max(high, at(q));
    }
    const auto& planes = sets_[i]->planes;
    const auto begin = std::lower_bound(planes.begin(), planes.end(), low + std::min(0.0, axial));
    const auto end = std::upper_bound(begin, planes.end(), high + std::max(0.0, axial));
    return {begin, end};
  }

  /// On the line through `base`, the apex of the largest block: in the window, and not beyond the
  /// maximum block's.
  std::optional<Point2> farthest(const TunnelPyramid& pyramid, const Vec3& base) const {
    const Point2 p = frame_.flat(base), d = frame_.flat(basis_[2]);
    Interval t;
    const Real axial = dot(base, frame_.axis), rate = dot(basis_[2], frame_.axis);
    t.keep(axial, rate);
    t.keep(window_.length - axial, -rate);
    for (std::size_t k = 0; k < 2; ++k) {
      t.keep(window_.reach - p[k], -d[k]);
      t.keep(window_.reach + p[k], d[k]);
    }
    const auto turn = [](const Point2& a, const Point2& b) { return a[0] * b[1] - a[1] * b[0]; };
    const auto& [first, last] = pyramid.sides();
    t.keep(turn(first, p) - pyramid.limits()[0], turn(first, d));
    t.keep(pyramid.limits()[1] - turn(last, p), -turn(last, d));
    if (!(t.low <= t.high)) return {};
    const auto& planes = sets_[2]->planes;
    if (sides_[2] > 0) {
      const auto above = std::upper_bound(planes.begin(), planes.end(), t.high);
      if (above == planes.begin() || *(above - 1) < t.low) return {};
      return Point2{p[0] + *(above - 1) * d[0], p[1] + *(above - 1) * d[1]};
    }
    const auto at = std::lower_bound(planes.begin(), planes.end(), t.low);
    if (at == planes.end() || *at > t.high) return {};
    return Point2{p[0] + *at * d[0], p[1] + *at * d[1]};
  }

  const TunnelFrame& frame_;
  Window window_;
  std::array<const DrawnSet*, 3> sets_;
  std::array<Real, 3> sides_;  ///< of the outward normals along the sets' own
  std::array<Vec3, 3> basis_{};
};

/// What one realisation has shown of a pyramid that has a finite block.
struct Found {
  std::size_t code;
  bool key;
  Real volume, support_force, support_pressure;
};

class Simulation {
 public:
  Simulation(const Model& model, const TheoryTunnel& tunnel, const MonteCarloSpec& spec);
  std::vector<Found> realise(std::uint64_t number) const;
  const std::vector<std::string>& codes() const { return codes_; }
  const Window& window() const { return window_; }

 private:
  const MonteCarloSpec& spec_;
  const TheoryTunnel& tunnel_;
  TunnelFrame frame_;
  TheoryLoads loads_;
  Window window_;
  std::vector<SetLaw> laws_;
  std::vector<std::string> codes_;
};

Distribution spacing_law(const JointSet& set) {
  if (set.random && !set.random->spacing)
    refuse(set.place, set.place.key + ".random.spacing",
           "is missing: a Monte Carlo simulation needs the spacing of each set (m)");
  if (set.random) return *set.random->spacing;
  Distribution constant;
  constant.mean = set.spacing;
  return constant;
}

Simulation::Simulation(const Model& model, const TheoryTunnel& tunnel, const MonteCarloSpec& spec)
    : spec_(spec),
      tunnel_(tunnel),
      frame_(tunnel_frame(tunnel.trend, tunnel.plunge, tunnel.section)),
      loads_(theory_loads(model)) {
  if (!is_convex(tunnel.section))
    refuse(tunnel.place, tunnel.place.key + ".section",
           "has an inward corner: a Monte Carlo simulation needs a convex section");
  Real extent = 0;
  for (const Point2& q : tunnel.section)
    extent = std::max({extent, std::abs(q[0]), std::abs(q[1])});
  window_ = {spec.reach.value_or(5 * extent), spec.length};
  for (const JointSet& set : model.joint_sets) {
    SetLaw law;
    law.frame = plane_frame(set.orientation);
    law.kappa = set.random ? set.random->fisher_kappa : std::numeric_limits<Real>::infinity();
    law.spacing = spacing_law(set);
    law.friction_deviation = spec.friction_deviation;
    law.name = set.name;
    if (set.material != none) {
      const auto& joint = model.joint_materials[static_cast<std::size_t>(set.material)];
      law.friction_angle = joint.friction_angle;
      law.cohesion.mean = joint.cohesion;
    }
    law.cohesion.standard_deviation = spec.cohesion_variation * law.cohesion.mean;
    if (law.cohesion.standard_deviation > 0) law.cohesion.kind = Distribution::Kind::log_normal;
    laws_.push_back(std::move(law));
  }
  if (laws_.size() >= 3) codes_ = codes_of(laws_.size(), 3);
}

std::vector<Found> Simulation::realise(std::uint64_t number) const {
  RandomStream random(mixed(mixed(spec_.seed) + number));
  std::vector<DrawnSet> drawn;
  std::vector<TheorySet> sets;
  for (const SetLaw& law : laws_) {
    drawn.push_back(draw_set(law, frame_, window_, random));
    if (drawn.back().planes.size() > most_planes)
      refuse(spec_.place, spec_.place.key + ".reach",
             fmt::format("more than {} joints of \"{}\" lie within {:g} m of tunnel \"{}\": the "
                         "spacing is too small, or reach and length are too large",
                         most_planes, law.name, window_.reach, tunnel_.name));
    sets.push_back(drawn.back().set);
  }
  const auto upward = upward_normals(sets);
  std::vector<Found> found;
  for (std::size_t c = 0; c < codes_.size(); ++c) {
    const auto normals = joint_pyramid(upward, codes_[c]);
    const auto pyramid = TunnelPyramid::make(frame_, normals);
    if (!pyramid) continue;
    const auto used = sets_of(codes_[c]);
    std::array<const DrawnSet*, 3> of{};
    std::array<Real, 3> sides{};
    for (std::size_t i = 0; i < 3; ++i) {
      of[i] = &drawn[used[i]];
      sides[i] = codes_[c][used[i]] == '1' ? 1 : -1;
    }
    const auto shape = ApexSearch(frame_, window_, of, sides).largest(*pyramid);
    if (!shape) continue;
    const TheoryBlock block = judge_theory_block(sets, codes_[c], *shape, loads_);
    found.push_back({c, block.key, shape->volume, block.support_force, block.support_pressure});
  }
  return found;
}

/// z of a two-sided confidence, by bisection of the normal distribution function.
Real normal_quantile(Real confidence) {
  Real low = 0, high = 40;
  for (int i = 0; i < 200; ++i) {
    const Real middle = (low + high) / 2;
    (std::erf(middle / std::numbers::sqrt2) < confidence ? low : high) = middle;
  }
  return (low + high) / 2;
}

}  // namespace

Probability probability(Index count, Index of, Real confidence) {
  const Real n = of, z = normal_quantile(confidence), p = count / n;
  const Real middle = (p + z * z / (2 * n)) / (1 + z * z / n);
  const Real half = z / (1 + z * z / n) * std::sqrt(p * (1 - p) / n + z * z / (4 * n * n));
  return {count, p, count == 0 ? 0 : std::max(0.0, middle - half),
          count == of ? 1 : std::min(1.0, middle + half)};
}

SampleDistribution distribution(std::vector<Real> sample, Real confidence) {
  constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();
  SampleDistribution d;
  d.count = static_cast<Index>(sample.size());
  if (sample.empty()) return d;
  std::sort(sample.begin(), sample.end());
  const Real n = static_cast<Real>(sample.size()), z = normal_quantile(confidence);
  Sum sum, squares;
  for (const Real x : sample) sum += x;
  d.mean = sum.value() / n;
  for (const Real x : sample) squares += (x - d.mean) * (x - d.mean);
  d.deviation = sample.size() > 1 ? std::sqrt(squares.value() / (n - 1)) : 0;
  d.mean_low = d.mean - z * d.deviation / std::sqrt(n);
  d.mean_high = d.mean + z * d.deviation / std::sqrt(n);
  d.least = sample.front();
  d.greatest = sample.back();
  for (const Real p : {0.05, 0.25, 0.5, 0.75, 0.9, 0.95, 0.99}) {
    const auto ranked = [&](Real rank) {  // the rank-th smallest, from 1
      return rank < 1 || rank > n ? unknown : sample[static_cast<std::size_t>(rank) - 1];
    };
    const Real spread = z * std::sqrt(n * p * (1 - p));
    d.quantiles.push_back({p, ranked(std::max(1.0, std::ceil(n * p - 1e-9))),
                           ranked(std::floor(n * p - spread)),
                           ranked(std::ceil(n * p + spread) + 1)});
  }
  return d;
}

MonteCarloResult simulate_tunnel(const Model& model, const TheoryTunnel& tunnel,
                                 const MonteCarloSpec& spec) {
  const Simulation simulation(model, tunnel, spec);
  std::vector<std::vector<Found>> found(static_cast<std::size_t>(spec.realisations));
  parallel_for(spec.realisations, 16, [&](std::int64_t i) {
    found[static_cast<std::size_t>(i)] = simulation.realise(static_cast<std::uint64_t>(i));
  });

  const std::size_t codes = simulation.codes().size();
  std::vector<Index> with_block(codes, 0), with_key(codes, 0);
  std::vector<std::vector<Real>> volumes(codes);
  std::vector<Real> counts, largest, pressures, forces;
  Index any = 0;
  for (const auto& realisation : found) {
    Real count = 0, volume = 0, pressure = 0, force = 0;
    for (const Found& f : realisation) {
      ++with_block[f.code];
      if (!f.key) continue;
      ++with_key[f.code];
      volumes[f.code].push_back(f.volume);
      ++count;
      volume = std::max(volume, f.volume);
      pressure = std::max(pressure, f.support_pressure);
      force += f.support_force;
    }
    counts.push_back(count);
    if (count == 0) continue;
    ++any;
    largest.push_back(volume);
    pressures.push_back(pressure);
    forces.push_back(force);
  }
  MonteCarloResult result;
  result.realisations = spec.realisations;
  result.seed = spec.seed;
  result.length = simulation.window().length;
  result.reach = simulation.window().reach;
  result.key = probability(any, spec.realisations, spec.confidence);
  for (std::size_t c = 0; c < codes; ++c)
    result.pyramids.push_back({simulation.codes()[c],
                               probability(with_block[c], spec.realisations, spec.confidence),
                               probability(with_key[c], spec.realisations, spec.confidence),
                               distribution(volumes[c], spec.confidence)});
  result.key_blocks = distribution(counts, spec.confidence);
  result.largest_volume = distribution(largest, spec.confidence);
  result.support_pressure = distribution(pressures, spec.confidence);
  result.support_force = distribution(forces, spec.confidence);
  return result;
}

}  // namespace rockfold
