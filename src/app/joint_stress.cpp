#include "src/app/joint_stress.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "host/cover/cover.hpp"
#include "host/cover/points/loads.hpp"
#include "host/cover/points/locate.hpp"
#include "host/cut/cut.hpp"
#include "host/direct/multifrontal.hpp"
#include "host/flatten/face_polygons.hpp"
#include "host/flatten/flatten.hpp"
#include "kernels/integrate/moments.hpp"
#include "kernels/time/motion.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"
#include "src/space/stress_on_plane.hpp"

namespace rockfold {
namespace {

using Stress6 = std::array<Real, 6>;

/// Points that a mean over faces is taken at, with their shares of the area.
struct FacePoints {
  std::vector<Index> face;
  std::vector<Vec3> x;
  std::vector<Real> share;  ///< m²
};

/// Quarters a triangle until no side is longer than `size`, and adds three points of each part: exact for quadratic stress.
void add_points(const std::array<Vec3, 3>& corner, Index face, Real size, FacePoints& points) {
  Real longest = 0;
  for (int k = 0; k < 3; ++k) longest = std::max(longest, norm(corner[k] - corner[(k + 1) % 3]));
  if (longest > size) {
    const std::array<Vec3, 3> half{0.5 * (corner[1] + corner[2]), 0.5 * (corner[2] + corner[0]),
                                   0.5 * (corner[0] + corner[1])};
    add_points(half, face, size, points);
    for (int k = 0; k < 3; ++k)
      add_points({corner[k], half[(k + 2) % 3], half[(k + 1) % 3]}, face, size, points);
    return;
  }
  const Real area = 0.5 * norm(cross(corner[1] - corner[0], corner[2] - corner[0]));
  for (int k = 0; k < 3; ++k) {  // Strang & Fix 1973, Table 4.1
    points.face.push_back(face);
    points.x.push_back((2.0 / 3) * corner[k] +
                       (1.0 / 6) * (corner[(k + 1) % 3] + corner[(k + 2) % 3]));
    points.share.push_back(area / 3);
  }
}

/// Faces of finite blocks that rock can lean on.
FacePoints points_on_joints(const BlockArrays& blocks, Real size) {
  std::vector<std::uint8_t> wanted(blocks.face_origin.size(), 0);
  for (Index b = 0; b < blocks.block_count(); ++b) {
    if (blocks.finite[static_cast<std::size_t>(b)] == 0) continue;
    for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f)
      wanted[f] = blocks.origins[blocks.face_origin[f]].kind != FaceOrigin::Kind::solid_face;
  }
  const PolygonMesh polygons = face_polygons(blocks);
  FacePoints points;
  for (Index p = 0; p < polygons.size(); ++p) {
    if (wanted[polygons.polygon_face[p]] == 0) continue;
    const Loop loop = polygons.polygon(p);
    for (std::size_t k = 1; k + 1 < loop.size(); ++k)
      add_points({blocks.vertex[loop[0]], blocks.vertex[loop[k]], blocks.vertex[loop[k + 1]]},
                 polygons.polygon_face[p], size, points);
  }
  return points;
}

std::vector<Vec3> face_means(const BlockArrays& blocks, const FacePoints& points,
                             const std::vector<Vec3>& traction) {
  std::vector<Vec3> mean(blocks.face_origin.size());
  std::vector<Real> area(mean.size(), 0.0);
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    mean[points.face[i]] += points.share[i] * traction[i];
    area[points.face[i]] += points.share[i];
  }
  for (std::size_t f = 0; f < mean.size(); ++f)
    if (area[f] > 0) mean[f] = (1 / area[f]) * mean[f];
  return mean;
}

/// What is less of the whole than rounding leaves of stresses that cancel is none.
void drop_rounding(const InitialStress& stress, std::vector<Vec3>& traction) {
  constexpr Real rounding = 1e-9;
  Real size = 0;
  for (const Vec3& t : traction) size = std::max(size, norm(t));
  for (const Real s : stress.at) size = std::max(size, std::abs(s));
  for (Vec3& t : traction)
    if (norm(t) < rounding * size) t = {};
}

