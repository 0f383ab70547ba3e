// Essential boundary conditions as rows over the unknowns (thesis 2.3.3): surfaces by held_rows.hpp, whole elements by all of their
// unknowns, points one by one.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include <fmt/format.h>

#include "host/cover/cover.hpp"
#include "host/cover/free_faces.hpp"
#include "host/cover/held_rows.hpp"
#include "host/cover/locate.hpp"
#include "host/cut/union_find.hpp"
#include "src/arrays/shape_functions.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Real augmented_factor = 10;  // of E/h: the multipliers do the rest (DESIGN.md, "Solve")
constexpr Real penalty_factor =
    1000;  // of E/h: displacement off by about 1e-3 of the element's own

/// Elements and their covers; regular cells by their parts.
class Elements {
 public:
  explicit Elements(const CoverArrays& covers) : covers_(covers), joined_(covers.cover_count()) {
    for (Index e = 0; e < covers.element_count(); ++e) {
      const auto cover = covers_of(e);
      for (const Index p : cover) joined_.join(p, cover[0]);
    }
  }

  std::vector<Index> covers_of(Index element) const {
    const ElementNodes nodes = element_nodes(covers_, element);
    return {nodes.cover.begin(), nodes.cover.begin() + covers_.nodes_per_part()};
  }
  /// The connected part of the rock that it belongs to.
  Index body(Index element) { return joined_.find(covers_of(element)[0]); }

  /// Calls visit(element, block, vertices in m) for the part of an element that is one piece, or a part of a regular cell.
  template <class Visit>
  void each(const Visit& visit) const {
    const int parts = covers_.parts_per_cell();
    std::vector<Vec3> vertex;
    for (Index r = 0; r < covers_.regular_count(); ++r)
      for (int t = 0; t < parts; ++t) {
        vertex.clear();
        const Index cell = covers_.regular_cell[r];
        const CellPart& part = covers_.lattice.split(cell).part[t];
        for (int a = 0; a < part.nodes; ++a)
          vertex.push_back(
              covers_.lattice.node_position(covers_.lattice.cell_node(cell, part.node[a])));
        visit(parts * r + t, covers_.regular_block[r], vertex);
      }
    for (Index e = 0; e < covers_.cut_count(); ++e)
      for (Index q = covers_.piece_begin[e]; q < covers_.piece_begin[e + 1]; ++q) {
        vertex.clear();
        const Vec3 centre = covers_.lattice.cell_centre(covers_.element_cell[e]);
        for (Index v = covers_.vertex_begin[q]; v < covers_.vertex_begin[q + 1]; ++v)
          vertex.push_back(centre + Vec3{covers_.vertex_xyz[3 * v], covers_.vertex_xyz[3 * v + 1],
                                         covers_.vertex_xyz[3 * v + 2]});
        visit(parts * covers_.regular_count() + e, covers_.piece_block[q], vertex);
      }
  }

 private:
  const CoverArrays& covers_;
  UnionFind joined_;
};

class Fixer {
 public:
  Fixer(const Cutting& cutting, const Covering& covering, const Model& model)
      : cutting_(cutting),
        covering_(covering),
        covers_(covering.arrays),
        model_(model),
        locator_(covering),
        elements_(covering.arrays),
        slack_(1e-9 * covering.pieces->planes.model_size()),
        spacing_(std::cbrt(
            dot(covering.arrays.lattice.edge[0],
                cross(covering.arrays.lattice.edge[1], covering.arrays.lattice.edge[2])))) {}

  FixedPoints run() {
    for (const Fixed& f : model_.fixed) {
      const std::size_t before = result_.points.size();
      fixed_ = &f;
      table_ = none;
      if (!f.table.empty()) {
        table_ = static_cast<Index>(result_.tables.size());
        result_.tables.push_back(f.table);
      }
      std::visit([this](const auto& region) { add(region); }, f.where);
      if (result_.points.size() == before) refuse();
    }
    return std::move(result_);
  }

 private:
  [[noreturn]] void refuse() {
    Place place = fixed_->place;
    place.key = fmt::format("fixed[{}].where", fixed_ - model_.fixed.data() + 1);
    throw Error(ErrorKind::model,
                meets_rock(fixed_->where)
                    ? fmt::format("holds nothing: within the rock a box or plane holds the "
                                  "vertices of elements in it, and there are none; make it as "
                                  "thick as cover.spacing ({:.4g} m), or let lattice planes run "
                                  "through it (cover.origin)",
                                  spacing_)
                    : "holds nothing: no rock lies there",
                place);
  }

  /// Whether elements reach into a box (by their extents) or to both sides of a plane.
  bool meets_rock(const Region& region) {
    const auto* box = std::get_if<BoxRegion>(&region);
    const auto* plane = std::get_if<PlaneRegion>(&region);
    if (!box && !plane) return false;
    bool meets = false;
    elements_.each([&](Index, Index, const std::vector<Vec3>& vertex) {
      bool apart = false;
      for (int d = 0; d < (box ? 3 : 1); ++d) {
        Real low = std::numeric_limits<Real>::infinity(), high = -low;
        for (const Vec3& x : vertex) {
          const Real at = box ? x[d] : dot(plane->normal, x - plane->point);
          low = std::min(low, at), high = std::max(high, at);
        }
        apart = apart || low > (box ? box->max[d] : 0) || high < (box ? box->min[d] : 0);
      }
      meets = meets || !apart;
    });
    return meets;
  }

  Real young_modulus(Index element) const {
    return model_.materials[material_of(covers_, element)].young_modulus;
  }

