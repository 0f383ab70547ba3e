#include "src/report/documents/documents.hpp"

#include <fmt/format.h>

#include "generated/version.hpp"
#include "src/base/sum.hpp"
#include "src/model/check_model.hpp"
#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

/// One line; bytes that are no UTF-8 (a title may hold any) become U+FFFD.
std::string line(const Json& value) {
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json diagnostic_json(ErrorKind kind, const Diagnostic& diagnostic) {
  return {{"kind", kind_name(kind)},           {"message", diagnostic.message},
          {"file", diagnostic.place.file},     {"line", diagnostic.place.line},
          {"column", diagnostic.place.column}, {"key", diagnostic.place.key}};
}

}  // namespace

Json head_json(const DocumentHead& head) {
  Json document{{"schema", "rockfold/1"},
                {"command", head.command},
                {"version", version},
                {"title", head.title}};
  if (head.seed) document["seed"] = *head.seed;
  return document;
}

Real total_volume(const BlockArrays& blocks) {
  Sum sum;
  for (const Real v : blocks.volume) sum += v;
  return sum.value();
}

Json check_document(const DocumentHead& head, const Model& model,
                    const std::vector<NamedExtent>& extents) {
  Json document = head_json(head);
  document["ok"] = true;
  document["totals"] = {{"materials", model.materials.size()},
                        {"joint_materials", model.joint_materials.size()},
                        {"solids", model.solids.size()},
                        {"joint_sets", model.joint_sets.size()},
                        {"joints", model.joints.size()},
                        {"joint_meshes", model.joint_meshes.size()},
                        {"joint_tables", model.joint_tables.size()},
                        {"merges", model.merges.size()},
                        {"excavations", model.excavations.size()},
                        {"scanlines", model.scanlines.size()},
                        {"fixed", model.fixed.size()},
                        {"point_loads", model.point_loads.size()},
                        {"monitors", model.monitors.size()}};
  document["commands"] = {{"cut", missing_for(model, Purpose::cut).empty()},
                          {"support", missing_for(model, Purpose::support).empty()},
                          {"theory", missing_for(model, Purpose::theory).empty()},
                          {"run", missing_for(model, Purpose::run).empty()}};
  auto& list = document["extents"] = Json::array();
  for (const NamedExtent& extent : extents) {
    list.push_back({{"kind", extent.kind}, {"name", extent.name}});
    list.back()["min"] = extent.bounded ? Json(extent.box.min) : Json();
    list.back()["max"] = extent.bounded ? Json(extent.box.max) : Json();
  }
  return document;
}

std::vector<std::string> hash_texts(const ResultInfo& info) {
  std::vector<std::string> texts;
  for (const std::uint64_t hash : info.hash) texts.push_back(fmt::format("{:016x}", hash));
  return texts;
}

Json info_document(const ResultInfo& info, const std::string& path) {
  Json document = head_json({"info", info.title, {}});
  document["file"] = path;
  document["made_by"] = {
      {"command", info.command}, {"version", info.version}, {"commit", info.commit}};
  document["units"] = info.units;
  document["totals"] = {{"blocks", info.blocks},      {"faces", info.faces},
                        {"vertices", info.vertices},  {"joint_faces", info.joint_faces},
                        {"volume", info.volume},      {"elements", info.elements},
                        {"pieces", info.pieces},      {"covers", info.covers},
                        {"states", info.step.size()}, {"bytes", info.file_bytes}};
  document["block_theory"] = info.block_theory;
  document["states"] = {{"step", info.step}, {"time", info.time}};
  if (!info.hash.empty()) document["states"]["hash"] = hash_texts(info);
  if (info.unfinished)
    document["unfinished"] = {
        {"journal", info.unfinished->journal},
        {"checkpoint",
         {{"step", info.unfinished->checkpoint}, {"time", info.unfinished->checkpoint_time}}}};
  auto& list = document["datasets"] = Json::array();
  for (const auto& set : info.datasets)
    list.push_back(
        {{"path", set.path}, {"type", set.type}, {"shape", set.shape}, {"bytes", set.bytes}});
  document["model"] = info.model_text;
  return document;
}

Json error_document(const Error& error) {
  Json first = diagnostic_json(error.kind(), error.diagnostics().front());
  if (error.diagnostics().size() > 1) {
    auto& all = first["errors"] = Json::array();
    for (const auto& diagnostic : error.diagnostics())
      all.push_back(diagnostic_json(error.kind(), diagnostic));
  }
  return {{"schema", "rockfold/1"}, {"error", first}};
}

void finish_document(Json& document, const std::vector<std::string>& warnings,
                     const PhaseSeconds& seconds) {
  document["warnings"] = warnings;
  for (const auto& [phase, s] : seconds) document["seconds"][phase] = s;
}

void write_document(std::FILE* stream, const Json& document, const LongList& list) {
  const char* before = "{\n";
  for (const auto& [key, value] : document.items()) {
    std::fprintf(stream, "%s%s: ", before, line(key).c_str());
    before = ",\n";
    const char* comma = "[\n";
    const auto write_entry = [&](const Json& entry) {
      std::fprintf(stream, "%s%s", comma, line(entry).c_str());
      comma = ",\n";
    };
    if (list.size > 0 && key == list.key) {
      for (Index i = 0; i < list.size; ++i) write_entry(list.entry(i));
    } else if (value.is_array() && !value.empty() && value.front().is_structured()) {
      for (const auto& entry : value) write_entry(entry);
    } else {
      std::fputs(line(value).c_str(), stream);
      continue;
    }
    std::fputs("\n]", stream);
  }
  std::fputs("\n}\n", stream);
}

}  // namespace rockfold
