#include "host/measure/lines.hpp"

#include <algorithm>
#include <limits>
#include <tuple>

#include "host/cut/cells/complex.hpp"
#include "host/parallel.hpp"
#include "src/base/sum.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real sound_piece = 0.1;          // m (Deere 1964)
constexpr Real rounding = 1e-9;            // of the model's size: gaps and pieces below are none
constexpr Real aside = 1e-6;               // of the model's size
constexpr Vec3 odd{0.577, 0.331, -0.747};  // along no joint that anyone would think of
constexpr Index chunk = 4096;              // cells

/// from + t·along, 0 ≤ t ≤ length, relative to the table's centre.
struct Line {
  Vec3 from{}, along{};  // along: unit
  Real length = 0;
};

Line placed_line(const Scanline& line, const PlaneTable& planes) {
  const Vec3 way = line.to - line.from;
  Line placed{line.from - planes.centre(), normalized(way), norm(way)};
  const Vec3 across = odd - dot(odd, placed.along) * placed.along;
  placed.from += (aside * planes.model_size()) * across;
  return placed;
}

/// The part of a line in a cell, and the faces where it enters and leaves (none: the line ends there).
struct Passage {
  Index cell = none;
  Real t[2] = {0, 0};
  Index face[2] = {none, none};
};

bool pass(const CellView& cell, const PlaneTable& planes, const Line& line, Passage& p) {
  p.t[0] = 0, p.t[1] = line.length;
  p.face[0] = p.face[1] = none;
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const HalfSpaceId h = cell.faces[f].inside;
    const Vec3& n = planes.normal(plane_of(h));
    const Real sign = is_above(h) ? -1 : 1;  // outwards
    const Real distance = sign * (dot(n, line.from) - planes.offset(plane_of(h)));
    const Real slope = sign * dot(n, line.along);
    if (slope == 0) {
      if (distance > 0) return false;
      continue;
    }
    const Real t = -distance / slope;
    const int end = slope > 0 ? 1 : 0;
    if (end == 1 ? t < p.t[1] : t > p.t[0]) p.t[end] = t, p.face[end] = static_cast<Index>(f);
    if (p.t[0] >= p.t[1]) return false;
  }
  return true;
}

std::vector<Passage> passages(const Complex& complex, const Line& line) {
  const Index chunks = (complex.cells.size() + chunk - 1) / chunk;
  std::vector<std::vector<Passage>> found(chunks);
  parallel_for(chunks, 1, [&](std::int64_t k) {
    const auto begin = static_cast<Index>(k * chunk);
    for (Index c = begin; c < std::min(begin + chunk, complex.cells.size()); ++c) {
      Passage p;
      if (!pass(complex.cells[c], complex.planes, line, p)) continue;
      p.cell = c;
      found[k].push_back(p);
    }
  });
  std::vector<Passage> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  return all;
}

bool inside(const Polygon& polygon, const Vec3& x, const PlaneTable& planes) {
  return std::all_of(polygon.edge.begin(), polygon.edge.end(), [&](HalfSpaceId h) {
    const Real distance = dot(planes.normal(plane_of(h)), x) - planes.offset(plane_of(h));
    return is_above(h) ? distance >= 0 : distance <= 0;
  });
}

struct Crossing {
  Real t;
  Index origin;
  bool operator<(const Crossing& other) const {
    return std::tie(t, origin) < std::tie(other.t, other.origin);
  }
};

