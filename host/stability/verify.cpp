#include "host/stability/verify.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "host/stability/certificate_form.hpp"
#include "host/stability/certified_area_exact.hpp"

namespace rockfold {

namespace {

constexpr Real balance_tolerance = 1e-9;    ///< of the sizes of all forces on a body
constexpr Real load_tolerance = 1e-6;       ///< of the load of a body …
constexpr Real all_load_tolerance = 1e-12;  ///< … and of all loads together, as doubles round them
constexpr Real dilation_tolerance = 1e-7;   ///< of the fastest slip
constexpr int hidden_pressures = 10;        ///< times those of `below`: it may be far from collapse
constexpr Real overlap_tolerance = 1e-6;    ///< of the fastest slip, in a state of sliding
constexpr Real collapse_tolerance = 1e-3;   ///< of the power of the loads, in a state of sliding

/// The sum of its components' sizes: as good as its length, and rational.
Exact size(const ExactVec3& a) {
  return abs(a[0]) + abs(a[1]) + abs(a[2]);
}

Exact positive(const Exact& x) {
  return x > 0 ? x : Exact(0);
}

/// What acts on a body: sums, and the sums of sizes that they are measured by.
struct Acting {
  ExactVec3 force, moment;  ///< what is left over
  Exact forces, moments;    ///< sums of sizes
  Exact reach;              ///< m, of its farthest point from the centre

  Exact moment_scale() const { return moments + reach * forces; }
};

/// A number over what it is measured by.
Exact ratio(const Exact& part, const Exact& whole) {
  return part == 0 ? Exact(0) : whole == 0 ? Exact(1) : Exact(part / whole);
}

class Verification {
 public:
  explicit Verification(const Certificate& certificate)
      : mass_(certificate.mass), certificate_(certificate) {
    for (std::size_t c = 0; c < mass_.contacts.size(); ++c)
      areas_.push_back(area_of(mass_, static_cast<Index>(c)));
    for (const RigidBody6& body : mass_.bodies) {
      centres_.push_back(rational(body.centre));
      all_load_ += size(rational(body.force));
    }
  }

  /// The largest imbalance, of the sizes of the forces on its body.
  Real residual() const {
    Exact largest = imbalance(certificate_.below);
    if (has_sliding()) largest = std::max(largest, imbalance(certificate_.sliding_balance));
    return largest.get_d();
  }

  void run() const {
    for (const CertifiedArea& area : areas_) require_shape(area);
    within("bound from below", [&] { require_balance(certificate_.below); });
    if (!certificate_.above.velocity.empty()) run_above();
    if (has_sliding()) run_sliding();
  }

  void run_above() const {
    within("bound from above", [&] { require_mechanism(certificate_.above); });
    if (certificate_.below.factor > certificate_.above.factor)
      throw WrongCertificate{
          fmt::format("the bound from below, {:.10g}, is over the one from above, {:.10g}",
                      certificate_.below.factor, certificate_.above.factor)};
  }

  void run_sliding() const {
    within("sliding", [&] { require_collapse(); });
  }

 private:
  bool has_sliding() const { return !certificate_.sliding_mechanism.velocity.empty(); }

  template <class Check>
  static void within(const char* part, const Check& check) {
    try {
      check();
    } catch (const WrongCertificate& wrong) {
      throw WrongCertificate{std::string(part) + ": " + wrong.what};
    }
  }

  /// Calls at(area, position, triangle's area, place's name, force) for all points, in the order of force_points().
  template <class At>
  void for_each_force(const Balance& balance, const At& at) const {
    std::size_t next = 0;
    const SafeRoot nothing{0, 0};
    for (const CertifiedArea& area : areas_) {
      for (std::size_t i = 0; i < area.corner.size(); ++i)
        at(area, area.corner[i], nothing, "corner", i + 1, rational(balance.force[next++]));
      for (std::size_t i = 0; i < area.triangle.size(); ++i) {
        const CertifiedTriangle& triangle = area.triangle[i];
        const auto& [a, b, c] = triangle.vertex;
        at(area, Exact(1, 3) * (a + b + c), triangle.area, "triangle", i + 1,
           rational(balance.force[next++]));
      }
    }
  }

