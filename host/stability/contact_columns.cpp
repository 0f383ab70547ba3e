#include "host/stability/contact_columns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

#include "host/stability/layered_program.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Index first_edges = 4;    ///< of a friction polygon, one of them down the slope
constexpr Index first_corners = 8;  ///< of a polygon of cohesion, likewise
/// Fewer pass on forces that the next layer cannot bear, more cost as much as the whole: 50 to 140 serve.
constexpr Index bodies_of_layer = 100;
constexpr Real unlimited = std::numeric_limits<Real>::infinity();

Real part_of_circle(Index k, Index parts) {
  return 2 * std::numbers::pi * k / parts;
}

bool has_disc(const ScaledMass& scaled, const ForcePoint& point) {
  return scaled.contact(point).cohesion * point.area > 0;
}

std::vector<ContactColumn> first_columns(const ScaledMass& scaled) {
  std::vector<ContactColumn> columns;
  for (Index p = 0; p < static_cast<Index>(scaled.points().size()); ++p) {
    const ForcePoint& point = scaled.points()[p];
    const Index edges = scaled.contact(point).friction > 0 ? first_edges : 1;
    for (Index k = 0; k < edges; ++k)
      columns.push_back({p, ContactColumn::Kind::edge, part_of_circle(k, edges)});
    for (Index k = 0; has_disc(scaled, point) && k < first_corners; ++k)
      columns.push_back({p, ContactColumn::Kind::disc, part_of_circle(k, first_corners)});
  }
  return columns;
}

}  // namespace

ContactColumns::ContactColumns(const ScaledMass& scaled)
    : ContactColumns(scaled, first_columns(scaled)) {}

ContactColumns::ContactColumns(const ScaledMass& scaled, std::vector<ContactColumn> columns)
    : scaled_(scaled), columns_(std::move(columns)), rows_(scaled.rows()) {
  for (const ForcePoint& point : scaled.points())
    disc_row_.push_back(has_disc(scaled, point) ? rows_++ : none);
  slack_ = scaled.rows() + rows_;
  ties_ = static_cast<Index>(scaled.mass().ties.size());
}

ContactColumns::Pull ContactColumns::pull(const ForcePoint& point, Real share) const {
  const ContactArea& area = scaled_.contact(point);
  const Real apex = area.friction > 0 ? area.cohesion / area.friction : unlimited;
  const bool cut_off = share * area.tension < apex;
  const Real per_force = point.area / scaled_.force_scale();
  const Real tension = cut_off ? share * area.tension * per_force : apex * per_force;
  return {tension, cut_off ? area.tension * per_force : 0};
}

ContactColumns::Pull ContactColumns::disc_radius(const ForcePoint& point, Real share) const {
  const ContactArea& area = scaled_.contact(point);
  const Pull tension = pull(point, share);
  const Real left =
      area.cohesion * point.area / scaled_.force_scale() - area.friction * tension.force;
  return {std::max(0.0, share * left), left - share * area.friction * tension.slope};
}

Vec3 ContactColumns::direction(const ContactColumn& column) const {
  const auto& t = scaled_.tangents(scaled_.points()[column.point]);
  return std::cos(column.angle) * t[0] + std::sin(column.angle) * t[1];
}

LinearProgram ContactColumns::program(Real share, Units units) const {
  const auto unit = [&](Real load) { return units == Units::own ? load : 1; };
  LinearProgram program(right_side(share));
  // Nothing is small against what stands on the right.
  const auto row_size = [&](Index r, Real load) {
    program.row_size.push_back(std::max(unit(load), std::abs(program.right[r])));
    return program.row_size.back();
  };
  for (Index r = 0; r < scaled_.rows(); ++r) {
    const Real load = scaled_.load(r / 6);
    row_size(r, load);
    for (const Real sign : {1.0, -1.0}) {
      program.add_entry(r, sign);
      program.add_column(1 / unit(load), unlimited, unit(load));
    }
  }
  for (std::size_t p = 0; p < disc_row_.size(); ++p)
    if (const Index r = disc_row_[p]; r != none) {
      program.add_entry(r, 1);
      program.add_column(0, unlimited, row_size(r, scaled_.load(scaled_.points()[p])));
    }
  for (const BoltTie& tie : scaled_.mass().ties) {
    const Real span = (tie.most - tie.least) / scaled_.force_scale();
    scaled_.add_tension(program, tie);
    program.add_column(0, span, unit(scaled_.load(tie.body)));
  }
  for (const ContactColumn& column : columns_) {
    const ForcePoint& point = scaled_.points()[column.point];
    const ContactArea& area = scaled_.contact(point);
    if (column.kind == ContactColumn::Kind::disc) {
      scaled_.add_force(program, point, direction(column));
      program.add_entry(disc_row_[column.point], 1);
      program.add_column(0, unlimited, program.row_size[disc_row_[column.point]]);
    } else {
      scaled_.add_force(program, point, area.normal + share * area.friction * direction(column));
      program.add_column(0, unlimited, unit(scaled_.load(point)));
    }
  }
  return program;
}

