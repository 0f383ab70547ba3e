#include "host/stability/spring_mass.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <Eigen/Dense>

#include "host/direct/multifrontal.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

using Vector = Eigen::VectorXd;
using Six = Eigen::Matrix<Real, 6, 6>;

constexpr Real shear_share = 0.5;  // of the normal stiffness, across
constexpr Real balanced = 1e-7, at_rest = 1e-6, relaxed = 1e-5, agreed = 1e-4;  // of all loads
constexpr Real on_the_way = 1e-2;                                               // of the drag
constexpr Index most_newton = 12, most_idle = 4, most_relaxing = 40, most_steps = 200;
/// Of a step against the drag: a load moves a body by as much as it moves the spring under it; then longer, until springs count no more.
constexpr Real first_span = 1, long_span = 1e3, last_span = 1e8;

Vector vector_of(const std::vector<Real>& x) {
  return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
}

}  // namespace

/// One step on its way.
struct SpringMass::Step {
  Real share = 0, span = 0;
  Vector before, now;          ///< displacements
  std::vector<Real> given;     ///< [corners] pressure that friction comes from while relaxing
  std::vector<Real> pressure;  ///< [corners] found
  std::vector<Eigen::Matrix3d> tangent;
  std::vector<Real> tension, tie_stiffness;  ///< [ties]
  Vector rest;                               ///< forces that do not balance, the drag among them
  Real drag = 0;                             ///< size of that alone
  Real potential = 0;
};

/// Unit forces along a corner's axes as entries of the balance; Newton's matrix, by blocks of two bodies.
struct SpringMass::Equations {
  struct Entries {
    std::array<Index, 12> row;  ///< none: held rock
    Eigen::Matrix<Real, 3, 12> of_axis;
    Index pair = none;
  };
  /// Two bodies that touch, and where their blocks are in the matrix: both of the first, first and second, …; none: held rock.
  struct Pair {
    std::array<Index, 2> body;
    std::array<Index, 4> place;
  };
  /// A bolt: what the tension 1 does.
  struct Tie {
    std::array<Index, 12> row;
    Eigen::Matrix<Real, 12, 1> pull;
    Index pair = none;
    Real least = 0, most = 0;  ///< of the scaled mass' forces

    Real lengthening(const Vector& displacement) const {
      Real sum = 0;
      for (int k = 0; k < 12; ++k)
        if (row[k] != none) sum -= pull[k] * displacement[row[k]];
      return sum;
    }
  };
  std::vector<Tie> tie;
  std::vector<Entries> corner;
  std::vector<Pair> pair;
  BlockMatrix matrix;          ///< its symmetric part
  std::vector<Real> coupling;  ///< what friction adds as it grows with pressure: like matrix.value
  std::vector<Index> diagonal;
  std::unique_ptr<DirectSolver> factors = host::make_direct_solver({8e9, 3e11});

  Eigen::Vector3d jump(std::size_t c, const Vector& displacement) const {
    Eigen::Matrix<Real, 12, 1> own;
    for (int k = 0; k < 12; ++k)
      own[k] = corner[c].row[k] == none ? 0 : displacement[corner[c].row[k]];
    return corner[c].of_axis * own;
  }
  void add(std::size_t c, const Eigen::Vector3d& force, Vector& rest) const {
    add(corner[c].row, corner[c].of_axis.transpose() * force, rest);
  }
  static void add(const std::array<Index, 12>& row, const Eigen::Matrix<Real, 12, 1>& own,
                  Vector& rest) {
    for (int k = 0; k < 12; ++k)
      if (row[k] != none) rest[row[k]] += own[k];
  }
  void find_places(Index bodies);
  void fill(const Step& step, const std::vector<Real>& mass);
  Vector product(const Vector& x) const;
  Vector divided(const Vector& x) const {
    std::vector<Real> z(x.data(), x.data() + x.size());
    factors->solve(z);
    return vector_of(z);
  }
  /// Newton's change.
  Vector solve(const Step& step, const std::vector<Real>& mass, bool with_coupling);
};

