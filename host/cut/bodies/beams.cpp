#include "host/cut/bodies/beams.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <map>

#include "host/cut/adjacency.hpp"
#include "host/cut/bodies/width.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

// Slivers that a beam passes at most: more lie behind each other only where somebody piles up joints.
constexpr std::size_t most_slivers = 64;
// Slivers that the beams of one area pass in all; the rest of it goes with the widest. A stack of n planes may divide it into n⁴
// columns, of which nobody can tell one from the other.
constexpr std::size_t most_passages = 512;
constexpr std::size_t most_parts = 32;  // of an area between whose beams strips are looked for

// An area of a sliver's boundary, seen from the sliver.
struct Opening {
  enum class Kind : std::uint8_t { fragment, gap, free_part };
  Kind kind;
  Index item;         // into Complex::fragments, the gaps or Complex::free_parts
  Index face, other;  // of the sliver; the cell behind it, none = none
  Index other_face;
  Real up = 0;                 // cosine of the outward normal and the sliver's axis
  std::vector<Vec3> corner{};  // in a row; none where it is narrow
};

// The joint that a beam has crossed, of several the nearest to where it starts.
struct Crossed {
  Index joint = none, instance = none;
  std::vector<Index> fragments;

  void add(const Fragment& f, Index number) {
    if (f.joint == none) return;
    if (joint == none) joint = f.joint, instance = f.instance;
    if (number != none) fragments.push_back(number);
  }
};

// The line of a polygon's edge, seen along an axis.
struct EdgeLine {
  Vec3 point;
  Vec3 inward;  // unit
};

// The edges' lines of a convex polygon, corners in a row, seen along `axis`. An edge between two positions of one point has no
// direction: its line might lie across the polygon.
std::vector<EdgeLine> edge_lines(const std::vector<Vec3>& polygon, const Vec3& axis,
                                 Real rounding) {
  Vec3 middle{};
  for (const Vec3& x : polygon) middle += (1.0 / static_cast<Real>(polygon.size())) * x;
  std::vector<EdgeLine> lines;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 across = cross(axis, polygon[(k + 1) % polygon.size()] - polygon[k]);
    const Real length = norm(across);
    if (length <= rounding) continue;
    const Real sense = dot(across, middle - polygon[k]) < 0 ? -1 : 1;
    lines.push_back({polygon[k], (sense / length) * across});
  }
  return lines;
}

struct Halves {
  std::vector<Vec3> inside, outside;
};

// The parts of a convex polygon on the two sides of a line. Corners on the line, to rounding, do not divide it: a strip without
// area would else be on both sides of each line along it, and double each time.
Halves split(const std::vector<Vec3>& polygon, const EdgeLine& line, Real rounding) {
  const auto height = [&](const Vec3& x) { return dot(line.inward, x - line.point); };
  bool any_inside = false, any_outside = false;
  for (const Vec3& x : polygon) {
    any_inside = any_inside || height(x) > rounding;
    any_outside = any_outside || height(x) < -rounding;
  }
  if (!any_inside) return {{}, polygon};
  if (!any_outside) return {polygon, {}};
  Halves halves;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Real dp = height(p), dq = height(q);
    if (dp >= 0) halves.inside.push_back(p);
    if (dp <= 0) halves.outside.push_back(p);
    if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0)) {
      const Vec3 on_line = p + (dp / (dp - dq)) * (q - p);
      halves.inside.push_back(on_line);
      halves.outside.push_back(on_line);
    }
  }
  return halves;
}

// The part of a convex polygon inside the prism over another one, along `axis`. Corners of both in a row.
std::vector<Vec3> clipped_to_prism(std::vector<Vec3> polygon, const std::vector<Vec3>& base,
                                   const Vec3& axis, Real rounding) {
  for (const EdgeLine& line : edge_lines(base, axis, rounding))
    polygon = split(polygon, line, rounding).inside;
  return polygon;
}

