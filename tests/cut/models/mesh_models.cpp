#include "tests/cut/models/mesh_models.hpp"

#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "tests/cut/oracles/exact_volume.hpp"

namespace rockfold::test {

namespace {

constexpr Real pi = std::numbers::pi;
using Ring = std::vector<Vec3>;

struct Turn {
  Vec3 x, y, z;
  Vec3 operator()(const Vec3& p) const { return p[0] * x + p[1] * y + p[2] * z; }
};
Turn odd_turn(Draw& draw) {
  const Vec3 z = draw.direction(), x = draw.normal_to(z);
  return {x, cross(z, x), z};
}
// About the vertical, by whole degrees.
Turn turn_by_azimuth(Draw& draw) {
  const Real a = pi / 180 * draw.integer(1, 359);
  return {{std::cos(a), std::sin(a), 0}, {-std::sin(a), std::cos(a), 0}, {0, 0, 1}};
}

// Rings of equally many corners, counter-clockwise seen from ahead; fans about the ends' centres close it.
TriangleSurface swept(const std::vector<Ring>& rings, const Vec3& start, const Vec3& end) {
  TriangleSurface s;
  const auto n = static_cast<Index>(rings.front().size());
  for (const Ring& r : rings) s.vertices.insert(s.vertices.end(), r.begin(), r.end());
  const auto last = static_cast<Index>(rings.size() - 1) * n;
  s.vertices.push_back(start);
  s.vertices.push_back(end);
  for (Index k = 0; k < n; ++k) {
    const Index next = (k + 1) % n;
    for (Index r = 0; r < last; r += n) {
      s.triangles.push_back({r + k, r + next, r + n + next});
      s.triangles.push_back({r + k, r + n + next, r + n + k});
    }
    s.triangles.push_back({last + n, next, k});
    s.triangles.push_back({last + n + 1, last + k, last + next});
  }
  return s;
}

TriangleSurface tunnel(Draw& draw) {
  const int arch = draw.integer(4, 12), rings = draw.integer(1, 12);
  const Real radius = draw.uniform(3, 6), bend = draw.uniform(-6, 6);
  std::vector<Ring> all;
  const auto centre = [&](Real s) { return Vec3{-40 + 80 * s, bend * std::sin(pi * s), 0}; };
  for (int i = 0; i <= rings; ++i) {
    const Vec3 c = centre(static_cast<Real>(i) / rings);
    Ring ring;
    for (int k = 0; k <= arch; ++k)
      ring.push_back(c + radius * Vec3{0, std::cos(pi * k / arch), 0.2 + std::sin(pi * k / arch)});
    ring.push_back(c + radius * Vec3{0, -1, -0.8});
    ring.push_back(c + radius * Vec3{0, 1, -0.8});
    all.push_back(std::move(ring));
  }
  return swept(all, centre(0), centre(1));
}

TriangleSurface sphere(Draw& draw) {
  const int meridians = draw.integer(5, 12), parallels = draw.integer(2, 6);
  const Real radius = draw.uniform(8, 14);
  std::vector<Ring> rings;
  for (int i = 1; i <= parallels; ++i) {
    const Real latitude = pi * i / (parallels + 1);
    Ring ring;
    for (int k = 0; k < meridians; ++k) {
      const Real t = 2 * pi * k / meridians;
      ring.push_back(radius * Vec3{std::sin(latitude) * std::cos(t),
                                   std::sin(latitude) * std::sin(t), -std::cos(latitude)});
    }
    rings.push_back(std::move(ring));
  }
  return swept(rings, {0, 0, -radius}, {0, 0, radius});
}

// A star of any corners, which its centre sees whole.
TriangleSurface extrusion(Draw& draw) {
  const int corners = draw.integer(3, 9);
  Ring base, top;
  const Vec3 along{draw.uniform(-5, 5), draw.uniform(-5, 5), draw.uniform(10, 25)};
  for (int k = 0; k < corners; ++k) {
    const Real t = 2 * pi * (k + draw.uniform(0, 0.5)) / corners, r = draw.uniform(6, 15);
    base.push_back(r * Vec3{std::cos(t), std::sin(t), 0} - 0.5 * along);
    top.push_back(base.back() + along);
  }
  return swept({base, top}, -0.5 * along, 0.5 * along);
}

// Triangles between two layers of a grid of posts, and its four sides.
void close(TriangleSurface& s, int m, Index lower, Index upper) {
  const auto post = [m](int i, int j) { return static_cast<Index>(j * (m + 1) + i); };
  const auto quad = [&s](Index a, Index b, Index c, Index d) {
    s.triangles.push_back({a, b, c});
    s.triangles.push_back({a, c, d});
  };
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const std::array c{post(i, j), post(i + 1, j), post(i + 1, j + 1), post(i, j + 1)};
      quad(upper + c[0], upper + c[1], upper + c[2], upper + c[3]);
      s.triangles.push_back({lower + c[0], lower + c[2], lower + c[1]});
      s.triangles.push_back({lower + c[0], lower + c[3], lower + c[2]});
    }
  for (int i = 0; i < m; ++i) {
    const auto wall = [&](Index a, Index b) { quad(lower + a, lower + b, upper + b, upper + a); };
    wall(post(i, 0), post(i + 1, 0));
    wall(post(m, i), post(m, i + 1));
    wall(post(i + 1, m), post(i, m));
    wall(post(0, i + 1), post(0, i));
  }
}

std::vector<Vec3> layer(int m, const Turn& turn, int decimals,
                        const std::function<Real(int, int)>& z) {
  std::vector<Vec3> posts;
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i)
      posts.push_back(to_decimals(turn({30.0 * i / m - 15, 30.0 * j / m - 15, z(i, j)}), decimals));
  return posts;
}