void SpringMass::Equations::find_places(Index bodies) {
  std::vector<std::vector<Index>> touched(static_cast<std::size_t>(bodies));
  for (Index b = 0; b < bodies; ++b) touched[b].push_back(b);
  for (const Pair& p : pair)
    for (int side = 0; side < 2; ++side)
      if (p.body[0] != none && p.body[1] != none) touched[p.body[side]].push_back(p.body[1 - side]);
  matrix.width = 6;
  matrix.begin.push_back(0);
  for (std::vector<Index>& row : touched) {
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    matrix.column.insert(matrix.column.end(), row.begin(), row.end());
    matrix.begin.push_back(static_cast<Index>(matrix.column.size()));
  }
  matrix.value.resize(36 * matrix.column.size());
  const auto place = [&](Index row, Index column) {
    if (row == none || column == none) return none;
    const auto begin = matrix.column.begin();
    return static_cast<Index>(
        std::lower_bound(begin + matrix.begin[row], begin + matrix.begin[row + 1], column) - begin);
  };
  for (Pair& p : pair)
    for (std::size_t k = 0; k < 4; ++k) p.place[k] = place(p.body[k / 2], p.body[k % 2]);
  for (Index b = 0; b < bodies; ++b) diagonal.push_back(place(b, b));
}

void SpringMass::Equations::fill(const Step& step, const std::vector<Real>& mass) {
  std::fill(matrix.value.begin(), matrix.value.end(), 0);
  coupling.assign(matrix.value.size(), 0);
  const auto add_block = [&](std::size_t c, const Eigen::Matrix3d& tangent,
                             std::vector<Real>& value) {
    const auto& axes = corner[c].of_axis;
    const Eigen::Matrix<Real, 3, 12> forces = tangent * axes;
    for (Index k = 0; k < 4; ++k)
      if (const Index place = pair[corner[c].pair].place[k]; place != none)
        Eigen::Map<Six>(&value[36 * place]) +=
            axes.middleCols<6>(6 * (k / 2)).transpose() * forces.middleCols<6>(6 * (k % 2));
  };
  for (std::size_t c = 0; c < corner.size(); ++c) {
    Eigen::Matrix3d even = step.tangent[c], odd = Eigen::Matrix3d::Zero();
    odd.bottomLeftCorner<2, 1>() = even.bottomLeftCorner<2, 1>();
    even -= odd;
    add_block(c, even, matrix.value);
    if (!odd.isZero(0)) add_block(c, odd, coupling);
  }
  for (std::size_t t = 0; t < tie.size(); ++t)
    for (Index k = 0; k < 4; ++k)
      if (const Index place = pair[tie[t].pair].place[k]; place != none)
        Eigen::Map<Six>(&matrix.value[36 * place]) +=
            step.tie_stiffness[t] * tie[t].pull.segment<6>(6 * (k / 2)) *
            tie[t].pull.segment<6>(6 * (k % 2)).transpose();
  for (std::size_t b = 0; b < diagonal.size(); ++b)
    for (Index d = 0; d < 6; ++d)
      matrix.value[36 * diagonal[b] + 7 * d] += mass[6 * b + d] / step.span;
}

/// Of the whole matrix.
Vector SpringMass::Equations::product(const Vector& x) const {
  Vector y = Vector::Zero(x.size());
  for (Index row = 0; row < matrix.rows(); ++row)
    for (Index e = matrix.begin[row]; e < matrix.begin[row + 1]; ++e)
      y.segment<6>(6 * row) += (Eigen::Map<const Six>(&matrix.value[36 * e]) +
                                Eigen::Map<const Six>(&coupling[36 * e])) *
                               x.segment<6>(6 * matrix.column[e]);
  return y;
}

/// GMRES (Saad & Schultz 1986), with the factors of the symmetric part from the right.
Vector SpringMass::Equations::solve(const Step& step, const std::vector<Real>& mass,
                                    bool with_coupling) {
  fill(step, mass);
  constexpr Real least_pivot = 1e-14;
  factors->factorise(matrix, least_pivot);
  if (!with_coupling) return divided(step.rest);
  constexpr Eigen::Index most = 60;
  constexpr Real enough = 1e-5;
  const Real size = step.rest.norm();
  std::vector<Vector> basis{step.rest / size};
  Eigen::MatrixXd hessenberg = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd best;
  for (Eigen::Index n = 0; n < most; ++n) {
    Vector next = product(divided(basis.back()));
    for (int again = 0; again < 2; ++again)
      for (Eigen::Index k = 0; k <= n; ++k) {
        const Real part = basis[k].dot(next);
        hessenberg(k, n) += part;
        next -= part * basis[k];
      }
    hessenberg(n + 1, n) = next.norm();
    const Eigen::MatrixXd h = hessenberg.topLeftCorner(n + 2, n + 1);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(n + 2);
    right[0] = size;
    best = h.householderQr().solve(right);
    if ((h * best - right).norm() <= enough * size || hessenberg(n + 1, n) == 0) break;
    basis.emplace_back(next / hessenberg(n + 1, n));
  }
  Vector sum = Vector::Zero(step.rest.size());
  for (Eigen::Index k = 0; k < best.size(); ++k) sum += best[k] * basis[k];
  return divided(sum);
}

