#include "host/cut/bodies/connectivity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "host/cut/bodies/union_find.hpp"
#include "host/cut/bodies/width.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

Real width_of(const Complex& complex, const Fragment& f) {
  const Real enough = doubt_factor * complex.planes.width_tolerance();
  if (f.polygon != none) return polygon_width(complex.polygons[f.polygon], complex.planes, enough);
  const CellView cell = complex.cells[f.cell[0]];
  return face_width(cell, cell.faces[f.face[0]], complex.planes, enough);
}

namespace {

// Where two planes meet at a small angle, glue that is narrow for the wedge between them is thin there may be wide all the same.
bool is_wide_in_plane(const Complex& complex, const Fragment& f) {
  const Polygon polygon = complex.polygon_of(f);
  std::vector<Vec3> corners;
  for (const Vertex& v : polygon.corner) corners.push_back(v.x);
  return width_in_plane(corners, complex.planes.normal(polygon.plane)) >=
         complex.planes.width_tolerance();
}

// A sliver may belong to a part over an area: glue before joints, then the larger area, then the part that lies lower. Glue as
// narrow as the sliver is thick says no more than a joint: such a strip runs along where another joint crosses it.
struct Claim {
  bool glue = false;
  Real area = 0;
  Index part = none;
};

class SliverOwners {
 public:
  SliverOwners(const Complex& complex, std::vector<Index>& part) : complex_(complex), part_(part) {
    for (const Fragment& f : complex.fragments)
      if (complex.touches_sliver(f))
        areas_.push_back({&f, f.joint == none && (!f.narrow || is_wide_in_plane(complex, f))});
    for (Index c = 0; c < complex.cells.size(); ++c)
      if (complex.is_sliver[c] == 0) {
        auto& m = moments_.try_emplace(part[c]).first->second;
        m.volume += complex.moments[c].volume;
        m.first += complex.moments[c].first;
      }
  }

  // Round by round, so that no sliver's owner depends on the order of its neighbours. Over a joint only what no glue leads to: a
  // sliver may have its glue with another sliver that has no owner yet.
  void run() {
    while (!areas_.empty()) {
      std::map<Index, Claim> claims;
      for (const auto& [f, glue] : areas_)
        for (int side = 0; side < 2; ++side)
          if (part_[f->cell[side]] == none && part_[f->cell[1 - side]] != none)
            consider(claims[f->cell[side]], {glue, f->area, part_[f->cell[1 - side]]});
      if (claims.empty()) return;
      const auto is_glue = [](const auto& claim) { return claim.second.glue; };
      if (std::any_of(claims.begin(), claims.end(), is_glue))
        std::erase_if(claims, [&](const auto& claim) { return !is_glue(claim); });
      for (const auto& [cell, claim] : claims) part_[cell] = claim.part;
      std::erase_if(areas_, [&](const Area& a) {
        return part_[a.fragment->cell[0]] != none && part_[a.fragment->cell[1]] != none;
      });
    }
  }

 private:
  struct Area {
    const Fragment* fragment;
    bool glue;  // that is no gap
  };

  void consider(Claim& best, const Claim& other) const {
    if (best.part == none || is_better(other, best)) best = other;
  }
  bool is_better(const Claim& a, const Claim& b) const {
    if (a.glue != b.glue) return a.glue;
    constexpr Real rounding = 1e-9;
    if (std::abs(a.area - b.area) > rounding * std::max(a.area, b.area)) return a.area > b.area;
    return a.part != b.part && centroid(a.part) < centroid(b.part);
  }
  // Rounded as that of blocks, which are numbered by it.
  std::array<Real, 3> centroid(Index part) const {
    const CellMoments& m = moments_.at(part);
    const Real unit = complex_.planes.width_tolerance() * m.volume;
    return {std::round(m.first[2] / unit), std::round(m.first[1] / unit),
            std::round(m.first[0] / unit)};
  }

