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

constexpr Real shear_share = 0.5;                // of the normal stiffness, across
constexpr Real balanced = 1e-7, at_rest = 1e-6;  // of all loads
constexpr Index most_newton = 20, few_idle = 4, most_idle = 8, most_steps = 200, most_failed = 5,
                most_shakes = 20;
/// Of shaking: as long as the slowest of hundreds of blocks on each other swing, at least.
constexpr Real past_peak = 0.9;
constexpr Index least_swing = 2000, longest_swing = 40000;
/// Of a step against the drag: a load moves a body by as much as it moves the spring under it; then longer, until springs count no more.
constexpr Real most_growth = 8, first_span = 1, long_span = 1e3, last_span = 1e8;

Vector vector_of(const std::vector<Real>& x) {
  return Eigen::Map<const Vector>(x.data(), static_cast<Eigen::Index>(x.size()));
}

/// What the forces at a corner lose, by the jump of its ends along its axes. `drawn`: friction by an opening.
Eigen::Matrix3d tangent_of(Real normal, Real across, const Eigen::Vector2d& along, bool slips,
                           Real drawn) {
  Eigen::Matrix3d tangent = Eigen::Matrix3d::Zero();
  tangent(0, 0) = normal;
  tangent.bottomRightCorner<2, 2>() = across * Eigen::Matrix2d::Identity();
  if (slips) {
    tangent.bottomRightCorner<2, 2>() -= across * along * along.transpose();
    tangent.bottomLeftCorner<2, 1>() = -drawn * along;
  }
  return tangent;
}

}  // namespace

/// One step on its way.
struct SpringMass::Step {
  Real share = 0, span = 0;
  Real precise = 0;    ///< of the drag: what need not balance
  Vector before, now;  ///< displacements
  std::vector<Eigen::Vector2d> slipped,
      slip;                    ///< [corners] before, and now: no spring pulls it back
  std::vector<Real> pressure;  ///< [corners]
  std::vector<Eigen::Matrix3d> tangent;
  std::vector<Real> tension, tie_stiffness;  ///< [ties]
  Vector rest;                               ///< forces that do not balance, the drag among them
  Real drag = 0;                             ///< size of that alone
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
  Vector shaken_mass;  ///< [rows]
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
  Vector solve(const Step& step, const std::vector<Real>& mass);
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
Vector SpringMass::Equations::solve(const Step& step, const std::vector<Real>& mass) {
  fill(step, mass);
  constexpr Real least_pivot = 1e-14;
  factors->factorise(matrix, least_pivot);
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
  weigh_for_shaking();
  equations_->find_places(static_cast<Index>(mass.bodies.size()));
  if (!equations_->factors->analyse(equations_->matrix))
    throw Error(ErrorKind::analysis,
                "the springs between these blocks have factors too large to be computed");
}

SpringMass::~SpringMass() = default;

/// Of each row the sum of its stiffness: no mode swings by more than 1 per step (Gershgorin 1931), and steps are stable up to 2.
void SpringMass::weigh_for_shaking() {
  equations_->shaken_mass = Vector::Zero(static_cast<Eigen::Index>(load_.size()));
  const auto add = [&](const std::array<Index, 12>& row, const auto& stiffness) {
    for (int k = 0; k < 12; ++k)
      if (row[k] != none) equations_->shaken_mass[row[k]] += stiffness.row(k).cwiseAbs().sum();
  };
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Real k = corners_[c].stiffness;
    const auto& axes = equations_->corner[c].of_axis;
    const Eigen::Matrix3d springs =
        Eigen::Vector3d(k, shear_share * k, shear_share * k).asDiagonal();
    add(equations_->corner[c].row, (axes.transpose() * springs * axes).eval());
  }
  for (const Equations::Tie& tie : equations_->tie)
    add(tie.row, ((tie.most - tie.least) * tie.pull * tie.pull.transpose()).eval());
  for (Real& m : equations_->shaken_mass)
    if (m == 0) m = 1;  // of a body that touches nothing
}

SpringMass::State SpringMass::start() const {
  return {std::vector<Real>(load_.size(), 0),
          std::vector<Real>(load_.size(), 0),
          std::vector<std::array<Real, 2>>(corners_.size(), {0, 0}),
          std::vector<Real>(corners_.size(), 0),
          std::vector<Real>(equations_->tie.size(), 0),
          false,
          Ending::undecided};
}

/// Forces, and what they change by.
void SpringMass::look(Step& step, bool with_tangents) const {
  step.rest = vector_of(load_);
  Real drag = 0;
  for (Eigen::Index r = 0; r < step.now.size(); ++r) {
    const Real held = mass_[r] / step.span * (step.now[r] - step.before[r]);
    step.rest[r] -= held;
    drag += held * held;
  }
  step.drag = std::sqrt(drag);
  for (std::size_t c = 0; c < corners_.size(); ++c) {
    const Corner& corner = corners_[c];
    const Real k = corner.stiffness, s = shear_share * k;
    const Real pull = corner.pull(step.share);
    const Eigen::Vector3d jump = equations_->jump(c, step.now);
    const bool open = -k * jump[0] < -pull;
    const Real normal = open ? -pull : -k * jump[0];
    const Real limit = std::max(0.0, step.share * (corner.friction * normal + corner.cohesion));
    const Eigen::Vector2d stretch = jump.tail<2>() - step.slipped[c];
    const Real length = stretch.norm();
    const bool slips = s * length > limit;
    const Real secant = slips ? limit / length : s;
    const Eigen::Vector2d along = length > 0 ? stretch / length : stretch;
    step.slip[c] = slips ? jump.tail<2>() - limit / s * along : step.slipped[c];
    step.pressure[c] = normal;
    equations_->add(c, {normal, -secant * stretch[0], -secant * stretch[1]}, step.rest);
    if (with_tangents)
      step.tangent[c] = tangent_of(open ? 0 : k, secant, along, slips,
                                   open || limit == 0 ? 0 : step.share * corner.friction * k);
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
    step.tension.push_back(tension);
    step.tie_stiffness.push_back(long_by > 0 && long_by < 1 ? stiffness : 0);
  }
}

