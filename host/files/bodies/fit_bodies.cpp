#include "host/files/bodies/fit_bodies.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "host/cut/cells/patch.hpp"
#include "host/files/bodies/common_planes.hpp"
#include "host/files/bodies/overlapping.hpp"
#include "host/files/bodies/touching.hpp"
#include "host/refuse.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

/// Of a body's least extent: decimals coarser than this are no rounding of it; whole numbers and halves are meant so.
constexpr Real coarsest_rounding = 0.005;
/// Of the extent of all: planes that are nearer are one in any case (decision 5, rule 2).
constexpr Real finest_rounding = 1e-10;
/// So many planes cost a convex body more as half-spaces than its triangles would: each is clipped by all.
constexpr std::size_t most_half_spaces = 200;

std::vector<Solid*> solids_of_meshes(Model& model) {
  std::vector<Solid*> solids;
  for (Solid& solid : model.solids)
    if (const auto* mesh = std::get_if<MeshShape>(&solid.shape);
        solid.add && mesh && mesh->surface && !mesh->surface->triangles.empty())
      solids.push_back(&solid);
  return solids;
}

const TriangleSurface& surface_of(const Solid& solid) {
  return *std::get<MeshShape>(solid.shape).surface;
}

Box box_of(const TriangleSurface& surface) {
  Box box;
  for (const Vec3& x : surface.vertices) box.add(x);
  return box;
}

/// How far coordinates may be off.
struct Rounding {
  Real tolerance = 0;  ///< m
  bool is_given = false;
};

Rounding rounding_of(const std::vector<Solid*>& solids, const Model& model) {
  Box all;
  Real digit = 0;
  const Solid* thinnest = nullptr;
  Real least = Box::infinity;
  for (const Solid* solid : solids) {
    const Box box = box_of(surface_of(*solid));
    const Vec3 extent = box.high - box.low;
    const Real thickness = std::min({extent[0], extent[1], extent[2]});
    if (thickness < least) least = thickness, thinnest = solid;
    if (surface_of(*solid).last_digit <= coarsest_rounding * thickness)
      digit = std::max(digit, surface_of(*solid).last_digit);
    all.add(box);
  }
  const Real finest = finest_rounding * norm(all.high - all.low);
  if (!model.contact.tolerance) return {std::max(digit, finest), false};
  constexpr Real of_thickness = 0.05;  // corners of opposite faces must stay two
  if (*model.contact.tolerance > of_thickness * least)
    refuse(model.contact.place, model.contact.place.key + ".tolerance",
           fmt::format(
               "found {:g}, must be a rounding error of the coordinates: body \"{}\" is {:.3g} m "
               "thick, which asks for {:.2g} or less (m)",
               *model.contact.tolerance, thinnest->name, least, of_thickness * least));
  return {std::max(*model.contact.tolerance, finest), true};
}

class Fitter {
 public:
  Fitter(std::vector<Solid*> solids, const Rounding& rounding)
      : solids_(std::move(solids)), rounding_(rounding) {}

  /// None where no body touches another.
  std::optional<BodyFit> run() {
    for (const Solid* solid : solids_) bodies_.add(surface_of(*solid), 2 * rounding_.tolerance);
    touching_ = find_touching(bodies_, 2 * rounding_.tolerance);
    if (touching_.on.empty()) return {};
    common_ = common_planes(middle_of_corners(), touching_.face_count, touching_.on);
    fit_.tolerance = rounding_.tolerance, fit_.is_given = rounding_.is_given;
    fit_.contacts = touching_.contacts;
    for (std::size_t b = 0; b < solids_.size(); ++b)
      if (touching_.touches[b]) fit(static_cast<Index>(b));
    return fit_;
  }

  /// The body whose corner went farthest, by name.
  const std::string& farthest() const { return farthest_; }
  /// m
  Real off() const { return common_.off; }

