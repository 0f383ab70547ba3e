#include "src/report/tables.hpp"

#include <vector>

#include <fmt/format.h>

#include "host/keyblock/face_shape.hpp"
#include "src/base/vector.hpp"
#include "src/report/csv_row.hpp"
#include "src/report/design_names.hpp"
#include "src/report/names.hpp"

namespace rockfold {

namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const auto& name : names) text += (text.empty() ? "" : "; ") + name;
  return text;
}

std::string blocks_table(const BlockArrays& blocks, const KeyblockReport& keyblocks) {
  std::string text = "block,class,batch,volume m3,mass kg,x m,y m,z m\n";
  for (Index b = 0; b < blocks.block_count(); ++b) {
    CsvRow row;
    row << b + 1 << class_name(keyblocks.block_class[b]) << keyblocks.batch[b] << blocks.volume[b]
        << blocks.mass[b] << blocks.centroid[b];
    text += row.line();
  }
  return text;
}

std::string keyblocks_table(const BlockArrays& blocks, const KeyblockReport& keyblocks,
                            const SupportDesign& design) {
  std::string text =
      "block,batch,volume m3,weight N,mode,planes,direction x,direction y,direction z,"
      "sliding force N,factor of safety,residual factor of safety,free area m2,support force "
      "N,support pressure Pa,"
      "support x,support y,support z,bolts,bolt capacity N,supported factor of safety,adequate,"
      "missing force N,utilisation %,displacement utilisation %,supported mode,blocks,"
      "free face x m,free face y m,free face z m,into rock x,into rock y,into rock z\n";
  const auto add = [&](const Keyblock& key, const BlockSupport* support) {
    if (key.volume < keyblocks.smallest_block) return;
    CsvRow row;
    row << key.block + 1 << key.batch << key.volume << key.weight << mode_name(key.mode)
        << joined(key.planes) << key.direction << key.sliding_force << key.factor_of_safety
        << key.residual_factor_of_safety << key.free_area << key.support_force
        << key.support_pressure << key.support_direction;
    if (support) {
      Real capacity = 0;
      for (const BoltCrossing& c : support->crossings) capacity += c.capacity;
      row << static_cast<Index>(support->crossings.size()) << capacity
          << support->held.factor_of_safety << support->held.adequate << support->held.missing_force
          << 100 * support->force_mobilisation << 100 * support->displacement_mobilisation
          << mode_name(support->mode);
    } else {
      row.empty(8);
    }
    std::vector<std::string> members;
    for (const Index block : key.members) members.push_back(std::to_string(block + 1));
    row << joined(members);
    if (key.free_face != none)
      row << face_centre(blocks, key.free_face) << Vec3{} - blocks.face_normal[key.free_face];
    else
      row.empty(6);
    text += row.line();
  };
  const auto& bolting = design.bolting;
  for (std::size_t i = 0; i < keyblocks.keyblocks.size(); ++i)
    add(keyblocks.keyblocks[i], bolting ? &bolting->keyblocks[i] : nullptr);
  for (const auto& [key, support] : staying_blocks(keyblocks, bolting ? &*bolting : nullptr))
    add(key, support);
  return text;
}

std::string bolts_table(const SupportDesign& design) {
  std::string text =
      "bolt,coupling,category,length m,collar x m,collar y m,collar z m,direction x,direction y,"
      "direction z,blocks crossed\n";
  if (!design.bolting) return text;
  const BoltingReport& bolting = *design.bolting;
  for (std::size_t i = 0; i < bolting.bolts.size(); ++i) {
    const Bolt& bolt = bolting.bolts[i];
    const BoltType& type = bolting.groups[bolt.group].type;
    std::string crossed;
    for (const RockSegment& segment : bolt.rock)
      crossed += (crossed.empty() ? "" : "; ") + std::to_string(segment.block + 1);
    CsvRow row;
    row << bolt_name(bolting, static_cast<Index>(i)) << coupling_name(type.coupling)
        << category_name(bolt_category(type, bolt.length)) << bolt.length << bolt.collar
        << bolt.direction << crossed;
    text += row.line();
  }
  return text;
}

