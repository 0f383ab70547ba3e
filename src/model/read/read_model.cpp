#include "src/model/read/read_model.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "src/model/plausibility.hpp"
#include "src/model/read/draft.hpp"
#include "src/model/text/file_kind.hpp"
#include "src/model/text/given_keys.hpp"
#include "src/model/text/nearest.hpp"
#include "src/model/text/overrides.hpp"
#include "src/model/text/parse_toml.hpp"

namespace rockfold {

namespace {

/// A model of 200,000 joints takes 30 MB; what is larger is another kind of file.
constexpr std::size_t largest_file = std::size_t{64} << 20;

[[noreturn]] void reject_file(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::io, why, Place{path, 0, 0, ""});
}

void read_title_and_gravity(TableReader& in, Model& model) {
  in.read("title", model.title, Need::optional);
  in.read("gravity", model.gravity, any_number("m/s2"), Need::optional);
}

/// Sections are known here and read by functions of their own, after all unknown ones were
/// reported.
void read_top_level(Draft& draft, const Value& root) {
  TableReader in(root, "", draft.out);
  read_title_and_gravity(in, draft.model);
  for (const char* key : {"material",
                          "joint_material",
                          "solid",
                          "joint_set",
                          "joint",
                          "joint_mesh",
                          "joint_table",
                          "merge",
                          "excavation",
                          "cut",
                          "scanline",
                          "cover",
                          "fixed",
                          "traction",
                          "point_load",
                          "quiet_boundary",
                          "initial_velocity",
                          "initial_stress",
                          "base_acceleration",
                          "analysis",
                          "contact",
                          "contact_pair",
                          "step",
                          "solver",
                          "output",
                          "reduction",
                          "monitor",
                          "support",
                          "bolt_type",
                          "bolt",
                          "bolt_pattern",
                          "shotcrete",
                          "pattern_search",
                          "classification",
                          "drawing",
                          "table",
                          "water",
                          "block_theory"}) {
    in.has(key);
    draft.out.know_section(key);
  }
}

void read_sections(Draft& draft) {
  read_materials(draft);
  read_joint_materials(draft);
  read_solids(draft);
  read_joint_sets(draft);
  read_joints(draft);
  read_joint_meshes(draft);
  read_joint_tables(draft);
  read_merges(draft);
  read_excavations(draft);
  read_cut(draft);
  read_scanlines(draft);
  read_cover(draft);
  read_fixed(draft);
  read_tractions(draft);
  read_point_loads(draft);
  read_quiet_boundaries(draft);
  read_initial_velocities(draft);
  read_initial_stress(draft);
  read_monitors(draft);
  read_analysis(draft);
  read_base_acceleration(draft);
  read_contact(draft);
  read_contact_pairs(draft);
  read_solver(draft);
  read_output(draft);
  read_reduction(draft);
  read_support(draft);
  read_bolt_types(draft);
  read_bolts(draft);
  read_bolt_patterns(draft);
  read_shotcrete(draft);
  read_pattern_search(draft);
  read_classification(draft);
  read_drawings(draft);
  read_tables(draft);
  read_waters(draft);
  read_block_theory(draft);
}

void add_missing(Draft& draft, Purpose purpose) {
  for (const auto& [place, message] : missing_for(draft.model, purpose))
    if (!draft.out.explained(place.key))
      draft.out.add({0, place.line, place.column}, place.key, message);
}

std::string text_with(std::string_view text, const std::vector<std::string>& overrides) {
  std::string result(text);
  if (overrides.empty()) return result;
  if (!result.empty() && result.back() != '\n') result += '\n';
  result += "\n# Overridden on the command line:\n";
  for (auto line : overrides) {
    std::replace_if(
        line.begin(), line.end(), [](unsigned char c) { return c < 0x20 || c == 0x7F; }, ' ');
    result += "#   " + override_name(line) + "\n";
  }
  return result;
}

ReadModel try_parse(std::string_view text, const std::string& name,
                    const std::vector<std::string>& overrides, Purpose purpose,
                    const BodyReader& bodies) {
  Value root = parse_toml(text, 0, name);
  std::vector<std::string> sources{name};
  for (const auto& override_text : overrides) {
    apply_override(root, override_text, static_cast<int>(sources.size()));
    sources.push_back(override_name(override_text));
  }
  Diagnostics out(std::move(sources));
  Draft draft{.root = std::get<Table>(root.data), .out = out, .model = {}, .bodies = bodies};
  draft.model.path = name;
  draft.model.text = text_with(text, overrides);
  read_top_level(draft, root);
  read_sections(draft);
  add_missing(draft, purpose);
  draft.model.given = given_keys(draft.root, out);
  if (out.empty()) draft.model.warnings = implausible_numbers(draft.root, draft.model, out);
  ReadModel read{std::move(draft.model), {}};
  if (!out.empty()) read.wrong = out.error();
  return read;
}

}  // namespace

std::string model_file_text(const std::string& name) {
  const std::string path = name == "-" ? "/dev/stdin" : name;
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored))
    reject_file(path, "cannot be read: is a directory");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file)
    reject_file(path, std::string("cannot be read: ") +
                          (errno ? std::strerror(errno) : "cannot be opened") +
                          file_hint(path, ".toml"));
  std::string text;
  std::vector<char> chunk(std::size_t{1} << 20);
  while (file.read(chunk.data(), static_cast<std::streamsize>(chunk.size())) || file.gcount() > 0) {
    text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest_file)
      reject_file(path,
                  "is larger than " + std::to_string(largest_file >> 20) + " MiB: no model file");
  }
  if (file.bad()) reject_file(path, "cannot be read: input error");
  if (const auto kind = kind_of_binary(text); !kind.empty())
    throw Error(ErrorKind::model, "is " + kind + "; must be a model, TOML text in UTF-8",
                Place{path, 0, 0, ""});
  return text;
}

Model read_model(const std::string& path, const std::vector<std::string>& overrides,
                 Purpose purpose, const BodyReader& bodies) {
  return parse_model(model_file_text(path), path, overrides, purpose, bodies);
}

Model parse_model(std::string_view text, const std::string& name,
                  const std::vector<std::string>& overrides, Purpose purpose,
                  const BodyReader& bodies) {
  ReadModel read = try_parse(text, name, overrides, purpose, bodies);
  if (read.wrong) throw *read.wrong;
  return std::move(read.model);
}

ReadModel try_read_model(const std::string& path, const std::vector<std::string>& overrides,
                         Purpose purpose, const BodyReader& bodies) {
  return try_parse(model_file_text(path), path, overrides, purpose, bodies);
}

ReadModel try_parse_model(std::string_view text, const std::string& name,
                          const std::vector<std::string>& overrides, Purpose purpose,
                          const BodyReader& bodies) {
  return try_parse(text, name, overrides, purpose, bodies);
}

}  // namespace rockfold
