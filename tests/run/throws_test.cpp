// Whatever is thrown, however thin and fast, it does not come through.
#include <array>
#include <cmath>
#include <random>
#include <string>

#include <gtest/gtest.h>

#include "src/base/error.hpp"
#include "tests/run/run_model.hpp"

namespace rockfold {
namespace {

class Throw {
 public:
  explicit Throw(unsigned seed) : random_(seed) {
    size_ = between(0.05, 0.4);
    thickness_ = std::pow(10, between(-2.5, -0.7));
    height_ = size_ * between(0.3, 1);
    start_ = between(0.02, 1);
    speed_ = std::pow(10, between(1, 2.4));
    step_ = std::pow(10, between(-4, -2.3));
    room_ = between(0, 1) < 0.4;
  }

  std::string model() {
    const Real tilt = between(0, 1.2), turn = between(0, 6.28);
    const std::array<Real, 3> velocity = {speed_ * std::sin(tilt) * std::cos(turn),
                                          speed_ * std::sin(tilt) * std::sin(turn),
                                          -speed_ * std::cos(tilt)};
    const bool substeps = between(0, 1) < 0.5;
    const Real restitution = std::floor(between(0, 3)) / 2;
    const Real middle = start_ + height_ / 2, t = thickness_;
    std::string text =
        "gravity = [0, 0, -9.81]\n[[material]]\ndensity = 2600\nyoung_modulus = 3e10\n"
        "poisson_ratio = 0.25\n[[joint_material]]\nname = 'j'\nfriction_angle = 30\n" +
        plate({-half, -half, -t}, {half, half, 0});
    if (room_)
      text += plate({-half, -half, top}, {half, half, top + t}) +
              plate({-half, -half, 0}, {-half + t, half, top}) +
              plate({half - t, -half, 0}, {half, half, top}) +
              plate({-half + t, -half, 0}, {half - t, -half + t, top}) +
              plate({-half + t, half - t, 0}, {half - t, half, top});
    const std::string at = list({0, 0, middle});
    return text + box({-size_ / 2, -size_ / 2, start_}, {size_ / 2, size_ / 2, start_ + height_}) +
           "[contact]\nrestitution = " + std::to_string(restitution) +
           "\n[cover]\nlattice = 'block'\n[[initial_velocity]]\nwhere = {block_at = " + at +
           "}\nvelocity = " + list(velocity) +
           "\nangular_velocity = " + list({between(-20, 20), between(-20, 20), between(-20, 20)}) +
           "\n[[monitor]]\nname = 'middle'\npoint = " + at +
           "\n[analysis]\ntype = 'dynamic'\ntime_step = " + std::to_string(step_) +
           "\nend_time = " + std::to_string(std::min(0.05, 6 / speed_)) + "\nscheme = '" +
           (substeps ? "explicit" : "implicit") + "'\n";
  }

  /// Of the middle of what was thrown: where it is at the end. (For a moment a thin plate's joint gives way by more than its thickness.)
  bool passes(const std::vector<Vec3>& displacement) const {
    const auto over = [](const Vec3& u) { return std::abs(u[0]) < half && std::abs(u[1]) < half; };
    const Real z = start_ + height_ / 2 + displacement.back()[2];
    if (room_) return !over(displacement.back()) || z < 0 || z > top + thickness_;
    for (const Vec3& u : displacement)
      if (!over(u)) return false;  // it goes beside the plate
    return z < -thickness_;
  }

 private:
  static constexpr Real half = 2, top = 3;  // m

  Real between(Real low, Real high) {
    return std::uniform_real_distribution<Real>(low, high)(random_);
  }
  static std::string list(const std::array<Real, 3>& x) {
    return "[" + std::to_string(x[0]) + ", " + std::to_string(x[1]) + ", " + std::to_string(x[2]) +
           "]";
  }
  std::string box(const std::array<Real, 3>& low, const std::array<Real, 3>& high) {
    return "[[solid]]\nname = 's" + std::to_string(++solids_) +
           "'\nshape = 'box'\nmin = " + list(low) + "\nmax = " + list(high) + "\ninterface = 'j'\n";
  }
  /// A box that is held.
  std::string plate(const std::array<Real, 3>& low, const std::array<Real, 3>& high) {
    std::array<Real, 3> middle{};
    for (std::size_t d = 0; d < 3; ++d) middle[d] = 0.5 * (low[d] + high[d]);
    if (high[2] - low[2] < 1) middle[0] = middle[1] = 0.9 * half;
    return box(low, high) + "[[fixed]]\nwhere = {block_at = " + list(middle) + "}\n";
  }

  std::mt19937 random_;
  Real size_, thickness_, height_, start_, speed_, step_;
  bool room_;
  int solids_ = 0;
};

TEST(SlowThrows, DoNotPassPlatesNorLeaveRooms) {
  int stopped = 0;
  for (unsigned seed = 1; seed <= 250; ++seed) {
    Throw thrown(seed);
    ModelAnswer answer;
    try {
      run_model(thrown.model(), answer);
    } catch (const Error& error) {
      ++stopped;  // told: contact made energy out of nothing
      EXPECT_NE(std::string(error.what()).find("out of nothing"), std::string::npos)
          << seed << ": " << error.what();
      continue;
    }
    EXPECT_FALSE(thrown.passes(answer.result.monitors[0].displacement)) << seed;
  }
  EXPECT_LE(stopped, 10);
}

}  // namespace
}  // namespace rockfold
