#include "tests/flatten/block_check.hpp"

#include <cmath>
#include <sstream>

#include "src/base/vector.hpp"

namespace rockfold::test {

namespace {

class Checker {
 public:
  Checker(const BlockArrays& blocks, Real size) : a_(blocks), size_(size) {}

  std::vector<std::string> run() {
    check_shape();
    if (!faults_.empty()) return std::move(faults_);
    for (Index b = 0; b < a_.block_count(); ++b) check_block(b);
    check_interfaces();
    return std::move(faults_);
  }

 private:
  template <class... Parts>
  void fault(const Parts&... parts) {
    if (faults_.size() >= 20) return;
    std::ostringstream text;
    (text << ... << parts);
    faults_.push_back(text.str());
  }

  // Offsets begin at 0, ascend, and end at the size of what they index; every face has a loop.
  void check_shape() {
    const auto offsets = [this](const char* name, const std::vector<Index>& begin, std::size_t rows,
                                std::size_t items, Index least) {
      bool right = begin.size() == rows + 1 && begin.front() == 0 &&
                   begin.back() == static_cast<Index>(items);
      for (std::size_t i = 1; right && i < begin.size(); ++i)
        right = begin[i] - begin[i - 1] >= least;
      if (!right) fault(name, " is no array of offsets");
    };
    const std::size_t blocks = a_.volume.size(), faces = a_.face_normal.size();
    offsets("face_begin", a_.face_begin, blocks, faces, 4);
    offsets("vertex_begin", a_.vertex_begin, blocks, a_.vertex.size(), 4);
    offsets("loop_begin", a_.loop_begin, faces, a_.corner_begin.size() - 1, 1);
    offsets("corner_begin", a_.corner_begin, a_.corner_begin.size() - 1, a_.corner_vertex.size(),
            3);
    for (const std::size_t size :
         {a_.centroid.size(), a_.edge_count.size(), a_.shell_count.size(), a_.genus.size(),
          a_.convex.size(), a_.finite.size(), a_.material.size()})
      if (size != blocks) fault("an array of ", size, " rows for ", blocks, " blocks");
    for (const std::size_t size :
         {a_.face_area.size(), a_.face_origin.size(), a_.face_up.size(), a_.face_plane.size()})
      if (size != faces) fault("an array of ", size, " rows for ", faces, " faces");
  }

  // Twice the vector area of a face's loops; holes run the other way and subtract themselves.
  Vec3 vector_area(Index face) const {
    Vec3 area{};
    const Vec3& o = a_.vertex[a_.corner_vertex[a_.corner_begin[a_.loop_begin[face]]]];
    for (Index l = a_.loop_begin[face]; l < a_.loop_begin[face + 1]; ++l) area += loop_area(l, o);
    return area;
  }
  Vec3 loop_area(Index loop, const Vec3& o) const {
    Vec3 area{};
    each_edge(loop, [&](const Vec3& p, const Vec3& q) { area += cross(p - o, q - o); });
    return area;
  }
  template <class F>
  void each_edge(Index loop, const F& f) const {
    const Index begin = a_.corner_begin[loop], end = a_.corner_begin[loop + 1];
    for (Index c = begin; c < end; ++c)
      f(a_.vertex[a_.corner_vertex[c]], a_.vertex[a_.corner_vertex[c + 1 == end ? begin : c + 1]]);
  }

