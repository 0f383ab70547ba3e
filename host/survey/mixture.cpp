#include "host/survey/mixture.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "host/survey/fisher.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real numbers_of_set = 4;
constexpr int most_iterations = 2000;
/// Of a pole's logarithm of likelihood: with a thousand poles far less than the 4 ln N that decides on a set.
constexpr Real settled = 1e-7;
/// Poles at which a new set may begin; of more, as many at equal steps of the list.
constexpr std::size_t most_beginnings = 200;
/// With which it may begin: 95 of 100 poles within 45°, 26° and 14°, as loose and as tight as sets of joints are.
constexpr Real beginning_kappas[] = {10, 30, 100};

Real density(const AxialMixture& mixture, const Vec3& axis) {
  Real sum = mixture.background;
  for (const AxialSet& set : mixture.sets)
    sum += set.share * axial_density(set.kappa, dot(set.mean, axis));
  return sum;
}

class Search {
 public:
  Search(std::span<const Vec3> poles, std::span<const Real> weights)
      : poles_(poles), weights_(weights.begin(), weights.end()) {
    Real sum = 0, squares = 0;
    for (const Real w : weights) sum += w, squares += w * w;
    effective_ = sum > 0 ? sum * sum / squares : 0;
    for (Real& w : weights_) w *= effective_ / sum;
  }

  AxialMixture without_sets() const { return judged({}); }

  /// With one more set: the likeliest of several beginnings, before all of those whose sets are not too small.
  AxialMixture with_one_more(const AxialMixture& before) const {
    AxialMixture best = settle(begun(before, beginning_kappas[0]));
    for (std::size_t i = 1; i < std::size(beginning_kappas); ++i) {
      AxialMixture trial = settle(begun(before, beginning_kappas[i]));
      const bool small = has_small_set(trial), best_small = has_small_set(best);
      if (small == best_small ? trial.log_likelihood > best.log_likelihood : best_small)
        best = std::move(trial);
    }
    return best;
  }

  bool has_small_set(const AxialMixture& mixture) const {
    return std::any_of(mixture.sets.begin(), mixture.sets.end(), [&](const AxialSet& set) {
      return set.share * effective_ < least_poles_of_set;
    });
  }

 private:
  /// A new set about the pole where it raises the likelihood most. It begins with the share of one more among equals.
  AxialMixture begun(const AxialMixture& before, Real kappa) const {
    const Real share = 1.0 / static_cast<Real>(before.sets.size() + 2);
    std::vector<Real> old(poles_.size());
    for (std::size_t i = 0; i < poles_.size(); ++i)
      old[i] = (1 - share) * density(before, poles_[i]);
    const std::size_t step = (poles_.size() + most_beginnings - 1) / most_beginnings;
    Real most = -std::numeric_limits<Real>::infinity();
    Vec3 at{};
    for (std::size_t c = 0; c < poles_.size(); c += step) {
      Real sum = 0;
      for (std::size_t i = 0; i < poles_.size(); ++i)
        sum += weights_[i] *
               std::log(old[i] + share * axial_density(kappa, dot(poles_[c], poles_[i])));
      if (sum > most) most = sum, at = poles_[c];
    }
    AxialMixture mixture = before;
    for (AxialSet& set : mixture.sets) set.share *= 1 - share;
    mixture.background *= 1 - share;
    mixture.sets.push_back({at, kappa, share});
    return mixture;
  }

  AxialMixture settle(AxialMixture mixture) const {
    Real before = -std::numeric_limits<Real>::infinity();
    for (int step = 0; step < most_iterations; ++step) {
      const Real now = improve(mixture);
      if (now - before < settled * effective_) break;
      before = now;
    }
    return judged(std::move(mixture));
  }

  /// One step of expectation and maximisation; the likelihood before it. Which way a pole points is unknown too: in the mean by
  /// tanh(κ t) to the side of the set's mean.
  Real improve(AxialMixture& mixture) const {
    const std::size_t sets = mixture.sets.size();
    std::vector<Vec3> resultant(sets);
    std::vector<Real> weight(sets, 0.0), chance(sets);
    Real likelihood = 0, background = 0;
    for (std::size_t i = 0; i < poles_.size(); ++i) {
      Real sum = mixture.background;
      for (std::size_t k = 0; k < sets; ++k) {
        const AxialSet& set = mixture.sets[k];
        chance[k] = set.share * axial_density(set.kappa, dot(set.mean, poles_[i]));
        sum += chance[k];
      }
      likelihood += weights_[i] * std::log(sum);
      background += weights_[i] * mixture.background / sum;
      for (std::size_t k = 0; k < sets; ++k) {
        const AxialSet& set = mixture.sets[k];
        const Real part = weights_[i] * chance[k] / sum;
        weight[k] += part;
        resultant[k] += part * std::tanh(set.kappa * dot(set.mean, poles_[i])) * poles_[i];
      }
    }
    mixture.background = background / effective_;
    for (std::size_t k = 0; k < sets; ++k) {
      AxialSet& set = mixture.sets[k];
      set.share = weight[k] / effective_;
      const Real length = norm(resultant[k]);
      if (!(length > 0)) continue;
      set.mean = (1 / length) * resultant[k];
      const Real mean_length = std::min(length / weight[k], 1 - 1 / narrowest_kappa);
      set.kappa = kappa_of_mean_length(mean_length);
    }
    return likelihood;
  }

  AxialMixture judged(AxialMixture mixture) const {
    std::stable_sort(mixture.sets.begin(), mixture.sets.end(),
                     [](const AxialSet& a, const AxialSet& b) { return a.share > b.share; });
    mixture.log_likelihood = 0;
    for (std::size_t i = 0; i < poles_.size(); ++i)
      mixture.log_likelihood += weights_[i] * std::log(density(mixture, poles_[i]));
    mixture.criterion = -2 * mixture.log_likelihood + numbers_of_set *
                                                          static_cast<Real>(mixture.sets.size()) *
                                                          std::log(std::max(effective_, 1.0));
    return mixture;
  }

  std::span<const Vec3> poles_;
  std::vector<Real> weights_;  ///< they add up to effective_
  Real effective_ = 0;
};

}  // namespace

std::vector<Real> AxialMixture::memberships(const Vec3& axis) const {
  const Real all = density(*this, axis);
  std::vector<Real> chances;
  for (const AxialSet& set : sets)
    chances.push_back(set.share * axial_density(set.kappa, dot(set.mean, axis)) / all);
  chances.push_back(background / all);
  return chances;
}

SetSearch find_axial_sets(std::span<const Vec3> poles, std::span<const Real> weights,
                          std::optional<std::size_t> count) {
  const Search search(poles, weights);
  SetSearch result;
  AxialMixture mixture = search.without_sets();
  result.found = mixture;
  result.criteria.push_back(mixture.criterion);
  const std::size_t most = poles.empty() ? 0 : count.value_or(most_sets_unasked);
  for (std::size_t k = 1; k <= most; ++k) {
    mixture = search.with_one_more(mixture);
    const bool small = search.has_small_set(mixture);
    if (small && !count) break;  // one more would be smaller still
    result.criteria.push_back(mixture.criterion);
    if (count ? k == *count : mixture.criterion < result.found.criterion) result.found = mixture;
  }
  return result;
}

}  // namespace rockfold
