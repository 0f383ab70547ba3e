#include "host/measure/measure.hpp"

#include <algorithm>
#include <limits>

#include "host/cut/cells/complex.hpp"
#include "src/base/sum.hpp"

namespace rockfold {

namespace {

Real ratio(Real a, Real b) {
  return b > 0 ? a / b : 0;
}

Real length_in_rock(const std::vector<LineMeasure>& lines) {
  Real length = 0;
  for (const auto& line : lines) length += line.length_in_rock;
  return length;
}

/// Distinct joints and area by origin.
void add_volume_measures(const Complex& complex, std::vector<OriginIntensity>& of) {
  std::vector<Sum> area(of.size());
  std::vector<JointInstance> seen;
  for (const Fragment& f : complex.fragments) {
    const JointInstance joint = joint_instance(complex, f);
    if (joint.origin == none) continue;
    area[joint.origin] += f.area;
    if (seen.empty() || seen.back() != joint) seen.push_back(joint);
  }
  keep_distinct(seen);
  for (const JointInstance& joint : seen) ++of[joint.origin].joints;
  for (std::size_t o = 0; o < of.size(); ++o) of[o].area = area[o].value();
}

void add_to(OriginIntensity& sum, const OriginIntensity& part) {
  sum.joints += part.joints;
  sum.area += part.area;
  sum.p30 += part.p30;
  sum.p32 += part.p32;
  sum.p20 += part.p20;
  sum.p21 += part.p21;
  sum.p10 += part.p10;
}

void add_intensities(const Complex& complex, RockMeasures& out) {
  std::vector<OriginIntensity> of(complex.origins.size());
  add_volume_measures(complex, of);
  Real section_area = 0;
  for (const auto& section : out.sections) section_area += section.area;
  const Real line_length = length_in_rock(out.lines);
  for (std::size_t o = 0; o < of.size(); ++o) {
    if (complex.origins[o].kind != FaceOrigin::Kind::joint) continue;
    OriginIntensity& i = of[o];
    i.name = complex.origins[o].name;
    Real traces = 0, trace_length = 0, crossings = 0;
    for (const auto& section : out.sections)
      traces += section.trace_count[o], trace_length += section.trace_length[o];
    for (const auto& line : out.lines) crossings += line.crossings_of[o];
    i.p30 = ratio(i.joints, out.blocks.volume);
    i.p32 = ratio(i.area, out.blocks.volume);
    i.p20 = ratio(traces, section_area);
    i.p21 = ratio(trace_length, section_area);
    i.p10 = ratio(crossings, line_length);
    out.intensities.push_back(i);
  }
  std::stable_sort(out.intensities.begin(), out.intensities.end(),
                   [](const auto& a, const auto& b) { return a.name < b.name; });
  for (const OriginIntensity& i : out.intensities) add_to(out.all_joints, i);
  out.all_joints.name = "all";
  out.volumetric_joint_count = out.all_joints.p32;
}

Real mean_rqd(const std::vector<LineMeasure>& lines) {
  const Real length = length_in_rock(lines);
  if (!(length > 0)) return std::numeric_limits<Real>::quiet_NaN();
  Real sound = 0;
  for (const auto& line : lines)
    if (line.length_in_rock > 0) sound += line.rqd * line.length_in_rock;
  return sound / length;
}

}  // namespace

StageKeys keys_of_measuring() {
  return {"measures", {"scanline", "cut"}};
}

RockMeasures measure_rock(const Cutting& cutting, const BlockArrays& blocks, const Model& model) {
  const Complex& complex = *cutting.complex;
  RockMeasures out;
  out.blocks = block_statistics(blocks, model.cut);
  out.lines = measure_lines(complex, model.scanlines);
  out.rqd = mean_rqd(out.lines);
  out.sections = measure_sections(complex, rock_box(complex).centre());
  add_intensities(complex, out);
  out.stages = stage_reports(blocks, model);
  return out;
}

}  // namespace rockfold