  void check_block(Index b) {
    const Index faces = a_.face_begin[b + 1] - a_.face_begin[b],
                vertices = a_.vertex_begin[b + 1] - a_.vertex_begin[b];
    const Index loops = a_.loop_begin[a_.face_begin[b + 1]] - a_.loop_begin[a_.face_begin[b]];
    const Index euler = vertices - a_.edge_count[b] + faces - (loops - faces);
    if (euler != 2 * (a_.shell_count[b] - a_.genus[b]))
      fault("block ", b, ": V ", vertices, " E ", a_.edge_count[b], " F ", faces, " holes ",
            loops - faces, " shells ", a_.shell_count[b], " genus ", a_.genus[b]);
    const Index corners = a_.corner_begin[a_.loop_begin[a_.face_begin[b + 1]]] -
                          a_.corner_begin[a_.loop_begin[a_.face_begin[b]]];
    if (corners != 2 * a_.edge_count[b])
      fault("block ", b, ": ", corners, " corners, ", a_.edge_count[b], " edges");

    // Divergence theorem, by the cones from a point o over each face's loops.
    const Vec3 o = a_.centroid[b];
    Real volume6 = 0, surface = 0;
    Vec3 first24{};
    for (Index f = a_.face_begin[b]; f < a_.face_begin[b + 1]; ++f) {
      check_face(b, f);
      surface += a_.face_area[f];
      for (Index l = a_.loop_begin[f]; l < a_.loop_begin[f + 1]; ++l) {
        const Vec3 apex = a_.vertex[a_.corner_vertex[a_.corner_begin[l]]] - o;
        each_edge(l, [&](const Vec3& p, const Vec3& q) {
          const Real v = dot(apex, cross(p - o, q - o));
          volume6 += v;
          first24 += v * (apex + (p - o) + (q - o));
        });
      }
    }
    const Real allowed = 1e-9 * size_ * surface;
    if (!(std::abs(volume6 / 6 - a_.volume[b]) <= allowed))
      fault("block ", b, ": volume ", a_.volume[b], ", its faces enclose ", volume6 / 6);
    if (!(norm((1.0 / 24) * first24) <= allowed * size_))
      fault("block ", b, ": the centroid is not the faces'");
  }

  void check_face(Index b, Index f) {
    const Vec3 area = vector_area(f);
    const Vec3& n = a_.face_normal[f];
    if (!(std::abs(norm(n) - 1) < 1e-14))
      fault("block ", b, " face ", f, ": normal of length ", norm(n));
    if (!(norm(0.5 * area - a_.face_area[f] * n) <= 1e-9 * size_ * size_))
      fault("block ", b, " face ", f, ": area ", a_.face_area[f], ", its loops enclose ",
            norm(area) / 2);
    for (Index l = a_.loop_begin[f]; l < a_.loop_begin[f + 1]; ++l) {
      const Vec3& first = a_.vertex[a_.corner_vertex[a_.corner_begin[l]]];
      const bool outer = l == a_.loop_begin[f];
      if ((dot(loop_area(l, first), n) > 0) != outer)
        fault("block ", b, " face ", f, " loop ", l, ": wrong sense");
      for (Index c = a_.corner_begin[l]; c < a_.corner_begin[l + 1]; ++c) {
        const Index v = a_.corner_vertex[c];
        if (v < a_.vertex_begin[b] || v >= a_.vertex_begin[b + 1])
          fault("block ", b, " face ", f, ": a vertex of another block");
        if (!(std::abs(dot(a_.vertex[v] - first, n)) <= 1e-9 * size_))
          fault("block ", b, " face ", f, ": not plane");
      }
    }
  }

  void check_interfaces() {
    std::vector<Real> shared(a_.face_normal.size(), 0);
    for (const auto& i : a_.interfaces) {
      if (!(i.block[0] < i.block[1]))
        fault("interface of blocks ", i.block[0], " and ", i.block[1]);
      if (!(i.area > 0)) fault("interface of area ", i.area);
      for (int s = 0; s < 2; ++s) {
        if (i.face[s] < a_.face_begin[i.block[s]] || i.face[s] >= a_.face_begin[i.block[s] + 1])
          fault("interface with a face of another block");
        shared[i.face[s]] += i.area;
      }
      const Index f = i.face[0], g = i.face[1];
      if (norm(a_.face_normal[f] + a_.face_normal[g]) != 0 ||
          a_.face_plane[f] != a_.face_plane[g] || a_.face_up[f] == a_.face_up[g])
        fault("interface of faces ", f, " and ", g, " that are not the two sides of one plane");
      if (a_.face_origin[f] != a_.face_origin[g]) fault("interface of faces of two origins");
    }
    for (std::size_t f = 0; f < shared.size(); ++f) {
      const bool joint = a_.origins[a_.face_origin[f]].kind == FaceOrigin::Kind::joint;
      if (!(std::abs(shared[f] - (joint ? a_.face_area[f] : 0)) <= 1e-9 * size_ * size_))
        fault("face ", f, " of ", a_.origins[a_.face_origin[f]].name, ": area ", a_.face_area[f],
              ", shared ", shared[f]);
    }
  }

  const BlockArrays& a_;
  const Real size_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> faults_of(const BlockArrays& blocks, Real size) {
  return Checker(blocks, size).run();
}

}  // namespace rockfold::test