  /// Pa/m; N/m for a point, whose area is then 1.
  Real stiffness(Index element) const {
    const Real factor = fixed_->method == FixMethod::penalty ? penalty_factor : augmented_factor;
    return fixed_->stiffness.value_or(factor * young_modulus(element) / spacing_);
  }

  void add_row(const HeldRow& row, Real stiffness) {
    MaterialPoints& points = result_.points;
    points.element.push_back(row.element);
    points.local.push_back(row.x -
                           covers_.lattice.cell_centre(element_nodes(covers_, row.element).cell));
    points.unknown.insert(points.unknown.end(), row.unknown.begin(), row.unknown.end());
    points.weight.insert(points.weight.end(), row.weight.begin(), row.weight.end());
    points.begin.push_back(static_cast<Index>(points.unknown.size()));
    std::array<std::uint8_t, 3> component{};
    for (int d = 0; d < 3; ++d) component[d] = fixed_->components[d];
    result_.component.push_back(component);
    result_.value.push_back(row.moment ? Vec3{} : fixed_->value);
    result_.table.push_back(row.moment ? none : table_);
    result_.condition.push_back(static_cast<Index>(fixed_ - model_.fixed.data()));
    result_.stiffness.push_back(stiffness);
    const auto enforce = fixed_->method == FixMethod::penalty    ? Enforce::penalty
                         : fixed_->method == FixMethod::lagrange ? Enforce::exact
                                                                 : Enforce::augmented;
    result_.augmented.push_back(static_cast<std::uint8_t>(enforce));
  }

  void add_point(const Vec3& x, Index element, Index other, Real stiffness) {
    MaterialPoints at;
    add_material_point(covers_, x, element, at, other);
    add_row({element, x, at.unknown, at.weight, 0, false}, stiffness);
  }

  /// The free faces of a region. Whether there are any.
  bool add_surface(const Region& region) {
    std::map<std::tuple<Index, Index>, std::vector<FacePolygon>> surfaces;  // by plane and body
    visit_free_faces(cutting_, covering_, region, [&](const FacePolygon& polygon) {
      surfaces[{polygon.plane, elements_.body(polygon.element)}].push_back(polygon);
    });
    for (const auto& [key, surface] : surfaces) {
      std::vector<HeldRow> rows;
      hold_surface(covers_, surface, spacing_, rows);
      for (const HeldRow& row : rows) add_row(row, row.area * stiffness(row.element));
    }
    return !surfaces.empty();
  }

  /// Whole elements that `inside` holds, by all unknowns of their covers; of other elements the vertices in it.
  template <class Inside>
  void add_volume(const Inside& inside, bool whole_elements) {
    std::map<Index, Index> covers;  // each with its first element
    elements_.each([&](Index element, Index block, const std::vector<Vec3>& vertex) {
      const bool whole =
          whole_elements && std::all_of(vertex.begin(), vertex.end(),
                                        [&](const Vec3& x) { return inside(x, block); });
      if (whole)
        for (const Index p : elements_.covers_of(element)) covers.emplace(p, element);
      else
        for (const Vec3& x : vertex)
          if (inside(x, block)) add_vertex(x, element);
    });
    for (const auto& [cover, element] : covers) add_cover(cover, element);
  }

  /// A vertex of an element stands for some h²/8 of area, of the order of its share.
  void add_vertex(const Vec3& x, Index element) {
    add_point(x, element, none, spacing_ * spacing_ / 8 * stiffness(element));
  }

  void add_cover(Index cover, Index element) {
    const Vec3 node = covers_.lattice.node_position(covers_.cover_node[cover]);
    for (int k = 0; k < covers_.functions(); ++k)
      add_row({element, node, {k * covers_.cover_count() + cover}, {1}, 0, k > 0},
              spacing_ * spacing_ * stiffness(element));
  }

  void add(const FaceRegion& region) { add_surface(region); }

  void add(const PlaneRegion& region) {
    if (add_surface(region)) return;
    const Real tolerance = std::max(region.tolerance, slack_);
    add_volume([&](const Vec3& x,
                   Index) { return std::abs(dot(region.normal, x - region.point)) <= tolerance; },
               false);
  }

  void add(const BoxRegion& region) {
    Real thickness = region.max[0] - region.min[0];
    for (int d = 1; d < 3; ++d) thickness = std::min(thickness, region.max[d] - region.min[d]);
    const bool flat = thickness <= slack_;
    if (flat && add_surface(region)) return;
    add_volume(
        [&](const Vec3& x, Index) {
          for (int d = 0; d < 3; ++d)
            if (x[d] < region.min[d] - slack_ || x[d] > region.max[d] + slack_) return false;
          return true;
        },
        !flat);
  }

  void add(const PointRegion& region) {
    const Holder h = locator_.find(region.point);
    if (!h.found()) return;
    const Real by_area = fixed_->stiffness ? 1 : spacing_ * spacing_;
    add_point(region.point, h.element, h.other, by_area * stiffness(h.element));
  }

  void add(const BlockRegion& region) {
    const Holder h = locator_.find(region.point);
    if (h.found()) add_volume([&](const Vec3&, Index block) { return block == h.block; }, true);
  }

  const Cutting& cutting_;
  const Covering& covering_;
  const CoverArrays& covers_;
  const Model& model_;
  const Locator locator_;
  Elements elements_;
  const Real slack_, spacing_;
  const Fixed* fixed_ = nullptr;
  Index table_ = none;
  FixedPoints result_;
};

}  // namespace

FixedPoints fixed_points(const Cutting& cutting, const Covering& covering, const Model& model) {
  return Fixer(cutting, covering, model).run();
}

}  // namespace rockfold
