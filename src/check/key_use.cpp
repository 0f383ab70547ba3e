#include "src/check/key_use.hpp"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "host/cut/cut.hpp"
#include "host/keyblock/keyblock.hpp"
#include "host/keyblock/theory/theory.hpp"
#include "host/measure/measure.hpp"
#include "src/app/support_design.hpp"
#include "src/base/error.hpp"
#include "src/check/needs.hpp"
#include "src/model/text/nearest.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

namespace {

/// What acts on rock: a result without it is another result.
struct Action {
  std::string section;
  bool is_load;         ///< or water: a command that does not take it stops
  std::string instead;  ///< what does the same in the other analyses, if anything does
};
const std::vector<Action>& actions() {
  static const std::vector<Action> all{
      {"traction", true, ""},
      {"point_load", true, ""},
      {"water", true, ""},
      {"base_acceleration", true, "support.seismic_coefficient acts on key blocks"},
      {"initial_stress", false, ""},
      {"bolt", false, ""},
      {"bolt_pattern", false, ""},
      {"shotcrete", false, ""},
  };
  return all;
}

/// Stages that compute forces, and those that only describe.
struct Stages {
  std::vector<StageKeys> acting, describing;
};

Stages stages_of(const Options& options, const Model& model) {
  Stages stages;
  if (options.command == Command::theory) {
    stages.acting = {keys_of_theory(model)};
    return stages;
  }
  stages.describing = {keys_of_cutting(), keys_of_measuring()};
  if (wants_support(options, model)) {
    stages.acting.push_back(keys_of_keyblocks(model));
    stages.describing.push_back(keys_of_support_design(model));
  }
  if (options.command == Command::stability) stages.acting.push_back(keys_of_stability());
  if (wants_run(options)) stages.acting.push_back(keys_of_analysis(model));
  return stages;
}

std::string section_of(const std::string& path) {
  return path.substr(0, path.find('.'));
}

/// As the file writes it: an entry of a list has a number in its place's key.
std::string heading(const GivenKey& key) {
  std::string section = section_of(key.path);
  const bool list = key.place.key.size() > section.size() && key.place.key[section.size()] == '[';
  if (key.path == section) return section;
  return list ? "[[" + section + "]]" : "[" + section + "]";
}

const GivenKey* given(const Model& model, const std::string& section) {
  for (const GivenKey& key : model.given)
    if (section_of(key.path) == section) return &key;
  return nullptr;
}

void check_ignored(const Options& options) {
  std::vector<std::string> sections;
  for (const Action& action : actions())
    if (action.is_load) sections.push_back(action.section);
  for (const std::string& key : options.ignored)
    if (std::find(sections.begin(), sections.end(), key) == sections.end())
      throw Error(ErrorKind::usage, fmt::format("--ignore: '{}' is no load{}", key,
                                                suggestion(key, sections, "the loads are")));
}

std::string refusal(const std::string& heading, const Options& options, const Action& action) {
  return fmt::format("{} does not act in `{}`{}; --ignore {} goes on without it", heading,
                     command_name(options.command),
                     action.instead.empty() ? "" : " (" + action.instead + ")", action.section);
}

}  // namespace

std::vector<std::string> unused_keys(const Options& options, const Model& model) {
  const Stages stages = stages_of(options, model);
  const auto is_used = [&](const std::string& path) {
    const auto uses = [&](const StageKeys& stage) { return stage.uses(path); };
    return std::any_of(stages.acting.begin(), stages.acting.end(), uses) ||
           std::any_of(stages.describing.begin(), stages.describing.end(), uses);
  };
  std::map<std::string, bool> any_used;
  for (const GivenKey& key : model.given) {
    bool& any = any_used[section_of(key.path)];
    any = any || is_used(key.path);
  }
  std::vector<std::string> unused;
  for (const GivenKey& key : model.given) {
    if (is_used(key.path)) continue;
    const bool part = any_used[section_of(key.path)];
    std::string name = part ? key.path : heading(key);
    if (std::find(unused.begin(), unused.end(), name) == unused.end())
      unused.push_back(std::move(name));
  }
  return unused;
}

void require_loads_used(const Options& options, const Model& model, Terminal& terminal) {
  check_ignored(options);
  const Stages stages = stages_of(options, model);
  if (stages.acting.empty()) return;  // nothing is loaded: cutting alone
  std::vector<Diagnostic> refused;
  for (const Action& action : actions()) {
    const GivenKey* key = given(model, action.section);
    if (!key) continue;
    std::vector<std::string> in, not_in;
    for (const StageKeys& stage : stages.acting)
      (stage.uses(action.section) ? in : not_in).push_back(stage.stage);
    const bool ignored = std::find(options.ignored.begin(), options.ignored.end(),
                                   action.section) != options.ignored.end();
    Place place = key->place;
    place.key = action.section;
    if (action.is_load && in.empty() && !ignored)
      refused.push_back({place, refusal(heading(*key), options, action)});
    if (!in.empty() && !not_in.empty() && !ignored)
      terminal.warn(fmt::format("{} acts on {} alone, not on {}{}", heading(*key), in.front(),
                                not_in.front(),
                                action.instead.empty() ? "" : ": " + action.instead));
  }
  if (model.support && wants_run(options) && model.support->seismic_coefficient != Vec3{} &&
      !model.analysis->is_seismic())
    terminal.warn(
        "support.seismic_coefficient acts on key blocks alone, not on the analysis: it does in a "
        "[[step]] with seismic = true, and base_acceleration brings a record");
  if (!refused.empty()) throw Error(ErrorKind::model, refused);
}

}  // namespace rockfold
