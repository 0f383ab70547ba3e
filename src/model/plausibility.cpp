#include "src/model/plausibility.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <optional>
#include <string>

#include "src/base/vector.hpp"
#include "src/model/jointed.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/read/geometry/read_shapes.hpp"
#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

constexpr Real infinity = std::numeric_limits<Real>::infinity();
constexpr Real g = 9.81;  // m/s2

/// Numbers over `low` and under `high` are `factor` times too small: they were given in `meant`.
struct Slip {
  const char *section, *key, *unit;
  Real low, high;
  Real factor;
  const char* meant;
  bool of_weightless = true;  ///< of a model without gravity too, which may well have no units
};

/// Bounds: soft clay has some MPa, the strongest rock 150 GPa; pumice 500 kg/m3, steel 7,850; a thin rod of glass fibre holds 50 kN.
/// Joints filled with soft clay have 10 MPa/m, tight ones in granite 100 GPa/m (manual of UDEC). A cohesion of 100 Pa carries 4 mm of
/// rock; soil has some kPa, intact rock MPa.
constexpr Slip slips[] = {
    {"material", "young_modulus", "Pa", 0, 1e3, 1e9, "GPa", false},
    {"material", "young_modulus", "Pa", 1e3, 1e6, 1e6, "MPa", false},
    {"material", "density", "kg/m3", 0, 10, 1e3, "t/m3", false},
    {"material", "density", "kg/m3", 10, 100, 1e3 / g, "kN/m3, a unit weight", false},
    {"material", "density", "kg/m3", 10'000, infinity, 1 / g, "N/m3, a unit weight", false},
    {"material", "cohesion", "Pa", 0, 100, 1e6, "MPa", false},
    {"joint_material", "cohesion", "Pa", 0, 1, 1e6, "MPa", false},
    {"joint_material", "cohesion", "Pa", 1, 100, 1e3, "kPa", false},
    {"joint_material", "normal_stiffness", "Pa/m", 0, 1e3, 1e9, "GPa/m", false},
    {"joint_material", "normal_stiffness", "Pa/m", 1e3, 1e6, 1e6, "MPa/m", false},
    {"joint_material", "shear_stiffness", "Pa/m", 0, 1e3, 1e9, "GPa/m", false},
    {"joint_material", "shear_stiffness", "Pa/m", 1e3, 1e6, 1e6, "MPa/m", false},
};

/// Of bolts, wherever their keys stand. Friction bolts hold some 10 kN/m; yielding bolts give way by some 0.3 m; diameters are of some 10 to 60 mm, steel has 200 GPa and yields at some hundred MPa, grout holds by 1 MN/m and more for each
/// metre and metre of slip.
constexpr Slip bolt_slips[] = {
    {"", "force_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"", "plate_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"", "shear_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"", "pretension", "N", 0, 1e3, 1e3, "kN"},
    {"", "bond_strength", "N/m", 0, 1e3, 1e3, "kN/m"},
    {"", "bond_stiffness", "N/m per m", 0, 1e4, 1e6, "MN/m per m"},
    {"", "displacement_capacity", "m", 1, infinity, 1e-3, "mm"},
    {"", "diameter", "m", 1, infinity, 1e-3, "mm"},
    {"", "young_modulus", "Pa", 0, 1e3, 1e9, "GPa"},
    {"", "young_modulus", "Pa", 1e3, 1e6, 1e6, "MPa"},
    {"", "yield", "Pa", 0, 1e4, 1e6, "MPa"},
};

/// Of friction alone: no surface has under 1 deg, and 1 rad is more than most have. 0 is a smooth joint.
constexpr Slip friction_slips[] = {
    {"material", "friction_angle", "deg", 0, 1, 180 / std::numbers::pi, "rad"},
    {"joint_material", "friction_angle", "deg", 0, 1, 180 / std::numbers::pi, "rad"},
};

/// Angles, and what the largest of them is in radians.
struct Angle {
  const char *section, *key;
  Real most;
};
constexpr Angle angles[] = {
    {"joint_set", "dip", 1.6},
    {"joint_set", "dip_direction", 6.3},
    {"joint", "dip", 1.6},
    {"joint", "dip_direction", 6.3},
    {"material", "friction_angle", 1.6},
    {"joint_material", "friction_angle", 1.6},
    {"joint_material", "residual_friction_angle", 1.6},
};

std::optional<Real> number(const Value& value) {
  if (const auto* real = std::get_if<double>(&value.data)) return *real;
  if (const auto* integer = std::get_if<std::int64_t>(&value.data))
    return static_cast<Real>(*integer);
  return {};
}

/// Calls visit(number, value, path) for the numbers under `key` of all entries [[section]].
template <class Visit>
void visit_numbers(const Table& root, const std::string& section, const std::string& key,
                   const Visit& visit) {
  const Entry* list = root.find(section);
  const auto* entries = list ? std::get_if<Array>(&list->value.data) : nullptr;
  for (std::size_t i = 0; entries && i < entries->size(); ++i) {
    const auto* table = std::get_if<Table>(&(*entries)[i].data);
    const Entry* entry = table ? table->find(key) : nullptr;
    const auto x = entry ? number(entry->value) : std::nullopt;
    if (x) visit(*x, entry->value, item_path(section, i) + "." + key);
  }
}

class Plausibility {
 public:
  Plausibility(const Table& root, const Model& model, const Diagnostics& out)
      : root_(root), model_(model), out_(out) {}

  std::vector<Diagnostic> find() {
    for (const Slip& slip : slips)
      if (slip.of_weightless || model_.gravity != Vec3{}) look_for(slip);
    for (const char* section : {"bolt_type", "bolt", "bolt_pattern"})
      for (Slip slip : bolt_slips) {
        slip.section = section;
        look_for(slip);
      }
    look_for_radians();
    look_at_gravity();
    look_at_loads();
    look_at_tractions();
    look_at_motion();
    look_at_statics();
    look_at_heads();
    look_at_heads_over_solids();
    look_at_stress();
    look_at_earthquake();
    look_at_target();
    return std::move(found_);
  }

 private:
  void add(const Value& value, const std::string& path, const std::string& message) {
    found_.push_back({out_.place(value.spot, path), message});
  }

  void look_for(const Slip& slip) {
    visit_numbers(root_, slip.section, slip.key, [&](Real x, const Value& value, const auto& path) {
      if (!(x > slip.low && x < slip.high)) return;
      add(value, path,
          "is " + described(value) + " " + slip.unit + ": did you mean " +
              rounded_text(x * slip.factor) + " (" + described(value) + " " + slip.meant + ")?");
    });
  }

  /// Four digits are enough to see what is meant.
  static std::string rounded_text(Real x) {
    char text[32];
    std::snprintf(text, sizeof text, "%.4g", x);
    std::string result = number_text(std::strtod(text, nullptr));
    if (result.ends_with(".0")) result.resize(result.size() - 2);
    return result;
  }

  /// All angles are as small as radians: of a model in degrees some dip or friction is larger. Where some are larger, a friction or the
  /// angles of one plane may be in radians alone.
  void look_for_radians() {
    const Value* first = nullptr;
    std::string first_path;
    int count = 0;
    bool all_small = true;
    for (const Angle& angle : angles)
      visit_numbers(root_, angle.section, angle.key,
                    [&](Real x, const Value& value, const auto& path) {
                      all_small = all_small && x < angle.most;
                      if (x == 0) return;  // says nothing
                      if (++count == 1) first = &value, first_path = path;
                    });
    if (!all_small || count < 2) {
      for (const Slip& slip : friction_slips) look_for(slip);
      for (const char* section : {"joint_set", "joint"}) look_at_planes(section);
      return;
    }
    add(*first, first_path,
        "is " + described(*first) +
            " deg, and no dip or friction angle is over 1.6 deg: did you mean radians? Angles are "
            "in degrees");
  }

  /// Both angles of a plane are as small as radians: in degrees, of planes of all directions, some 2 % of those that lie so flat. Whole
  /// numbers are degrees.
  void look_at_planes(const char* section) {
    const Entry* list = root_.find(section);
    const auto* entries = list ? std::get_if<Array>(&list->value.data) : nullptr;
    for (std::size_t i = 0; entries && i < entries->size(); ++i) {
      const auto* table = std::get_if<Table>(&(*entries)[i].data);
      const Entry* dip = table ? table->find("dip") : nullptr;
      const Entry* direction = table ? table->find("dip_direction") : nullptr;
      if (!dip || !direction) continue;
      const auto a = number(dip->value), b = number(direction->value);
      if (!a || !b || !(*a > 0 && *a < 1.6 && *b > 0 && *b < 6.3)) continue;
      if (*a == std::floor(*a) && *b == std::floor(*b)) continue;
      add(dip->value, item_path(section, i) + ".dip",
          "is " + described(dip->value) + " deg, and dip_direction " + described(direction->value) +
              " deg: did you mean radians? Angles are in degrees");
    }
  }

  bool anything_acts() const {
    const auto moves = [](const Fixed& f) { return f.value != Vec3{} || !f.table.empty(); };
    return !model_.tractions.empty() || !model_.point_loads.empty() ||
           !model_.initial_velocities.empty() || model_.initial_stress.any ||
           model_.base_acceleration || !model_.waters.empty() ||
           std::any_of(model_.fixed.begin(), model_.fixed.end(), moves);
  }

  void look_at_gravity() {
    const Entry* gravity = root_.find("gravity");
    if (!gravity) return;
    if (model_.gravity[2] > 0)
      add(gravity->value, "gravity", "points up: z is up, weight is [0, 0, -9.81]");
    if (model_.gravity == Vec3{} && model_.analysis && !anything_acts())
      add(gravity->value, "gravity", "is zero and nothing else acts: the rock stays as it is");
  }

  /// Loads of newtons on rock that weighs giganewtons.
  void look_at_loads() {
    constexpr Real small = 1e3, heavy = 1e9;  // N
    Real density = 0;
    for (const Material& material : model_.materials) density = std::max(density, material.density);
    const Real size = given_size(model_);
    if (!(norm(model_.gravity) * density * size * size * size / 8 > heavy)) return;
    for (const PointLoad& load : model_.point_loads) {
      Real force = norm(load.force);
      for (const Vec3& f : load.table.value) force = std::max(force, norm(f));
      if (force > 0 && force < small)
        found_.push_back({load.place, "is at most " + rounded_text(force) +
                                          " N on rock that weighs giganewtons: did you mean kN?"});
    }
  }

  /// Stresses of which nobody takes account: 1 kPa is 4 cm of rock, or snow on a roof. A model without weight may well have no units.
  void look_at_tractions() {
    constexpr Real small = 1e3;  // Pa
    if (model_.gravity == Vec3{}) return;
    for (const Traction& traction : model_.tractions) {
      if (traction.head) continue;
      Real stress = norm(traction.value);
      for (const Vec3& p : traction.table.value) stress = std::max(stress, norm(p));
      if (stress > 0 && stress < small)
        found_.push_back({traction.place, "is at most " + rounded_text(stress) +
                                              " Pa, the weight of a few centimetres of rock: did "
                                              "you mean kPa?"});
    }
  }

  /// m/s of the fastest wave in the rock, 0 where it is not known.
  Real fastest_wave() const {
    Real fastest = 0;
    for (const Material& m : model_.materials) {
      if (!(m.density > 0 && m.young_modulus > 0)) continue;
      const Real p_wave = m.young_modulus * (1 - m.poisson_ratio) /
                          ((1 + m.poisson_ratio) * (1 - 2 * m.poisson_ratio));
      fastest = std::max(fastest, std::sqrt(p_wave / m.density));
    }
    return fastest;
  }

  /// A rock mass, which something must hold; a lone body may well fly.
  bool is_rock_mass() const {
    return has_joints(model_) ||
           std::any_of(model_.solids.begin(), model_.solids.end(), [](const Solid& s) {
             return std::find(s.continues.begin(), s.continues.end(), true) != s.continues.end();
           });
  }

  /// A motion that nothing holds, or whose waves the time step passes over.
  void look_at_motion() {
    if (!model_.analysis || !model_.analysis->has(AnalysisType::dynamic)) return;
    const Entry* analysis = root_.find("analysis");
    if (!analysis) return;
    if (is_rock_mass() && model_.fixed.empty() && model_.quiet_boundaries.empty() &&
        model_.initial_velocities.empty() && model_.gravity != Vec3{})
      add(analysis->value, "analysis",
          "is dynamic, and no [[fixed]] holds anything: all rock falls freely");
    constexpr Real long_steps = 1000;  // travel times through a cell of the lattice
    const Real spacing =
        model_.cover ? *std::max_element(model_.cover->spacing.begin(), model_.cover->spacing.end())
                     : 0;
    const Real speed = fastest_wave();
    if (!(spacing > 0 && speed > 0)) return;
    const Real travel = spacing / speed;
    Real longest = 0;
    for (const AnalysisStage& stage : model_.analysis->stages)
      if (stage.type == AnalysisType::dynamic) longest = std::max(longest, stage.time_step);
    if (longest <= long_steps * travel) return;
    add(analysis->value, "analysis.time_step",
        "is " + rounded_text(longest) + " s, " + rounded_text(longest / travel) +
            " times the travel time of a wave through a cell (" + rounded_text(travel) +
            " s): the motion is not resolved");
  }

  /// Statics of blocks that come apart at joints: only contact could hold those that no support does.
  void look_at_statics() {
    const Entry* analysis = root_.find("analysis");
    if (!analysis || !model_.analysis || !model_.analysis->has(AnalysisType::static_) ||
        !model_.cover || model_.cover->joints == JointTreatment::welded || !has_joints(model_))
      return;
    add(analysis->value, "analysis.type",
        "is \"static\", and the blocks come apart at the joints: those that no [[fixed]] holds are "
        "free to move. Take cover.joints = \"welded\" for rock that deforms as one mass, or type "
        "= \"quasi_static\"");
  }

  /// Water in slopes of [block_theory], whose toe is z = 0, that stands over the crest.
  void look_at_heads() {
    if (!model_.theory || model_.theory->slopes.empty()) return;
    Real crest = 0;
    for (const TheorySlope& slope : model_.theory->slopes) crest = std::max(crest, slope.height);
    for (const Water& water : model_.waters)
      if (const auto* head = std::get_if<WaterHead>(&water.level); head && head->elevation > crest)
        found_.push_back({water.place, "has a head of " + rounded_text(head->elevation) +
                                           " m, above the crest: the toe of a slope is z = 0, its "
                                           "crest " +
                                           rounded_text(crest) + " m"});
  }

  /// Bottom and top of the solids by the points that they are given by, m; none where files or half-spaces bound one.
  std::optional<std::array<Real, 2>> solid_heights() const {
    Real low = infinity, high = -infinity;
    for (const Solid& solid : model_.solids) {
      if (!solid.add) continue;
      if (std::holds_alternative<HalfspacesShape>(solid.shape) ||
          std::holds_alternative<MeshShape>(solid.shape) ||
          std::holds_alternative<TerrainShape>(solid.shape))
        return {};
      for (const Vec3& point : given_points(solid.shape)) {
        low = std::min(low, point[2]);
        high = std::max(high, point[2]);
      }
    }
    return low < high ? std::optional(std::array{low, high}) : std::nullopt;
  }

  /// Water far above the rock: heights above the sea in a model with an origin of its own, or pressures in kPa. A kilometre is left to
  /// models of deep tunnels, and ten heights to higher ones. Heads count against gravity: looked at where that is z.
  void look_at_heads_over_solids() {
    constexpr Real most = 10, deep = 1e3;  // heights of the solids, m, above their top
    const auto heights = solid_heights();
    if (!heights || model_.gravity[0] != 0 || model_.gravity[1] != 0) return;
    const auto [low, high] = *heights;
    const auto look = [&, low = low, high = high](Real head, const Place& place) {
      if (head <= high + std::max(deep, most * (high - low))) return;
      found_.push_back({place, "has a head of " + rounded_text(head) +
                                   " m; the solids reach from z = " + rounded_text(low) + " to " +
                                   rounded_text(high) +
                                   " m: did you mean another datum? A head is an elevation in m"});
    };
    for (const Water& water : model_.waters)
      if (const auto* head = std::get_if<WaterHead>(&water.level))
        look(head->elevation, water.place);
    for (const Traction& traction : model_.tractions)
      if (traction.head) look(*traction.head, traction.place);
  }

  /// Rock is pressed in every direction.
  void look_at_stress() {
    const Entry* entry = root_.find("initial_stress");
    const InitialStress& stress = model_.initial_stress;
    if (!entry || !stress.any) return;
    const auto pulls = [](const std::array<Real, 6>& s) {
      return s[0] >= 0 && s[1] >= 0 && s[2] >= 0 && s[0] + s[1] + s[2] > 0;
    };
    const bool none_given = stress.at == std::array<Real, 6>{};
    if (pulls(none_given ? stress.gradient : stress.at))
      add(entry->value, none_given ? "initial_stress.gradient" : "initial_stress.value",
          "is tension in every direction: compression is negative");
  }

  /// The strongest earthquakes shake with 1 to 2 g.
  void look_at_earthquake() {
    constexpr Real strongest = 2;
    const Entry* entry = root_.find("support");
    if (!entry || !model_.support || norm(model_.support->seismic_coefficient) <= strongest) return;
    add(entry->value, "support.seismic_coefficient",
        "is " + rounded_text(norm(model_.support->seismic_coefficient)) +
            " times g: it is a fraction of g, 0.1 for 10 %");
  }

  /// Codes ask for 1.1 to 3; 150 is per cent.
  void look_at_target() {
    constexpr Real largest = 20;
    const Entry* entry = root_.find("support");
    if (!entry || !model_.support || model_.support->target_factor_of_safety <= largest) return;
    add(entry->value, "support.target_factor_of_safety",
        "is " + rounded_text(model_.support->target_factor_of_safety) +
            ": it is a factor, 1.5 for 150 %");
  }

  const Table& root_;
  const Model& model_;
  const Diagnostics& out_;
  std::vector<Diagnostic> found_;
};

}  // namespace

std::vector<Diagnostic> implausible_numbers(const Table& root, const Model& model,
                                            const Diagnostics& out) {
  return Plausibility(root, model, out).find();
}

}  // namespace rockfold