std::vector<Vec3> far_field(const BlockArrays& blocks, const InitialStress& stress,
                            const FacePoints& points) {
  std::vector<Vec3> traction;
  for (std::size_t i = 0; i < points.x.size(); ++i)
    traction.push_back(traction_on(stress, points.x[i], blocks.face_normal[points.face[i]]));
  return traction;
}

/// The change of stress that the openings cause, at points of the rock.
class Redistribution {
 public:
  Redistribution(Continuum& continuum, Progress& progress)
      : cutting_(cut_blocks(continuum.model, progress)) {
    hold_continuum(continuum, flatten_blocks(cutting_, continuum.model));
    const Model& model = continuum.model;
    covering_ = build_covers(cutting_, model, progress);
    const FixedPoints fixed = fixed_points(cutting_, covering_, model);
    const PieceMoments moments = piece_moments(covering_.arrays);
    std::vector<ElasticMaterial> materials;
    for (const Material& m : model.materials)
      materials.push_back({m.density, m.young_modulus, m.poisson_ratio});
    MotionSetup setup{covering_.arrays, moments, materials, fixed};
    setup.loads =
        unloading_points(cutting_, covering_, model.initial_stress,
                         [&](const FaceOrigin& origin) { return continuum.is_made_free(origin); });
    setup.solver.tolerance =
        1e-6;  // of the openings' forces: a hundredth of a per cent of the stress near them
    setup.direct = [] { return host::make_direct_solver(); };
    motion_.emplace(setup);
    const SolveReport report = motion_->solve_static();
    if (!report.converged)
      throw Error(ErrorKind::analysis,
                  fmt::format("support.stress = \"elastic\": the rock round the openings does not "
                              "come to equilibrium (residual {:.2g} after {} iterations); "
                              "\"far_field\" does without",
                              report.residual, report.iterations));
  }

  Index unknowns() const { return 3 * covering_.arrays.unknown_count(); }

  /// Adds its tractions; none where rock is gone, or beyond the reach.
  void add(const BlockArrays& blocks, const FacePoints& points, std::vector<Vec3>& traction) const;

 private:
  Cutting cutting_;
  Covering covering_;
  std::optional<Motion> motion_;
};

void Redistribution::add(const BlockArrays& blocks, const FacePoints& points,
                         std::vector<Vec3>& traction) const {
  const Locator locator(covering_);
  const CoverArrays& covers = covering_.arrays;
  std::vector<Index> element;
  std::vector<Vec3> local;
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    const Holder holder = locator.find_firm(points.x[i]);
    if (!holder.found()) continue;
    at.push_back(i);
    element.push_back(holder.element);
    local.push_back(points.x[i] -
                    covers.lattice.cell_centre(element_nodes(covers, holder.element).cell));
  }
  const std::vector<Stress6> stress = motion_->stress_at(element, local);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const std::size_t i = at[k];
    InitialStress change;
    change.at = stress[k];
    traction[i] += traction_on(change, points.x[i], blocks.face_normal[points.face[i]]);
  }
}

/// Radii from an opening within which it changes the stress by more than some per cent: (1/4)² of Kirsch's solution.
constexpr Real radii_of_influence = 3;

/// The boxes of faces beyond which the rock goes on, by name.
std::map<std::string, Extent> continuing_faces(const BlockArrays& blocks) {
  std::map<std::string, Extent> boxes;
  for (std::size_t f = 0; f < blocks.face_origin.size(); ++f) {
    const FaceOrigin& origin = blocks.origins[blocks.face_origin[f]];
    if (!origin.continues) continue;
    for (const Index v : face_loop(blocks, blocks.loop_begin[f])) {
      const Vec3& x = blocks.vertex[v];
      auto [box, first] = boxes.try_emplace(origin.name, Extent{x, x});
      for (int d = 0; d < 3; ++d) {
        box->second.min[d] = std::min(box->second.min[d], x[d]);
        box->second.max[d] = std::max(box->second.max[d], x[d]);
      }
    }
  }
  return boxes;
}

