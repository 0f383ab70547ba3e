#include "host/joints/random_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "host/exact/orientation.hpp"
#include "host/joints/area_in_box.hpp"
#include "host/joints/radius_near_box.hpp"
#include "host/joints/random_stream.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real infinite = std::numeric_limits<Real>::infinity();
constexpr Real max_planes = 1e6;  // as of a regular set

// What drawing one set needs, resolved.
struct Sampler {
  Sampler(const JointSet& joint_set, const std::vector<Vec3>& corners, const std::string& set_key)
      : set(joint_set),
        random(*joint_set.random),
        key(set_key + ".random"),
        frame(plane_frame(joint_set.orientation)),
        box(bounding_box(corners)),
        region(corners),
        stream(joint_set.random->seed) {
    if (random.radius) radius = random.radius;
    if (!radius && set.radius) {
      radius.emplace();
      radius->mean = *set.radius;
    }
  }

  const JointSet& set;
  const RandomSet& random;
  std::string key;
  PlaneFrame frame;
  Extent box;
  const std::vector<Vec3>& region;
  std::optional<Distribution> radius;
  RandomStream stream;

  bool scatters() const { return std::isfinite(random.fisher_kappa); }
  Orientation draw_orientation() {
    if (!scatters()) return set.orientation;
    return draw_fisher(frame, random.fisher_kappa, stream);
  }
  [[noreturn]] void refuse_at(const std::string& what, const std::string& message) const {
    refuse(set.place, key + what, message);
  }
};

void check(const Distribution& distribution, const Sampler& sampler, const std::string& what) {
  constexpr Real max_deviation = 1e6;
  if (distribution.kind == Distribution::Kind::log_normal &&
      distribution.standard_deviation > max_deviation * distribution.mean)
    sampler.refuse_at(
        what, fmt::format("the standard deviation is {:.3g} times the mean; at most {:g} "
                          "times can be drawn",
                          distribution.standard_deviation / distribution.mean, max_deviation));
  const Real share = share_in_window(distribution);
  if (!(share >= least_share_in_window))
    sampler.refuse_at(
        what, fmt::format("only {:.2g} % of the values of this distribution lie in [{:g}, {:g}]; "
                          "at least {:g} % are needed",
                          100 * std::max(0.0, share), distribution.min, distribution.max,
                          100 * least_share_in_window));
}

// Planes or discs one spacing after another: from the origin along the mean normal, then against it.
class SpacedJoints {
 public:
  explicit SpacedJoints(Sampler& sampler) : s_(sampler) {
    for (const Vec3& p : s_.region) {
      low_ = std::min(low_, dot(s_.frame.normal, p - s_.set.origin));
      high_ = std::max(high_, dot(s_.frame.normal, p - s_.set.origin));
    }
    if (s_.radius) {
      const Vec3 lengths = s_.box.max - s_.box.min;
      // Discs that are not parallel to the others may reach into the region from beside it.
      if (s_.scatters()) reach_ = RadiusNearBox(*s_.radius, lengths).largest();
    }
  }

  std::vector<DrawnJoint> draw() {
    const auto& count = s_.set.count;
    add(0);
    walk(1, count ? std::floor(*count / 2.0) : infinite);
    walk(-1, count ? std::floor((*count - 1) / 2.0) : infinite);
    return std::move(joints_);
  }

 private:
  void walk(Real sense, Real most) {
    const Real end = sense > 0 ? high_ + reach_ : reach_ - low_;
    Real distance = 0;
    for (Real k = 0; k < most; ++k) {
      distance += rockfold::draw(*s_.random.spacing, s_.stream);
      if (most == infinite && !(distance <= end)) return;
      add(sense * distance);
    }
  }

  void add(Real t) {
    if (++drawn_ > max_planes)
      s_.refuse_at(
          ".spacing",
          fmt::format("makes more than {:g} joints of set \"{}\" in the {:.3g} m from its "
                      "origin through the rock; use a larger spacing",
                      max_planes, s_.set.name, std::max(high_, 0.0) - std::min(low_, 0.0)));
    DrawnJoint joint;
    joint.orientation = s_.draw_orientation();
    joint.radius = s_.radius ? rockfold::draw(*s_.radius, s_.stream) : infinite;
    joint.point = s_.set.origin + t * s_.frame.normal;
    if (t >= low_ - reach_ && t <= high_ + reach_) joints_.push_back(joint);
  }

  Sampler& s_;
  Real low_ = infinite, high_ = -infinite, reach_ = 0;  // m along the normal, from the origin
  Real drawn_ = 0;
  std::vector<DrawnJoint> joints_;
};

