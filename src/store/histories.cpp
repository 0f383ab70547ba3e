#include "src/store/histories.hpp"

#include <array>
#include <map>
#include <string>
#include <utility>

namespace rockfold {

namespace {

template <std::size_t n>
History::Column column(const char* name, const char* unit,
                       const std::vector<std::array<Real, n>>& rows) {
  History::Column made{name, unit, static_cast<int>(n), {}};
  made.values.reserve(n * rows.size());
  for (const auto& row : rows) made.values.insert(made.values.end(), row.begin(), row.end());
  return made;
}

template <typename T>
History::Column column(const char* name, const char* unit, const std::vector<T>& values) {
  History::Column made{name, unit, 1, {}};
  for (const T value : values) made.values.push_back(static_cast<Real>(value));
  return made;
}

History point_history(const MonitorHistory& m) {
  return {m.name,
          "",
          m.time,
          {column("displacement", "m", m.displacement), column("velocity", "m/s", m.velocity),
           column("acceleration", "m/s2", m.acceleration), column("stress", "Pa", m.stress)}};
}

History joint_history(const JointHistory& m) {
  return {m.name,
          m.joint,
          m.time,
          {column("normal_stress", "Pa", m.normal_stress),
           column("shear_stress", "Pa", m.shear_stress), column("opening", "m", m.opening),
           column("slip", "m", m.slip), column("state", "", m.state)}};
}

constexpr std::pair<const char*, Real Energy::*> energy_parts[] = {
    {"kinetic", &Energy::kinetic},
    {"strain", &Energy::strain},
    {"potential", &Energy::potential},
    {"contact", &Energy::contact},
    {"dissipated", &Energy::dissipated},
    {"damping", &Energy::damping},
    {"quiet", &Energy::quiet},
    {"friction", &Energy::friction},
    {"impact", &Energy::impact},
    {"numerical", &Energy::numerical},
    {"ratio", &Energy::ratio},
    {"loads", &Energy::loads},
    {"supports", &Energy::supports},
    {"excavated", &Energy::excavated},
    {"bolts", &Energy::bolts}};

}  // namespace

std::vector<History> monitor_histories(const Model& model, const RunResult& run) {
  std::vector<History> histories;
  auto point = run.monitors.begin();
  auto joint = run.joint_monitors.begin();
  for (const Monitor& monitor : model.monitors)
    histories.push_back(monitor.is_of_rock() ? point_history(*point++) : joint_history(*joint++));
  return histories;
}

History energy_history(const RunResult& run) {
  History history{"", "", run.energy_time, {}};
  for (const auto& [name, part] : energy_parts) {
    std::vector<Real> values;
    for (const Energy& energy : run.energies) values.push_back(energy.*part);
    history.columns.push_back(column(name, "J", values));
  }
  return history;
}

History contact_history(const RunResult& run) {
  const ContactHistory& h = run.contact_history;
  if (h.open.empty()) return {};
  return {"",
          "",
          run.energy_time,
          {column("open", "", h.open), column("stick", "", h.stick), column("slide", "", h.slide),
           column("iterations", "", h.iterations), column("substeps", "", h.substeps)}};
}

void add_histories(ResultWriter& writer, const Model& model, const RunResult& run) {
  std::map<std::string, History> groups{{"energy", energy_history(run)}};
  Index number = 0;
  for (History& monitor : monitor_histories(model, run))
    groups["monitors/" + std::to_string(++number)] = std::move(monitor);
  if (!run.contact_history.open.empty()) groups["contacts_history"] = contact_history(run);
  writer.write_histories(groups);
}

}  // namespace rockfold