/// Finite blocks nearer to the openings than that.
Index blocks_near(const BlockArrays& blocks, const Openings& openings) {
  Index count = 0;
  for (std::size_t b = 0; b < blocks.centroid.size(); ++b)
    count += blocks.finite[b] != 0 && (blocks.stage.empty() || blocks.stage[b] == 0) &&
             distance({blocks.centroid[b], blocks.centroid[b]}, openings.box) <
                 radii_of_influence * openings.size;
  return count;
}

}  // namespace

std::vector<std::string> joint_stress_warnings(const BlockArrays& blocks, const Model& model,
                                               const JointStressReport* report) {
  std::vector<std::string> warnings;
  const auto openings = measure_openings(model);
  if (!model.initial_stress.any || !openings) return warnings;
  if (!report) {
    if (const Index near = blocks_near(blocks, *openings))
      warnings.push_back(fmt::format(
          "support.stress = \"far_field\": {} finite blocks lie within three radii "
          "({:.3g} m) of the "
          "openings, where the rock has relaxed or is squeezed: what far-field stress "
          "holds there is "
          "not to be relied on. \"elastic\" finds the stress there; it needs young_modulus "
          "and a solid that continues",
          near, radii_of_influence * openings->size));
    return warnings;
  }
  std::string near;
  for (const auto& [name, box] : continuing_faces(blocks)) {
    const Real gap = distance(box, openings->box);
    if (gap > 0 && gap < radii_of_influence * openings->size)
      near += fmt::format("{}{} ({:.3g} m)", near.empty() ? "" : ", ", name, gap);
  }
  if (!near.empty())
    warnings.push_back(
        fmt::format("support.stress = \"elastic\": faces of continues are nearer to the openings "
                    "than three radii "
                    "({:.3g} m), and how the rock is held there changes the stress: {}. A larger "
                    "solid is better",
                    radii_of_influence * openings->size, near));
  const auto coarsest = std::max_element(
      report->stages.begin(), report->stages.end(), [](const auto& a, const auto& b) {
        return a.coarser * a.spacing / a.radius < b.coarser * b.spacing / b.radius;
      });
  if (coarsest != report->stages.end() && coarsest->coarser)
    warnings.push_back(fmt::format(
        "support.stress = \"elastic\": cells of {:.3g} m on openings of a radius of {:.3g} m "
        "(stage "
        "{}) are coarser than a sixth of it, so that the model is not too large: stress near their "
        "walls is less accurate",
        coarsest->spacing, coarsest->radius, coarsest->stage));
  return warnings;
}

JointStressReport find_joint_stress(const BlockArrays& blocks, const Model& model,
                                    Progress& progress, const ContinuumRule& rule) {
  std::set<Index> stages(blocks.stage.begin(), blocks.stage.end());
  stages.insert(0);
  JointStressReport report;
  for (const Index stage : stages) {
    auto continuum = continuum_after(model, stage, rule);
    const Real size = continuum ? continuum->spacing : std::numeric_limits<Real>::infinity();
    const FacePoints points = points_on_joints(blocks, size);
    std::vector<Vec3> traction = far_field(blocks, model.initial_stress, points);
    if (continuum) {
      const Redistribution change(*continuum, progress);
      change.add(blocks, points, traction);
      report.stages.push_back({stage, continuum->openings.radius, continuum->spacing,
                               change.unknowns(), continuum->coarser});
    }
    std::vector<Vec3> mean = face_means(blocks, points, traction);
    drop_rounding(model.initial_stress, mean);
    report.tractions.stage.push_back(stage);
    report.tractions.of_face.push_back(std::move(mean));
  }
  return report;
}

}  // namespace rockfold
