#include "host/cut/connectivity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <unordered_map>

#include "host/cut/union_find.hpp"
#include "host/cut/width.hpp"
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

// A sliver may belong to a part over an area: glue before joints, then the larger area, then the part that lies lower.
struct Claim {
  bool glue = false;
  Real area = 0;
  Index part = none;
};

class SliverOwners {
 public:
  SliverOwners(const Complex& complex, std::vector<Index>& part) : complex_(complex), part_(part) {
    for (const Fragment& f : complex.fragments)
      if (complex.touches_sliver(f)) areas_.push_back(&f);
    for (Index c = 0; c < complex.cells.size(); ++c)
      if (complex.is_sliver[c] == 0) {
        auto& m = moments_.try_emplace(part[c]).first->second;
        m.volume += complex.moments[c].volume;
        m.first += complex.moments[c].first;
      }
  }

  // Round by round, so that no sliver's owner depends on the order of its neighbours.
  void run() {
    while (!areas_.empty()) {
      std::map<Index, Claim> claims;
      for (const Fragment* f : areas_)
        for (int side = 0; side < 2; ++side)
          if (part_[f->cell[side]] == none && part_[f->cell[1 - side]] != none)
            consider(claims[f->cell[side]], {f->joint == none, f->area, part_[f->cell[1 - side]]});
      if (claims.empty()) return;
      for (const auto& [cell, claim] : claims) part_[cell] = claim.part;
      std::erase_if(areas_, [&](const Fragment* f) {
        return part_[f->cell[0]] != none && part_[f->cell[1]] != none;
      });
    }
  }

 private:
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
  std::vector<const Fragment*> areas_;
  std::unordered_map<Index, CellMoments> moments_;  // of the parts without their slivers
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
  std::vector<Index> part(complex.cells.size(), none);
  for (Index c = 0; c < complex.cells.size(); ++c)
    if (complex.is_sliver[c] == 0) part[c] = parts.find(c);
  return part;
}

void give_slivers(const Complex& complex, std::vector<Index>& part) {
  SliverOwners(complex, part).run();
}

}  // namespace rockfold
