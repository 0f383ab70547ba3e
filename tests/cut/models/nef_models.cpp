#include "tests/cut/models/nef_models.hpp"

#include <cmath>
#include <random>

#include "src/base/vector.hpp"

namespace rockfold::test {

Vec3 Frame::operator()(Real a, Real b) const {
  return origin + a * u + b * v;
}

void add_polygon(Model& model, const Frame& frame,
                 const std::vector<std::array<Real, 2>>& corners) {
  add_joint(model, cross(frame.u, frame.v), frame.origin);
  for (const auto& [a, b] : corners) model.joints.back().polygon.push_back(frame(a, b));
}

void add_corners(Model& model, const std::vector<Vec3>& corners) {
  add_joint(model, cross(corners[1] - corners[0], corners[2] - corners[0]), corners[0]);
  model.joints.back().polygon = corners;
}

namespace {

using Outline = std::vector<std::array<Real, 2>>;

const Outline octagon{{2, 1}, {1, 2}, {-1, 2}, {-2, 1}, {-2, -1}, {-1, -2}, {1, -2}, {2, -1}};
const Outline ell{{-2, -2}, {2, -2}, {2, 0}, {0, 0}, {0, 2}, {-2, 2}};
const Outline arrow{{-2, -2}, {2, 0}, {-2, 2}, {-1, 0}};
const Outline cee{{-2, -2}, {2, -2}, {2, -1}, {-1, -1}, {-1, 1}, {2, 1}, {2, 2}, {-2, 2}};
const Outline square{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};

class RandomModel {
 public:
  explicit RandomModel(unsigned seed) : random_(seed) {}

  Model draw() {
    model_ = box_model({0, 0, 0}, {16, 16, 16});
    if (small(0, 3) == 0) add_solid();
    const int joints = small(2, 8);
    while (static_cast<int>(model_.joints.size()) < joints) {
      add_one();
      leave_out_coplanar_joints();
    }
    return std::move(model_);
  }

 private:
  int small(int low, int high) { return low + static_cast<int>(random_() % (high - low + 1)); }
  Vec3 any(int low, int high) {
    Vec3 v;
    for (Real& c : v) c = small(low, high);
    return v;
  }
  Frame frame(int reach) {
    Frame f;
    do f = {any(2, 14), any(-reach, reach), any(-reach, reach)};
    while (norm(cross(f.u, f.v)) < 0.5 * reach * reach);
    return f;
  }

  // At odd halves, where no corner of a joint and no face of the box is: no coplanar faces of two origins.
  void add_solid() {
    const auto half = [this](int low, int high) { return small(low, high) + 0.5; };
    Solid solid = box_solid("second", {}, {}, small(0, 2) == 0);
    const Vec3 low{half(-3, 6), half(-3, 6), half(-3, 6)};
    switch (small(0, 2)) {
      case 0:
        solid.shape = BoxShape{low, low + any(4, 14)};
        break;
      case 1:
        solid.shape =
            PrismShape{{low, low + Vec3{9, 1, 0}, low + Vec3{4, 4, 0}, low + Vec3{2, 11, 0}},
                       {1.0 * small(-3, 3), 1.0 * small(-3, 3), 9.0 + small(0, 9)}};
        break;
      default:
        solid.shape = convex_solid("", {{{-1, 0, 0.25}, low},
                                        {{0, -1, 0.5}, low},
                                        {{0.25, 0, -1}, low},
                                        {{1, 2, 3}, low + any(2, 6)}})
                          .shape;
    }
    solid.continues.assign(face_names(solid.shape).size(), false);
    model_.solids.push_back(solid);
  }

  // The oracle takes coplanar joints for one origin. Integers: exact.
  void leave_out_coplanar_joints() {
    std::vector<Joint>& joints = model_.joints;
    for (std::size_t i = 1; i < joints.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const Vec3 &m = std::get<Vec3>(joints[i].plane.orientation),
                   &n = std::get<Vec3>(joints[j].plane.orientation);
        if (cross(m, n) != Vec3{} || dot(n, joints[i].plane.point - joints[j].plane.point) != 0)
          continue;
        joints.erase(joints.begin() + static_cast<std::ptrdiff_t>(i--));
        break;
      }
  }

