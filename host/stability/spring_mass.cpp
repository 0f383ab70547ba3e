#include "host/stability/spring_mass.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Matrix = Eigen::SparseMatrix<Real>;

constexpr Real shear_share = 0.5;  // of the normal stiffness, across
constexpr Index most_newton = 80, most_passes = 80, remembered = 3;
constexpr Real balanced = 1e-8;  // of all loads
constexpr Real agreed = 1e-5;    // of all pressure

Real size_of(const std::vector<Real>& x) {
  Real sum = 0;
  for (const Real v : x) sum += v * v;
  return std::sqrt(sum);
}

}  // namespace

/// Unit forces along a corner's axes as entries of the balance, and the tangent made of them.
struct SpringMass::Equations {
  struct Entries {
    std::array<Index, 12> row;  ///< none: held rock
    Eigen::Matrix<Real, 3, 12> of_axis;
  };
  std::vector<Entries> corner;
  std::vector<Eigen::Matrix3d> tangent;
  Eigen::SimplicialLDLT<Matrix> factors;
  bool analysed = false;

  Eigen::Vector3d jump(std::size_t c, const std::vector<Real>& displacement) const {
    Eigen::Matrix<Real, 12, 1> own;
    for (int k = 0; k < 12; ++k)
      own[k] = corner[c].row[k] == none ? 0 : displacement[corner[c].row[k]];
    return corner[c].of_axis * own;
  }
  void add(std::size_t c, const Eigen::Vector3d& force, std::vector<Real>& rest) const {
    const Eigen::Matrix<Real, 12, 1> own = corner[c].of_axis.transpose() * force;
    for (int k = 0; k < 12; ++k)
      if (corner[c].row[k] != none) rest[corner[c].row[k]] += own[k];
  }
  /// Newton's step.
  std::vector<Real> step(const std::vector<Real>& rest, Real on_diagonal);
};

std::vector<Real> SpringMass::Equations::step(const std::vector<Real>& rest, Real on_diagonal) {
  const int rows = static_cast<int>(rest.size());
  std::vector<Eigen::Triplet<Real>> entries;
  entries.reserve(corner.size() * 78 + rest.size());
  for (std::size_t c = 0; c < corner.size(); ++c) {
    const Eigen::Matrix<Real, 12, 12> block =
        corner[c].of_axis.transpose() * tangent[c] * corner[c].of_axis;
    for (int i = 0; i < 12; ++i)
      for (int k = 0; k < 12; ++k) {
        const Index row = corner[c].row[i], column = corner[c].row[k];
        if (row != none && column != none && row >= column)
          entries.emplace_back(row, column, block(i, k));
      }
  }
  for (int r = 0; r < rows; ++r) entries.emplace_back(r, r, on_diagonal);
  Matrix matrix(rows, rows);
  matrix.setFromTriplets(entries.begin(), entries.end());
  if (!analysed) factors.analyzePattern(matrix);
  analysed = true;
  factors.factorize(matrix);
  const Eigen::VectorXd x = factors.solve(Eigen::Map<const Eigen::VectorXd>(rest.data(), rows));
  return {x.data(), x.data() + rows};
}

SpringMass::SpringMass(const ScaledMass& scaled)
    : scaled_(scaled), load_(scaled.right_side()), equations_(std::make_unique<Equations>()) {
  for (Real& f : load_) f = -f;
  const RigidMass& mass = scaled.mass();
  std::vector<Real> share(mass.contacts.size(), 0);
  Real sum = 0, count = 0;
  for (std::size_t k = 0; k < mass.contacts.size(); ++k) {
    const std::vector<Vec3>& x = mass.contacts[k].corner;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
      share[k] += 0.5 * norm(cross(x[i] - x[0], x[i + 1] - x[0])) / static_cast<Real>(x.size());
    sum += share[k] * static_cast<Real>(x.size());
    count += static_cast<Real>(x.size());
  }
  for (const ForcePoint& point : scaled.points()) {
    if (point.area > 0) continue;  // strength inside an area counts at its corners here
    const ContactArea& area = scaled.contact(point);
    const auto& t = scaled.tangents(point);
    const Real own = share[point.contact];
    corners_.push_back({point,
                        {area.normal, t[0], t[1]},
                        own * count / sum,
                        area.friction,
                        area.cohesion * own / scaled.force_scale(),
                        area.tension * own / scaled.force_scale()});
    Equations::Entries entries;
    entries.row.fill(none);
    entries.of_axis.setZero();
    for (int axis = 0; axis < 3; ++axis) {
      LinearProgram column({});
      scaled.add_force(column, point, corners_.back().axis[axis]);
      for (std::size_t e = 0; e < column.row.size(); ++e) {
        const bool second = area.body[0] == none || column.row[e] / 6 != area.body[0];
        const Index k = column.row[e] % 6 + (second ? 6 : 0);
        entries.row[k] = column.row[e];
        entries.of_axis(axis, k) = column.value[e];
      }
    }
    equations_->corner.push_back(entries);
  }
  equations_->tangent.resize(corners_.size());
}

SpringMass::~SpringMass() = default;

SpringMass::State SpringMass::start() const {
  constexpr Real even = 0.3;  // of a mean load: as if three corners bore each block
  return {std::vector<Real>(load_.size(), 0), std::vector<Real>(corners_.size(), even), false, 0};
}

