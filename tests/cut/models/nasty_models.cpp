#include "tests/cut/models/nasty_models.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/cut/models/nasty_body.hpp"

namespace rockfold::test {

namespace {

constexpr Real pi = std::numbers::pi;
// Corners this far from where they were meant, over the model's size, must not matter: a fiftieth of rule 2's tolerance, since oblique maps
// magnify it.
constexpr Real harmless = 2e-12;

using Body = NastyBody;
/// Draws joints; the number of blocks that they make of a single body, if it is known.
using Kind = std::optional<Index> (*)(Body&);

struct NamedKind {
  const char* name;
  Kind add;
};

// ------------------------------------------------------------------------------------------------- through-going planes

std::optional<Index> near_coincident(Body& b) {
  const Vec3 n = b.draw.direction(), o = b.inner();
  for (int i = b.draw.integer(2, 5); i > 0; --i)
    b.plane(n + b.tiny() * b.draw.direction(), o + b.tiny() * n);
  return {};
}

std::optional<Index> near_one_point(Body& b) {
  const Vec3 o = b.inner();
  for (int i = b.draw.integer(4, 9); i > 0; --i)
    b.plane(b.draw.direction(), o + b.tiny() * b.draw.direction());
  return {};
}

std::optional<Index> near_one_line(Body& b) {
  const Vec3 axis = b.draw.direction(), o = b.inner();
  for (int i = b.draw.integer(3, 7); i > 0; --i)
    b.plane(b.draw.normal_to(axis) + b.tiny() * b.draw.direction(),
            o + b.draw.uniform(-1, 1) * axis + b.tiny() * b.draw.direction());
  return {};
}

std::optional<Index> tiny_dihedrals(Body& b) {
  const Vec3 n = b.draw.direction(), axis = b.draw.normal_to(n), o = b.inner();
  b.plane(n, o);
  for (int i = b.draw.integer(1, 3); i > 0; --i)
    b.plane(n + b.draw.sign() * b.draw.power(-12, -3) * cross(axis, n), o + b.tiny() * n);
  return {};
}

std::optional<Index> slabs(Body& b) {
  const Vec3 n = b.draw.chance(0.5) ? b.draw.direction() : Vec3{1, 0, 0};
  Vec3 o = b.draw.within(0.3, 0.5);
  for (int i = b.draw.integer(2, 5); i > 0; --i) {
    b.plane(n, o);
    o += b.draw.power(-12, -2) * n;
  }
  return {};
}

// Two slabs that cross; both may taper.
std::optional<Index> needles(Body& b) {
  const Vec3 axis = b.draw.direction(), o = b.inner();
  for (int i = 0; i < 2; ++i) {
    const Vec3 n = b.draw.normal_to(axis);
    b.plane(n, o);
    b.plane(n + b.tiny() * axis, o + b.draw.power(-12, -2) * n);
  }
  return {};
}

// Chips off the box' corners, edges and faces.
std::optional<Index> flakes(Body& b) {
  for (int i = b.draw.integer(1, 5); i > 0; --i) {
    Vec3 n{}, corner{};
    const int directions = b.draw.integer(1, 3);
    for (int d = 0; d < 3; ++d) {
      corner[d] = b.draw.integer(0, 1);
      n[d] = (corner[d] > 0 ? -1 : 1) * (d < directions ? b.draw.uniform(0.3, 1) : b.tiny());
    }
    b.plane(n, corner + b.draw.sign() * b.draw.power(-16, -4) * normalized(n));
  }
  return {};
}

std::optional<Index> lattice_planes(Body& b) {
  const auto small = [&](int low, int high) {
    return static_cast<Real>(b.draw.integer(low, high));
  };
  for (int i = b.draw.integer(3, 9); i > 0; --i) {
    Vec3 n{};
    while (norm(n) == 0) n = {small(-2, 2), small(-2, 2), small(-2, 2)};
    const Vec3 o{small(0, 2) / 2, small(0, 2) / 2, small(0, 2) / 2};
    b.plane(n + b.tiny() * b.draw.direction(), o + b.tiny() * b.draw.direction());
  }
  return {};
}

// Angles as people write them, through points that they share.
std::optional<Index> round_angles(Body& b) {
  const Vec3 o = b.draw.chance(0.5) ? Vec3{0.5, 0.5, 0.5} : b.inner();
  for (int i = b.draw.integer(3, 8); i > 0; --i) {
    const Real step = b.draw.pick({15.0, 30.0, 45.0});
    const Real dip = step * b.draw.integer(0, static_cast<int>(90 / step));
    const Real dip_direction = step * b.draw.integer(0, static_cast<int>(360 / step) - 1);
    b.dipping({dip, dip_direction}, b.draw.chance(0.7) ? o : o + b.tiny() * b.draw.direction());
  }
  return {};
}

// Four planes about a tetrahedron of 1e-12 … 1e-1.
std::optional<Index> small_tetrahedron(Body& b) {
  const Vec3 o = b.inner();
  const Real edge = b.draw.power(-12, -1);
  for (int i = 0; i < 4; ++i) {
    const Vec3 n = b.draw.direction();
    b.plane(n, o + edge * n);
  }
  return {};
}

// -------------------------------------------------------------------------------------------------------- finite joints

struct Frame2 {
  Vec3 o, u, v;
  Vec3 operator()(Real s, Real t) const { return o + s * u + t * v; }
};
Frame2 any_frame(Body& b) {
  const Vec3 n = b.draw.direction(), u = b.draw.normal_to(n);
  return {b.inner(), u, cross(n, u)};
}

/// Noise that must not matter, or any.
Real noise(Body& b, bool& matters) {
  matters = b.draw.chance(0.4);
  return matters              ? b.draw.power(-11, -6)
         : b.draw.chance(0.3) ? 0
                              : b.draw.power(-16, std::log10(harmless));
}

std::optional<Index> tiles(Body& b) {
  bool matters;
  const Real by = noise(b, matters);
  const Frame2 f = any_frame(b);
  const int m = b.draw.integer(1, 4);
  const auto at = [&](int i) { return -2 + 4.0 * i / m; };
  const bool triangles = b.draw.chance(0.5);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j) {
      const std::array c{f(at(i), at(j)), f(at(i + 1), at(j)), f(at(i + 1), at(j + 1)),
                         f(at(i), at(j + 1))};
      if (triangles) {
        b.polygon({b.off(c[0], by), b.off(c[1], by), b.off(c[2], by)});
        b.polygon({b.off(c[0], by), b.off(c[2], by), b.off(c[3], by)});
      } else {
        b.polygon({b.off(c[0], by), b.off(c[1], by), b.off(c[2], by), b.off(c[3], by)});
      }
    }
  if (matters) return {};
  return 2;
}

// A rectangle that starts on a plane, on it, short of it, or beyond it.
std::optional<Index> tees(Body& b) {
  const Frame2 f = any_frame(b);
  const Vec3 n = cross(f.u, f.v) + b.draw.uniform(-1, 1) * f.u;
  b.plane(cross(f.u, f.v), f.o);
  const Real miss = b.draw.chance(0.5) ? b.draw.sign() * b.draw.power(-16, std::log10(harmless))
                                       : b.draw.sign() * b.draw.power(-11, -6);
  b.polygon({f.o - 2 * f.v + miss * n, f.o + 2 * f.v + miss * n, f.o + 2 * f.v + 3 * n,
             f.o - 2 * f.v + 3 * n});
  if (std::abs(miss) > harmless) return {};
  return 3;
}

std::optional<Index> closed_box(Body& b) {
  bool matters;
  const Real by = noise(b, matters);
  const Frame2 f = any_frame(b);
  const std::array<Vec3, 3> edge{0.2 * f.u, b.draw.uniform(0.02, 0.2) * f.v,
                                 0.15 * cross(f.u, f.v)};
  for (int d = 0; d < 3; ++d)
    for (const Real side : {-0.5, 0.5}) {
      const Vec3 centre = f.o + side * edge[d], s = 0.5 * edge[(d + 1) % 3],
                 t = 0.5 * edge[(d + 2) % 3];
      b.polygon({b.off(centre - s - t, by), b.off(centre + s - t, by), b.off(centre + s + t, by),
                 b.off(centre - s + t, by)});
    }
  if (matters) return {};
  return 2;
}

// Rectangles that start on one line, a sector each.
std::optional<Index> fan(Body& b) {
  bool matters;
  const Real by = noise(b, matters);
  const Frame2 f = any_frame(b);
  const Vec3 axis = cross(f.u, f.v);
  const int blades = b.draw.integer(3, 7);
  for (int i = 0; i < blades; ++i) {
    const Real t = 2 * pi * (i + b.draw.uniform(0, 0.3)) / blades;
    const Vec3 out = 3 * std::cos(t) * f.u + 3 * std::sin(t) * f.v;
    b.polygon({b.off(f.o - 3 * axis, by), b.off(f.o + 3 * axis, by),
               b.off(f.o + 3 * axis + out, by), b.off(f.o - 3 * axis + out, by)});
  }
  if (matters) return {};
  return blades;
}

// Triangles of one corner, about the half of the space above a plane or all of it: sides shared to rounding.
std::optional<Index> cone(Body& b) {
  bool matters;
  const Real by = noise(b, matters);
  const Frame2 f = any_frame(b);
  const Vec3 up = cross(f.u, f.v);
  const int sides = b.draw.integer(3, 8);
  const Real slope = b.draw.chance(0.5) ? b.draw.uniform(0.2, 2) : b.draw.power(-10, -1);
  const auto corner = [&](int i) {
    const Real t = 2 * pi * i / sides;
    return f(3 * std::cos(t), 3 * std::sin(t)) + 3 * slope * up;
  };
  for (int i = 0; i < sides; ++i)
    b.polygon({b.off(f.o, by), b.off(corner(i), by), b.off(corner(i + 1), by)});
  if (matters || slope < 1e-2) return {};
  return 2;
}

// Rounding must leave their corners in order: it is 2e-16 near the origin and up to 1e-10 of the size at map coordinates.
std::optional<Index> slender_polygons(Body& b) {
  const Real least = b.far() ? 1e-7 : 1e-12;
  for (int i = b.draw.integer(2, 6); i > 0; --i) {
    const Frame2 f = any_frame(b);
    const Real length = b.draw.power(-4, 0);
    const Real width = std::max(least, length * b.draw.power(-8, 0));
    if (b.draw.chance(0.5))
      b.polygon({f(-length, -width), f(length, -width), f(length, width), f(-length, width)});
    else
      b.polygon({f(-length, 0), f(length, 0), f(length * b.draw.uniform(-1, 1), width)});
  }
  return {};
}

// Polygons of near-coincident planes that overlap in part.
std::optional<Index> overlapping_patches(Body& b) {
  const Frame2 f = any_frame(b);
  const Vec3 n = cross(f.u, f.v);
  for (int i = b.draw.integer(2, 6); i > 0; --i) {
    const Frame2 g{f(b.draw.uniform(-0.3, 0.3), b.draw.uniform(-0.3, 0.3)) + b.tiny() * n,
                   f.u + b.tiny() * n, f.v + b.tiny() * n};
    const Real s = b.draw.uniform(0.1, 1), t = b.draw.uniform(0.1, 1);
    b.polygon({g(-s, -t), g(s, -t), g(s, t), g(-s, t)});
  }
  return {};
}

// A network in which every third disc nearly lies on the one before.
std::optional<Index> discs(Body& b) {
  Vec3 n = b.draw.direction(), o = b.inner();
  for (int i = b.draw.integer(3, 10); i > 0; --i) {
    if (i % 3 == 0) {
      n += b.tiny() * b.draw.direction();
      o += b.draw.uniform(0, 0.2) * b.draw.normal_to(n) + b.tiny() * n;
    } else {
      n = b.draw.direction(), o = b.draw.within(0, 1);
    }
    b.disc(n, o, b.draw.power(-3, 0));
  }
  return {};
}

// Bricks whose courses and perpends meet to a hair.
std::optional<Index> bricks(Body& b) {
  const int courses = b.draw.integer(2, 3), perpends = b.draw.integer(1, 3);
  const auto z = [&](int i) { return static_cast<Real>(i) / courses; };
  for (int i = 1; i < courses; ++i) {
    const Real h = z(i) + b.tiny();
    b.polygon({{-0.2, -0.2, h + b.tiny()}, {1.2, -0.2, h}, {1.2, 1.2, h}, {-0.2, 1.2, h}});
  }
  for (int i = 0; i < courses; ++i)
    for (int j = 1; j <= perpends; ++j) {
      const Real x = (j - 0.5 * (i % 2)) / (perpends + 0.5) + b.tiny();
      const Real low = i == 0 ? -0.1 : z(i) + b.tiny(),
                 high = i + 1 == courses ? 1.1 : z(i + 1) + b.tiny();
      b.polygon({{x, -0.2, low}, {x + b.tiny(), 1.2, low}, {x, 1.2, high}, {x, -0.2, high}});
    }
  return {};
}

// Joints on the box' faces, but for a hair, and on its diagonals.
std::optional<Index> on_the_boundary(Body& b) {
  for (int i = b.draw.integer(1, 4); i > 0; --i) {
    const int d = b.draw.integer(0, 2);
    Vec3 o{}, u{}, v{};
    o[d] = b.draw.integer(0, 1) + b.tiny();
    u[(d + 1) % 3] = 1;
    v[(d + 2) % 3] = 1;
    if (b.draw.chance(0.5)) v[d] = b.tiny();
    const Real s = b.draw.pick({0.0, -0.25, 0.25}), t = b.draw.pick({1.0, 0.75, 1.25});
    const Frame2 f{o, u, v};
    b.polygon({f(s, s), f(t, s), f(t, t), f(s, t)});
  }
  return {};
}

constexpr std::array kinds{
    NamedKind{"near-coincident planes", near_coincident},
    NamedKind{"planes near one point", near_one_point},
    NamedKind{"planes near one line", near_one_line},
    NamedKind{"tiny dihedrals", tiny_dihedrals},
    NamedKind{"slabs", slabs},
    NamedKind{"needles", needles},
    NamedKind{"flakes", flakes},
    NamedKind{"lattice planes", lattice_planes},
    NamedKind{"round angles", round_angles},
    NamedKind{"small tetrahedron", small_tetrahedron},
    NamedKind{"tiles", tiles},
    NamedKind{"tees", tees},
    NamedKind{"closed box", closed_box},
    NamedKind{"fan", fan},
    NamedKind{"cone", cone},
    NamedKind{"slender polygons", slender_polygons},
    NamedKind{"overlapping patches", overlapping_patches},
    NamedKind{"discs", discs},
    NamedKind{"bricks", bricks},
    NamedKind{"on the boundary", on_the_boundary},
};

// A joint once more, exactly or to a hair, from either side.
void duplicate_one(NastyModel& m, Draw& draw) {
  Joint twin = m.model.joints[draw.integer(0, static_cast<int>(m.model.joints.size()) - 1)];
  twin.name += "'";
  if (draw.chance(0.5))
    if (auto* n = std::get_if<Vec3>(&twin.plane.orientation)) *n = -*n;
  if (draw.chance(0.5)) twin.plane.point += m.size * draw.power(-16, -9) * draw.direction();
  m.model.joints.push_back(twin);
}

}  // namespace

int nasty_kind_count() {
  return static_cast<int>(kinds.size());
}

NastyModel nasty_model_of_kind(int kind, unsigned seed) {
  NastyBody body(seed, true);
  const std::optional<Index> blocks = kinds[kind].add(body);
  const bool far = body.far();
  NastyModel m = body.take(kinds[kind].name);
  if (!far) m.blocks = blocks;
  return m;
}

NastyModel nasty_model(unsigned seed) {
  NastyBody body(seed, false);
  std::string name;
  for (int i = body.draw.integer(1, 3); i > 0; --i) {
    const NamedKind& kind = kinds[body.draw.integer(0, nasty_kind_count() - 1)];
    kind.add(body);
    name += (name.empty() ? "" : " + ") + std::string(kind.name);
  }
  NastyModel m = body.take(name);
  Draw draw(seed + 1);
  if (draw.chance(0.3)) duplicate_one(m, draw);
  return m;
}

}  // namespace rockfold::test
