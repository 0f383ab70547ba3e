// Essential boundary conditions as rows over the unknowns (thesis 2.3.3): surfaces by held_rows.hpp, whole elements by all of their
// unknowns, points one by one.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "host/box_tree.hpp"
#include "host/cover/cover.hpp"
#include "host/cover/points/free_faces.hpp"
#include "host/cover/points/held_rows.hpp"
#include "host/cover/points/locate.hpp"
#include "host/cover/points/rows_apart.hpp"
#include "host/cut/bodies/union_find.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

namespace {

constexpr Real share_factor = 10;  // of E/h: by which points held share what they take together
constexpr Real penalty_factor =
    1000;  // of E/h: displacement off by about 1e-3 of the element's own

/// Of its node's weight at the node: a cover that nowhere in the elements held comes to as much is not held for them, but where
/// no other rock is its.
constexpr Real least_weight = 0.1;
constexpr Real least_cosine = 0.9;  // between a plane and the faces that lie along it
/// Spacings: nearer to a held face or vertex than that vertices go with it. Held one by one they would hold slopes too, by rows that
/// differ so little that rounding decides.
constexpr Real close_by = 0.01;
constexpr Real few_whole = 0.1;    // of the area of the rest of a rock face
constexpr Real few_held = 0.25;    // of what moves that rest
constexpr Real least_width = 0.1;  // spacings: of a part of a rock face that a box holds by itself
constexpr Real least_area = 0.25;  // spacings squared: likewise

/// Parts of held faces, to tell which points lie on them.
class HeldFaces {
 public:
  explicit HeldFaces(Real spacing, std::vector<FacePolygon> parts = {})
      : reach_(close_by * spacing), parts_(std::move(parts)) {
    const Vec3 beyond{reach_, reach_, reach_};
    std::vector<Bounds> bounds;
    for (const FacePolygon& part : parts_) {
      Box box;
      for (const Vec3& x : part.corner) box.add(x);
      bounds.push_back({box.low - beyond, box.high + beyond});
    }
    boxes_ = BoxTree(std::move(bounds));
  }

  bool hold(const Vec3& x) const {
    const auto near = boxes_.at(x);
    return std::any_of(near.begin(), near.end(), [&](Index part) {
      return std::abs(dot(parts_[part].normal, x - parts_[part].corner[0])) <= reach_;
    });
  }

 private:
  const Real reach_;
  const std::vector<FacePolygon> parts_;
  BoxTree boxes_;
};

/// Where vertices are held, by the cells of a grid, and by which rows.
class HeldPlaces {
 public:
  explicit HeldPlaces(Real spacing) : reach_(close_by * spacing) {}

  /// The row of a place close by; else that of x from now on, which is none so far.
  Index& row_near(const Vec3& x) {
    Cell c{};
    for (int d = 0; d < 3; ++d) c[d] = static_cast<std::int64_t>(std::floor(x[d] / reach_));
    for (auto i = c[0] - 1; i <= c[0] + 1; ++i)
      for (auto j = c[1] - 1; j <= c[1] + 1; ++j)
        for (auto k = c[2] - 1; k <= c[2] + 1; ++k)
          if (const auto found = of_cell_.find({i, j, k}); found != of_cell_.end())
            for (auto& [place, row] : found->second)
              if (norm(x - place) <= reach_) return row;
    return of_cell_[c].emplace_back(x, none).second;
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  const Real reach_;
  std::map<Cell, std::vector<std::pair<Vec3, Index>>> of_cell_;
};

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