/// Minus the loads, what areas pull with and what ties bear at least; the radii of polygons.
std::vector<Real> ContactColumns::right_side(Real share) const {
  std::vector<Real> right = scaled_.right_side();
  right.resize(static_cast<std::size_t>(rows_), 0);
  LinearProgram pulls({});
  for (std::size_t p = 0; p < disc_row_.size(); ++p) {
    const ForcePoint& point = scaled_.points()[p];
    if (disc_row_[p] != none) right[disc_row_[p]] = disc_radius(point, share).force;
    if (const Real t = pull(point, share).force; t > 0)
      scaled_.add_force(pulls, point, -t * scaled_.contact(point).normal);
  }
  for (std::size_t e = 0; e < pulls.row.size(); ++e) right[pulls.row[e]] -= pulls.value[e];
  for (const BoltTie& tie : scaled_.mass().ties) {
    LinearProgram always({});
    scaled_.add_tension(always, tie);
    for (std::size_t e = 0; e < always.row.size(); ++e)
      right[always.row[e]] -= tie.least / scaled_.force_scale() * always.value[e];
  }
  return right;
}

/// [rows] the bodies on top first, as the loads go.
std::vector<Index> ContactColumns::layer_of_rows() const {
  const std::vector<RigidBody6>& bodies = scaled_.mass().bodies;
  Vec3 load{};
  for (const RigidBody6& body : bodies) load += body.force;
  std::vector<Real> down;
  for (const RigidBody6& body : bodies) down.push_back(dot(body.centre, load));
  std::vector<Index> order(bodies.size());
  std::iota(order.begin(), order.end(), Index{0});
  std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) { return down[a] < down[b]; });
  std::vector<Index> layer(static_cast<std::size_t>(rows_), 0);
  for (std::size_t k = 0; k < order.size(); ++k)
    std::fill_n(layer.begin() + 6 * order[k], 6, static_cast<Index>(k) / bodies_of_layer);
  for (std::size_t p = 0; p < disc_row_.size(); ++p) {
    if (disc_row_[p] == none) continue;
    const auto [a, b] = scaled_.contact(scaled_.points()[p]).body;
    const Index of_a = layer[6 * (a != none ? a : b)], of_b = layer[6 * (b != none ? b : a)];
    layer[disc_row_[p]] = std::min(of_a, of_b);
  }
  return layer;
}

LinearSolution ContactColumns::solve_anew(const LinearProgram& program) const {
  if (scaled_.mass().bodies.size() <= bodies_of_layer) return solve(program);
  return solve_in_layers(program, layer_of_rows());
}

Real ContactColumns::imbalance(const LinearSolution& solution) const {
  Real sum = 0;
  for (Index c = 0; c < 2 * scaled_.rows(); ++c) sum += solution.x[c] / scaled_.load(c / 12);
  return sum;
}

Real ContactColumns::slope(Real share, const LinearSolution& solution,
                           const std::vector<BodyVelocity>& velocity) const {
  Real slope = 0;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    if (columns_[c].kind == ContactColumn::Kind::disc) continue;
    const ForcePoint& point = scaled_.points()[columns_[c].point];
    const Real along = dot(direction(columns_[c]), scaled_.jump(point, velocity));
    slope -= solution.x[slack_ + ties_ + c] * scaled_.contact(point).friction * along;
  }
  for (std::size_t p = 0; p < disc_row_.size(); ++p) {
    const ForcePoint& point = scaled_.points()[p];
    slope += pull(point, share).slope *
             dot(scaled_.contact(point).normal, scaled_.jump(point, velocity));
    if (disc_row_[p] != none)
      slope -= solution.price[disc_row_[p]] * disc_radius(point, share).slope;
  }
  return slope;
}