 private:
  std::vector<Vec3> middle_of_corners() const {
    std::vector<Vec3> sum(touching_.corner_count);
    std::vector<Real> count(sum.size(), 0);
    for (std::size_t b = 0; b < solids_.size(); ++b)
      for (std::size_t v = 0; v < surface_of(*solids_[b]).vertices.size(); ++v) {
        const Index corner = touching_.corner[bodies_.vertex_begin[b] + static_cast<Index>(v)];
        if (corner == none) continue;
        sum[corner] += surface_of(*solids_[b]).vertices[v];
        count[corner] += 1;
      }
    for (std::size_t c = 0; c < sum.size(); ++c) sum[c] = (1 / count[c]) * sum[c];
    return sum;
  }

  void fit(Index b) {
    auto fitted = std::make_shared<TriangleSurface>(surface_of(*solids_[b]));
    for (std::size_t v = 0; v < fitted->vertices.size(); ++v) {
      const Vec3& to =
          common_.corner[touching_.corner[bodies_.vertex_begin[b] + static_cast<Index>(v)]];
      if (const Real moved = norm(to - fitted->vertices[v]); moved > fit_.largest_move)
        fit_.largest_move = moved, farthest_ = solids_[b]->name;
      fitted->vertices[v] = to;
    }
    const BodyPlanes& planes = bodies_.planes[b];
    if (planes.convex && planes.outward.size() <= most_half_spaces) {
      ++fit_.convex;
      for (std::size_t p = 0; p < planes.outward.size(); ++p) {
        const FittedPlane& plane =
            common_.plane[touching_.face[bodies_.plane_begin[b] + static_cast<Index>(p)]];
        fitted->planes.push_back(
            {plane.centre, plane.normal, dot(plane.normal, planes.outward[p]) < 0});
      }
    }
    ++fit_.bodies;
    std::get<MeshShape>(solids_[b]->shape).surface = std::move(fitted);
  }

  std::vector<Solid*> solids_;
  Rounding rounding_;
  BodySet bodies_;
  Touching touching_;
  CommonPlanes common_;
  BodyFit fit_;
  std::string farthest_;
};

void warn_of_overlap(const std::vector<Solid*>& solids, const Rounding& rounding, Model& model) {
  std::vector<const TriangleSurface*> surfaces;
  for (const Solid* solid : solids) surfaces.push_back(&surface_of(*solid));
  const Overlap overlap = find_overlap(surfaces, 2 * rounding.tolerance);
  if (overlap.count == 0) return;
  const Solid &in = *solids[overlap.body], &around = *solids[overlap.other];
  model.warnings.push_back(
      {around.place,
       fmt::format("\"{}\" lies in \"{}\" by {:.3g} m, far more than the rounding of their "
                   "files{}: where solids overlap the rock is that of the later one, and the other "
                   "is carved by it",
                   in.name, around.name, overlap.depth,
                   overlap.count > 1 ? fmt::format(" (the deepest of {} such pairs)", overlap.count)
                                     : "")});
}

}  // namespace

void fit_bodies(Model& model) {
  if (model.body_fit) return;
  std::vector<Solid*> solids = solids_of_meshes(model);
  if (solids.size() < 2) return;
  const Rounding rounding = rounding_of(solids, model);
  warn_of_overlap(solids, rounding, model);
  Fitter fitter(std::move(solids), rounding);
  model.body_fit = fitter.run();
  if (!model.body_fit) return;
  const Place place{model.path, model.contact.place.line, 0, "contact.tolerance"};
  // A corner of rounded coordinates goes by the error of its own, of its planes' and of its neighbours'.
  constexpr Real much = 5;
  if (model.body_fit->largest_move > much * rounding.tolerance)
    model.warnings.push_back(
        {place,
         fmt::format("fitting bodies together moved a corner of \"{}\" by {:.2g} m, more than "
                     "{:g} times the tolerance of {:.2g} m: its faces are not plane, or bodies "
                     "overlap by more than rounding",
                     fitter.farthest(), model.body_fit->largest_move, much, rounding.tolerance)});
}

}  // namespace rockfold