std::shared_ptr<const TriangleSurface> between(int m, std::vector<Vec3> lower,
                                               const std::vector<Vec3>& upper) {
  auto s = std::make_shared<TriangleSurface>();
  const auto n = static_cast<Index>(lower.size());
  s->vertices = std::move(lower);
  s->vertices.insert(s->vertices.end(), upper.begin(), upper.end());
  close(*s, m, 0, n);
  return s;
}

}  // namespace

RoundedMesh rounded_mesh(Draw& draw) {
  const int form = draw.integer(0, 2);
  TriangleSurface s = form == 0 ? tunnel(draw) : form == 1 ? sphere(draw) : extrusion(draw);
  const Turn turn = form == 0 ? turn_by_azimuth(draw) : odd_turn(draw);
  const int decimals = s.vertices.size() < 12 ? draw.integer(0, 3) : draw.integer(1, 3);
  for (Vec3& x : s.vertices) x = to_decimals(turn(x), decimals);
  RoundedMesh mesh;
  mesh.kind = std::array{"tunnel", "sphere", "extrusion"}[form];
  mesh.volume = signed_volume(s);
  if (mesh.volume < 0) {
    for (auto& t : s.triangles) std::swap(t[1], t[2]);
    mesh.volume = -mesh.volume;
  }
  mesh.surface = std::make_shared<TriangleSurface>(std::move(s));
  return mesh;
}

Solid mesh_solid(std::string name, std::shared_ptr<const TriangleSurface> surface, bool add) {
  Solid solid = box_solid(std::move(name), {}, {}, add);
  MeshShape shape;
  shape.surface = std::move(surface);
  solid.shape = std::move(shape);
  solid.continues.assign(1, false);
  return solid;
}

void add_joint_sets(Model& model, Draw& draw) {
  for (int i = draw.integer(2, 3); i > 0; --i)
    add_set(model,
            DipOrientation{std::round(draw.uniform(0, 90)), std::round(draw.uniform(0, 359))},
            std::round(draw.uniform(6, 15)), to_decimals(draw.within(-5, 5), 1));
  if (!draw.chance(0.3)) return;
  for (int i = 0; i < 4; ++i) {
    add_joint(model, draw.direction(), draw.within(-15, 15));
    model.joints.back().radius = draw.uniform(3, 12);
  }
}