SpringMass::SpringMass(const ScaledMass& scaled)
    : scaled_(scaled), load_(scaled.right_side()), equations_(std::make_unique<Equations>()) {
  for (Real& f : load_) f = -f;
  const RigidMass& mass = scaled.mass();
  constexpr Real least_mass = 1e-3;  // of a mean load
  constexpr Real inertia = 0.3;  // of a block, by its mass and the square of its farthest corner
  for (const RigidBody6& body : mass.bodies) {
    const Real own = std::max(least_mass, norm(body.force) / scaled.force_scale());
    mass_.insert(mass_.end(), {own, own, own, inertia * own, inertia * own, inertia * own});
  }
  std::vector<Real> share(mass.contacts.size(), 0);
  Real sum = 0, count = 0;
  for (std::size_t k = 0; k < mass.contacts.size(); ++k) {
    const std::vector<Vec3>& x = mass.contacts[k].corner;
    for (std::size_t i = 1; i + 1 < x.size(); ++i)
      share[k] += 0.5 * norm(cross(x[i] - x[0], x[i + 1] - x[0])) / static_cast<Real>(x.size());
    sum += share[k] * static_cast<Real>(x.size());
    count += static_cast<Real>(x.size());
  }
  std::map<std::array<Index, 2>, Index> pairs;
  const auto pair_of = [&](const std::array<Index, 2>& body) {
    const auto [place, is_new] =
        pairs.try_emplace(body, static_cast<Index>(equations_->pair.size()));
    if (is_new) equations_->pair.push_back({body, {}});
    return place->second;
  };
  const auto rows_of = [](const std::array<Index, 2>& body) {
    std::array<Index, 12> row;
    for (int k = 0; k < 12; ++k) row[k] = body[k / 6] == none ? none : 6 * body[k / 6] + k % 6;
    return row;
  };
  /// Where an entry of the balance stands among the rows of two bodies.
  const auto place_of = [](Index row, const std::array<Index, 2>& body) {
    return row % 6 + (body[0] == none || row / 6 != body[0] ? 6 : 0);
  };
  for (const ForcePoint& point : scaled.points()) {
    if (point.area > 0) continue;  // strength inside an area counts at its corners here
    const ContactArea& area = scaled.contact(point);
    const auto& t = scaled.tangents(point);
    const Real own = share[point.contact];
    corners_.push_back({area.body, own * count / sum, area.friction,
                        area.cohesion * own / scaled.force_scale(),
                        area.tension * own / scaled.force_scale()});
    Equations::Entries entries;
    entries.of_axis.setZero();
    entries.row = rows_of(area.body);
    for (int axis = 0; axis < 3; ++axis) {
      LinearProgram column({});
      scaled.add_force(column, point, axis == 0 ? area.normal : t[axis - 1]);
      for (std::size_t e = 0; e < column.row.size(); ++e)
        entries.of_axis(axis, place_of(column.row[e], area.body)) = column.value[e];
    }
    entries.pair = pair_of(area.body);
    equations_->corner.push_back(entries);
  }
  for (const BoltTie& bolt : mass.ties) {
    Equations::Tie tie;
    tie.row = rows_of(bolt.body);
    tie.pull.setZero();
    LinearProgram column({});
    scaled.add_tension(column, bolt);
    for (std::size_t e = 0; e < column.row.size(); ++e)
      tie.pull[place_of(column.row[e], bolt.body)] = column.value[e];
    tie.pair = pair_of(bolt.body);
    tie.least = bolt.least / scaled.force_scale();
    tie.most = bolt.most / scaled.force_scale();
    equations_->tie.push_back(tie);
  }
  equations_->find_places(static_cast<Index>(mass.bodies.size()));
  if (!equations_->factors->analyse(equations_->matrix))
    throw Error(ErrorKind::analysis,
                "the springs between these blocks have factors too large to be computed");
}

SpringMass::~SpringMass() = default;

SpringMass::State SpringMass::start() const {
  return {std::vector<Real>(load_.size(), 0), std::vector<Real>(load_.size(), 0),
          std::vector<Real>(corners_.size(), 0), std::vector<Real>(equations_->tie.size(), 0),
          Ending::undecided};
}

