#include "tests/cut/oracles/cutting_rules.hpp"

#include <algorithm>
#include <cmath>
#include <exception>
#include <map>
#include <sstream>

#include "tests/cut/models/draw.hpp"

namespace rockfold::test {

namespace {

template <class... Part>
void line(Faults& faults, const Part&... part) {
  if (faults.size() >= 20) return;
  std::ostringstream text;
  text.precision(17);
  (text << ... << part);
  faults.push_back(text.str());
}

long double total(const BlockArrays& a) {
  long double sum = 0;
  for (const Real v : a.volume) sum += v;
  return sum;
}

bool finite(const Vec3& x) {
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}

std::vector<Real> sorted_volumes(const BlockArrays& a) {
  std::vector<Real> volumes = a.volume;
  std::sort(volumes.begin(), volumes.end());
  return volumes;
}

// Offsets ascend from 0 to the length of what they index.
template <class T>
bool offsets_of(const std::vector<Index>& begin, const std::vector<T>& indexed) {
  return !begin.empty() && begin.front() == 0 && std::is_sorted(begin.begin(), begin.end()) &&
         begin.back() == static_cast<Index>(indexed.size());
}

bool well_formed(const BlockArrays& a) {
  if (!offsets_of(a.face_begin, a.face_area) || !offsets_of(a.vertex_begin, a.vertex) ||
      !offsets_of(a.corner_begin, a.corner_vertex) || a.loop_begin.empty() ||
      !std::is_sorted(a.loop_begin.begin(), a.loop_begin.end()) || a.loop_begin.front() != 0 ||
      a.loop_begin.back() + 1 != static_cast<Index>(a.corner_begin.size()))
    return false;
  return std::all_of(a.corner_vertex.begin(), a.corner_vertex.end(),
                     [&](Index v) { return 0 <= v && v < static_cast<Index>(a.vertex.size()); });
}

}  // namespace

std::string rule_of(const std::string& fault) {
  return fault.substr(0, fault.find(':'));
}

void check_volumes(const Blocks& blocks, Faults& faults) {
  const BlockArrays& a = blocks.arrays;
  for (Index b = 0; b < a.block_count(); ++b)
    if (!(a.volume[b] > 0) || !std::isfinite(a.volume[b]))
      line(faults, "volume: block ", b + 1, " has ", a.volume[b], " m3");
  check_total(blocks, blocks.cutting.totals.solid_volume, 1e-12, faults);
}

void check_total(const Blocks& blocks, long double expected, Real relative, Faults& faults) {
  const long double sum = total(blocks.arrays);
  if (!(std::abs(sum - expected) <= relative * expected))
    line(faults, "volume: blocks of ", sum, " m3 in all, expected ", expected, " (off by ",
         static_cast<Real>((sum - expected) / expected), ")");
}

void check_surfaces(const BlockArrays& a, Faults& faults) {
  if (!well_formed(a)) return line(faults, "surface: offsets or indices out of range");
  for (const Vec3& x : a.vertex)
    if (!finite(x)) line(faults, "surface: a vertex that is not finite");
  for (Index b = 0; b < a.block_count(); ++b) {
    if (!finite(a.centroid[b])) line(faults, "surface: the centroid of block ", b + 1);
    std::map<std::pair<Index, Index>, int> runs;  // edge → times along minus times against
    for (Index l = a.loop_begin[a.face_begin[b]]; l < a.loop_begin[a.face_begin[b + 1]]; ++l)
      for (Index c = a.corner_begin[l]; c < a.corner_begin[l + 1]; ++c) {
        const Index next = c + 1 < a.corner_begin[l + 1] ? c + 1 : a.corner_begin[l];
        const Index p = a.corner_vertex[c], q = a.corner_vertex[next];
        runs[std::minmax(p, q)] += p < q ? 1 : -1;
      }
    const auto open =
        std::count_if(runs.begin(), runs.end(), [](const auto& r) { return r.second; });
    if (open > 0) line(faults, "surface: block ", b + 1, " has ", open, " open edges");
    const Counts n = counts_of(a, b);
    const Index holes = a.loop_begin[a.face_begin[b + 1]] - a.loop_begin[a.face_begin[b]] - n.faces;
    if (n.vertices - n.edges + n.faces - holes != 2 * (a.shell_count[b] - a.genus[b]))
      line(faults, "surface: block ", b + 1, ": ", n, ", ", holes, " holes, ", a.shell_count[b],
           " shells, genus ", a.genus[b]);
  }
}

void check_order(const Model& model, const BlockArrays& as_listed, unsigned seed, Real size,
                 Faults& faults) {
  Model shuffled = model;
  Draw draw(seed + 1);
  draw.shuffle(shuffled.joints);
  draw.shuffle(shuffled.joint_sets);
  draw.shuffle(shuffled.joint_meshes);
  const std::vector<Real> p = sorted_volumes(as_listed), q = sorted_volumes(cut(shuffled).arrays);
  if (p.size() != q.size())
    return line(faults, "order: ", p.size(), " blocks, shuffled ", q.size());
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!(std::abs(p[i] - q[i]) <= 1e-7 * p[i] + 1e-8 * size * size * size))
      return line(faults, "order: a block of ", p[i], " m3, shuffled ", q[i]);
}

Faults faults_of_cutting(const Model& model, unsigned seed, Real size,
                         const std::function<void(const Blocks&, Faults&)>& further) {
  Faults faults;
  try {
    const Blocks blocks = cut(model);
    check_volumes(blocks, faults);
    check_surfaces(blocks.arrays, faults);
    if (further) further(blocks, faults);
    check_order(model, blocks.arrays, seed, size, faults);
  } catch (const std::exception& error) {
    line(faults, "error: ", error.what());
  }
  return faults;
}

}  // namespace rockfold::test