TwoBodies bodies_that_share_faces(Draw& draw, Real noise) {
  const int m = draw.integer(1, 5), decimals = draw.integer(1, 3);
  const Turn turn = odd_turn(draw);
  const bool flat = draw.chance(0.3);
  std::vector<Real> bump;
  for (int i = 0; i < (m + 1) * (m + 1); ++i) bump.push_back(flat ? 0 : draw.uniform(-3, 3));
  const auto bottom = layer(m, turn, decimals, [](int, int) { return -15; });
  const auto middle = layer(m, turn, decimals, [&](int i, int j) { return bump[j * (m + 1) + i]; });
  const auto top = layer(m, turn, decimals, [](int, int) { return 15; });
  std::vector<Vec3> moved = middle;
  if (noise > 0)
    for (Vec3& x : moved)
      for (Real& c : x) c += draw.uniform(-noise, noise);
  TwoBodies bodies;
  bodies.lower = between(m, bottom, middle);
  bodies.upper = between(m, moved, top);
  // The whole: three layers, whose middle one is inside.
  auto both = std::make_shared<TriangleSurface>();
  const auto n = static_cast<Index>(bottom.size());
  for (const auto* posts : {&bottom, &middle, &top})
    both->vertices.insert(both->vertices.end(), posts->begin(), posts->end());
  TriangleSurface halves;
  close(halves, m, 0, n);
  close(halves, m, n, 2 * n);
  for (const auto& t : halves.triangles)
    if (t[0] / n != 1 || t[1] / n != 1 || t[2] / n != 1) both->triangles.push_back(t);
  bodies.both = std::move(both);
  return bodies;
}

BumpySurface bumpy_surface(Draw& draw, Real edge, Real bumps) {
  const int m = draw.integer(1, 6);  // squares over the cube, and one more on each side
  const Real spacing = edge / m, height = to_decimals(edge * draw.uniform(0.3, 0.7), 2);
  auto surface = std::make_shared<TriangleSurface>();
  TriangleSurface inside;
  for (int j = -1; j <= m + 1; ++j)
    for (int i = -1; i <= m + 1; ++i)
      surface->vertices.push_back(
          {edge * i / m, edge * j / m, height + bumps * spacing * draw.uniform(-1, 1)});
  const Index row = m + 3;
  for (int j = 0; j < m + 2; ++j)
    for (int i = 0; i < m + 2; ++i) {
      const Index a = j * row + i, b = a + 1, c = a + row, d = c + 1;
      for (const auto& t : {std::array{a, b, d}, {a, d, c}}) {
        surface->triangles.push_back(t);
        if (i > 0 && j > 0 && i <= m && j <= m) inside.triangles.push_back(t);
      }
    }
  inside.vertices = surface->vertices;
  BumpySurface result;
  result.volume_below = volume_below(inside, 0);
  result.surface = std::move(surface);
  return result;
}

std::shared_ptr<TriangleSurface> planar_surface_in_floats(Draw& draw, Real edge) {
  const int m = draw.integer(1, 4);
  const Vec3 normal = draw.direction();
  const Vec3 u = normalized(cross(normal, draw.direction()));
  const Vec3 v = cross(normal, u);
  auto surface = std::make_shared<TriangleSurface>();
  for (int j = 0; j <= m; ++j)
    for (int i = 0; i <= m; ++i) {
      const Vec3 x = edge * ((4.0 * i / m - 2) * u + (4.0 * j / m - 2) * v);
      surface->vertices.push_back({Real(float(x[0])), Real(float(x[1])), Real(float(x[2]))});
    }
  for (Index j = 0; j < m; ++j)
    for (Index i = 0; i < m; ++i) {
      const Index a = j * (m + 1) + i, b = a + 1, c = a + m + 1, d = c + 1;
      surface->triangles.push_back({a, b, d});
      surface->triangles.push_back({a, d, c});
    }
  return surface;
}

}  // namespace rockfold::test
