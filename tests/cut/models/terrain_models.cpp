#include "tests/cut/models/terrain_models.hpp"

#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "tests/cut/models/draw.hpp"
#include "tests/cut/oracles/exact_volume.hpp"

namespace rockfold::test {

namespace {

class Ground {
 public:
  Ground(Draw& draw, int most_posts) : draw_(draw) {
    posts_ =
        draw.chance(0.7) ? draw.integer(6, std::min(20, most_posts)) : draw.integer(6, most_posts);
    rows_ = std::max(6, posts_ - draw.integer(0, 5));
    cell_ = draw.pick({0.3, 1.0, 2.0, 5.0, 30.0});
    far_ = draw.chance(0.5);
    decimals_ = draw.integer(-1, 3);
    if (decimals_ == 0 && cell_ < 1) decimals_ = 2;  // else all steps
    origin_ = far_ ? Vec3{5e5 + draw.integer(0, 999), 4e6 + 0.5 * draw.integer(0, 999), 0}
                   : Vec3{draw.pick({0.0, 100.0, -12.3}), 0, 0};
    lay_out();
  }

  TriangleSurface surface() const {
    TriangleSurface s;
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < posts_; ++i) s.vertices.push_back(post(i, j));
    for (int j = 0; j + 1 < rows_; ++j)
      for (int i = 0; i + 1 < posts_; ++i) {
        const Index a = j * posts_ + i, b = a + 1, c = a + posts_, d = c + 1;
        const auto length = [&](Index p, Index q) { return norm(s.vertices[p] - s.vertices[q]); };
        if (length(a, d) <= length(b, c)) {
          s.triangles.push_back({a, b, d});
          s.triangles.push_back({a, d, c});
        } else {
          s.triangles.push_back({a, b, c});
          s.triangles.push_back({b, d, c});
        }
      }
    return s;
  }

  Vec3 low() const { return {origin_[0], origin_[1], base_}; }
  Vec3 extent() const { return {cell_ * (posts_ - 1), cell_ * (rows_ - 1), mean_ - base_}; }
  Real base() const { return base_; }
  Real cell() const { return cell_; }
  std::string kind() const {
    return name_ + ", " + (decimals_ < 0 ? "all" : std::to_string(decimals_)) + " decimals, " +
           (far_ ? "map" : "local") + ", " + std::to_string(posts_) + " x " +
           std::to_string(rows_) + " posts, cell " + std::to_string(cell_);
  }

 private:
  void lay_out() {
    const Real wave = cell_ * draw_.uniform(3, 12), height = cell_ * draw_.uniform(0.2, 2);
    const Real east = draw_.uniform(-0.3, 0.3), north = draw_.uniform(-0.3, 0.3);
    const Real step = draw_.pick({1.0, 0.5, 0.25}) * cell_;
    mean_ = std::round(cell_ * draw_.uniform(8, 20)) + 3;
    base_ = -std::round(0.5 * cell_ * posts_) - (far_ ? 0 : 0.5);
    const auto smooth = [=](Real x, Real y) {
      return height * std::sin(x / wave) * std::cos(0.7 * y / wave + 0.3);
    };
    const auto slope = [=](Real x, Real y) { return east * x + north * y; };
    const int form = draw_.integer(0, 5);
    name_ = std::array{"flat", "smooth", "rough", "terraces", "planar in parts", "roof"}[form];
    elevation_.assign(static_cast<std::size_t>(posts_) * static_cast<std::size_t>(rows_), 0);
    for (int j = 0; j < rows_; ++j)
      for (int i = 0; i < posts_; ++i) {
        const Real x = cell_ * i, y = cell_ * j;
        Real z = 0;
        switch (form) {
          case 0:
            z = 0;
            break;
          case 1:
            z = smooth(x, y);
            break;
          case 2:
            z = smooth(x, y) + height * draw_.uniform(-0.5, 0.5);
            break;
          case 3:
            z = step * std::floor((smooth(x, y) + slope(x, y)) / step);
            break;
          case 4:
            z = std::max(slope(x, y), smooth(x, y));
            break;
          default:
            z = std::min(slope(x, y), slope(y, -x));
            break;
        }
        elevation_[j * posts_ + i] = mean_ + z;
      }
    const Real lowest = *std::min_element(elevation_.begin(), elevation_.end());
    base_ = std::min(base_, std::floor(lowest - cell_) - 1);
    if (decimals_ >= 0)
      for (Real& z : elevation_) z = to_decimals(z, decimals_);
  }
  // Of a decimal cell size: so as a file's reader computes it.
  Vec3 post(int i, int j) const {
    return {origin_[0] + cell_ * i, origin_[1] + cell_ * j, elevation_[j * posts_ + i]};
  }