/// Each fragment is looked at from its lower cell alone, so that it counts once.
std::vector<Crossing> crossings(const Complex& complex, const Line& line,
                                const std::vector<Passage>& passed) {
  std::vector<Index> passage_of(complex.cells.size(), none);
  for (std::size_t i = 0; i < passed.size(); ++i)
    passage_of[passed[i].cell] = static_cast<Index>(i);
  std::vector<Crossing> found;
  for (const Fragment& f : complex.fragments) {
    if (f.joint == none || passage_of[f.cell[0]] == none) continue;
    if (complex.origins[f.joint].kind != FaceOrigin::Kind::joint) continue;
    const Passage& p = passed[passage_of[f.cell[0]]];
    for (int end = 0; end < 2; ++end) {
      if (p.face[end] != f.face[0]) continue;
      const Vec3 x = line.from + p.t[end] * line.along;
      if (f.polygon == none || inside(complex.polygons[f.polygon], x, complex.planes))
        found.push_back({p.t[end], f.joint});
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Passages joined into stretches of rock.
std::vector<std::array<Real, 2>> stretches(const std::vector<Passage>& passed, Real gap) {
  std::vector<std::array<Real, 2>> parts, joined;
  for (const Passage& p : passed) parts.push_back({p.t[0], p.t[1]});
  std::sort(parts.begin(), parts.end());
  for (const auto& part : parts) {
    if (!joined.empty() && part[0] <= joined.back()[1] + gap)
      joined.back()[1] = std::max(joined.back()[1], part[1]);
    else
      joined.push_back(part);
  }
  return joined;
}

void add_pieces(const std::vector<std::array<Real, 2>>& rock, const std::vector<Crossing>& joints,
                Real gap, LineMeasure& out) {
  Sum length, sound;
  std::size_t j = 0;
  for (const auto& stretch : rock) {
    length += stretch[1] - stretch[0];
    Real start = stretch[0];
    const auto end_piece = [&](Real end) {
      if (end - start <= gap) return;
      ++out.pieces;
      // Pieces of just 0.1 m count, whatever rounding did to them.
      if (end - start >= sound_piece - gap) sound += end - start;
      start = end;
    };
    while (j < joints.size() && joints[j].t < stretch[0]) ++j;
    for (; j < joints.size() && joints[j].t <= stretch[1]; ++j) end_piece(joints[j].t);
    end_piece(stretch[1]);
  }
  out.length_in_rock = length.value();
  out.rqd =
      length.value() > 0 ? sound.value() / length.value() : std::numeric_limits<Real>::quiet_NaN();
}

LineMeasure measure_line(const Complex& complex, const Scanline& given) {
  LineMeasure out{given.name, given.from, given.to, 0, 0, {}, 0, 0};
  out.crossings_of.assign(complex.origins.size(), 0);
  const Line line = placed_line(given, complex.planes);
  const auto passed = passages(complex, line);
  const auto joints = crossings(complex, line, passed);
  for (const Crossing& c : joints) ++out.crossings_of[c.origin];
  out.crossings = static_cast<Index>(joints.size());
  const Real gap = rounding * complex.planes.model_size();
  add_pieces(stretches(passed, gap), joints, gap, out);
  return out;
}

std::vector<Scanline> default_lines(const Complex& complex) {
  const RockBox box = rock_box(complex);
  std::vector<Scanline> lines;
  for (int d = 0; d < 3; ++d) {
    Scanline line{std::string(1, static_cast<char>('x' + d)), box.centre(), box.centre(), {}};
    line.from[d] = box.min[d], line.to[d] = box.max[d];
    lines.push_back(line);
  }
  return lines;
}

}  // namespace

Vec3 RockBox::centre() const {
  return 0.5 * (min + max);
}

RockBox rock_box(const Complex& complex) {
  constexpr Real huge = std::numeric_limits<Real>::infinity();
  const RockBox nothing{{huge, huge, huge}, {-huge, -huge, -huge}};
  const auto add = [](RockBox& box, const Vec3& low, const Vec3& high) {
    for (int d = 0; d < 3; ++d) {
      box.min[d] = std::min(box.min[d], low[d]);
      box.max[d] = std::max(box.max[d], high[d]);
    }
  };
  const Index chunks = (complex.cells.size() + chunk - 1) / chunk;
  std::vector<RockBox> parts(chunks, nothing);
  parallel_for(chunks, 1, [&](std::int64_t k) {
    const auto begin = static_cast<Index>(k * chunk);
    for (Index c = begin; c < std::min(begin + chunk, complex.cells.size()); ++c)
      for (const Vertex& v : complex.cells[c].vertices) add(parts[k], v.x, v.x);
  });
  RockBox box = nothing;
  for (const RockBox& part : parts) add(box, part.min, part.max);
  box.min += complex.planes.centre();
  box.max += complex.planes.centre();
  return box;
}

std::vector<LineMeasure> measure_lines(const Complex& complex, const std::vector<Scanline>& lines) {
  std::vector<LineMeasure> out;
  if (complex.cells.size() == 0) return out;
  for (const Scanline& line : lines.empty() ? default_lines(complex) : lines)
    out.push_back(measure_line(complex, line));
  return out;
}

}  // namespace rockfold
