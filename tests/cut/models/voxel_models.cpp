// Grid models as models of the program, and its answers against the oracle's.
#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>

#include "src/base/vector.hpp"
#include "tests/cut/oracles/voxel_oracle.hpp"

namespace rockfold::test {

Vec3 AffineMap::operator()(const Vec3& x) const {
  return x[0] * column[0] + x[1] * column[1] + x[2] * column[2] + shift;
}
Vec3 AffineMap::square(int axis) const {
  return cross(column[(axis + 1) % 3], column[(axis + 2) % 3]);
}
Real AffineMap::determinant() const {
  return dot(column[0], square(0));
}
Vec3 AffineMap::inverse(const Vec3& x) const {
  Vec3 y;
  for (int d = 0; d < 3; ++d) y[d] = dot(x - shift, square(d)) / determinant();
  return y;
}

namespace {

class Placer {
 public:
  explicit Placer(const Placing& p) : p_(p), random_(p.seed), noise_(-p.noise, p.noise) {}

  Vec3 operator()(const Vec3& x) {
    Vec3 y = p_.straight ? x : p_.map(x);
    if (p_.noise > 0)
      for (Real& c : y) c += noise_(random_);
    return y;
  }

  Vec3 normal(int axis) const {
    Vec3 n{};
    n[axis] = 1;
    return p_.straight ? n : p_.map.square(axis);
  }

  Shape shape(const GridBox& b) {
    const auto real = [](const std::array<int, 3>& v) {
      return Vec3{1.0 * v[0], 1.0 * v[1], 1.0 * v[2]};
    };
    const Vec3 low = real(b.min), high = real(b.max);
    if (p_.straight && p_.noise == 0) return BoxShape{low, high};
    if (p_.prisms) {
      PrismShape prism;
      for (const auto& [x, y] :
           {std::pair{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}})
        prism.base.push_back(p_.map({x, y, low[2]}));
      prism.extrude = (high[2] - low[2]) * p_.map.column[2];
      return prism;
    }
    HalfspacesShape shape;
    for (int d = 0; d < 3; ++d) {
      shape.planes.push_back({{normal(d), (*this)(low)}, p_.map.determinant() > 0});
      shape.planes.push_back({{normal(d), (*this)(high)}, p_.map.determinant() < 0});
    }
    return shape;
  }

  Joint joint(const GridJoint& r) {
    Joint joint;
    const int u = r.axis == 0 ? 1 : 0, v = r.axis == 2 ? 1 : 2;
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
      Vec3 corner{};
      corner[r.axis] = r.at;
      corner[u] = r.u[i];
      corner[v] = r.v[j];
      joint.polygon.push_back((*this)(corner));
    }
    joint.plane.point = joint.polygon.front();
    joint.plane.orientation = p_.normals_of_corners ? cross(joint.polygon[2] - joint.polygon[0],
                                                            joint.polygon[3] - joint.polygon[1])
                                                    : normal(r.axis);
    return joint;
  }

 private:
  const Placing& p_;
  std::mt19937 random_;
  std::uniform_real_distribution<Real> noise_;
};

// Collects at most 20 lines.
class Lines {
 public:
  template <class... Part>
  void add(const Part&... part) {
    if (lines_.size() >= 20) return;
    std::ostringstream text;
    text.precision(17);
    (text << ... << part);
    lines_.push_back(text.str());
  }
  std::vector<std::string> take() { return std::move(lines_); }

 private:
  std::vector<std::string> lines_;
};

Real area_of(const std::array<Index, 3>& squares, const AffineMap& map) {
  Real area = 0;
  for (int d = 0; d < 3; ++d) area += squares[d] * norm(map.square(d));
  return area;
}

}  // namespace

Model model_of(const GridModel& model, const Placing& placing) {
  Placer place(placing);
  Model out;
  for (const GridBox& b : model.solids) {
    Solid solid;
    solid.name = std::string("s").append(std::to_string(out.solids.size() + 1));
    solid.add = b.add;
    solid.shape = place.shape(b);
    solid.continues.assign(6, false);
    out.solids.push_back(std::move(solid));
  }
  for (const GridJoint& r : model.joints) {
    out.joints.push_back(place.joint(r));
    out.joints.back().name = std::string("F").append(std::to_string(out.joints.size()));
  }
  return out;
}