  const Complex& complex_;
  std::vector<Index>& part_;
  std::vector<Area> areas_;
  std::unordered_map<Index, CellMoments> moments_;  // of the parts without their slivers
};

// Cells about as thin as the tolerance that only joints and narrow glue surround. Where a wedge between two planes of a folded
// joint is cut in pieces, the glue of each is narrow for the wedge is thin there, wide as it may be in its own plane; the
// piece is of the rock that the glue leads to as a sliver would be. A gap that is narrow in its own plane leads nowhere.
class ThinParts {
 public:
  ThinParts(const Complex& complex, UnionFind& parts) : complex_(complex), parts_(parts) {
    for (const Fragment& f : complex.fragments)
      if (f.joint == none && f.narrow && !complex.touches_sliver(f) && is_wide_in_plane(complex, f))
        glue_.push_back(&f);
  }

  // Round by round over the largest area of each, so that nothing depends on the order of cells.
  void join() {
    if (glue_.empty()) return;
    find_thin();
    for (bool joined = true; joined;) {
      std::map<Index, const Fragment*> largest;
      for (const Fragment* f : glue_)
        for (int side = 0; side < 2; ++side) {
          const Index part = parts_.find(f->cell[side]);
          if (!thin_[part] || part == parts_.find(f->cell[1 - side])) continue;
          const Fragment*& best = largest[part];
          if (best == nullptr || f->area > best->area) best = f;
        }
      joined = !largest.empty();
      for (const auto& [part, f] : largest) {
        const Index one = parts_.find(f->cell[0]), two = parts_.find(f->cell[1]);
        const bool both_thin = thin_[one] && thin_[two];
        parts_.join(one, two);
        thin_[parts_.find(one)] = both_thin;
      }
    }
  }

 private:
  void find_thin() {
    thin_.assign(complex_.cells.size(), true);
    std::vector<bool> beside(complex_.cells.size(), false);
    for (const Fragment* f : glue_)
      for (const Index cell : f->cell) beside[parts_.find(cell)] = true;
    const Real enough = doubt_factor * complex_.planes.width_tolerance();
    for (Index c = 0; c < complex_.cells.size(); ++c)
      if (const Index part = parts_.find(c); beside[part] && thin_[part])
        thin_[part] = cell_width(complex_.cells[c], complex_.planes).width < enough;
  }

  const Complex& complex_;
  UnionFind& parts_;
  std::vector<const Fragment*> glue_;  // narrow, but not in its own plane
  std::vector<bool> thin_;             // [parts]
};

}  // namespace

std::vector<Index> mark_narrow_glue(Complex& complex) {
  const Real tolerance = complex.planes.width_tolerance();
  std::vector<std::uint8_t> doubtful(complex.fragments.size(), 0);
  parallel_for(static_cast<std::int64_t>(complex.fragments.size()), 4096, [&](std::int64_t i) {
    Fragment& f = complex.fragments[i];
    if (f.joint != none) return;
    const Real width = width_of(complex, f);
    f.narrow = width < tolerance;
    doubtful[i] = is_doubtful(width, tolerance) && !complex.touches_sliver(f) ? 1 : 0;
  });
  std::vector<Index> list;
  for (std::size_t i = 0; i < doubtful.size(); ++i)
    if (doubtful[i] != 0) list.push_back(static_cast<Index>(i));
  return list;
}

std::vector<Index> wide_parts(const Complex& complex) {
  UnionFind parts(complex.cells.size());
  for (const Fragment& f : complex.fragments)
    if (f.joint == none && !f.narrow && !complex.touches_sliver(f))
      parts.join(f.cell[0], f.cell[1]);
  // Each sliver on its way moves a beam's rim by about the tolerance: at a fold of a joint a strip as narrow looks past the joint.
  for (const Beam& b : complex.beams)
    if (b.joint == none && b.cell[1] != none && !b.narrow) parts.join(b.cell[0], b.cell[1]);
  ThinParts(complex, parts).join();
  std::vector<Index> part(complex.cells.size(), none);
  for (Index c = 0; c < complex.cells.size(); ++c)
    if (complex.is_sliver[c] == 0) part[c] = parts.find(c);
  return part;
}

void give_slivers(const Complex& complex, std::vector<Index>& part) {
  SliverOwners(complex, part).run();
}

}  // namespace rockfold
