#include "host/survey/fisher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include <Eigen/Eigenvalues>

#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real degree = std::numbers::pi / 180;
constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();

struct Principal {
  Vec3 axis{};         ///< of the largest eigenvalue
  Vec3 eigenvalues{};  ///< descending
};

Principal principal_axis(std::span<const Vec3> poles, std::span<const Real> weights) {
  Eigen::Matrix3d tensor = Eigen::Matrix3d::Zero();
  Real sum = 0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const Eigen::Vector3d x(poles[i][0], poles[i][1], poles[i][2]);
    tensor += weights[i] * x * x.transpose();
    sum += weights[i];
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solved(tensor / sum);
  const Eigen::Vector3d axis = solved.eigenvectors().col(2);
  const Eigen::Vector3d& values = solved.eigenvalues();
  return {{axis[0], axis[1], axis[2]}, {values[2], values[1], values[0]}};
}

Vec3 resultant_on_side_of(const Vec3& mean, std::span<const Vec3> poles,
                          std::span<const Real> weights) {
  Vec3 sum{};
  for (std::size_t i = 0; i < poles.size(); ++i)
    sum += (dot(poles[i], mean) < 0 ? -weights[i] : weights[i]) * poles[i];
  return sum;
}

/// Each turn of a pole to the mean's side makes the resultant longer, so that none comes again and the search ends.
Vec3 longest_resultant(const Vec3& start, std::span<const Vec3> poles,
                       std::span<const Real> weights) {
  Vec3 sum = resultant_on_side_of(start, poles, weights);
  for (std::size_t turn = 0; turn < poles.size(); ++turn) {
    const Vec3 next = resultant_on_side_of(sum, poles, weights);
    if (norm(next) <= norm(sum)) break;
    sum = next;
  }
  return sum;
}

}  // namespace

FisherStatistics fisher_statistics(std::span<const Vec3> poles, std::span<const Real> given,
                                   std::span<const Real> chances) {
  FisherStatistics result;
  Real sum = 0, squares = 0;
  std::vector<Real> weights;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    weights.push_back(given[i] * chances[i]);
    sum += weights[i];
    squares += given[i] * weights[i];
  }
  if (!(sum > 0)) {
    const Vec3 nowhere{not_a_number, not_a_number, not_a_number};
    return {nowhere, 0, not_a_number, not_a_number, not_a_number, not_a_number, nowhere};
  }
  const Principal principal = principal_axis(poles, weights);
  const Vec3 resultant = longest_resultant(principal.axis, poles, weights);
  const Real n = sum * sum / squares;
  const Real length = std::min(norm(resultant) / sum, Real{1});
  // What rounding leaves of poles that coincide is no scatter.
  const Real missing = 1 - length < 8 * std::numeric_limits<Real>::epsilon() ? 0 : n * (1 - length);
  result.mean = normalized(resultant[2] < 0 ? -resultant : resultant);
  result.effective_count = n;
  result.resultant = n - missing;
  result.kappa = n > 1 ? (n - 1) / missing : not_a_number;
  result.kappa_unbiased = n > 2 ? (n - 2) / missing : not_a_number;
  result.confidence_cone = confidence_cone(n, result.resultant, 0.05);
  result.eigenvalues = principal.eigenvalues;
  return result;
}

Real confidence_cone(Real count, Real resultant, Real outside) {
  if (!(count > 1)) return not_a_number;
  const Real below = (count - resultant) / resultant * (std::pow(outside, -1 / (count - 1)) - 1);
  return below < 2 ? std::acos(1 - below) / degree : 180;
}

Real cone_of_share(Real kappa, Real share) {
  if (std::isinf(kappa)) return 0;
  const Real below = -std::log1p(share * std::expm1(-2 * kappa)) / kappa;
  return std::acos(std::clamp(1 - below, Real{-1}, Real{1})) / degree;
}

Real axial_density(Real kappa, Real t) {
  if (kappa < 1e-6) return 1;
  const Real far = std::abs(t);
  return kappa * std::exp(kappa * (far - 1)) * (1 + std::exp(-2 * kappa * far)) /
         -std::expm1(-2 * kappa);
}

Real kappa_of_mean_length(Real length) {
  if (!(length > 0)) return 0;
  // Banerjee et al., J. Mach. Learn. Res. 6, 2005, on the sphere: good to some per cent; Newton's iteration does the rest.
  Real kappa = length * (3 - length * length) / (1 - length * length);
  for (int step = 0; step < 50; ++step) {
    if (kappa < 1e-3) return 3 * length;  // coth κ − 1/κ = κ/3 − κ³/45 …
    const Real sinh = std::sinh(std::min(kappa, Real{350}));
    const Real change =
        (1 / std::tanh(kappa) - 1 / kappa - length) / (1 / (kappa * kappa) - 1 / (sinh * sinh));
    kappa -= change;
    if (std::abs(change) <= 1e-12 * kappa) break;
  }
  return kappa;
}

}  // namespace rockfold