std::vector<std::string> differences(const Blocks& found, const GridBlocks& expected,
                                     const AffineMap& map, Real tolerance) {
  Lines lines;
  const BlockArrays& a = found.arrays;
  const Real scale = std::abs(map.determinant());
  const Real rock = scale * expected.volume(), volume_off = tolerance * rock,
             area_off = tolerance * std::pow(rock, 2.0 / 3);
  if (a.block_count() != static_cast<Index>(expected.blocks.size()))
    lines.add(a.block_count(), " blocks, expected ", expected.blocks.size());
  std::vector<bool> used(expected.blocks.size(), false);
  for (Index b = 0; b < a.block_count(); ++b) {
    std::size_t match = expected.blocks.size();
    for (std::size_t i = 0; i < expected.blocks.size() && match == expected.blocks.size(); ++i) {
      const GridBlock& e = expected.blocks[i];
      // Centroids are far less exact than volumes after noise; blocks differ by far more.
      if (!used[i] && std::abs(a.volume[b] / scale - e.volume) < 1e-3 &&
          norm(map.inverse(a.centroid[b]) - e.centroid) < 1e-3)
        match = i;
    }
    if (match == expected.blocks.size()) {
      const Vec3 at = map.inverse(a.centroid[b]);
      lines.add("block ", b, " of volume ", a.volume[b] / scale, " about ", at[0], " ", at[1], " ",
                at[2], " is not expected");
      continue;
    }
    used[match] = true;
    const GridBlock& e = expected.blocks[match];
    const Counts counts = counts_of(a, b);
    if (!(std::abs(a.volume[b] - scale * e.volume) <= volume_off))
      lines.add("block ", b, ": volume ", a.volume[b], ", expected ", scale * e.volume);
    if (!(counts == e.counts)) lines.add("block ", b, ": ", counts, ", expected ", e.counts);
    const Index loops = a.loop_begin[a.face_begin[b + 1]] - a.loop_begin[a.face_begin[b]];
    if (loops - counts.faces != e.holes)
      lines.add("block ", b, ": ", loops - counts.faces, " holes, expected ", e.holes);
    if (a.shell_count[b] != e.shells)
      lines.add("block ", b, ": ", a.shell_count[b], " shells, expected ", e.shells);
    if (a.genus[b] != e.genus)
      lines.add("block ", b, ": genus ", a.genus[b], ", expected ", e.genus);
    // Arrays of an older cutting have no dead ends at all.
    const Real dead = a.dead_end_area.empty() ? 0 : a.dead_end_area[b];
    if (!(std::abs(dead - area_of(e.dead_ends, map)) <= area_off))
      lines.add("block ", b, ": dead-end area ", dead, ", expected ", area_of(e.dead_ends, map));
  }
  for (std::size_t i = 0; i < used.size(); ++i)
    if (!used[i]) {
      const GridBlock& e = expected.blocks[i];
      lines.add("no block of volume ", e.volume, " about ", e.centroid[0], " ", e.centroid[1], " ",
                e.centroid[2]);
    }
  const CutTotals& t = found.cutting.totals;
  const Real dead = area_of(expected.dead_ends, map),
             joints = dead + area_of(expected.separating, map);
  if (!(std::abs(t.solid_volume - rock) <= volume_off))
    lines.add("solid volume ", t.solid_volume, ", expected ", rock);
  if (!(std::abs(t.joint_area - joints) <= area_off))
    lines.add("joint area ", t.joint_area, ", expected ", joints);
  if (!(std::abs(t.dangling_joint_area - dead) <= area_off))
    lines.add("dangling joint area ", t.dangling_joint_area, ", expected ", dead);
  if (static_cast<Index>(a.interfaces.size()) != expected.interfaces)
    lines.add(a.interfaces.size(), " interfaces, expected ", expected.interfaces);
  Real shared = 0;
  for (const auto& i : a.interfaces) shared += i.area;
  if (!(std::abs(shared - area_of(expected.separating, map)) <= area_off))
    lines.add("interfaces of area ", shared, ", expected ", area_of(expected.separating, map));
  return lines.take();
}

std::string to_text(const GridModel& m) {
  std::ostringstream text;
  text << "size {" << m.size[0] << ", " << m.size[1] << ", " << m.size[2] << "}";
  for (const GridBox& b : m.solids) {
    text << (b.add ? " add {" : " subtract {") << b.min[0] << ", " << b.min[1] << ", " << b.min[2]
         << "}-{" << b.max[0] << ", " << b.max[1] << ", " << b.max[2] << "}";
  }
  for (const GridJoint& j : m.joints)
    text << "\n  {" << j.axis << ", " << j.at << ", {" << j.u[0] << ", " << j.u[1] << "}, {"
         << j.v[0] << ", " << j.v[1] << "}}";
  return text.str();
}

}  // namespace rockfold::test
