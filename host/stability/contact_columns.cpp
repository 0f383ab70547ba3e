#include "host/stability/contact_columns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

constexpr Index first_edges = 4;    ///< of a friction polygon, one of them down the slope
constexpr Index first_corners = 8;  ///< of a polygon of cohesion, likewise
constexpr Real unlimited = std::numeric_limits<Real>::infinity();

Real part_of_circle(Index k, Index parts) {
  return 2 * std::numbers::pi * k / parts;
}

}  // namespace

ContactColumns::ContactColumns(const ScaledMass& scaled) : scaled_(scaled), rows_(scaled.rows()) {
  for (Index p = 0; p < static_cast<Index>(scaled.points().size()); ++p) {
    const ForcePoint& point = scaled.points()[p];
    const Index edges = scaled.contact(point).friction > 0 ? first_edges : 1;
    for (Index k = 0; k < edges; ++k)
      columns_.push_back({p, ContactColumn::Kind::edge, part_of_circle(k, edges)});
    const bool has_disc = scaled.contact(point).cohesion * point.area > 0;
    disc_row_.push_back(has_disc ? rows_++ : none);
    for (Index k = 0; has_disc && k < first_corners; ++k)
      columns_.push_back({p, ContactColumn::Kind::disc, part_of_circle(k, first_corners)});
  }
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
  for (const ForcePoint& point : scaled_.points()) {
    jumps.push_back(scaled_.jump(point, velocity));
    largest = std::max(largest, norm(jumps.back()));
  }
  std::vector<Real> taken_up(jumps.size(), 0);  // by polygons, for radius 1
  for (const ContactColumn& column : columns_)
    if (column.kind == ContactColumn::Kind::disc)
      taken_up[column.point] =
          std::max(taken_up[column.point], -dot(direction(column), jumps[column.point]));
  Index added = 0;
  for (std::size_t p = 0; p < jumps.size(); ++p) {
    const ForcePoint& point = scaled_.points()[p];
    const ContactArea& area = scaled_.contact(point);
    const auto& t = scaled_.tangents(point);
    const Real a = -dot(jumps[p], t[0]), b = -dot(jumps[p], t[1]), slip = std::hypot(a, b);
    const Vec3 of_priced = priced ? scaled_.jump(point, *priced) : Vec3{};
    const Real paid = scaled_.slip(point, of_priced);
    const Real opening = dot(jumps[p], area.normal) +
                         2 * std::max(0.0, -dot(of_priced, area.normal));  // overlaps are paid for
    const auto add = [&](ContactColumn::Kind kind) {
      columns_.push_back({static_cast<Index>(p), kind, std::atan2(b, a)});
      ++added;
    };
    if (opening < share * area.friction * (slip - paid) - gap * largest)
      add(ContactColumn::Kind::edge);
    if (disc_row_[p] != none && taken_up[p] < slip - gap * largest) add(ContactColumn::Kind::disc);
  }
  return added;
}

}  // namespace rockfold