SpringMass::Look SpringMass::look(Real share, const State& state, bool with_tangent) {
  Look look;
  look.rest = load_;
  for (std::size_t r = 0; r < load_.size(); ++r) {
    const Real u = state.displacement[r];
    look.rest[r] -= drag * u;
    look.potential += (0.5 * drag * u - load_[r]) * u;
  }
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Corner& corner = corners_[c];
    const Real k = corner.stiffness, s = shear_share * k;
    const Real limit = share * (corner.friction * state.pressure[c] + corner.cohesion);
    const Real pull = share * corner.tension;
    const Eigen::Vector3d jump = equations_->jump(c, state.displacement);
    const Real slip = std::hypot(jump[1], jump[2]);
    const bool open = -k * jump[0]<-pull, slips = s * slip> limit;
    const Real normal = open ? -pull : -k * jump[0], shear = slips ? limit : s * slip;
    look.potential += open ? pull * jump[0] - 0.5 * pull * pull / k : 0.5 * normal * normal / k;
    look.potential += slips ? limit * slip - 0.5 * limit * limit / s : 0.5 * shear * shear / s;
    const Real over = slip > 0 ? 1 / slip : 0;
    const Eigen::Vector2d along{jump[1] * over, jump[2] * over};
    equations_->add(c, {normal, -shear * along[0], -shear * along[1]}, look.rest);
    look.pressure.push_back(std::max(0.0, normal));
    look.fastest = std::max(look.fastest, jump.norm());
    if (!with_tangent) continue;
    Eigen::Matrix3d& tangent = equations_->tangent[c];
    tangent.setZero();
    tangent(0, 0) = open ? 0 : k;
    const Real secant = slips ? limit * over : s;
    tangent.bottomRightCorner<2, 2>() = secant * Eigen::Matrix2d::Identity();
    if (slips) tangent.bottomRightCorner<2, 2>() -= secant * along * along.transpose();
  }
  return look;
}

/// To the least potential with the limits that the state's pressure makes.
void SpringMass::relax(Real share, State& state, Look& found) {
  const Real enough = balanced * size_of(load_);
  for (Index n = 0; n < most_newton; ++n) {
    found = look(share, state, true);
    if (size_of(found.rest) < enough) return;
    const std::vector<Real> step = equations_->step(found.rest, drag);
    Real slope = 0;
    for (std::size_t r = 0; r < step.size(); ++r) slope -= found.rest[r] * step[r];
    State next = state;
    for (Real part = 1; part > 1e-9; part *= 0.5) {
      for (std::size_t r = 0; r < step.size(); ++r)
        next.displacement[r] = state.displacement[r] + part * step[r];
      const Real potential = look(share, next, false).potential;
      if (potential <= found.potential + 1e-4 * part * slope + 1e-13 * std::abs(found.potential))
        break;
    }
    state.displacement = std::move(next.displacement);
  }
}

SpringMass::State SpringMass::settle(Real share, State state) {
  // Anderson's mixing of the last pressures.
  std::vector<Eigen::VectorXd> pressures, changes;
  state.settled = false;
  for (Index pass = 0; pass < most_passes; ++pass) {
    Look found;
    relax(share, state, found);
    state.fastest = found.fastest;
    const auto count = static_cast<Eigen::Index>(corners_.size());
    const Eigen::VectorXd limits = Eigen::Map<const Eigen::VectorXd>(state.pressure.data(), count);
    const Eigen::VectorXd change =
        Eigen::Map<const Eigen::VectorXd>(found.pressure.data(), count) - limits;
    if (change.lpNorm<1>() <= agreed * (limits + change).lpNorm<1>()) {
      state.settled = true;
      return state;
    }
    Eigen::VectorXd next = limits + 0.5 * change;
    if (!pressures.empty()) {
      Eigen::MatrixXd by(count, static_cast<Eigen::Index>(pressures.size())), of = by;
      for (std::size_t k = 0; k < pressures.size(); ++k) {
        by.col(static_cast<Eigen::Index>(k)) = change - changes[k];
        of.col(static_cast<Eigen::Index>(k)) = limits - pressures[k];
      }
      Eigen::VectorXd weight = by.colPivHouseholderQr().solve(change);
      constexpr Real most_weight = 3;
      if (weight.lpNorm<1>() > most_weight) weight *= most_weight / weight.lpNorm<1>();
      next -= (of + 0.5 * by) * weight;
    }
    pressures.push_back(limits);
    changes.push_back(change);
    if (pressures.size() > remembered) {
      pressures.erase(pressures.begin());
      changes.erase(changes.begin());
    }
    constexpr Real nothing = 1e-13;
    for (Eigen::Index c = 0; c < count; ++c) state.pressure[c] = std::max(next[c], nothing);
  }
  return state;
}

Real SpringMass::factor(const State& state) const {
  Real driven = 0, resisted = 0;
  for (std::size_t r = 0; r < load_.size(); ++r) driven += load_[r] * state.displacement[r];
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Eigen::Vector3d jump = equations_->jump(c, state.displacement);
    resisted += (corners_[c].friction * state.pressure[c] + corners_[c].cohesion) *
                    std::hypot(jump[1], jump[2]) +
                corners_[c].tension * std::max(0.0, jump[0]);
  }
  return resisted / driven;
}

}  // namespace rockfold
