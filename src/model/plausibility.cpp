#include "src/model/plausibility.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include "src/model/read_value.hpp"

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
constexpr Slip slips[] = {
    {"material", "young_modulus", "Pa", 0, 1e3, 1e9, "GPa", false},
    {"material", "young_modulus", "Pa", 1e3, 1e6, 1e6, "MPa", false},
    {"material", "density", "kg/m3", 0, 10, 1e3, "t/m3", false},
    {"material", "density", "kg/m3", 10, 100, 1e3 / g, "kN/m3, a unit weight", false},
    {"material", "density", "kg/m3", 10'000, infinity, 1 / g, "N/m3, a unit weight", false},
    {"bolt_type", "force_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt_type", "plate_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt_type", "shear_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt", "force_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt", "plate_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt", "shear_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt_pattern", "force_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt_pattern", "plate_capacity", "N", 0, 1e3, 1e3, "kN"},
    {"bolt_pattern", "shear_capacity", "N", 0, 1e3, 1e3, "kN"},
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
    look_for_radians();
    look_at_gravity();
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

  /// All angles are as small as radians: of a model in degrees some dip or friction is larger.
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
    if (!all_small || count < 2) return;
    add(*first, first_path,
        "is " + described(*first) +
            " deg, and no dip or friction angle is over 1.6 deg: did you mean radians? Angles are "
            "in degrees");
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
