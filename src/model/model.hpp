// A model as the user means it: INTERFACE.md §2 in SI units, with names resolved to ids and
// defaults filled in. Nothing here is geometry yet; host/cut turns solids and joints into exact
// planes.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/types.hpp"

namespace rockfold {

/// Intact rock, concrete, … check_model.hpp says which commands need which constants.
struct Material {
  std::string name;
  Real density = 0;        ///< kg/m³, > 0; 0 = not given
  Real young_modulus = 0;  ///< Pa, > 0; 0 = neither it nor poisson_ratio is given
  Real poisson_ratio = 0;  ///< (−1, 0.5)
  Place place = {};        ///< where the model defines it, for messages of later stages
};

/// Mohr–Coulomb joint.
struct JointMaterial {
  std::string name;
  Real friction_angle = 0;               ///< deg, [0, 90)
  Real cohesion = 0;                     ///< Pa, ≥ 0
  Real tensile_strength = 0;             ///< Pa, ≥ 0
  std::optional<Real> normal_stiffness;  ///< Pa/m, > 0; default from the rock and the cover spacing
  std::optional<Real> shear_stiffness;   ///< Pa/m, > 0
};

/// Orientation by dip and dip direction in degrees.
struct DipOrientation {
  Real dip = 0;            ///< deg, [0, 90]
  Real dip_direction = 0;  ///< deg, clockwise from north (+y), [0, 360]
};

/// The orientation of a plane as given: by angles, or by a normal of any length, taken exactly.
using Orientation = std::variant<DipOrientation, Vec3>;

/// A plane as given: its orientation and a point on it.
struct GivenPlane {
  Orientation orientation;
  Vec3 point{};  ///< m
};

struct HalfSpace {
  GivenPlane plane;
  bool keep_above =
      true;  ///< the side that the upward normal points to (for a given normal: its own side)
};

struct BoxShape {
  Vec3 min{}, max{};  ///< m, min < max
};
struct HalfspacesShape {
  std::vector<HalfSpace> planes;  ///< their intersection
};
struct PrismShape {
  std::vector<Vec3> base;  ///< m; 3+ coplanar points, convex, either sense
  Vec3 extrude{};          ///< m; not in the base's plane
};
using Shape = std::variant<BoxShape, HalfspacesShape, PrismShape>;

/// The names of a shape's faces, in the order in which host/cut numbers them: box xmin xmax ymin
/// ymax zmin zmax; halfspaces "0", "1", … in the order of the planes; prism "0" … "n−1" the sides
/// in the order of the base's edges (side i holds the points i and i + 1), "n" the base, "n+1" the
/// far end.
std::vector<std::string> face_names(const Shape& shape);

/// The faces (into face_names) that a name means: one face, or a prism's group: "side" its sides,
/// "cap0" its base, "cap1" its far end. Empty if the shape has no such face.
std::vector<Index> faces_named(const Shape& shape, const std::string& name);

struct Solid {
  std::string name;
  bool add = true;  ///< block operation '+', else '−'
  Shape shape;
  Index material =
      0;  ///< into Model::materials (meaningless for '−'); none if the model has no material
  std::vector<bool> continues;  ///< [face_names(shape).size()] the rock goes on beyond this face
  Place place = {};
};

/// Parallel planes, all through-going.
struct JointSet {
  std::string name;
  Orientation orientation;
  Real spacing = 0;  ///< m along the normal, > 0
  Vec3 origin{};     ///< m, a point on one plane of the set
  std::optional<Index>
      count;           ///< that many planes, centred on origin; else all that meet the solids
  Index material = 0;  ///< into Model::joint_materials; none if the model has none
  Place place = {};
};

/// One through-going discontinuity.
struct Joint {
  std::string name;
  GivenPlane plane;
  Index material = 0;  ///< likewise
  Place place = {};
};

enum class JointTreatment {
  separate,  ///< each block has covers of its own (contact between them comes with issue "contact")
  welded,    ///< covers go on across joints: the mass deforms as one continuum
};

/// Mathematical cover: the thesis' tet6 lattice, order 0.
struct CoverSpec {
  Real spacing = 0;  ///< m, > 0
  /// Normals of the three plane families, mutually orthogonal; listed z, y, x as in INTERFACE.md:
  /// the last one is the lattice's first axis.
  std::array<DipOrientation, 3> directions{{{0, 0}, {90, 0}, {90, 90}}};
  std::optional<Vec3> origin;  ///< m, a lattice node; default the centre of the solids' box
  JointTreatment joints = JointTreatment::separate;
  Place place = {};
};

/// A region of the model to which a condition applies.
struct FaceRegion {
  Index solid = 0;
  std::vector<Index> faces;
};  ///< faces into face_names
struct BoxRegion {
  Vec3 min{}, max{};
};
struct PointRegion {
  Vec3 point{};
};
struct PlaneRegion {
  Vec3 point{};
  Vec3 normal{};
  Real tolerance = 0;
};  ///< |n·(x − point)| ≤ tolerance, n unit
struct BlockRegion {
  Vec3 point{};
};  ///< the block that holds this point
using Region = std::variant<FaceRegion, BoxRegion, PointRegion, PlaneRegion, BlockRegion>;

enum class FixMethod { penalty, augmented_lagrangian };

/// Essential boundary condition: displacement `value` in the chosen components.
struct Fixed {
  Region where;
  std::array<bool, 3> components{true, true, true};
  Vec3 value{};  ///< m
  FixMethod method = FixMethod::augmented_lagrangian;
  Place place = {};
};

struct PointLoad {
  Vec3 point{};  ///< m, in the rock
  Vec3 force{};  ///< N
  Place place = {};
};

enum class AnalysisType { static_, quasi_static, dynamic };

struct Analysis {
  AnalysisType type = AnalysisType::dynamic;
  Real time_step = 0.01;  ///< s, > 0
  /// s, of the last step: shorter where end_time is no multiple of time_step.
  std::optional<Real> last_time_step;
  Index steps = 100;         ///< resolved from `steps` or `end_time`; 1 for static
  Real dynamic_ratio = 1.0;  ///< [0, 1]: share of the velocity handed to the next step
  std::optional<Real> max_displacement_ratio;  ///< largest vertex displacement a step / model half
                                               ///< height, if limited
  Real newmark_beta = 0.25;                    ///< only average acceleration yet
  Real newmark_gamma = 0.5;
};

struct SolverSpec {
  Real tolerance = 1e-8;  ///< ‖r‖/‖b‖, (0, 1)
  Index max_iterations = 5000;
};

struct Output {
  Index every = 10;  ///< steps between stored states; 0 = first and last
};

struct Monitor {
  std::string name;
  Vec3 point{};  ///< m
  Place place = {};
};

struct SupportSpec {
  /// Only joints hold a block; if false, solid faces under a [[fixed]] face region hold it too.
  bool joint_faces_only = true;
  Real water_pressure = 0;             ///< Pa on joint faces, ≥ 0
  Vec3 seismic_coefficient{};          ///< fraction of g added to the resultant
  Real target_factor_of_safety = 1.5;  ///< > 0
};

struct Model {
  std::string title;
  Vec3 gravity{0, 0, -9.81};  ///< m/s²
  std::vector<Material> materials;
  std::vector<JointMaterial> joint_materials;
  std::vector<Solid> solids;
  std::vector<JointSet> joint_sets;
  std::vector<Joint> joints;
  std::optional<CoverSpec> cover;
  std::vector<Fixed> fixed;
  std::vector<PointLoad> point_loads;
  std::optional<Analysis> analysis;
  SolverSpec solver;
  Output output;
  std::vector<Monitor> monitors;
  std::optional<SupportSpec> support;

  std::string
      text;  ///< the model file as read, with overrides appended as comments; stored in results
  std::string path;  ///< as given on the command line; for messages
};

}  // namespace rockfold