std::string crossings_table(const KeyblockReport& keyblocks, const SupportDesign& design) {
  std::string text =
      "block,batch,bolt,length within m,anchored length m,plate,axial capacity N,angle deg,"
      "capacity N,load N,utilisation %,displacement utilisation %\n";
  if (!design.bolting) return text;
  const BoltingReport& bolting = *design.bolting;
  const auto add = [&](const Keyblock& key, const BlockSupport& support) {
    for (const BoltCrossing& c : support.crossings) {
      CsvRow row;
      row << key.block + 1 << key.batch << bolt_name(bolting, c.bolt) << c.embedment.within
          << c.embedment.anchored << c.embedment.plate << c.axial_capacity
          << c.force.angle * 57.29577951308232 << c.capacity << c.load << 100 * c.force_mobilisation
          << 100 * c.displacement_mobilisation;
      text += row.line();
    }
  };
  for (std::size_t i = 0; i < bolting.keyblocks.size(); ++i)
    add(keyblocks.keyblocks[i], bolting.keyblocks[i]);
  for (const auto& [key, support] : staying_blocks(keyblocks, &bolting)) add(key, *support);
  return text;
}

std::string search_table(const SupportDesign& design, const Model& model) {
  const bool by_mass = design.search && design.search->by_mass;
  std::string text = fmt::format(
      "type,spacing m,length m,bolts,{},key blocks held,key blocks wanted,least factor of "
      "safety,blocks disturbed\n",
      by_mass ? "mass kg" : "length x capacity N m");
  if (!design.search) return text;
  for (const PatternTrial& trial : design.search->trials) {
    CsvRow row;
    row << model.bolt_types[trial.type].name << trial.spacing << trial.length << trial.bolts
        << trial.weight << trial.held << design.search->wanted << trial.least_factor_of_safety
        << trial.disturbed;
    text += row.line();
  }
  return text;
}

std::string classification_table(const SupportDesign& design) {
  std::string text = "system,quantity,value\n";
  const auto add = [&](const char* system, const char* quantity, const auto& value) {
    text += (CsvRow() << system << quantity << value).line();
  };
  if (!design.classification) return text;
  const ClassificationReport& report = *design.classification;
  if (report.q) {
    const QParameters& p = report.q->parameters;
    add("Q", "RQD %", p.rqd);
    add("Q", "Jn", p.jn);
    add("Q", "Jr", p.jr);
    add("Q", "Ja", p.ja);
    add("Q", "Jw", p.jw);
    add("Q", "SRF", p.srf);
    add("Q", "Q", report.q->value);
    add("Q", "class", q_class(report.q->value));
    add("Q", "unsupported span m", report.q->unsupported_span);
    add("Q", "roof pressure Pa", report.q->roof_pressure);
    if (report.q->roof_bolts) add("Q", "roof bolt length m", *report.q->roof_bolts);
    if (report.q->wall_bolts) add("Q", "wall bolt length m", *report.q->wall_bolts);
  }
  if (report.rmr) {
    for (std::size_t i = 0; i < rmr_parameters.size(); ++i)
      add("RMR89", rmr_parameters[i], report.rmr->ratings[i]);
    add("RMR89", "RMR", report.rmr->value);
    add("RMR89", "class", rmr_classes[static_cast<std::size_t>(report.rmr->number - 1)]);
    add("RMR89", "stand-up time", report.rmr->stand_up.text);
    if (report.rmr->roof_pressure) add("RMR89", "roof pressure Pa", *report.rmr->roof_pressure);
  }
  add("block theory", "key blocks", report.demand.keyblocks);
  add("block theory", "largest support pressure Pa", report.demand.largest_pressure);
  add("block theory", "mean support pressure Pa", report.demand.mean_pressure);
  add("block theory", "deepest key block m", report.demand.deepest);
  return text;
}

}  // namespace

std::string csv_table(TableFile::Kind kind, const BlockArrays& blocks,
                      const KeyblockReport& keyblocks, const SupportDesign& design,
                      const Model& model) {
  switch (kind) {
    case TableFile::Kind::blocks:
      return blocks_table(blocks, keyblocks);
    case TableFile::Kind::keyblocks:
      return keyblocks_table(blocks, keyblocks, design);
    case TableFile::Kind::bolts:
      return bolts_table(design);
    case TableFile::Kind::bolt_crossings:
      return crossings_table(keyblocks, design);
    case TableFile::Kind::pattern_search:
      return search_table(design, model);
    case TableFile::Kind::classification:
      return classification_table(design);
    case TableFile::Kind::monitors:
    case TableFile::Kind::energy:
      break;  // histories: history_tables.hpp
  }
  return {};
}

}  // namespace rockfold