/// False where it does not converge.
bool SpringMass::newton(Step& step, Index patience) {
  const Real loads = vector_of(load_).norm();
  look(step);
  const auto good = [&] {
    return step.rest.norm() <=
           (step.drag > at_rest * loads ? step.precise * step.drag : balanced * loads);
  };
  Real least = step.rest.norm();
  for (Index n = 0, idle = 0; n < most_newton && idle < patience; ++n) {
    if (n > 0 && good()) return true;
    const Real left = step.rest.norm();
    const Vector from = step.now, change = equations_->solve(step, mass_);
    if (!change.allFinite()) return false;
    for (Real part = 1; part > 0.1; part *= 0.5) {
      step.now = from + part * change;
      look(step);
      if (step.rest.norm() < left) break;
    }
    idle = step.rest.norm() < 0.5 * least ? 0 : idle + 1;
    least = std::min(least, step.rest.norm());
  }
  return good();
}

/// Lets it swing without drag, from rest, and stops it wherever it is fastest, until it rests or no longer swings (dynamic relaxation with
/// kinetic damping; Barnes 1999). Each row has the mass with which the steps are just stable.
void SpringMass::shake(Step& step) const {
  const Real loads = vector_of(load_).norm();
  step.span = std::numeric_limits<Real>::infinity();
  step.before = step.now;
  Vector velocity = Vector::Zero(step.now.size());
  Real most = 0;
  for (Index n = 0, stopped = 0; n - stopped < std::max(least_swing, n / 2) && n < longest_swing;
       ++n) {
    look(step, false);
    step.slipped = step.slip;
    if (step.rest.norm() < balanced * loads) return;
    velocity += step.rest.cwiseQuotient(equations_->shaken_mass);
    const Real now = velocity.dot(equations_->shaken_mass.cwiseProduct(velocity));
    most = std::max(most, now);
    if (now < past_peak * most) {
      velocity.setZero();
      most = 0;
      stopped = n;
    }
    step.now += velocity;
  }
}

SpringMass::State SpringMass::settle(Real share, State state, Real steady) {
  Step step;
  step.share = share;
  step.precise =
      steady / 2;  // two velocities then differ by no more than `steady` where nothing changes
  step.span = first_span;
  step.now = vector_of(state.displacement);
  for (const auto& [a, b] : state.slip) step.slipped.emplace_back(a, b);
  step.slip = step.slipped;
  step.pressure.resize(corners_.size());
  step.tangent.resize(corners_.size());
  Vector velocity = vector_of(state.velocity);
  const Real loads = vector_of(load_).norm();
  state.ending = Ending::undecided;
  Vector steady_velocity = velocity;
  Real growth = most_growth, steady_for = 0;
  for (Index n = 0, failed = 0, shakes = state.shaken ? 1 : 0;
       n < most_steps && state.ending == Ending::undecided; ++n) {
    step.before = step.now;
    step.now += step.span * velocity;
    if (!newton(step, shakes == 0 ? few_idle : most_idle)) {
      step.now = step.before;
      growth = 2;
      if (shakes == 0 ? ++failed <= most_failed : step.span > first_span) {
        step.span /= most_growth;
      } else if (++shakes > most_shakes) {
        break;
      } else {
        shake(step);
        state.shaken = true;
        velocity.setZero();
        step.span = first_span;
        growth = most_growth;
      }
      continue;
    }
    if (state.shaken) step.slipped = step.slip;
    velocity = (step.now - step.before) / step.span;
    if ((velocity - steady_velocity).norm() <= steady * velocity.norm()) {
      steady_for += step.span;
    } else {
      steady_velocity = velocity;
      steady_for = 0;
    }
    if (step.drag <= at_rest * loads)
      state.ending = Ending::stands;
    else if (steady_for >= long_span && vector_of(load_).dot(velocity) > 0)
      state.ending = Ending::creeps;
    step.span = std::min(step.span * growth, last_span);
  }
  state.displacement.assign(step.now.data(), step.now.data() + step.now.size());
  state.velocity.assign(velocity.data(), velocity.data() + velocity.size());
  for (std::size_t c = 0; c < corners_.size(); ++c)
    state.slip[c] = {step.slipped[c][0], step.slipped[c][1]};
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
    resisted[root(body)] += std::max(0.0, corner.friction * state.pressure[c] + corner.cohesion) *
                            std::hypot(jump[1], jump[2]);
    // No factor divides the apex of a cone.
    const Real pull = corner.pull(1), opening = std::max(0.0, jump[0]);
    if (pull < corner.tension)
      driven[root(body)] -= pull * opening;
    else
      resisted[root(body)] += pull * opening;
  }
  constexpr Real counts = 1e-3;  // of all power: the rest is noise of blocks at rest
  const Real all = std::accumulate(driven.begin(), driven.end(), 0.0);
  Real least = std::numeric_limits<Real>::infinity();
  for (std::size_t b = 0; b < part.size(); ++b)
    if (driven[b] > counts * all) least = std::min(least, resisted[b] / driven[b]);
  return least;
}

}  // namespace rockfold