// What of convex polygons lies outside a convex one; all in one plane, corners in a row. A polygon that shares no area with it
// stays whole; else its edges divide it.
void subtract(std::vector<std::vector<Vec3>>& polygons, const std::vector<Vec3>& other,
              const Vec3& normal, Real rounding) {
  const std::vector<EdgeLine> lines = edge_lines(other, normal, rounding);
  std::vector<std::vector<Vec3>> rest;
  for (std::vector<Vec3>& polygon : polygons) {
    const std::size_t before = rest.size();
    std::vector<Vec3> common = polygon;
    for (const EdgeLine& line : lines) {
      Halves halves = split(common, line, rounding);
      if (!halves.outside.empty()) rest.push_back(std::move(halves.outside));
      common = std::move(halves.inside);
    }
    if (!common.empty()) continue;
    rest.resize(before);
    rest.push_back(std::move(polygon));
  }
  polygons = std::move(rest);
}

class BeamFinder {
 public:
  BeamFinder(const Complex& complex, Index rock_count, const std::vector<Fragment>& gaps)
      : complex_(complex),
        rock_count_(rock_count),
        gaps_(gaps),
        rounding_(complex.planes.position_tolerance()) {
    number_slivers();
    find_openings();
    measure_openings();
  }

  std::vector<Beam> run() const {
    std::vector<Start> starts;
    for (std::size_t i = 0; i < complex_.fragments.size(); ++i) {
      const Fragment& f = complex_.fragments[i];
      for (int side = 0; side < 2; ++side)
        if (is_wide(f.cell[side]) && !is_wide(f.cell[1 - side]))
          starts.push_back({static_cast<Index>(i), side, false});
    }
    for (std::size_t i = 0; i < gaps_.size(); ++i)
      for (int side = 0; side < 2; ++side)
        if (is_wide(gaps_[i].cell[side])) starts.push_back({static_cast<Index>(i), side, true});
    std::vector<std::vector<Beam>> found(starts.size());
    parallel_for(static_cast<std::int64_t>(starts.size()), 16,
                 [&](std::int64_t i) { follow(starts[i], found[i]); });
    std::vector<Beam> beams;
    for (auto& of_start : found)
      std::move(of_start.begin(), of_start.end(), std::back_inserter(beams));
    return beams;
  }

 private:
  struct Start {
    Index item;
    int side;
    bool gap;
  };
  struct Path {
    Index start_cell, start_face;
    Index start = none;      // Beam::start
    Index open_face = none;  // origin of the face at the start, if a void is before it
    Vec3 normal;             // of the start's plane
    std::vector<Beam>* beams;
    std::vector<Index> slivers{};  // that it is in
    std::size_t passages = 0;
  };

  bool is_rock(Index cell) const { return cell < rock_count_; }
  bool is_wide(Index cell) const { return is_rock(cell) && complex_.is_sliver[cell] == 0; }

  void number_slivers() {
    const Index cells = complex_.cells.size();
    number_.assign(cells, none);
    for (Index c = 0; c < cells; ++c)
      if (!is_wide(c)) {
        number_[c] = static_cast<Index>(slivers_.size());
        slivers_.push_back(c);
      }
    axis_.resize(slivers_.size());
    for (std::size_t s = 0; s < slivers_.size(); ++s) {
      const CellView cell = complex_.cells[slivers_[s]];
      axis_[s] = outward(cell.faces[cell_width(cell, complex_.planes).face]);
    }
  }

  Vec3 outward(const ConvexCell::Face& face) const {
    const Vec3& n = complex_.planes.normal(plane_of(face.inside));
    return is_above(face.inside) ? -n : n;
  }

  void find_openings() {
    openings_.resize(slivers_.size());
    const auto add_sides = [&](const Fragment& f, Opening::Kind kind, std::size_t i) {
      for (int side = 0; side < 2; ++side)
        if (const Index s = number_[f.cell[side]]; s != none)
          openings_[s].push_back(
              {kind, static_cast<Index>(i), f.face[side], f.cell[1 - side], f.face[1 - side]});
    };
    for (std::size_t i = 0; i < complex_.fragments.size(); ++i)
      add_sides(complex_.fragments[i], Opening::Kind::fragment, i);
    for (std::size_t i = 0; i < gaps_.size(); ++i) add_sides(gaps_[i], Opening::Kind::gap, i);
    for (std::size_t i = 0; i < complex_.free_parts.size(); ++i) {
      const FreePart& f = complex_.free_parts[i];
      if (f.gap != none)
        free_before_gap_.emplace(std::array{f.cell, f.face, f.gap}, f.origin);
      else if (const Index s = number_[f.cell]; s != none)
        openings_[s].push_back(
            {Opening::Kind::free_part, static_cast<Index>(i), f.face, none, none});
    }
  }