  /// Calls visit(element, block, vertices in m) for the part of an element that is one piece, or a part of a regular cell. `of`: a
  /// block, whose elements alone are visited where no others share its covers (kind `block`); none: all.
  template <class Visit>
  void each(Index of, const Visit& visit) const {
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
    IndexRange cut{0, covers_.cut_count()};
    if (of != none && covers_.lattice.kind == LatticeKind::block)
      cut = elements_of_cell(covers_, of);
    for (Index e = cut.begin; e < cut.end; ++e)
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

/// m: of all rock, along x, y or z.
Real largest_extent(const CoverArrays& covers) {
  Real largest = 0;
  if (covers.regular_count() > 0) return std::numeric_limits<Real>::infinity();
  for (int d = 0; d < 3; ++d) {
    Real low = std::numeric_limits<Real>::infinity(), high = -low;
    for (Index e = 0; e < covers.cut_count(); ++e) {
      const Real centre = covers.lattice.cell_centre(covers.element_cell[e])[d];
      for (Index v = covers.vertex_begin[covers.piece_begin[e]];
           v < covers.vertex_begin[covers.piece_begin[e + 1]]; ++v) {
        low = std::min(low, centre + covers.vertex_xyz[3 * v + d]);
        high = std::max(high, centre + covers.vertex_xyz[3 * v + d]);
      }
    }
    largest = std::max(largest, high - low);
  }
  return largest;
}

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
                cross(covering.arrays.lattice.edge[1], covering.arrays.lattice.edge[2])))),
        reach_(std::min(spacing_, largest_extent(covering.arrays))) {}

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
    elements_.each(none, [&](Index, Index, const std::vector<Vec3>& vertex) {
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

  /// Pa/m; N/m for a point, whose area is then 1. Springs alone are measured by rock that cannot bulge, which resists most: λ + 2μ.
  Real stiffness(Index element) const {
    if (fixed_->stiffness) return *fixed_->stiffness;
    const Material& rock = model_.materials[material_of(covers_, element)];
    const Real nu = rock.poisson_ratio, e = rock.young_modulus;
    switch (fixed_->method) {
      case FixMethod::penalty:
        return penalty_factor * e * (1 - nu) / ((1 + nu) * (1 - 2 * nu)) / reach_;
      case FixMethod::augmented_lagrangian:
      case FixMethod::lagrange:
        break;
    }
    return share_factor * e / reach_;
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
    result_.motion_ratio.push_back(row.motion_ratio);
    result_.enforce.push_back(enforce_of(row));
  }

  /// What the functions of one cover follow by themselves is prescribed exactly, unless the model gives a spring's stiffness.
  Enforce enforce_of(const HeldRow& row) const {
    const auto of_first = [&](Index unknown) {
      return unknown % covers_.cover_count() == row.unknown[0] % covers_.cover_count();
    };
    const bool of_one_cover = std::all_of(row.unknown.begin(), row.unknown.end(), of_first);
    const bool spring =
        fixed_->method == FixMethod::penalty && (fixed_->stiffness || !of_one_cover);
    return spring ? Enforce::penalty : Enforce::held;
  }

  void add_point(const Vec3& x, Index element, Index other, Real stiffness) {
    MaterialPoints at;
    add_material_point(covers_, x, element, at, other);
    add_row({element, x, at.unknown, at.weight, 0, false}, stiffness);
  }

  /// The free faces of a region that `wanted` takes. Whether there are any.
  template <class Wanted>
  bool add_surface(const Region& region, const Wanted& wanted) {
    std::map<std::tuple<Index, Index>, std::vector<FacePolygon>> surfaces;  // by plane and body
    visit_free_faces(cutting_, covering_, region, [&](const FacePolygon& polygon) {
      if (wanted(polygon))
        surfaces[{polygon.plane, elements_.body(polygon.element)}].push_back(polygon);
    });
    for (const auto& [key, surface] : surfaces) add_rows(surface);
    return !surfaces.empty();
  }
  void add_rows(const std::vector<FacePolygon>& surface) {
    std::vector<HeldRow> rows;
    hold_surface(covers_, surface, spacing_, slack_, rows);
    for (const HeldRow& row : rows) add_row(row, row.area * stiffness(row.element));
  }
  bool add_surface(const Region& region) {
    return add_surface(region, [](const FacePolygon&) { return true; });
  }

  /// A cover of elements that are held as a whole.
  struct HeldCover {
    Index element = none;  ///< the first of them
    Real weight = 0;       ///< of its node in them, at most
    bool alone = true;     ///< whether all of its rock is held
  };

  /// What of a rock face lies in a box: the faces of its elements that do.
  struct FaceInBox {
    std::vector<FacePolygon> part;  ///< without those of elements that are held as a whole
    Real extent = 0, area = 0;      ///< m, m²; of these
    Real of_whole = 0;              ///< m², of the others
    Real of_held = 0;               ///< m², of `area` times the weight of covers that are held
    bool all = true;                ///< nothing of the rock face lies outside

    void add(const FacePolygon& polygon, bool is_whole, Real held_weight) {
      const Real share = polygon.share * polygon_area(polygon.corner);
      if (is_whole) {
        of_whole += share;
        return;
      }
      part.push_back(polygon);
      area += share;
      of_held += share * held_weight;
      for (const Vec3& x : polygon.corner) extent = std::max(extent, norm(x - part[0].corner[0]));
    }

    /// Not beside elements that are held as a whole, which leave the rest few covers of its own, unless these are specks; nor strips and
    /// specks of a rock face that lies across what is to be held: multipliers would hold slopes at its edges.
    bool to_be_held(Real spacing) const {
      return !part.empty() && of_whole <= few_whole * area && of_held <= few_held * area &&
             (all || area >= std::max(least_width * extent, least_area * spacing) * spacing);
    }
  };

  /// Holds faces in a box.
  HeldFaces hold_faces_in(const BoxRegion& box, const std::set<Index>& whole,
                          const std::map<Index, HeldCover>& covers) {
    const PlaneRegion everywhere{{}, {0, 0, 1}, std::numeric_limits<Real>::infinity()};
    std::map<std::tuple<Index, Index>, FaceInBox> faces;  // by plane and body
    visit_free_faces(cutting_, covering_, everywhere, [&](const FacePolygon& polygon) {
      FaceInBox& face = faces[{polygon.plane, elements_.body(polygon.element)}];
      if (std::all_of(polygon.corner.begin(), polygon.corner.end(),
                      [&](const Vec3& x) { return is_in(box, x); }))
        face.add(polygon, whole.count(polygon.element) > 0, held_weight(polygon, covers));
      else
        face.all = false;
    });
    std::vector<FacePolygon> held;
    for (const auto& [key, face] : faces) {
      if (!face.to_be_held(spacing_)) continue;
      held.insert(held.end(), face.part.begin(), face.part.end());
      add_rows(face.part);
    }
    return HeldFaces(spacing_, std::move(held));
  }

  bool is_in(const BoxRegion& box, const Vec3& x) const {
    for (int d = 0; d < 3; ++d)
      if (x[d] < box.min[d] - slack_ || x[d] > box.max[d] + slack_) return false;
    return true;
  }

  /// Of what moves a part of a face, the share of covers that are held; at its corners, in the mean.
  Real held_weight(const FacePolygon& polygon, const std::map<Index, HeldCover>& covers) const {
    const ElementNodes nodes = element_nodes(covers_, polygon.element);
    const CellPart& part = covers_.lattice.split(nodes.cell).part[nodes.part];
    const Vec3 centre = covers_.lattice.cell_centre(nodes.cell);
    Real held = 0;
    for (const Vec3& x : polygon.corner) {
      const auto weight = part_weights(part, covers_.lattice.to_local(x - centre));
      for (int a = 0; a < part.nodes; ++a)
        if (covers.count(nodes.cover[a]) > 0) held += std::abs(weight[a]);
    }
    return held / static_cast<Real>(polygon.corner.size());
  }

  /// Whole elements that `inside` holds, by all unknowns of their covers; of other elements the faces that hold_faces(whole elements, covers) holds
  /// and the vertices in it, which go with faces and covers that are held beside them. Slivers of rock that others of a cover's elements
  /// share must not hold all of these: they hold the covers at whose nodes they lie. `of`: the block that holds all that is inside, or none.
  template <class Inside, class HoldFaces>
  void add_volume(const Inside& inside, bool whole_elements, const HoldFaces& hold_faces,
                  Index of = none) {
    const std::size_t first = result_.points.size();
    std::map<Index, HeldCover> covers;
    std::set<Index> whole;
    const auto is_whole = [&](Index block, const std::vector<Vec3>& vertex) {
      return whole_elements && std::all_of(vertex.begin(), vertex.end(),
                                           [&](const Vec3& x) { return inside(x, block); });
    };
    elements_.each(of, [&](Index element, Index block, const std::vector<Vec3>& vertex) {
      if (!is_whole(block, vertex)) return;
      whole.insert(element);
      hold_element(element, vertex, covers);
    });
    elements_.each(of, [&](Index element, Index block, const std::vector<Vec3>& vertex) {
      if (is_whole(block, vertex)) return;
      for (const Index p : elements_.covers_of(element))
        if (const auto found = covers.find(p); found != covers.end()) found->second.alone = false;
    });
    for (auto it = covers.begin(); it != covers.end();)
      it = it->second.alone || it->second.weight >= least_weight ? std::next(it) : covers.erase(it);
    for (const auto& [cover, held] : covers) add_cover(cover, held);
    const HeldFaces faces = hold_faces(whole, covers);
    RowsApart apart(result_, first);
    std::map<std::pair<Index, bool>, HeldPlaces> places;  // by body and split
    elements_.each(of, [&](Index element, Index block, const std::vector<Vec3>& vertex) {
      if (is_whole(block, vertex)) return;
      const bool second = element_nodes(covers_, element).part >= covers_.first_split_parts();
      HeldPlaces& held =
          places.try_emplace({elements_.body(element), second}, spacing_).first->second;
      for (const Vec3& x : vertex)
        if (inside(x, block) && !faces.hold(x))
          add_vertex(x, element, block, covers, held.row_near(x), apart,
                     [&](const Vec3& node) { return inside(node, block); });
    });
  }

  void hold_element(Index element, const std::vector<Vec3>& vertex,
                    std::map<Index, HeldCover>& covers) const {
    const ElementNodes nodes = element_nodes(covers_, element);
    const CellPart& part = covers_.lattice.split(nodes.cell).part[nodes.part];
    const Vec3 centre = covers_.lattice.cell_centre(nodes.cell);
    for (const Vec3& x : vertex) {
      const auto weight = part_weights(part, covers_.lattice.to_local(x - centre));
      for (int a = 0; a < part.nodes; ++a) {
        HeldCover& held = covers.emplace(nodes.cover[a], HeldCover{element}).first->second;
        held.weight = std::max(held.weight, weight[a]);
      }
    }
  }

  /// A vertex of an element stands for some h²/8 of area, of the order of its share. Beside nodes that `inside` holds, it holds these, unless
  /// they are held as a whole: with the little that others have in it as well, held exactly, the layer of elements beyond could not deform.
  /// `of_place`: the row that holds its place, if there is one.
  template <class Inside>
  void add_vertex(const Vec3& x, Index element, Index block, const std::map<Index, HeldCover>& held,
                  Index& of_place, RowsApart& apart, const Inside& inside) {
    const Real resistance = reach_ * reach_ / 8 * stiffness(element);
    if (of_place != none) {
      result_.stiffness[of_place] += resistance;
      return;
    }
    Holder own;
    own.element = element;
    own.block = block;
    element = locator_.firm_for(x, own).element;
    const ElementNodes nodes = element_nodes(covers_, element);
    const CellPart& part = covers_.lattice.split(nodes.cell).part[nodes.part];
    const auto weight =
        part_weights(part, covers_.lattice.to_local(x - covers_.lattice.cell_centre(nodes.cell)));
    Real beyond = 0, loose = 0;
    std::set<Index> others;
    for (int a = 0; a < part.nodes; ++a) {
      const Index p = nodes.cover[a];
      if (held.count(p) == 0) loose += std::abs(weight[a]);
      if (inside(covers_.lattice.node_position(covers_.cover_node[p]))) continue;
      others.insert(p);
      beyond += std::abs(weight[a]);
    }
    if (loose < least_weight) return;
    if (!(beyond < least_weight)) others.clear(), beyond = 0;
    MaterialPoints at;
    add_material_point(covers_, x, element, at);
    HeldRow row{element, x, {}, {}, 0, false};
    for (std::size_t i = 0; i < at.unknown.size(); ++i) {
      if (others.count(at.unknown[i] % covers_.cover_count()) > 0) continue;
      row.unknown.push_back(at.unknown[i]);
      row.weight.push_back(at.weight[i] / (1 - beyond));  // rock that moves as a whole moves so
    }
    of_place = static_cast<Index>(result_.points.size());
    const Real stiffer = fixed_->stiffness ? 1 : apart.stiffening(row.unknown, row.weight);
    add_row(row, stiffer * resistance);
  }

  void add_cover(Index cover, const HeldCover& held) {
    const Vec3 node = covers_.lattice.node_position(covers_.cover_node[cover]);
    for (int k = 0; k < covers_.functions(); ++k)
      add_row({held.element,
               node,
               {k * covers_.cover_count() + cover},
               {1},
               0,
               k > 0,
               std::min<Real>(1, held.weight)},
              reach_ * reach_ * stiffness(held.element));
  }

  void add(const FaceRegion& region) { add_surface(region); }

  void add(const PlaneRegion& region) {
    const Real tolerance = std::max(region.tolerance, slack_);
    const auto inside = [&](const Vec3& x, Index) {
      return std::abs(dot(region.normal, x - region.point)) <= tolerance;
    };
    // Faces that lie along it, and vertices beside them: a wider plane holds no less. Slivers of faces across are not such faces.
    add_volume(inside, false, [&](const auto&, const auto&) {
      std::vector<FacePolygon> faces;
      add_surface(region, [&](const FacePolygon& polygon) {
        const bool along = std::abs(dot(polygon.normal, region.normal)) >= least_cosine;
        if (along) faces.push_back(polygon);
        return along;
      });
      return HeldFaces(spacing_, std::move(faces));
    });
  }

  void add(const BoxRegion& region) {
    Real thickness = region.max[0] - region.min[0];
    for (int d = 1; d < 3; ++d) thickness = std::min(thickness, region.max[d] - region.min[d]);
    const bool flat = thickness <= slack_;
    if (flat && add_surface(region)) return;
    add_volume([&](const Vec3& x, Index) { return is_in(region, x); }, !flat,
               [&](const auto& whole, const auto& covers) {
                 return hold_faces_in(region, whole, covers);
               });
  }

  void add(const PointRegion& region) {
    const Holder h = locator_.find_firm(region.point);
    if (!h.found()) return;
    const Real by_area = fixed_->stiffness ? 1 : reach_ * reach_;
    add_point(region.point, h.element, h.other, by_area * stiffness(h.element));
  }

  void add(const BlockRegion& region) {
    const Holder h = locator_.find(region.point);
    if (h.found())
      add_volume([&](const Vec3&, Index block) { return block == h.block; }, true,
                 [&](const auto&, const auto&) { return HeldFaces(spacing_); }, h.block);
  }

  const Cutting& cutting_;
  const Covering& covering_;
  const CoverArrays& covers_;
  const Model& model_;
  const Locator locator_;
  Elements elements_;
  const Real slack_, spacing_;
  const Real
      reach_;  ///< m, of the rock behind a support, at most a spacing: springs are stiff beside it
  const Fixed* fixed_ = nullptr;
  Index table_ = none;
  FixedPoints result_;
};

}  // namespace

FixedPoints fixed_points(const Cutting& cutting, const Covering& covering, const Model& model) {
  return Fixer(cutting, covering, model).run();
}

}  // namespace rockfold