/// Of the friction's pressure against the pressure that is found, of all.
Real SpringMass::pressure_change(const Step& step) {
  Real changed = 0, sum = 0;
  for (std::size_t c = 0; c < step.pressure.size(); ++c) {
    changed += std::abs(std::max(0.0, step.pressure[c]) - std::max(0.0, step.given[c]));
    sum += std::max(0.0, step.pressure[c]);
  }
  return sum > 0 ? changed / sum : 0;
}

/// Forces, tangent and, where friction comes from a given pressure, the potential.
void SpringMass::look(Step& step, bool own_friction) const {
  step.rest = vector_of(load_);
  step.potential = 0;
  Real drag = 0;
  for (Eigen::Index r = 0; r < step.now.size(); ++r) {
    const Real moved = step.now[r] - step.before[r], held = mass_[r] / step.span * moved;
    step.rest[r] -= held;
    drag += held * held;
    step.potential += 0.5 * held * moved - load_[r] * step.now[r];
  }
  step.drag = std::sqrt(drag);
  step.pressure.resize(corners_.size());
  step.tangent.resize(corners_.size());
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Corner& corner = corners_[c];
    const Real k = corner.stiffness, s = shear_share * k, pull = step.share * corner.tension;
    const Eigen::Vector3d jump = equations_->jump(c, step.now);
    const bool open = -k * jump[0] < -pull;
    const Real normal = open ? -pull : -k * jump[0];
    const Real pressure = std::max(0.0, own_friction ? normal : step.given[c]);
    const Real limit = step.share * (corner.friction * pressure + corner.cohesion);
    const Real slip = std::hypot(jump[1], jump[2]);
    const bool slips = s * slip > limit;
    const Real shear = slips ? limit : s * slip, secant = slips ? limit / slip : s;
    const Eigen::Vector2d along =
        slip > 0 ? Eigen::Vector2d(jump[1] / slip, jump[2] / slip) : Eigen::Vector2d(0, 0);
    equations_->add(c, {normal, -shear * along[0], -shear * along[1]}, step.rest);
    step.potential += open ? pull * jump[0] - 0.5 * pull * pull / k : 0.5 * normal * normal / k;
    step.potential += slips ? limit * slip - 0.5 * limit * limit / s : 0.5 * shear * slip;
    step.pressure[c] = normal;
    Eigen::Matrix3d& tangent = step.tangent[c];
    tangent.setZero();
    tangent(0, 0) = open ? 0 : k;
    tangent.bottomRightCorner<2, 2>() = secant * Eigen::Matrix2d::Identity();
    if (slips) tangent.bottomRightCorner<2, 2>() -= secant * along * along.transpose();
    if (slips && own_friction && normal > 0)
      tangent.bottomLeftCorner<2, 1>() = -step.share * corner.friction * k * along;
  }
  pull(step);
}

/// Bolts: at their most when their ends are a spring's unit apart.
void SpringMass::pull(Step& step) const {
  step.tension.clear();
  step.tie_stiffness.clear();
  for (const Equations::Tie& tie : equations_->tie) {
    const Real stiffness = tie.most - tie.least, long_by = tie.lengthening(step.now);
    const Real stretch = std::clamp(long_by, 0.0, 1.0);
    const Real tension = tie.least + stiffness * stretch;
    Equations::add(tie.row, tension * tie.pull, step.rest);
    step.potential += tie.least * long_by + 0.5 * stiffness * stretch * stretch +
                      stiffness * std::max(0.0, long_by - 1);
    step.tension.push_back(tension);
    step.tie_stiffness.push_back(long_by > 0 && long_by < 1 ? stiffness : 0);
  }
}

/// With the friction of the pressure that is found; false where it does not converge.
bool SpringMass::newton(Step& step) {
  const Real loads = vector_of(load_).norm();
  look(step, true);
  // On the way the drag is none of the mass' own.
  const auto good = [&] {
    const Real enough = step.span < long_span ? on_the_way * step.drag : 0;
    return step.rest.norm() < std::max(balanced * loads, enough);
  };
  Real least = step.rest.norm();
  for (Index n = 0, idle = 0; n < most_newton && idle < most_idle; ++n) {
    if (n > 0 && good()) return true;
    const Real left = step.rest.norm();
    const Vector from = step.now, change = equations_->solve(step, mass_, true);
    if (!change.allFinite()) return false;
    for (Real part = 1; part > 0.1; part *= 0.5) {
      step.now = from + part * change;
      look(step, true);
      if (step.rest.norm() < left) break;
    }
    idle = step.rest.norm() < 0.5 * least ? 0 : idle + 1;
    least = std::min(least, step.rest.norm());
  }
  return good();
}

