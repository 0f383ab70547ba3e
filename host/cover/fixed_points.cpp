// Essential boundary conditions as points of the material (thesis 2.3.3): a face's polygons are split over the elements
// and held at their corners, which holds the linear displacement of an element exactly.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "host/cover/cover.hpp"
#include "host/cover/surface_split.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real augmented_factor = 10;  // of E/h: the multipliers do the rest (DESIGN.md, "Solve")
constexpr Real penalty_factor =
    1000;  // of E/h: displacement off by about 1e-3 of the element's own

class Fixer {
 public:
  Fixer(const Cutting& cutting, const Covering& covering, const Model& model)
      : complex_(*cutting.complex),
        covering_(covering),
        model_(model),
        locator_(covering),
        spacing_(std::cbrt(
            dot(covering.arrays.lattice.edge[0],
                cross(covering.arrays.lattice.edge[1], covering.arrays.lattice.edge[2])))) {}

  FixedPoints run() {
    for (const Fixed& f : model_.fixed) {
      const std::size_t before = result_.points.size();
      fixed_ = &f;
      std::visit([this](const auto& region) { add(region); }, f.where);
      if (result_.points.size() == before)
        refuse(static_cast<std::size_t>(&f - model_.fixed.data()));
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse(std::size_t i) const {
    throw Error(ErrorKind::model, "holds nothing: no rock lies there",
                Place{model_.fixed[i].place.file, model_.fixed[i].place.line,
                      model_.fixed[i].place.column, fmt::format("fixed[{}].where", i + 1)});
  }

  Real young_modulus(Index rock) const {
    return model_.materials[model_.solids[complex_.zone(rock).solid].material].young_modulus;
  }

  // `area` is the point's share, m².
  void add_point(const Vec3& x, const Holder& holder, Real area) {
    locator_.add(x, holder, result_.points);
    std::array<std::uint8_t, 3> component{};
    for (int d = 0; d < 3; ++d) component[d] = fixed_->components[d];
    const bool augmented = fixed_->method == FixMethod::augmented_lagrangian;
    result_.component.push_back(component);
    result_.value.push_back(fixed_->value);
    result_.stiffness.push_back((augmented ? augmented_factor : penalty_factor) *
                                young_modulus(holder.rock) / spacing_ * area);
    result_.augmented.push_back(augmented);
  }

  void add(const FaceRegion& region) {
    SurfaceSplitter surface(complex_, covering_);
    for (const FreePart& part : complex_.free_parts) {
      const FaceOrigin& origin = complex_.origins[part.origin];
      if (origin.solid == region.solid && std::find(region.faces.begin(), region.faces.end(),
                                                    origin.solid_face) != region.faces.end())
        surface.split(part, [this](const Holder& holder, const Polygon& polygon) {
          add_polygon(holder, polygon);
        });
    }
  }

  // Corners share the area so that the sum over them integrates linear functions exactly (a fan of triangles, a third each).
  void add_polygon(const Holder& holder, const Polygon& polygon) {
    const std::size_t n = polygon.corner.size();
    std::vector<Real> share(n, 0);
    for (std::size_t k = 1; k + 1 < n; ++k) {
      const Vec3& o = polygon.corner[0].x;
      const Real third = cell_split(covering_.arrays.lattice.kind).share *
                         norm(cross(polygon.corner[k].x - o, polygon.corner[k + 1].x - o)) / 6;
      share[0] += third, share[k] += third, share[k + 1] += third;
    }
    for (std::size_t k = 0; k < n; ++k)
      if (share[k] > 0) add_point(polygon.corner[k].x + complex_.planes.centre(), holder, share[k]);
  }

  void add(const PointRegion& region) {
    const Holder h = locator_.find(region.point);
    if (h.found()) add_point(region.point, h, spacing_ * spacing_);
  }

  void add(const BoxRegion& region) {
    add_vertices([&](const Vec3& x, Index) {
      for (int d = 0; d < 3; ++d)
        if (x[d] < region.min[d] || x[d] > region.max[d]) return false;
      return true;
    });
  }

  void add(const PlaneRegion& region) {
    add_vertices([&](const Vec3& x, Index) {
      return std::abs(dot(region.normal, x - region.point)) <= region.tolerance;
    });
  }

  void add(const BlockRegion& region) {
    const Holder h = locator_.find(region.point);
    if (h.found()) add_vertices([&](const Vec3&, Index block) { return block == h.block; });
  }

  // The vertices of elements that `wanted` picks; each stands for some h²/8 of area, of the order of its share.
  template <class Wanted>
  void add_vertices(const Wanted& wanted) {
    const CoverArrays& covers = covering_.arrays;
    const Real area = spacing_ * spacing_ / 8;
    for (Index r = 0; r < covers.regular_count(); ++r) {
      const Index cell = covers.regular_cell[r];
      const auto& parts = covers.lattice.split(cell).part;
      for (int c = 0; c < covers.nodes_per_cell(); ++c) {
        const Vec3 x = covers.lattice.node_position(covers.lattice.cell_node(cell, c));
        if (!wanted(x, covers.regular_block[r])) continue;
        const auto part = std::find_if(parts.begin(), parts.end(), [&](const CellPart& p) {
          return std::find(p.node.begin(), p.node.begin() + p.nodes, c) != p.node.begin() + p.nodes;
        });
        add_point(x,
                  holder_of(complex_, covering_, cell, static_cast<int>(part - parts.begin()),
                            covering_.pieces->regular_rock[r]),
                  area);
      }
    }
    for (Index e = 0; e < covers.cut_count(); ++e)
      for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q) {
        const Holder h = holder_of(complex_, covering_, covers.element_cell[e],
                                   covers.element_part[e], covering_.pieces->piece_rock[q]);
        const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[e]);
        for (Index v = covers.vertex_begin[q]; v < covers.vertex_begin[q + 1]; ++v) {
          const Vec3 x = centre + Vec3{covers.vertex_xyz[3 * v], covers.vertex_xyz[3 * v + 1],
                                       covers.vertex_xyz[3 * v + 2]};
          if (wanted(x, covers.piece_block[q])) add_point(x, h, area);
        }
      }
  }

  const Complex& complex_;
  const Covering& covering_;
  const Model& model_;
  const Locator locator_;
  const Real spacing_;
  const Fixed* fixed_ = nullptr;
  FixedPoints result_;
};

}  // namespace

FixedPoints fixed_points(const Cutting& cutting, const Covering& covering, const Model& model) {
  return Fixer(cutting, covering, model).run();
}

}  // namespace rockfold