  Draw& draw_;
  int posts_ = 0, rows_ = 0, decimals_ = 0;
  bool far_ = false;
  Real cell_ = 1, mean_ = 0, base_ = 0;
  Vec3 origin_{};
  std::string name_;
  std::vector<Real> elevation_;
};

Vec3 at(const Ground& g, const Vec3& share) {
  Vec3 x = g.low();
  for (int d = 0; d < 3; ++d) x[d] += share[d] * g.extent()[d];
  return x;
}

void add_joints(Model& model, const Ground& g, Draw& draw) {
  const Real reach = std::min(g.extent()[0], g.extent()[1]);
  for (int i = draw.integer(0, 4); i > 0; --i) {
    const DipOrientation dip{std::round(draw.uniform(0, 90)), std::round(draw.uniform(0, 359))};
    Vec3 o = at(g, draw.within(0.2, 0.9));
    if (draw.chance(0.5)) o = to_decimals(o, 1);
    switch (draw.integer(0, 3)) {
      case 0:
        add_joint(model, dip, o);
        model.joints.back().radius = reach * draw.uniform(0.1, 0.7);
        break;
      case 1: {
        const Vec3 n = draw.direction(), u = reach * draw.uniform(0.1, 0.8) * draw.normal_to(n),
                   v = draw.uniform(0.3, 2) * cross(n, u);
        add_joint(model, n, o);
        model.joints.back().polygon = {o - u - v, o + u - v, o + 0.5 * u, o + u + v, o - u + v};
        break;
      }
      default:
        add_joint(model, dip, o);
    }
  }
}

void add_disc_network(Model& model, const Ground& g, Draw& draw) {
  const Real reach = std::min(g.extent()[0], g.extent()[1]);
  for (int i = draw.integer(5, 20); i > 0; --i) {
    add_joint(model, draw.direction(), at(g, draw.within(0, 1)));
    model.joints.back().radius = reach * draw.uniform(0.05, 0.25);
  }
}

// Through the hill from side to side, and from above the ground down.
Shape opening(const Ground& g, Draw& draw, bool shaft) {
  const Real radius = 0.8 * g.cell();
  if (shaft) {
    const Vec3 foot = at(g, {draw.uniform(0.3, 0.7), draw.uniform(0.3, 0.7), 0.4});
    CylinderShape cylinder;
    cylinder.axis = {foot, foot + Vec3{0, 0, 3 * g.extent()[2]}};
    cylinder.radius = radius;
    cylinder.sides = draw.integer(6, 16);
    return cylinder;
  }
  TunnelShape tunnel;
  const Real y = draw.uniform(0.3, 0.7);
  tunnel.path = {at(g, {-0.2, y, 0.5}), at(g, {0.5, 1 - y, 0.45}), at(g, {1.2, y, 0.55})};
  for (const auto& [a, b] :
       {std::pair{-1.0, -0.7}, {1, -0.7}, {1, 0.4}, {0.6, 0.9}, {-0.6, 0.9}, {-1, 0.4}})
    tunnel.section.push_back({radius * a, radius * b});
  return tunnel;
}

void add_opening(TerrainModel& m, const Ground& g, Draw& draw, bool shaft) {
  const Shape shape = opening(g, draw, shaft);
  if (draw.chance(0.5)) {
    Excavation excavation;
    excavation.name = shaft ? "shaft" : "tunnel";
    excavation.stage = shaft ? 2 : 1;
    excavation.shape = shape;
    m.model.excavations.push_back(std::move(excavation));
  } else {
    Solid solid;
    solid.name = shaft ? "shaft" : "tunnel";
    solid.add = false;
    solid.continues.assign(face_names(shape).size(), false);
    solid.shape = shape;
    m.model.solids.push_back(std::move(solid));
    m.subtracted = true;
  }
}

}  // namespace

TerrainModel terrain_model(unsigned seed, int most_posts) {
  Draw draw(seed);
  const Ground ground(draw, most_posts);
  TerrainModel m;
  m.kind = ground.kind();
  m.size = norm(ground.extent());
  TerrainShape shape;
  shape.base = ground.base();
  shape.ground = std::make_shared<TriangleSurface>(ground.surface());
  m.ground_volume = volume_below(*shape.ground, shape.base);
  Solid rock;
  rock.name = "rock";
  rock.shape = shape;
  rock.continues.assign(6, false);
  m.model.solids.push_back(std::move(rock));
  add_joints(m.model, ground, draw);
  if (draw.chance(0.2)) add_disc_network(m.model, ground, draw);
  for (const bool shaft : {false, true})
    if (draw.chance(0.2)) add_opening(m, ground, draw, shaft);
  return m;
}

Model jittered(const Model& model, Real by, unsigned seed) {
  Model moved = model;
  auto& terrain = std::get<TerrainShape>(moved.solids.front().shape);
  auto ground = std::make_shared<TriangleSurface>(*terrain.ground);
  Draw draw(seed);
  for (Vec3& x : ground->vertices) x[2] += draw.uniform(-by, by);
  terrain.ground = std::move(ground);
  return moved;
}

}  // namespace rockfold::test