  void measure_openings() {
    parallel_for(static_cast<std::int64_t>(openings_.size()), 64, [&](std::int64_t s) {
      for (Opening& o : openings_[s]) {
        const Vec3 out = outward(complex_.cells[slivers_[s]].faces[o.face]);
        o.up = dot(out, axis_[s]);
        std::vector<Vec3> corner = corners(o);
        // Seen edge-on nothing is before it.
        if (!is_narrow(corner, out) && width_in_plane(corner, axis_[s]) > rounding_)
          o.corner = std::move(corner);
      }
    });
  }

  std::vector<Vec3> corners(const Opening& o) const {
    switch (o.kind) {
      case Opening::Kind::fragment:
        return corners(complex_.polygon_of(complex_.fragments[o.item]));
      case Opening::Kind::gap:
        return corners(complex_.polygon_of(gaps_[o.item]));
      default:
        return corners(complex_.polygon_of(complex_.free_parts[o.item]));
    }
  }
  static std::vector<Vec3> corners(const Polygon& polygon) {
    std::vector<Vec3> result;
    for (const Vertex& v : polygon.corner) result.push_back(v.x);
    return result;
  }

  bool is_narrow(const std::vector<Vec3>& polygon, const Vec3& normal) const {
    return polygon.size() < 3 ||
           width_in_plane(polygon, normal) <= complex_.planes.width_tolerance();
  }

  void follow(const Start& start, std::vector<Beam>& beams) const {
    const Fragment& f = start.gap ? gaps_[start.item] : complex_.fragments[start.item];
    const Index cell = f.cell[start.side], face = f.face[start.side];
    const Vec3 normal = outward(complex_.cells[cell].faces[face]);
    std::vector<Vec3> polygon = corners(complex_.polygon_of(f));
    // Polygons run counter-clockwise seen from above their plane: from outside the cell below it, side 0.
    if (start.side == 1) std::reverse(polygon.begin(), polygon.end());
    if (is_narrow(polygon, normal)) return;
    Path path{cell,
              face,
              start.gap ? none : 2 * start.item + start.side,
              start.gap ? free_origin(cell, face, f.cell[1 - start.side]) : none,
              normal,
              &beams};
    Crossed crossed;
    crossed.add(f, start.gap ? none : start.item);
    pass(path, polygon, f.cell[1 - start.side], f.face[1 - start.side], crossed);
    add_strips(polygon, normal, beams);
    for (Beam& b : beams)
      b.narrow =
          width_in_plane(b.polygon, normal) < doubt_factor * complex_.planes.width_tolerance();
  }

  // What no beam leaves through is narrow: it goes with the widest beam, so that an area has no holes. Beams that all end alike
  // are one.
  void add_strips(const std::vector<Vec3>& polygon, const Vec3& normal,
                  std::vector<Beam>& beams) const {
    if (beams.empty()) return;
    Beam widest = *std::max_element(beams.begin(), beams.end(),
                                    [](const Beam& a, const Beam& b) { return a.area < b.area; });
    const auto ends_alike = [&](const Beam& b) {
      return b.cell[1] == widest.cell[1] && b.joint == widest.joint && b.origin == widest.origin;
    };
    std::vector<std::vector<Vec3>> rest{polygon};
    if (std::all_of(beams.begin(), beams.end(), ends_alike)) {
      for (const Beam& b : beams)
        widest.slivers.insert(widest.slivers.end(), b.slivers.begin(), b.slivers.end());
      beams.clear();
    } else if (beams.size() <= most_parts) {
      for (const Beam& b : beams) subtract(rest, b.polygon, normal, rounding_);
    } else {
      return;
    }
    for (std::vector<Vec3>& strip : rest) {
      beams.push_back(widest);
      beams.back().area = area_of(strip);
      beams.back().polygon = std::move(strip);
    }
  }

  static Real area_of(const std::vector<Vec3>& polygon) {
    Vec3 twice{};
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      twice += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
    return norm(twice) / 2;
  }