  void add_one() {
    switch (small(0, 9)) {
      case 0:
        return add_corners(model_, triangle());
      case 1:
        return add_polygon(model_, frame(3), octagon);
      case 2:
      case 3:
        return add_polygon(model_, frame(7), octagon);
      case 4:
        return add_polygon(model_, frame(5), small(0, 1) ? ell : small(0, 1) ? arrow : cee);
      case 5:
        return add_polygon(model_, frame(3), {});
      case 6:
      case 7:
        return add_ending();
      case 8:
        return add_tetrahedron();
      default:
        return add_fan();
    }
  }

  std::vector<Vec3> triangle() {
    std::vector<Vec3> t;
    do t = {any(-6, 22), any(-6, 22), any(-6, 22)};
    while (norm(cross(t[1] - t[0], t[2] - t[0])) < 20);
    return t;
  }

  // A large polygon one of whose edges lies on another joint's plane.
  void add_ending() {
    if (model_.joints.empty()) return add_polygon(model_, frame(7), octagon);
    const Joint& other = model_.joints[random_() % model_.joints.size()];
    const Vec3 n = std::get<Vec3>(other.plane.orientation);
    // In the other's plane, of integers: n × any.
    Vec3 along, out;
    do {
      along = cross(n, any(-1, 1));
      out = any(-3, 3);
    } while (norm(along) == 0 || std::abs(dot(n, out)) < 0.3 * norm(n) * norm(out) ||
             norm(cross(along, out)) == 0);
    const Real reach = std::max(1.0, std::ceil(24 / norm(along)));
    const Real far = std::ceil(small(6, 30) / norm(out));
    add_polygon(model_, {other.plane.point, along, out},
                {{-reach, 0}, {reach, 0}, {reach, far}, {-reach, far}});
  }

  // Four triangles that close a block, whole or enlarged about their corners' mean, which overshoot.
  void add_tetrahedron() {
    std::array<Vec3, 4> t;
    do t = {any(1, 15), any(1, 15), any(1, 15), any(1, 15)};
    while (std::abs(dot(t[1] - t[0], cross(t[2] - t[0], t[3] - t[0]))) < 150);
    const bool overshoot = small(0, 1) == 0;
    for (int skip = 0; skip < 4; ++skip) {
      std::vector<Vec3> face;
      for (int i = 0; i < 4; ++i)
        if (i != skip) face.push_back(t[i]);
      if (overshoot) {
        // Three times as large, by integers.
        const Vec3 sum = face[0] + face[1] + face[2];
        for (Vec3& p : face) p = 4.0 * p - sum;
      }
      add_corners(model_, face);
    }
  }

  // Rectangles through one line.
  void add_fan() {
    const Vec3 origin = any(4, 12);
    Vec3 axis;
    do axis = any(-3, 3);
    while (norm(axis) == 0);
    const int sheets = small(2, 4);
    for (int i = 0; i < sheets; ++i) {
      Vec3 out;
      do out = any(-4, 4);
      while (norm(cross(axis, out)) < 0.3 * norm(axis) * norm(out) || norm(out) == 0);
      const Real reach = small(2, 9), from = small(-5, 0);
      add_polygon(model_, {origin, axis, out},
                  {{-reach, from}, {reach, from}, {reach, 6}, {-reach, 6}});
    }
  }