/// To the least potential, with the friction of the pressure that is given.
bool SpringMass::relax(Step& step) {
  const Real loads = vector_of(load_).norm();
  look(step, false);
  for (Index n = 0; n < most_relaxing; ++n) {
    if (step.rest.norm() < std::max(relaxed * loads, on_the_way * step.drag))
      return n <= most_relaxing / 4;
    const Vector from = step.now, change = equations_->solve(step, mass_, false);
    const Real slope = step.rest.dot(change), potential = step.potential;
    for (Real part = 1; part > 1e-9; part *= 0.5) {
      step.now = from + part * change;
      look(step, false);
      if (step.potential <= potential - 1e-4 * part * slope + 1e-13 * std::abs(potential)) break;
    }
  }
  return false;
}

SpringMass::State SpringMass::settle(Real share, State state, Real steady) {
  Step step;
  step.share = share;
  step.span = first_span;
  step.now = vector_of(state.displacement);
  step.pressure = state.pressure;
  Vector velocity = Vector::Zero(step.now.size());
  const Real loads = vector_of(load_).norm();
  state.ending = Ending::undecided;
  for (Index n = 0; n < most_steps && state.ending == Ending::undecided; ++n) {
    step.before = step.now;
    step.given = step.pressure;
    const bool smooth = newton(step);
    Real growth = 8, wrong = 0;
    if (!smooth) {
      step.now = step.before;
      const bool easy = relax(step);
      const Real changed = pressure_change(step);
      growth = !easy || changed > 0.15 ? 0.5 : 2;
      look(step, true);
      wrong = step.rest.norm() / loads;
    }
    const Vector last = std::exchange(velocity, (step.now - step.before) / step.span);
    const bool is_steady =
        step.span >= last_span ||
        (step.span >= long_span && (velocity - last).norm() <= steady * velocity.norm());
    if (wrong <= agreed && step.drag <= at_rest * loads)
      state.ending = Ending::stands;
    else if (smooth && is_steady && vector_of(load_).dot(velocity) > 0)
      state.ending = Ending::creeps;
    step.span = std::min(step.span * growth, last_span);
  }
  state.displacement.assign(step.now.data(), step.now.data() + step.now.size());
  state.velocity.assign(velocity.data(), velocity.data() + velocity.size());
  state.pressure = step.pressure;
  state.tension = step.tension;
  return state;
}

Real SpringMass::factor(const State& state) const {
  const Vector velocity = vector_of(state.velocity);
  std::vector<Index> part(scaled_.mass().bodies.size());
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](Index b) {
    while (part[b] != b) b = part[b] = part[part[b]];
    return b;
  };
  for (std::size_t c = 0; c < corners_.size(); ++c)
    if (const auto& [a, b] = corners_[c].body; a != none && b != none && state.pressure[c] > 0)
      part[root(a)] = root(b);
  for (std::size_t t = 0; t < equations_->tie.size(); ++t)
    if (const auto& [a, b] = equations_->pair[equations_->tie[t].pair].body;
        a != none && b != none && state.tension[t] > 0)
      part[root(a)] = root(b);
  std::vector<Real> driven(part.size(), 0), resisted(part.size(), 0);
  // No factor divides what bolts take up.
  for (std::size_t t = 0; t < equations_->tie.size(); ++t) {
    const auto& [a, b] = equations_->pair[equations_->tie[t].pair].body;
    driven[root(a == none ? b : a)] -= state.tension[t] * equations_->tie[t].lengthening(velocity);
  }
  for (std::size_t r = 0; r < load_.size(); ++r)
    driven[root(static_cast<Index>(r / 6))] += load_[r] * velocity[r];
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Corner& corner = corners_[c];
    const Eigen::Vector3d jump = equations_->jump(c, velocity);
    const Index body = corner.body[0] == none ? corner.body[1] : corner.body[0];
    resisted[root(body)] += (corner.friction * std::max(0.0, state.pressure[c]) + corner.cohesion) *
                                std::hypot(jump[1], jump[2]) +
                            corner.tension * std::max(0.0, jump[0]);
  }
  constexpr Real counts = 1e-3;  // of all power: the rest is noise of blocks at rest
  const Real all = std::accumulate(driven.begin(), driven.end(), 0.0);
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t b = 0; b < part.size(); ++b)
    if (driven[b] > counts * all) least = std::min(least, resisted[b] / driven[b]);
  return least;
}

}  // namespace rockfold