// Baecher's discs: centres uniform in space, of which those are drawn that may reach into the box.
class UniformDiscs {
 public:
  explicit UniformDiscs(Sampler& sampler)
      : s_(sampler),
        lengths_(s_.box.max - s_.box.min),
        volume_(lengths_[0] * lengths_[1] * lengths_[2]),
        radii_(*s_.radius, lengths_),
        outline_(disc_outline(s_.set.sides)) {
    if (s_.random.count) {
      target_ = *s_.random.count;
    } else if (s_.random.p32) {
      target_ = *s_.random.p32 * volume_;
    } else {
      target_ = *s_.random.p10 * volume_;
      line_ = normalized(s_.random.scanline[1] - s_.random.scanline[0]);
    }
  }

  std::vector<DrawnJoint> draw() {
    if (s_.random.count && target_ > max_discs) refuse_many(target_);
    Real reached = 0;
    while (reached < target_) {
      const Real before = reached;
      const bool kept = add(reached);
      check_number(reached);
      if (reached - target_ <= target_ - before) continue;  // the nearer of the two
      if (kept) joints_.pop_back();
      break;
    }
    return std::move(joints_);
  }

 private:
  // Draws a disc, adds its share to `reached` and keeps the disc if it meets the box.
  bool add(Real& reached) {
    const Real radius = radii_.draw(s_.stream);
    Vec3 centre;
    bool inside = true;
    for (int d = 0; d < 3; ++d) {
      centre[d] = s_.box.min[d] - radius + s_.stream.uniform() * (lengths_[d] + 2 * radius);
      inside = inside && centre[d] >= s_.box.min[d] && centre[d] < s_.box.max[d];
    }
    const Orientation orientation = s_.draw_orientation();
    const PlaneFrame frame = s_.scatters() ? plane_frame(orientation) : s_.frame;
    const auto corners = disc_corners(frame, centre, {}, radius, outline_);
    ++drawn_;
    if (s_.random.count && inside) reached += 1;
    if (!boxes_meet(bounding_box(corners), s_.box, 0)) return false;
    if (!s_.random.count) {
      const Real area = area_in_box(corners, s_.box);
      area_ += area;
      reached += s_.random.p32 ? area : area * std::abs(dot(frame.normal, line_));
    }
    joints_.push_back({orientation, centre, radius});
    return true;
  }

  // Early where the first discs show it.
  void check_number(Real reached) const {
    const bool first_look = drawn_ == 1e3 || drawn_ == 1e4 || drawn_ == 1e5 || drawn_ == 1e6;
    if (!first_look && drawn_ <= max_discs) return;
    const Real expected = drawn_ * target_ / reached;
    if (s_.random.p10 && reached <= 1e-9 * area_)
      s_.refuse_at(".scanline",
                   fmt::format("the discs of set \"{}\" lie along the scanline: hardly any would "
                               "cross it",
                               s_.set.name));
    if (drawn_ > max_discs || expected > 2 * max_discs) refuse_many(expected);
  }

  [[noreturn]] void refuse_many(Real number) const {
    const char* what = s_.random.count ? ".count" : s_.random.p32 ? ".p32" : ".p10";
    s_.refuse_at(what, fmt::format("asks for about {:.2g} discs of set \"{}\"; at most {:g} are "
                                   "allowed",
                                   number, s_.set.name, max_discs));
  }

  Sampler& s_;
  Vec3 lengths_;
  Real volume_;
  RadiusNearBox radii_;
  DiscOutline outline_;
  Real target_ = 0;
  Vec3 line_{};
  Real drawn_ = 0, area_ = 0;  // m², in the box
  std::vector<DrawnJoint> joints_;
};

}  // namespace

std::vector<DrawnJoint> draw_joints(const JointSet& set, const std::vector<Vec3>& region,
                                    const std::string& key) {
  Sampler sampler(set, region, key);
  const RandomSet& random = *set.random;
  if (sampler.radius) check(*sampler.radius, sampler, ".radius");
  if (random.spacing) {
    check(*random.spacing, sampler, ".spacing");
    return SpacedJoints(sampler).draw();
  }
  if (!sampler.radius)
    sampler.refuse_at("",
                      "asks for discs by `p32`, `p10` or `count` but gives no radius; `radius` is "
                      "needed here or in the set");
  if (!random.count && !random.p32 && !random.p10)
    sampler.refuse_at("", "says not how many joints; one of spacing, p32, p10, count is needed");
  if (random.p10 && random.scanline[0] == random.scanline[1])
    sampler.refuse_at(".scanline", "the scanline's ends are the same point; it needs a length");
  return UniformDiscs(sampler).draw();
}

}  // namespace rockfold