  std::mt19937 random_;
  Model model_;
};

// ---- by hand

const Model cube = box_model({0, 0, 0}, {16, 16, 16});

void add_box_sides(Model& m, const Vec3& low, const Vec3& high, int leave_out = -1) {
  for (int side = 0; side < 6; ++side) {
    if (side == leave_out) continue;
    const int d = side / 2, u = (d + 1) % 3, v = (d + 2) % 3;
    Vec3 corner = low;
    corner[d] = side % 2 ? high[d] : low[d];
    std::vector<Vec3> corners(4, corner);
    corners[1][u] = corners[2][u] = high[u];
    corners[2][v] = corners[3][v] = high[v];
    add_corners(m, corners);
  }
}

Model annulus() {
  Model m = cube;  // oblique, of two concave halves
  const Frame f{{8, 8, 8}, {2, 1, 0}, {0, 1, 2}};
  add_polygon(m, f, {{-2, 0}, {-2, -2}, {2, -2}, {2, 0}, {1, 0}, {1, -1}, {-1, -1}, {-1, 0}});
  add_polygon(m, f, {{-2, 0}, {-1, 0}, {-1, 1}, {1, 1}, {1, 0}, {2, 0}, {2, 2}, {-2, 2}});
  return m;
}

// A joint across the rock with a hole, made of four rectangles, and a tube behind the hole: a plug with a ring about it.
Model plugged_hole() {
  Model m = cube;
  const Frame f{{8, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  add_polygon(m, f, {{0, 0}, {16, 0}, {16, 4}, {0, 4}});
  add_polygon(m, f, {{0, 12}, {16, 12}, {16, 16}, {0, 16}});
  add_polygon(m, f, {{0, 4}, {4, 4}, {4, 12}, {0, 12}});
  add_polygon(m, f, {{12, 4}, {16, 4}, {16, 12}, {12, 12}});
  add_box_sides(m, {8, 4, 4}, {12, 12, 12}, 0);  // open towards x = 8
  return m;
}

Model touching_at_a_corner() {
  Model m = cube;
  add_polygon(m, {{8, 8, 8}, {0, 1, 0}, {4, 0, 4}}, square);
  add_corners(m, {{16, 8, 8}, {12, 6, 11}, {12, 10, 4}});  // a corner on a face
  add_corners(m, {{0, 0, 8}, {3, 4, 5}, {5, 3, 11}});      // on an edge
  add_corners(m, {{0, 16, 0},
                  {4, 13, 3},
                  {3, 11, 5},
                  {1, 14, 3}});  // at a corner; the plane passes through it
  m.joints.back().polygon.pop_back();
  return m;
}

Model meeting_along_a_line() {
  Model m = cube;
  for (const Vec3& out : {Vec3{1, 0, 0}, {-1, 2, 0}, {-1, -2, 0}})
    add_polygon(m, {{8, 8, 0}, {0, 0, 1}, out}, {{0, 0}, {16, 0}, {16, 20}, {0, 20}});
  return m;
}

Model tee_of_oblique_joints(Real from) {
  Model m = cube;
  add_polygon(m, {{8, 8, 8}, {1, 2, 0}, {0, 1, 3}}, {});
  add_polygon(m, {{8, 8, 8}, {1, 3, 3}, {3, -1, 0}}, {{-9, from}, {9, from}, {9, 9}, {-9, 9}});
  return m;
}

Model ell_of_oblique_joints() {
  Model m = cube;
  const Vec3 common{1, 1, 8};
  add_polygon(m, {{8, 8, 8}, common, {3, 1, 0}}, {{-9, 0}, {9, 0}, {9, 9}, {-9, 9}});
  add_polygon(m, {{8, 8, 8}, common, {-1, 3, 1}}, {{-9, 0}, {9, 0}, {9, 9}, {-9, 9}});
  return m;
}

// A triangular tube through the rock: core and ring.
Model ring() {
  Model m = cube;
  const std::array<Vec3, 3> corner{{{4, 4, 8}, {12, 5, 8}, {7, 12, 8}}};
  const Vec3 axis{1, 1, 16};
  for (int i = 0; i < 3; ++i)
    add_polygon(m, {corner[i], axis, corner[(i + 1) % 3] - corner[i]},
                {{-1, 0}, {1, 0}, {1, 1}, {-1, 1}});
  return m;
}

// A box closed by six joints, in it another.
Model box_in_box() {
  Model m = cube;
  add_box_sides(m, {2, 3, 4}, {14, 13, 12});
  add_box_sides(m, {5, 6, 7}, {9, 9, 9});
  return m;
}

// A rock in the cavity of another, touching nothing; a joint across both.
Model block_in_a_cavity() {
  Model m = cube;
  m.solids.push_back(box_solid("cavity", {3, 3, 3}, {13, 13, 13}, false));
  m.solids.push_back(box_solid("inner", {5, 5, 5}, {11, 11, 11}));
  add_polygon(m, {{8, 8, 8}, {1, 2, 0}, {0, 1, 3}}, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}});
  return m;
}

Model coplanar_overlap() {
  Model m = cube;
  const Frame f{{8, 8, 8}, {2, 1, 0}, {0, 1, 2}};
  add_polygon(m, f, {{-9, -9}, {1, -9}, {1, 9}, {-9, 9}});
  add_polygon(m, f, {{-1, -9}, {9, -9}, {9, 9}, {-1, 9}});
  return m;
}

Model concave(const Outline& outline, Real size) {
  Model m = cube;
  const Frame f{{8, 8, 8}, {2, 1, 0}, {0, 1, 2}};
  Outline scaled = outline;
  for (auto& [a, b] : scaled) a *= size, b *= size;
  add_polygon(m, f, scaled);
  add_polygon(m, {{8, 8, 8}, {1, -2, 1}, {1, 0, -3}}, {});
  return m;
}

// On the boundary of the rock: cuts nothing, alone and where other joints end on it.
Model on_the_boundary() {
  Model m = cube;
  add_corners(m, {{0, 4, 4}, {0, 12, 4}, {0, 12, 12}, {0, 4, 12}});
  add_corners(m, {{-4, 0, -4}, {20, 0, -4}, {20, 0, 20}, {-4, 0, 20}});
  add_corners(m, {{0, 4, 4}, {0, 12, 4}, {7, 12, 6}, {7, 4, 6}});
  return m;
}

Model partly_outside() {
  Model m = cube;
  add_polygon(m, {{0, 8, 8}, {3, 1, 0}, {0, 1, 3}}, octagon);  // half of it, a dead end
  add_polygon(m, {{14, 14, 14}, {1, -1, 0}, {1, 1, -2}},
              {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}});              // cuts the corner off
  add_polygon(m, {{20, 20, 20}, {1, 0, 0}, {0, 1, 0}}, octagon);  // all of it
  return m;
}

Model through_an_edge() {
  Model m = cube;
  // Holds the box' edge x = y = 0 and ends half-way to the other; then the rest of that plane.
  add_polygon(m, {{0, 0, 0}, {0, 0, 1}, {1, 1, 0}}, {{0, 0}, {16, 0}, {16, 8}, {0, 8}});
  add_polygon(m, {{16, 0, 0}, {0, 0, 1}, {-1, 1, 0}}, {{0, 0}, {16, 0}, {16, 16}, {0, 16}});
  return m;
}

// A joint across the arms of a U, one of which it misses.
Model across_a_u() {
  Model m = cube;
  m.solids.push_back(box_solid("slot", {4.5, -1, 4.5}, {11.5, 17, 17}, false));
  add_corners(m, {{-1, -1, 10}, {8, -1, 10}, {8, 17, 10}, {-1, 17, 10}});
  add_corners(m, {{9, -1, 12}, {14, -1, 12}, {14, 17, 12}, {9, 17, 12}});
  return m;
}

// Dead ends that cross each other on a block's face, and cross its edges.
Model dead_ends_on_faces() {
  Model m = cube;
  add_polygon(m, {{8, 8, 8}, {1, 0, 0}, {0, 1, 0}}, {});
  add_polygon(m, {{8, 8, 8}, {1, 1, 0}, {0, 1, 4}}, {{-3, -1}, {3, -1}, {3, 1}, {-3, 1}});
  add_polygon(m, {{8, 8, 8}, {1, -1, 0}, {1, 0, 4}}, {{-3, -1}, {3, -1}, {3, 1}, {-3, 1}});
  add_polygon(m, {{16, 8, 8}, {0, 2, 0}, {2, 0, 1}}, {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}});
  return m;
}