  std::vector<Acting> acting(const Balance& balance) const {
    std::vector<Acting> result;
    for (const RigidBody6& body : mass_.bodies) {
      const ExactVec3 force = rational(body.force), moment = rational(body.moment);
      result.push_back({force, moment, size(force), size(moment), 0});
    }
    for_each_force(balance, [&](const CertifiedArea& area, const ExactVec3& x, const SafeRoot&,
                                const char*, std::size_t, const ExactVec3& force) {
      add(result, area.body[0], x, force);
      add(result, area.body[1], x, Exact(-1) * force);
    });
    for (std::size_t t = 0; t < mass_.ties.size(); ++t) {
      const BoltTie& tie = mass_.ties[t];
      const ExactVec3 pull = rational(balance.tension[t]) * rational(tie.axis);
      add(result, tie.body[0], rational(tie.at), pull);
      add(result, tie.body[1], rational(tie.at), Exact(-1) * pull);
    }
    return result;
  }

  /// A force on a body, if it is one.
  void add(std::vector<Acting>& all, Index body, const ExactVec3& at,
           const ExactVec3& force) const {
    if (body == none) return;
    Acting& on = all[body];
    const ExactVec3 arm = at - centres_[body], moment = cross(arm, force);
    on.force = on.force + force;
    on.moment = on.moment + moment;
    on.forces += size(force);
    on.moments += size(moment);
    on.reach = std::max(on.reach, size(arm));
  }

  Exact imbalance(const Balance& balance) const {
    Exact largest = 0;
    for (const Acting& on : acting(balance))
      largest = std::max(
          {largest, ratio(size(on.force), on.forces), ratio(size(on.moment), on.moment_scale())});
    return largest;
  }

  /// `left` is what is left over of sums of the size `whole`, on a body loaded by `load`; both in N or both in N m.
  void require_nothing_left(Index body, const char* what, const Exact& left, const Exact& whole,
                            const Exact& load, const Exact& rounding) const {
    if (left > rational(balance_tolerance) * whole)
      throw WrongCertificate{fmt::format("{}: the {} do not balance: {} of their size is left over",
                                         body_text(mass_, body), what,
                                         short_text(ratio(left, whole)))};
    if (left > rational(load_tolerance) * load + rounding)
      throw WrongCertificate{
          fmt::format("{}: the {} do not balance: {} of its load is left over, hidden by {} "
                      "that press on each other",
                      body_text(mass_, body), what, short_text(ratio(left, load)), what)};
  }

  void require_balance(const Balance& balance) const {
    const std::vector<Acting> all = acting(balance);
    const Exact rounding = rational(all_load_tolerance) * all_load_;
    for (std::size_t b = 0; b < all.size(); ++b) {
      const Acting& on = all[b];
      const auto body = static_cast<Index>(b);
      const Exact load = size(rational(mass_.bodies[b].force));
      const Exact moment = size(rational(mass_.bodies[b].moment)) + on.reach * load;
      require_nothing_left(body, "forces", size(on.force), on.forces, load, rounding);
      require_nothing_left(body, "moments", size(on.moment), on.moment_scale(), moment,
                           on.reach * rounding);
    }
    for (std::size_t t = 0; t < mass_.ties.size(); ++t)
      if (balance.tension[t] < mass_.ties[t].least || balance.tension[t] > mass_.ties[t].most)
        throw WrongCertificate{
            fmt::format("{}: the tension, {:.10g} N, is not between {:.10g} and {:.10g}",
                        tie_text(mass_, static_cast<Index>(t)), balance.tension[t],
                        mass_.ties[t].least, mass_.ties[t].most)};
    const Exact factor = rational(balance.factor);
    for_each_force(balance,
                   [&](const CertifiedArea& area, const ExactVec3&, const SafeRoot& point_area,
                       const char* kind, std::size_t number, const ExactVec3& force) {
                     require_borne(force, area, strength_of(area, factor), point_area.below,
                                   fmt::format("{}, {} {}", area.name, kind, number));
                   });
  }

  ExactVec3 velocity_at(const ExactVec3& x, Index body, const Mechanism& mechanism) const {
    if (body == none) return {};
    const BodyVelocity& v = mechanism.velocity[body];
    return rational(v.velocity) + cross(rational(v.spin), x - centres_[body]);
  }

  /// Of the first body against the second, m/s.
  ExactVec3 slip_at(const ExactVec3& x, const CertifiedArea& area,
                    const Mechanism& mechanism) const {
    return velocity_at(x, area.body[0], mechanism) - velocity_at(x, area.body[1], mechanism);
  }

  /// The part of a slip across the normal; an upper bound.
  static Exact shear(const ExactVec3& slip, const CertifiedArea& area) {
    const Exact along = dot(slip, area.normal);
    return root_of(square(slip) - along * along / area.normal_square).above;
  }

