#include "tests/cut/oracles/conservation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <sstream>
#include <tuple>

#include <omp.h>

#include "src/base/vector.hpp"
#include "tests/flatten/array_difference.hpp"

namespace rockfold::test {

namespace {

class Losses {
 public:
  Losses(const Blocks& blocks, Real size, Real relative)
      : a_(blocks.arrays), t_(blocks.cutting.totals), size_(size), relative_(relative) {}

  std::vector<std::string> run() {
    if (!near(sum(a_.volume), t_.solid_volume, relative_ * t_.solid_volume))
      line("blocks of ", sum(a_.volume), " m3 in solids of ", t_.solid_volume);
    Real joint_faces = 0;
    for (Index b = 0; b < a_.block_count(); ++b) {
      check_surface(b);
      for (Index f = a_.face_begin[b]; f < a_.face_begin[b + 1]; ++f)
        if (a_.origins[a_.face_origin[f]].kind == FaceOrigin::Kind::joint)
          joint_faces += a_.face_area[f];
    }
    Real shared = 0;
    for (const auto& i : a_.interfaces) shared += i.area;
    // Strips narrower than 1e-9 of the size are on no face.
    const bool strips = t_.intent.slivers + t_.intent.openings_closed + a_.vertices_identified > 0;
    const Real area = (strips ? 1e-9 : 1e-11) * std::max(size_ * size_, t_.joint_area);
    if (!near(joint_faces, 2 * shared, area))
      line("joint faces of ", joint_faces, " m2, interfaces of ", shared);
    if (!near(t_.joint_area - t_.dangling_joint_area, shared, area))
      line("joints of ", t_.joint_area, " m2, of these ", t_.dangling_joint_area,
           " dead ends; interfaces of ", shared);
    if (!near(sum(a_.dead_end_area), t_.dangling_joint_area, area))
      line("dead ends of ", sum(a_.dead_end_area), " m2, in all ", t_.dangling_joint_area);
    if (!a_.dead_end_area.empty()) check_dead_ends(area);
    return std::move(lines_);
  }

 private:
  template <class... Part>
  void line(const Part&... part) {
    if (lines_.size() >= 20) return;
    std::ostringstream text;
    text.precision(17);
    (text << ... << part);
    lines_.push_back(text.str());
  }
  static bool near(Real a, Real b, Real off) { return std::abs(a - b) <= off; }

  // Polygons of dead ends against the areas that blocks claim.
  void check_dead_ends(Real area) {
    std::vector<Real> of_block(a_.block_count(), 0);
    for (std::size_t d = 0; d < a_.dead_end_block.size(); ++d) {
      const Index begin = a_.dead_end_corner_begin[d], end = a_.dead_end_corner_begin[d + 1];
      Vec3 twice{};
      for (Index c = begin + 1; c + 1 < end; ++c)
        twice += cross(a_.dead_end_vertex[c] - a_.dead_end_vertex[begin],
                       a_.dead_end_vertex[c + 1] - a_.dead_end_vertex[begin]);
      of_block[a_.dead_end_block[d]] += norm(twice) / 2;
    }
    for (Index b = 0; b < a_.block_count(); ++b)
      if (!near(of_block[b], a_.dead_end_area[b], area))
        line("block ", b, ": dead ends of ", a_.dead_end_area[b], " m2, their polygons ",
             of_block[b]);
  }