// Two tetrahedra of joints that share a corner, and two that share an edge.
Model touching_tetrahedra() {
  Model m = cube;
  const auto tetrahedron = [&](const std::array<Vec3, 4>& t) {
    for (int skip = 0; skip < 4; ++skip) {
      std::vector<Vec3> face;
      for (int i = 0; i < 4; ++i)
        if (i != skip) face.push_back(t[i]);
      add_corners(m, face);
    }
  };
  tetrahedron({{{4, 4, 4}, {8, 5, 4}, {5, 8, 4}, {5, 5, 7}}});
  tetrahedron({{{5, 5, 7}, {8, 6, 10}, {4, 9, 11}, {2, 4, 10}}});  // a corner
  tetrahedron({{{8, 5, 4}, {5, 8, 4}, {10, 10, 3}, {9, 9, 8}}});   // an edge
  return m;
}

// A concave solid and a concave base: prisms of an L and of a star.
Model concave_solid() {
  Model m;
  Solid s;
  s.name = "star";
  s.shape = PrismShape{{{0, 0, 0},
                        {6, 4, 0},
                        {14, 0, 0},
                        {10, 7, 0},
                        {14, 14, 0},
                        {7, 10, 0},
                        {0, 14, 0},
                        {4, 7, 0}},
                       {1, 2, 12}};
  s.continues.assign(10, false);
  m.solids.push_back(s);
  add_polygon(m, {{7, 7, 6}, {1, 0, 0}, {0, 1, 1}}, {{-9, -9}, {0, -9}, {0, 9}, {-9, 9}});
  add_polygon(m, {{7, 7, 6}, {0, 0, 1}, {1, 3, 0}}, {{-9, -9}, {9, -9}, {9, 9}, {-9, 9}});
  return m;
}

}  // namespace