  Exact fastest_slip(const Mechanism& mechanism) const {
    Exact fastest = 0;
    for (const CertifiedArea& area : areas_)
      for (const ExactVec3& x : area.corner)
        fastest = std::max(fastest, square(slip_at(x, area, mechanism)));
    return root_of(fastest).below;
  }

  Exact load_power(const Mechanism& mechanism) const {
    Exact power = 0;
    for (std::size_t b = 0; b < mass_.bodies.size(); ++b) {
      const RigidBody6& body = mass_.bodies[b];
      const BodyVelocity& v = mechanism.velocity[b];
      power += dot(rational(body.force), rational(v.velocity)) +
               dot(rational(body.moment), rational(v.spin));
    }
    return power;
  }

  static bool moves(const BodyVelocity& v) { return v.velocity != Vec3{} || v.spin != Vec3{}; }

  static void require_motion(const Mechanism& mechanism) {
    if (std::none_of(mechanism.velocity.begin(), mechanism.velocity.end(), moves))
      throw WrongCertificate{"no body moves"};
  }

  /// How much each area overlaps at most, m/s: opening must not be less than `dilation` wants of a slip, but for that share of the fastest.
  template <class Dilation>
  std::vector<Exact> overlaps(const Mechanism& mechanism, Real tolerance,
                              const Dilation& dilation) const {
    const Exact fastest = fastest_slip(mechanism);
    std::vector<Exact> largest(areas_.size(), 0);
    for (std::size_t c = 0; c < areas_.size(); ++c)
      for (std::size_t i = 0; i < areas_[c].corner.size(); ++i) {
        const CertifiedArea& area = areas_[c];
        const ExactVec3 slip = slip_at(area.corner[i], area, mechanism);
        const Exact lack = over(-dot(slip, area.normal), area.normal_length) + dilation(area, slip);
        if (lack > rational(tolerance) * fastest)
          throw WrongCertificate{
              fmt::format("{}, corner {}: the slip opens the area too little, by {} of the "
                          "fastest slip",
                          area.name, i + 1, short_text(ratio(lack, fastest)))};
        largest[c] = std::max(largest[c], lack);
      }
    return largest;
  }

  /// What areas that overlap a little could hide, W: ten times the pressure of `below` on each, or the loads of all that moves on the worst.
  Exact hidden_power(const std::vector<Exact>& overlaps, const Mechanism& mechanism) const {
    Exact sum = 0;
    for_each_force(certificate_.below,
                   [&](const CertifiedArea& area, const ExactVec3&, const SafeRoot&, const char*,
                       std::size_t, const ExactVec3& force) {
                     const Exact pressure = positive(dot(force, area.normal));
                     sum += hidden_pressures * pressure * overlaps[&area - areas_.data()];
                   });
    Exact moving_load = 0;
    for (std::size_t b = 0; b < mass_.bodies.size(); ++b)
      if (moves(mechanism.velocity[b])) moving_load += size(rational(mass_.bodies[b].force));
    for (const Exact& worst : overlaps) sum = std::max(sum, Exact(worst * moving_load));
    return sum;
  }

  void require_mechanism(const Mechanism& mechanism) const {
    require_motion(mechanism);
    const Exact factor = rational(mechanism.factor);
    const auto dilation = [&](const CertifiedArea& area, const ExactVec3& slip) {
      return Exact(area.friction / factor * shear(slip, area));
    };
    const Exact hidden = hidden_power(overlaps(mechanism, dilation_tolerance, dilation), mechanism);
    Exact taken = 0;
    for (const CertifiedArea& area : areas_) taken += dissipation(area, mechanism, factor);
    for (const BoltTie& tie : mass_.ties) taken += most_power(tie, mechanism);
    const Exact power = load_power(mechanism);
    if (power <= taken)
      throw WrongCertificate{fmt::format(
          "the power of the loads, {:.10g} W, is not over the {:.10g} W that strength can take up",
          power.get_d(), taken.get_d())};
    if (power - taken <= hidden)
      throw WrongCertificate{fmt::format(
          "the loads' power is {} W over what strength can take up, but slips that open areas too "
          "little may hide {} W",
          short_text(power - taken), short_text(hidden))};
  }

  /// m/s
  Exact lengthening(const BoltTie& tie, const Mechanism& mechanism) const {
    const ExactVec3 at = rational(tie.at);
    return dot(rational(tie.axis),
               velocity_at(at, tie.body[1], mechanism) - velocity_at(at, tie.body[0], mechanism));
  }