std::vector<Vec3> ContactColumns::forces(Real share, const LinearSolution& solution) const {
  struct Parts {
    Real normal = 0;
    Vec3 slip{};
  };
  std::vector<Parts> parts(scaled_.points().size());
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const ContactColumn& column = columns_[c];
    const ContactArea& area = scaled_.contact(scaled_.points()[column.point]);
    const Real x = std::max(0.0, solution.x[slack_ + ties_ + c]);
    const bool edge = column.kind == ContactColumn::Kind::edge;
    parts[column.point].normal += edge ? x : 0;
    parts[column.point].slip += (edge ? x * share * area.friction : x) * direction(column);
  }
  std::vector<Vec3> force;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const ForcePoint& point = scaled_.points()[p];
    const Real normal = parts[p].normal - pull(point, share).force;
    force.push_back(scaled_.force_scale() *
                    (normal * scaled_.contact(point).normal + parts[p].slip));
  }
  return force;
}

void ContactColumns::price(LinearProgram& program, Real share,
                           const std::vector<BodyVelocity>& slips, Real unbalanced) const {
  const Index balance = 2 * scaled_.rows();
  for (Index c = 0; c < balance; ++c) program.cost[c] = unbalanced / scaled_.load(c / 12);
  for (std::size_t p = 0; p < disc_row_.size(); ++p)
    if (disc_row_[p] != none)
      program.cost[balance + disc_row_[p] - scaled_.rows()] =
          scaled_.slip(scaled_.points()[p], scaled_.jump(scaled_.points()[p], slips));
  for (Index t = 0; t < ties_; ++t)
    program.cost[slack_ + t] = -scaled_.lengthening(scaled_.mass().ties[t], slips);
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    const ForcePoint& point = scaled_.points()[columns_[c].point];
    const ContactArea& area = scaled_.contact(point);
    const Vec3 jump = scaled_.jump(point, slips);
    const Real lacks = scaled_.slip(point, jump) + dot(direction(columns_[c]), jump);
    program.cost[slack_ + ties_ + c] =
        columns_[c].kind == ContactColumn::Kind::disc
            ? lacks
            : std::abs(dot(area.normal, jump)) + share * area.friction * lacks;
  }
}

std::vector<Real> ContactColumns::tensions(const LinearSolution& solution) const {
  std::vector<Real> tension;
  for (Index t = 0; t < ties_; ++t) {
    const BoltTie& tie = scaled_.mass().ties[t];
    tension.push_back(std::clamp(tie.least + scaled_.force_scale() * solution.x[slack_ + t],
                                 tie.least, tie.most));
  }
  return tension;
}

Index ContactColumns::round_off(Real share, const std::vector<BodyVelocity>& velocity, Real gap,
                                const std::vector<BodyVelocity>* priced) {
  Real largest = 0;
  std::vector<Vec3> jumps;
  std::vector<Real> angles;  // against the slip
  for (const ForcePoint& point : scaled_.points()) {
    jumps.push_back(scaled_.jump(point, velocity));
    largest = std::max(largest, norm(jumps.back()));
    const auto& t = scaled_.tangents(point);
    angles.push_back(std::atan2(-dot(jumps.back(), t[1]), -dot(jumps.back(), t[0])));
  }
  std::vector<Real> taken_up(jumps.size(), 0);              // by polygons, for radius 1
  std::vector<std::array<bool, 2>> is_there(jumps.size());  // [kinds] what would be added
  for (const ContactColumn& column : columns_) {
    is_there[column.point][static_cast<std::size_t>(column.kind)] |=
        column.angle == angles[column.point];
    if (column.kind == ContactColumn::Kind::disc)
      taken_up[column.point] =
          std::max(taken_up[column.point], -dot(direction(column), jumps[column.point]));
  }
  Index added = 0;
  for (std::size_t p = 0; p < jumps.size(); ++p) {
    const ForcePoint& point = scaled_.points()[p];
    const ContactArea& area = scaled_.contact(point);
    const Real slip = scaled_.slip(point, jumps[p]);
    const Vec3 of_priced = priced ? scaled_.jump(point, *priced) : Vec3{};
    const Real paid = scaled_.slip(point, of_priced);
    const Real opening = dot(jumps[p], area.normal) +
                         2 * std::max(0.0, -dot(of_priced, area.normal));  // overlaps are paid for
    const auto add = [&](ContactColumn::Kind kind) {
      if (is_there[p][static_cast<std::size_t>(kind)]) return;
      columns_.push_back({static_cast<Index>(p), kind, angles[p]});
      ++added;
    };
    if (opening < share * area.friction * (slip - paid) - gap * largest)
      add(ContactColumn::Kind::edge);
    if (disc_row_[p] != none && taken_up[p] < slip - gap * largest) add(ContactColumn::Kind::disc);
  }
  return added;
}

}  // namespace rockfold