  // The face of a cell of rock before a narrow void.
  Index free_origin(Index cell, Index face, Index gap) const {
    const auto found = free_before_gap_.find({cell, face, gap});
    return found != free_before_gap_.end() ? found->second : none;
  }

  // Through a sliver that was entered by one of its faces.
  void pass(Path& path, const std::vector<Vec3>& polygon, Index sliver, Index entered,
            const Crossed& crossed) const {
    const Index s = number_[sliver];
    const CellView cell = complex_.cells[sliver];
    const Real sense = dot(outward(cell.faces[entered]), axis_[s]);
    path.slivers.push_back(sliver);
    ++path.passages;
    std::vector<std::vector<Vec3>> rest{polygon};
    for (const Opening& o : openings_[s]) {
      if (o.up * sense >= 0 || o.corner.empty()) continue;
      std::vector<Vec3> part = clipped_to_prism(polygon, o.corner, axis_[s], rounding_);
      if (is_narrow(part, path.normal)) continue;
      if (!is_rock(sliver)) subtract(rest, part, path.normal, rounding_);
      leave(path, std::move(part), sliver, o, crossed);
    }
    // Nothing is behind the rest of a void.
    for (std::vector<Vec3>& part : rest)
      if (!is_rock(sliver) && !is_narrow(part, path.normal))
        end(path, std::move(part), none, none, path.open_face, {});
    path.slivers.pop_back();
  }

  void leave(Path& path, std::vector<Vec3> part, Index sliver, const Opening& o,
             const Crossed& crossed) const {
    if (path.slivers.size() == most_slivers || path.passages >= most_passages ||
        std::find(path.slivers.begin(), path.slivers.end(), o.other) != path.slivers.end())
      return;
    Crossed further = crossed;
    if (o.kind == Opening::Kind::fragment) further.add(complex_.fragments[o.item], o.item);
    if (o.kind == Opening::Kind::gap) further.add(gaps_[o.item], none);
    if (o.other == none)
      return end(path, std::move(part), none, none, complex_.free_parts[o.item].origin, further);
    if (is_wide(o.other)) return end(path, std::move(part), o.other, o.other_face, none, further);
    const Index open_face = path.open_face;
    if (o.kind == Opening::Kind::gap && is_rock(sliver))
      path.open_face = free_origin(sliver, o.face, o.other);
    pass(path, part, o.other, o.other_face, further);
    path.open_face = open_face;
  }

  void end(const Path& path, std::vector<Vec3> polygon, Index cell, Index face, Index origin,
           const Crossed& crossed) const {
    Beam beam;
    beam.cell[0] = path.start_cell;
    beam.face[0] = path.start_face;
    beam.start = path.start;
    beam.cell[1] = cell;
    beam.face[1] = face;
    beam.origin = origin;
    beam.joint = crossed.joint;
    beam.instance = crossed.instance;
    beam.fragments = crossed.fragments;
    for (const Index s : path.slivers)
      if (is_rock(s)) beam.slivers.push_back(s);
    if (cell != none && beam.joint == none) {
      const Zone &one = complex_.zone(path.start_cell), &two = complex_.zone(cell);
      beam.joint = interface_between(complex_, one, two);
      if (beam.joint == none && one.stage != two.stage) beam.joint = path.open_face;
    }
    beam.area = area_of(polygon);
    beam.polygon = std::move(polygon);
    path.beams->push_back(std::move(beam));
  }

  const Complex& complex_;
  const Index rock_count_;
  const std::vector<Fragment>& gaps_;
  const Real rounding_;         // m: of positions of one point
  std::vector<Index> number_;   // [cells] among the slivers, or none
  std::vector<Index> slivers_;  // cells
  std::vector<Vec3> axis_;      // [slivers] unit, across the least width
  std::vector<std::vector<Opening>> openings_;
  std::map<std::array<Index, 3>, Index> free_before_gap_;  // cell, face, gap → origin
};

}  // namespace

std::vector<Beam> find_beams(const Complex& complex, Index rock_count,
                             const std::vector<Fragment>& gaps) {
  const bool any = !gaps.empty() || std::any_of(complex.is_sliver.begin(), complex.is_sliver.end(),
                                                [](std::uint8_t sliver) { return sliver != 0; });
  return any ? BeamFinder(complex, rock_count, gaps).run() : std::vector<Beam>{};
}

}  // namespace rockfold