Model random_finite_joints(unsigned seed) {
  return RandomModel(seed).draw();
}

Model random_discs(unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<Real> gauss;
  std::uniform_real_distribution<Real> unit;
  const auto any = [&] { return Vec3{gauss(random), gauss(random), gauss(random)}; };
  Model model = box_model({0, 0, 0}, {16, 16, 16});
  const auto joints = 2 + random() % 7;
  for (unsigned j = 0; j < joints; ++j) {
    const Vec3 normal = normalized(any()), u = normalized(cross(any(), normal));
    const Frame frame{
        {16 * unit(random), 16 * unit(random), 16 * unit(random)}, u, cross(normal, u)};
    const Real radius = 4 + 12 * unit(random);
    const auto sides = 5 + random() % 12;
    add_joint(model, normal, frame.origin);
    for (unsigned i = 0; i < sides; ++i) {
      const Real t = 2 * 3.14159265358979323846 * i / static_cast<Real>(sides);
      model.joints.back().polygon.push_back(frame(radius * std::cos(t), radius * std::sin(t)));
    }
  }
  return model;
}

std::ostream& operator<<(std::ostream& out, const NamedModel& m) {
  return out << m.name;
}

const std::vector<NamedModel>& nasty_models() {
  static const std::vector<NamedModel> models{
      {"Annulus", annulus(), false},
      {"PluggedHole", plugged_hole(), false},
      {"TouchingAtACorner", touching_at_a_corner()},
      {"MeetingAlongALine", meeting_along_a_line()},
      {"Tee", tee_of_oblique_joints(0)},
      {"TeeThatOvershoots", tee_of_oblique_joints(-1)},
      {"TeeThatUndershoots", tee_of_oblique_joints(1)},
      {"Ell", ell_of_oblique_joints()},
      {"Ring", ring()},
      {"BoxInABox", box_in_box()},
      {"BlockInACavity", block_in_a_cavity()},
      {"CoplanarOverlap", coplanar_overlap(), false},
      {"ConcaveL", concave(ell, 3)},
      {"ConcaveArrow", concave(arrow, 5)},
      {"ConcaveC", concave(cee, 3)},
      {"ConcaveCAcrossTheRock", concave(cee, 8)},
      {"OnTheBoundary", on_the_boundary()},
      {"PartlyOutside", partly_outside()},
      {"ThroughAnEdge", through_an_edge()},
      {"AcrossAU", across_a_u()},
      {"DeadEndsOnFaces", dead_ends_on_faces()},
      {"TouchingTetrahedra", touching_tetrahedra()},
      {"ConcaveSolid", concave_solid()},
  };
  return models;
}

}  // namespace rockfold::test