  void check_surface(Index b) {
    std::map<std::pair<Index, Index>, int> runs;  // edge → times along minus times against
    Vec3 vector_area{};
    Real volume = 0, surface = 0;
    const Vec3 o = a_.centroid[b];
    for (Index f = a_.face_begin[b]; f < a_.face_begin[b + 1]; ++f) {
      vector_area += a_.face_area[f] * a_.face_normal[f];
      surface += a_.face_area[f];
      for (Index l = a_.loop_begin[f]; l < a_.loop_begin[f + 1]; ++l)
        for (Index c = a_.corner_begin[l]; c < a_.corner_begin[l + 1]; ++c) {
          const Index next = c + 1 < a_.corner_begin[l + 1] ? c + 1 : a_.corner_begin[l];
          const Index p = a_.corner_vertex[c], q = a_.corner_vertex[next];
          runs[std::minmax(p, q)] += p < q ? 1 : -1;
          const Vec3& apex = a_.vertex[a_.corner_vertex[a_.corner_begin[l]]];
          volume += dot(apex - o, cross(a_.vertex[p] - o, a_.vertex[q] - o)) / 6;
        }
    }
    for (const auto& [edge, balance] : runs)
      if (balance != 0) {
        line("block ", b, ": an edge is run through ", balance, " times more in one sense");
        break;
      }
    if (!(norm(vector_area) <= 1e-9 * size_ * size_))
      line("block ", b, ": its faces' vector areas leave ", norm(vector_area));
    if (!near(volume, a_.volume[b], 1e-9 * size_ * surface))
      line("block ", b, ": volume ", a_.volume[b], ", its faces enclose ", volume);
    if (!(a_.volume[b] > 0)) line("block ", b, ": volume ", a_.volume[b]);
  }

  const BlockArrays& a_;
  const CutTotals& t_;
  const Real size_, relative_;
  std::vector<std::string> lines_;
};

std::string totals_text(const CutTotals& t) {
  std::ostringstream text;
  text << std::hexfloat << t.cells << " cells, " << t.solid_volume << " m3, joints " << t.joint_area
       << " dangling " << t.dangling_joint_area << ", doubts " << t.intent.doubts;
  return text.str();
}

// Totals are sums over cells, whose shapes may depend on the order of joints: to rounding only.
bool nearly_equal(Real a, Real b) {
  return std::abs(a - b) <= 1e-12 * std::max(std::abs(a), std::abs(b));
}

}  // namespace

std::vector<std::string> losses(const Blocks& blocks, Real size, Real relative) {
  return Losses(blocks, size, relative).run();
}

Real clipped_area(const std::vector<Vec3>& polygon, const std::vector<HalfSpaceOutside>& solid) {
  // A polygon's vector area is that of its fan of signed triangles, each of them convex.
  Vec3 whole{};
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
    whole += cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  const Vec3 up = normalized(whole);
  Real area = 0;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    std::vector<Vec3> part{polygon[0], polygon[k], polygon[k + 1]};
    const Real sense = dot(up, cross(part[1] - part[0], part[2] - part[0])) < 0 ? -1 : 1;
    for (const auto& [normal, point] : solid) {
      std::vector<Vec3> kept;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Vec3 &p = part[i], &q = part[(i + 1) % part.size()];
        const Real dp = dot(normal, p - point), dq = dot(normal, q - point);
        if (dp <= 0) kept.push_back(p);
        if ((dp < 0 && dq > 0) || (dp > 0 && dq < 0))
          kept.push_back(p + (dp / (dp - dq)) * (q - p));
      }
      part = std::move(kept);
      if (part.size() < 3) break;
    }
    Vec3 twice{};
    for (std::size_t i = 1; i + 1 < part.size(); ++i)
      twice += cross(part[i] - part[0], part[i + 1] - part[0]);
    area += sense * norm(twice) / 2;
  }
  return area;
}

