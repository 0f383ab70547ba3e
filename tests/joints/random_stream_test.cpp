// The generator, the distributions and Fisher's orientations against closed forms, and golden numbers.
#include "host/joints/random_stream.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "host/exact/correctly_rounded.hpp"
#include "host/joints/radius_near_box.hpp"
#include "src/base/seeds.hpp"
#include "src/base/vector.hpp"
#include "tests/joints/statistics.hpp"

namespace rockfold::test {
namespace {

using std::numbers::pi;
constexpr Real infinite = std::numeric_limits<Real>::infinity();
constexpr std::size_t sample_size = 40'000;

Distribution exponential(Real mean, Real min = 0, Real max = infinite) {
  return {Distribution::Kind::exponential, mean, 0, 0, min, max};
}
Distribution log_normal_of(Real mean, Real deviation, Real min = 0, Real max = infinite) {
  return {Distribution::Kind::log_normal, mean, deviation, 0, min, max};
}
Distribution power_law(Real exponent, Real min, Real max) {
  return {Distribution::Kind::power_law, 0, 0, exponent, min, max};
}

std::vector<Real> sample(const Distribution& distribution, std::uint64_t seed) {
  RandomStream random(seed);
  std::vector<Real> x(sample_size);
  for (Real& value : x) value = draw(distribution, random);
  return x;
}

TEST(RandomStream, IsTheGeneratorThatTheStandardFixes) {
  // ISO C++ [rand.predef]: the 10,000th number of a default-constructed mt19937_64.
  std::mt19937_64 engine;
  engine.discard(9999);
  const std::uint64_t last = engine();
  EXPECT_EQ(last, 9981545732273789042u);
  RandomStream random(5489);  // the default seed
  Real u = 0;
  for (int i = 0; i < 10'000; ++i) u = random.uniform();
  EXPECT_EQ(u, static_cast<Real>(last >> 11) / 9007199254740992.0);
}

TEST(Mixed, GivesTheFirstNumbersOfSplitMix64) {
  // From state 0, as its authors' program prints them: each step adds the odd constant and mixes.
  constexpr std::uint64_t step = 0x9E3779B97F4A7C15u;
  EXPECT_EQ(mixed(0), 0xE220A8397B1DCDAFu);
  EXPECT_EQ(mixed(step), 0x6E789E6AA1B965F4u);
  EXPECT_EQ(mixed(2 * step), 0x06C45D188009454Fu);
}

TEST(SeedOfSet, IsOfNoOtherSetOfAThousandNetworks) {
  std::set<std::uint64_t> seeds;
  for (std::uint64_t seed = 0; seed < 1000; ++seed)
    for (std::size_t k = 1; k <= 10; ++k) {
      EXPECT_LT(seed_of_set(seed, k), std::uint64_t{1} << 53);
      seeds.insert(seed_of_set(seed, k));
    }
  EXPECT_EQ(seeds.size(), 10'000u);
}

TEST(RandomStream, GivesUniformNumbers) {
  RandomStream random(7);
  std::vector<Real> x(sample_size);
  for (Real& value : x) value = random.uniform();
  expect_distribution(x, [](Real u) { return u; });
}

TEST(CorrectlyRounded, FunctionsAreWithinHalfAUnitOfTheLastPlace) {
  // Digits by hand-held arithmetic of 40 digits, rounded to nearest.
  EXPECT_EQ(correctly_rounded::exp(1), 2.718281828459045235360287);
  EXPECT_EQ(correctly_rounded::log(10), 2.302585092994045684017991);
  EXPECT_EQ(correctly_rounded::expm1(0.5), 0.6487212707001281468486508);
  EXPECT_EQ(correctly_rounded::log1p(1), 0.6931471805599453094172321);
  EXPECT_EQ(correctly_rounded::sin(1), 0.8414709848078965066525023);
  EXPECT_EQ(correctly_rounded::cos(1), 0.5403023058681397174009366);
}

TEST(Distributions, ConstantUsesNoRandomNumbers) {
  RandomStream random(3), untouched(3);
  Distribution constant;
  constant.mean = 2.5;
  EXPECT_EQ(draw(constant, random), 2.5);
  EXPECT_EQ(random.uniform(), untouched.uniform());
}

TEST(Distributions, ExponentialHasItsMeanVarianceAndQuantiles) {
  const auto x = sample(exponential(3), 1);
  expect_mean(x, 3, 9);
  expect_variance(x, 9, 9);
  expect_distribution(x, [](Real r) { return 1 - std::exp(-r / 3); });
}

TEST(Distributions, LogNormalHasTheMeanAndDeviationOfTheValuesThemselves) {
  const auto x = sample(log_normal_of(2, 1.5), 2);
  const Real s2 = std::log(1 + 1.5 * 1.5 / 4), w = std::exp(s2), mu = std::log(2) - s2 / 2;
  expect_mean(x, 2, 2.25);
  expect_variance(x, 2.25, w * w * w * w + 2 * w * w * w + 3 * w * w - 3);
  expect_distribution(
      x, [&](Real r) { return 0.5 * std::erfc((mu - std::log(r)) / std::sqrt(2 * s2)); });
}

TEST(Distributions, PowerLawHasItsMeanVarianceAndQuantiles) {
  for (const Real exponent : {0.5, 1.0, 1.0 + 1e-9, 2.5, 3.0, 4.0}) {
    SCOPED_TRACE(exponent);
    const Real min = 0.5, max = 20;
    const auto moment = [&](Real k) {  // ∫ x^(k − exponent) dx
      const Real e = k + 1 - exponent;
      return std::abs(e) < 1e-6 ? std::log(max / min) : (std::pow(max, e) - std::pow(min, e)) / e;
    };
    const Real mean = moment(1) / moment(0);
    const Real variance = moment(2) / moment(0) - mean * mean;
    const Real fourth = moment(4) / moment(0) - 4 * mean * moment(3) / moment(0) +
                        6 * mean * mean * moment(2) / moment(0) - 3 * std::pow(mean, 4);
    const auto x = sample(power_law(exponent, min, max), 4);
    expect_mean(x, mean, variance);
    expect_variance(x, variance, fourth / (variance * variance));
    expect_distribution(x, [&](Real r) {
      const Real e = 1 - exponent;
      return std::abs(e) < 1e-6
                 ? std::log(r / min) / std::log(max / min)
                 : (std::pow(r, e) - std::pow(min, e)) / (std::pow(max, e) - std::pow(min, e));
    });
    EXPECT_GE(*std::min_element(x.begin(), x.end()), min);
    EXPECT_LE(*std::max_element(x.begin(), x.end()), max);
  }
}

TEST(Distributions, AreCutOffAtTheWindowWithoutChangingTheirShapeInside) {
  const auto x = sample(exponential(2, 1, 3), 5);
  expect_distribution(x, [](Real r) {
    return (std::exp(-0.5) - std::exp(-r / 2)) / (std::exp(-0.5) - std::exp(-1.5));
  });
  EXPECT_GE(*std::min_element(x.begin(), x.end()), 1);
  EXPECT_LE(*std::max_element(x.begin(), x.end()), 3);
}

TEST(Distributions, KnowTheShareOfTheirValuesInTheWindow) {
  EXPECT_NEAR(share_in_window(exponential(2, 1, 3)), std::exp(-0.5) - std::exp(-1.5), 1e-15);
  // Half of a log-normal distribution lies below its median exp(mu) = mean/√(1 + (deviation/mean)²).
  EXPECT_NEAR(share_in_window(log_normal_of(2, 2, 0, std::sqrt(2))), 0.5, 1e-15);
  EXPECT_EQ(share_in_window(log_normal_of(2, 2)), 1);
  EXPECT_EQ(share_in_window(power_law(2, 1, 3)), 1);
  EXPECT_EQ(share_in_window({Distribution::Kind::constant, 2, 0, 0, 3, 4}), 0);
}

// Of r on [low, high] with the density f(r)·V(r), by the trapezoidal rule in ln r.
class NearBox {
 public:
  template <class Density>
  NearBox(Density f, Real low, Real high, const Vec3& l) : start_(std::log(low)) {
    constexpr int steps = 100'000;
    step_ = (std::log(high) - start_) / steps;
    Real before = 0;
    for (int i = 0; i <= steps; ++i) {
      const Real r = std::exp(start_ + i * step_);
      const Real g = f(r) * r * (l[0] + 2 * r) * (l[1] + 2 * r) * (l[2] + 2 * r);
      sum_.push_back(i == 0 ? 0 : sum_.back() + 0.5 * (g + before));
      before = g;
    }
  }
  Real operator()(Real r) const {
    const Real at = std::clamp((std::log(r) - start_) / step_, 0.0, sum_.size() - 1.001);
    const auto i = static_cast<std::size_t>(at);
    return (sum_[i] + (at - static_cast<Real>(i)) * (sum_[i + 1] - sum_[i])) / sum_.back();
  }

 private:
  Real start_, step_ = 0;
  std::vector<Real> sum_;
};

std::vector<Real> radii_near(const Distribution& radius, const Vec3& lengths, std::uint64_t seed) {
  const RadiusNearBox radii(radius, lengths);
  RandomStream random(seed);
  std::vector<Real> x(sample_size);
  for (Real& value : x) value = radii.draw(random);
  return x;
}

TEST(RadiusNearBox, WeighsEachRadiusByTheVolumeFromWhichItReachesTheBox) {
  const Vec3 l = {3, 5, 2};
  expect_distribution(radii_near(power_law(2.5, 0.5, 20), l, 1),
                      NearBox([](Real r) { return std::pow(r, -2.5); }, 0.5, 20, l));
  expect_distribution(radii_near(power_law(1, 0.5, 20), l, 2),
                      NearBox([](Real r) { return 1 / r; }, 0.5, 20, l));
  expect_distribution(radii_near(exponential(2), l, 3),
                      NearBox([](Real r) { return std::exp(-r / 2); }, 1e-6, 90, l));
  expect_distribution(radii_near(exponential(2, 1, 3), l, 4),
                      NearBox([](Real r) { return std::exp(-r / 2); }, 1, 3, l));
  // A long tail: the mean of the radii near the box is a hundred times that of all.
  const Real s2 = std::log(1 + 9.0), mu = -s2 / 2;
  const auto density = [&](Real r) {
    return std::exp(-std::pow(std::log(r) - mu, 2) / (2 * s2)) / r;
  };
  expect_distribution(radii_near(log_normal_of(1, 3), l, 5), NearBox(density, 1e-7, 1e9, l));
  expect_distribution(radii_near(log_normal_of(1, 3, 0.5, 5), l, 6), NearBox(density, 0.5, 5, l));
}

class FisherOfKappa : public testing::TestWithParam<Real> {};

// Fisher (1953): mean cos θ = coth κ − 1/κ, variance 1/κ² − 1/sinh² κ; uniform azimuth.
TEST_P(FisherOfKappa, HasTheMeanResultantAndAzimuthOfTheDistribution) {
  const Real kappa = GetParam();
  const PlaneFrame frame = plane_frame(DipOrientation{50, 130});
  RandomStream random(11);
  std::vector<Real> off, azimuth;  // off: 1 − cos θ, keeps its digits for large κ
  Vec3 sum{};
  for (std::size_t i = 0; i < sample_size; ++i) {
    const Vec3 n = draw_fisher(frame, kappa, random);
    EXPECT_NEAR(norm(n), 1, 1e-15 * 4);
    sum += n;
    off.push_back(0.5 * dot(n - frame.normal, n - frame.normal));
    azimuth.push_back(0.5 + std::atan2(dot(n, frame.strike), dot(n, frame.down)) / (2 * pi));
  }
  // 1 − (coth κ − 1/κ), and the variance; by their series at 0 for small κ, to κ³.
  const bool small = kappa < 1e-3;
  const Real mean = small ? 1 - kappa / 3 : 1 - 1 / std::tanh(kappa) + 1 / kappa;
  const Real variance = small         ? 1.0 / 3 - kappa * kappa / 15
                        : kappa > 300 ? 1 / (kappa * kappa)
                                      : 1 / (kappa * kappa) - 1 / std::pow(std::sinh(kappa), 2);
  expect_mean(off, mean, variance);
  expect_distribution(azimuth, [](Real a) { return a; });
  expect_distribution(off, [&](Real t) { return std::expm1(-kappa * t) / std::expm1(-2 * kappa); });
  // The resultant: along the pole as cos θ, across it with variance E[sin² θ]/2 = (mean cos θ)/κ each way.
  const Vec3 resultant = (1.0 / sample_size) * sum;
  const Real across = small ? 1.0 / 3 : (1 - mean) / kappa;
  EXPECT_NEAR(dot(resultant, frame.normal), 1 - mean,
              5 * std::sqrt(variance / sample_size) + 1e-12);
  EXPECT_NEAR(dot(resultant, frame.down), 0, 5 * std::sqrt(across / sample_size));
  EXPECT_NEAR(dot(resultant, frame.strike), 0, 5 * std::sqrt(across / sample_size));
}
INSTANTIATE_TEST_SUITE_P(Kappa, FisherOfKappa, testing::Values(1e-12, 0.5, 5.0, 50.0, 500.0, 1e6));

// Written by an independent implementation in Python (its own Mersenne twister, its own elementary functions: the last
// digit may differ there, here it may not).
TEST(GoldenNumbers, OfSeedOneAreTheSameOnEveryMachine) {
  RandomStream random(1);
  EXPECT_EQ(random.uniform(), 0.13387664401253263);
  EXPECT_EQ(random.uniform(), 0.13640703636619722);
  EXPECT_EQ(random.uniform(), 0.4512149038445381);
  const auto first_two = [](const Distribution& distribution) {
    RandomStream stream(1);
    const Real first = draw(distribution, stream);
    return std::pair(first, draw(distribution, stream));
  };
  EXPECT_EQ(first_two(exponential(3)), std::pair(0.43118381148077467, 0.4399611842673765));
  EXPECT_EQ(first_two(log_normal_of(2, 1.5)), std::pair(2.0228010219742845, 3.305097982294874));
  EXPECT_EQ(first_two(power_law(2.5, 0.5, 20)), std::pair(0.5500556857931949, 0.5511247212313463));
  RandomStream stream(1);
  const PlaneFrame frame = plane_frame(DipOrientation{50, 130});
  const Vec3 first = draw_fisher(frame, 20, stream), second = draw_fisher(frame, 20, stream);
  EXPECT_EQ(first, (Vec3{0.67933171039857854, -0.45193634861978993, 0.57815392763792006}));
  EXPECT_EQ(second, (Vec3{0.70846881355326119, -0.55267429929774481, 0.43888843584466986}));
}

}  // namespace
}  // namespace rockfold::test
