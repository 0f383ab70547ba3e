#include <algorithm>
#include <numeric>

#include <nlohmann/json.hpp>

#include "src/report/documents/document_parts.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

/// {"D10": …, …, "D100": …}
Json percentiles_json(const Percentiles& values) {
  Json json = Json::object();
  for (std::size_t p = 0; p < values.size(); ++p)
    json["D" + std::to_string(percentiles[p])] = values[p];
  return json;
}

Json histogram_json(const BlockStatistics& blocks) {
  Json list = Json::array();
  for (const VolumeBin& bin : blocks.histogram)
    list.push_back(
        {{"from", bin.from}, {"to", bin.to}, {"blocks", bin.blocks}, {"volume", bin.volume}});
  return list;
}

Json classes_json(const BlockStatistics& blocks) {
  Json list = Json::array();
  for (int c = 0; c < shape_class_count; ++c)
    list.push_back({{"class", shape_name(static_cast<ShapeClass>(c))},
                    {"blocks", blocks.of_class[c].blocks},
                    {"volume", blocks.of_class[c].volume}});
  return list;
}

Json scanline_json(const LineMeasure& line) {
  const Real length = line.length_in_rock;
  return {{"name", line.name},
          {"from", line.from},
          {"to", line.to},
          {"length_in_rock", length},
          {"joints", line.crossings},
          {"p10", length > 0 ? line.crossings / length : 0},
          {"pieces", line.pieces},
          {"rqd", line.rqd}};  // NaN is written as null
}

Json section_json(const SectionMeasure& section) {
  // Ascending, so that the sum does not depend on the order of the model's joints.
  std::vector<Real> lengths = section.trace_length;
  std::sort(lengths.begin(), lengths.end());
  const Real length = std::accumulate(lengths.begin(), lengths.end(), 0.0);
  Index count = 0;
  for (const Index n : section.trace_count) count += n;
  return {{"normal", std::string(1, static_cast<char>('x' + section.axis))},
          {"position", section.position},
          {"area", section.area},
          {"traces", count},
          {"trace_length", length}};
}

Json intensity_json(const OriginIntensity& i) {
  return {{"name", i.name}, {"joints", i.joints}, {"area", i.area}, {"p10", i.p10},
          {"p20", i.p20},   {"p21", i.p21},       {"p30", i.p30},   {"p32", i.p32}};
}

template <class List, class ToJson>
Json list_json(const List& list, ToJson to_json) {
  Json json = Json::array();
  for (const auto& entry : list) json.push_back(to_json(entry));
  return json;
}

Json statistics_json(const RockMeasures& measures) {
  const BlockStatistics& blocks = measures.blocks;
  Json json;
  json["volume"] = {{"mean", blocks.mean_volume},
                    {"by_number", percentiles_json(blocks.volume_by_number)},
                    {"by_volume", percentiles_json(blocks.volume_by_volume)}};
  json["block_size"] = percentiles_json(blocks.size_by_volume);
  json["histogram"] = histogram_json(blocks);
  json["shape"] = {
      {"alpha", blocks.mean_alpha}, {"beta", blocks.mean_beta}, {"classes", classes_json(blocks)}};
  json["volumetric_joint_count"] = measures.volumetric_joint_count;
  json["rqd"] = measures.rqd;
  json["scanlines"] = list_json(measures.lines, scanline_json);
  json["sections"] = list_json(measures.sections, section_json);
  return json;
}

}  // namespace

void add_measures(Json& document, const RockMeasures& measures) {
  document["statistics"] = statistics_json(measures);
  document["intensities"] = list_json(measures.intensities, intensity_json);
  document["stages"] = list_json(measures.stages, [](const StageReport& stage) -> Json {
    return {{"stage", stage.stage},
            {"blocks", stage.blocks},
            {"volume", stage.volume},
            {"new_free_area", stage.new_free_area}};
  });
  document["flagged"] = {{"small_volume", measures.blocks.small_blocks},
                         {"elongated", measures.blocks.elongated_blocks}};
}

Json flags_json(std::uint8_t flags) {
  Json list = Json::array();
  if ((flags & flag_small_volume) != 0) list.push_back("small_volume");
  if ((flags & flag_elongated) != 0) list.push_back("elongated");
  return list;
}

}  // namespace rockfold