std::string block_difference(const BlockArrays& a, const BlockArrays& b, Real size) {
  // What is rounded is compared by rounding to 1e-9 of the size, coarse enough to fall between two values rarely; so each list
  // is sorted by exact keys first and compared in order.
  struct Face {
    std::string origin;
    Vec3 normal;
    Index loops, corners;
    Real area;
  };
  const auto faces_of = [](const BlockArrays& x, Index block) {
    std::vector<Face> faces;
    for (Index f = x.face_begin[block]; f < x.face_begin[block + 1]; ++f)
      faces.push_back({x.origins[x.face_origin[f]].name, x.face_normal[f],
                       x.loop_begin[f + 1] - x.loop_begin[f],
                       x.corner_begin[x.loop_begin[f + 1]] - x.corner_begin[x.loop_begin[f]],
                       x.face_area[f]});
    std::sort(faces.begin(), faces.end(), [](const Face& p, const Face& q) {
      return std::tie(p.origin, p.normal, p.loops, p.corners, p.area) <
             std::tie(q.origin, q.normal, q.loops, q.corners, q.area);
    });
    return faces;
  };
  const auto off = [size](Real x, Real y, int power) {
    return !(std::abs(x - y) <= 1e-10 * std::pow(size, power));
  };
  if (a.block_count() != b.block_count()) return "block_count";
  for (Index i = 0; i < a.block_count(); ++i) {
    const std::string block = " of block " + std::to_string(i);
    if (off(a.volume[i], b.volume[i], 3)) return "volume" + block;
    if (norm(a.centroid[i] - b.centroid[i]) > 1e-7 * size) return "centroid" + block;
    if (!(counts_of(a, i) == counts_of(b, i))) return "counts" + block;
    if (a.shell_count[i] != b.shell_count[i]) return "shells" + block;
    if (a.genus[i] != b.genus[i]) return "genus" + block;
    if (a.convex[i] != b.convex[i]) return "convex" + block;
    if (off(a.dead_end_area[i], b.dead_end_area[i], 2)) return "dead_end_area" + block;
    const auto p = faces_of(a, i), q = faces_of(b, i);
    for (std::size_t f = 0; f < p.size(); ++f)
      if (p[f].origin != q[f].origin || norm(p[f].normal - q[f].normal) > 1e-9 ||
          p[f].loops != q[f].loops || p[f].corners != q[f].corners || off(p[f].area, q[f].area, 2))
        return "face of " + p[f].origin + block;
  }
  if (a.interfaces.size() != b.interfaces.size()) return "interfaces";
  return "";
}

std::vector<std::string> dependences(const Model& model, Real size, bool shuffle_joints) {
  std::vector<std::string> lines;
  const int threads_before = omp_get_max_threads();
  omp_set_num_threads(1);
  const Blocks one = cut(model);
  for (const int threads : {2, 4}) {
    omp_set_num_threads(threads);
    const Blocks many = cut(model);
    const std::string what = std::to_string(threads) + " threads";
    std::string differs = first_difference(one.arrays, many.arrays);
    if (differs.empty() && (one.arrays.dead_end_area != many.arrays.dead_end_area ||
                            one.arrays.dead_end_vertex != many.arrays.dead_end_vertex))
      differs = "dead ends";
    if (!differs.empty()) lines.push_back(std::string(what).append(": ").append(differs));
    if (totals_text(many.cutting.totals) != totals_text(one.cutting.totals))
      lines.push_back(what + ": " + totals_text(many.cutting.totals) +
                      ", one thread: " + totals_text(one.cutting.totals));
  }
  omp_set_num_threads(threads_before);
  for (unsigned seed = 1; shuffle_joints && seed <= 3; ++seed) {
    Model shuffled = model;
    std::mt19937 random(seed);
    std::shuffle(shuffled.joints.begin(), shuffled.joints.end(), random);
    const Blocks other = cut(shuffled);
    const std::string what = "shuffle " + std::to_string(seed);
    const std::string differs = block_difference(one.arrays, other.arrays, size);
    if (!differs.empty()) lines.push_back(std::string(what).append(": ").append(differs));
    const CutTotals &t = one.cutting.totals, &u = other.cutting.totals;
    if (!nearly_equal(t.joint_area, u.joint_area) || !nearly_equal(t.solid_volume, u.solid_volume))
      lines.push_back(what + ": " + totals_text(u) + ", before: " + totals_text(t));
  }
  return lines;
}

}  // namespace rockfold::test