  /// The most that a tie can take up, W.
  Exact most_power(const BoltTie& tie, const Mechanism& mechanism) const {
    const Exact longer = lengthening(tie, mechanism);
    return longer * rational(longer > 0 ? tie.most : tie.least);
  }

  /// The most that cohesion and tensile strength of an area can take up, W: convex over each triangle, so not over the mean of its vertices.
  Exact dissipation(const CertifiedArea& area, const Mechanism& mechanism,
                    const Exact& factor) const {
    const ReducedStrength s = strength_of(area, factor);
    const Exact cohesion = s.cohesion - s.friction * s.tension;
    Exact sum = 0;
    for (const CertifiedTriangle& triangle : area.triangle)
      for (const ExactVec3& x : triangle.vertex) {
        const ExactVec3 slip = slip_at(x, area, mechanism);
        const Exact opening = positive(over(dot(slip, area.normal), area.normal_length));
        sum += triangle.area.above / 3 * (s.tension * opening + cohesion * shear(slip, area));
      }
    return sum;
  }

  void require_collapse() const {
    const Balance& balance = certificate_.sliding_balance;
    const Mechanism& mechanism = certificate_.sliding_mechanism;
    if (balance.factor != mechanism.factor)
      throw WrongCertificate{fmt::format("its forces are for the factor {}, its velocities for {}",
                                         balance.factor, mechanism.factor)};
    require_balance(balance);
    require_motion(mechanism);
    overlaps(mechanism, overlap_tolerance,
             [](const CertifiedArea&, const ExactVec3&) { return Exact(0); });
    const Exact power = load_power(mechanism);
    if (power <= 0)
      throw WrongCertificate{
          fmt::format("the loads do no work: their power is {} W", short_text(power))};
    const Exact unused = unused_power(balance, mechanism);
    if (unused > rational(collapse_tolerance) * power)
      throw WrongCertificate{
          fmt::format("the forces are not at their strength on these slips: they lack {} of "
                      "the loads' power",
                      short_text(unused / power))};
  }

  /// What these forces lack of all that strength could take up of the slips, W; of an area that opens, all that it passes on; of one that
  /// overlaps, all the work of its pressure.
  Exact unused_power(const Balance& balance, const Mechanism& mechanism) const {
    const Exact factor = rational(balance.factor);
    Exact sum = 0;
    for (std::size_t t = 0; t < mass_.ties.size(); ++t)
      sum += most_power(mass_.ties[t], mechanism) -
             rational(balance.tension[t]) * lengthening(mass_.ties[t], mechanism);
    for_each_force(
        balance, [&](const CertifiedArea& area, const ExactVec3& x, const SafeRoot& point_area,
                     const char*, std::size_t, const ExactVec3& force) {
          const ReducedStrength s = strength_of(area, factor);
          const ExactVec3 slip = slip_at(x, area, mechanism);
          const Exact along = dot(force, area.normal), opening = dot(slip, area.normal);
          const Exact pressure = over(along, area.normal_length);
          const Exact passed_on =
              opening > 0 ? Exact(pressure + s.tension * point_area.above) : Exact(abs(pressure));
          sum += passed_on * over(abs(opening), area.normal_length);
          sum += (s.friction * pressure + s.cohesion * point_area.above) * shear(slip, area);
          sum += dot(force, slip) - along * opening / area.normal_square;
        });
    return sum;
  }

  const RigidMass& mass_;
  const Certificate& certificate_;
  std::vector<CertifiedArea> areas_;
  std::vector<ExactVec3> centres_;
  Exact all_load_ = 0;  ///< N, sizes of all loads
};

}  // namespace

Verdict verify(const Certificate& certificate) {
  Verdict verdict{lack_of_form(certificate), 0};
  if (!verdict.holds()) return verdict;
  try {
    const Verification verification(certificate);
    verdict.residual = verification.residual();
    verification.run();
  } catch (const WrongCertificate& wrong) {
    verdict.wrong = wrong.what;
  }
  return verdict;
}

Verdict verify_sliding(const RigidMass& mass, const Balance& balance, const Mechanism& mechanism) {
  Verdict verdict;
  const Certificate certificate{mass, {}, {}, balance, mechanism};
  try {
    Verification(certificate).run_sliding();
  } catch (const WrongCertificate& wrong) {
    verdict.wrong = wrong.what;
  }
  return verdict;
}

}  // namespace rockfold
