// A model as the user means it: docs/user_guide.md, The model file, in SI units, with names resolved to ids and
// defaults filled in. Nothing here is geometry yet; host/cut turns solids and joints into exact
// planes.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/arrays/lattice.hpp"
#include "src/arrays/load_arrays.hpp"
#include "src/base/error.hpp"
#include "src/base/types.hpp"
#include "src/model/bolting_spec.hpp"
#include "src/model/classification_spec.hpp"
#include "src/model/drawing_spec.hpp"

namespace rockfold {

/// Mohr–Coulomb strength of intact rock, with a tension cut-off.
struct MohrCoulombStrength {
  Real cohesion = 0;          ///< Pa, ≥ 0
  Real friction_angle = 0;    ///< deg, [0, 90)
  Real tensile_strength = 0;  ///< Pa, ≥ 0; at most cohesion / tan(friction_angle), the cone's apex
};

/// Hoek & Brown's (2002 edition): σ1 = σ3 + σ_ci (m_b σ3/σ_ci + s)^a, compression positive; tensile strength s σ_ci / m_b.
struct HoekBrownStrength {
  Real sigma_ci = 0;  ///< Pa, > 0, of intact rock in uniaxial compression
  Real m_b = 0;       ///< > 0
  Real s = 1;         ///< [0, 1]
  Real a = 0.5;       ///< [0.5, 1]
};

/// Intact rock, concrete, … check_model.hpp says which commands need which constants.
struct Material {
  std::string name;
  Real density = 0;        ///< kg/m³, > 0; 0 = not given
  Real young_modulus = 0;  ///< Pa, > 0; 0 = neither it nor poisson_ratio is given
  Real poisson_ratio = 0;  ///< (−1, 0.5)
  std::variant<std::monostate, MohrCoulombStrength, HoekBrownStrength> strength = {};
  Place place = {};  ///< where the model defines it, for messages of later stages
};

/// Mohr–Coulomb joint. Residual strength counts after the first slip; there is no tensile strength then, and no cohesion once it has opened.
struct JointMaterial {
  std::string name;
  Real friction_angle = 0;               ///< deg, [0, 90)
  Real cohesion = 0;                     ///< Pa, ≥ 0
  Real tensile_strength = 0;             ///< Pa, ≥ 0
  std::optional<Real> normal_stiffness;  ///< Pa/m, > 0; none: for the run to choose
  std::optional<Real> shear_stiffness;   ///< Pa/m, > 0; none: the normal one
  Real dilation_angle = 0;               ///< deg, [0, friction_angle]
  /// m of slip, > 0, up to which the joint dilates.
  Real dilation_limit = std::numeric_limits<Real>::infinity();
  /// deg, [0, friction_angle]; none: friction_angle
  std::optional<Real> residual_friction_angle = std::nullopt;
  Real residual_cohesion = 0;  ///< Pa, [0, cohesion]; a model's default is `cohesion`
  Place place = {};
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
  std::vector<Vec3> base;  ///< m; 3+ coplanar points, simple, may be concave, either sense
  Vec3 extrude{};          ///< m; not in the base's plane
};
struct PyramidShape {
  std::vector<Vec3> base;  ///< as a prism's
  Vec3 apex{};             ///< m; not in the base's plane
};
struct FrustumShape {
  std::vector<Vec3> base, top;  ///< m; as a prism's, convex, of the same length; planar sides
};
struct CylinderShape {
  std::array<Vec3, 2> axis{};  ///< m
  Real radius = 0;             ///< m, of the corners of the regular polygon that is its section
  Index sides = 32;
};
struct SphereShape {
  Vec3 center{};
  Real radius = 0;         ///< m, of the vertices: an icosahedron whose triangles are divided
  Index subdivisions = 2;  ///< times into four: 20·4^n triangles
};
struct TunnelShape {
  std::vector<Vec3> path;  ///< m, 2+ points; bends are mitred
  /// m; a simple polygon, counter-clockwise, seen along the path: x to the right (horizontal), y up;
  /// for a vertical segment x is east. The path runs through (0, 0).
  std::vector<std::array<Real, 2>> section;
};

/// A plane that a body's surface shares with the bodies that it touches.
struct SurfacePlane {
  Vec3 point{}, normal{};    ///< m; taken exactly
  bool inside_above = true;  ///< the body lies where the normal points
};
/// Triangles read from a file. Filled after the model is read (host/files).
struct TriangleSurface {
  std::vector<Vec3> vertices;                   ///< m
  std::vector<std::array<Index, 3>> triangles;  ///< counter-clockwise seen from outside (solids)
  Real last_digit = 0;  ///< m: what 1 in the last decimal of its coordinates means; 0 = not known
  /// Of a convex body that was fitted to its neighbours (host/files/bodies): their intersection is the body.
  /// Empty: it is what the triangles bound.
  std::vector<SurfacePlane> planes = {};
};
struct MeshShape {
  std::string file;  ///< OBJ, OFF, STL or PLY; resolved against the model's folder
  std::shared_ptr<const TriangleSurface> surface;
};
/// The rock between a base elevation and a ground surface of triangles over a regular or scattered
/// set of posts.
struct TerrainShape {
  std::string file;  ///< ESRI ASCII grid or XYZ; resolved against the model's folder
  Real base = 0;     ///< m, elevation of the flat bottom, below all posts
  std::shared_ptr<const TriangleSurface> ground;  ///< counter-clockwise seen from above
  std::vector<std::string> columns =
      {};  ///< what the columns of a table of posts are, where its heading does not say
};
using Shape = std::variant<BoxShape, HalfspacesShape, PrismShape, PyramidShape, FrustumShape,
                           CylinderShape, SphereShape, TunnelShape, MeshShape, TerrainShape>;

/// The names of a shape's faces, in the order in which host/cut numbers them: box xmin xmax ymin
/// ymax zmin zmax; halfspaces "0", "1", … in the order of the planes; prism and frustum "0" … "n−1"
/// the sides in the order of the base's edges (side i holds the points i and i + 1), "n" the base,
/// "n+1" the far end; pyramid likewise without a far end; cylinder and tunnel likewise, "n" where the
/// axis or path starts and "n+1" where it ends; sphere and mesh "0"; terrain xmin xmax ymin ymax zmin
/// and "top" (a boundary of scattered posts that is no rectangle belongs to the nearest of the four).
std::vector<std::string> face_names(const Shape& shape);

/// The faces (into face_names) that a name means: one face, or a group of any shape but box, halfspaces and terrain:
/// "side" its sides, "cap0" its base or start, "cap1" its far end. Empty if the shape has no such face.
std::vector<Index> faces_named(const Shape& shape, const std::string& name);

struct Solid {
  std::string name;
  bool add = true;  ///< block operation '+', else '−'
  Shape shape;
  Index material =
      0;  ///< into Model::materials (meaningless for '−'); none if the model has no material
  std::vector<bool> continues;  ///< [face_names(shape).size()] the rock goes on beyond this face
  /// Joint material of the solid's boundary where rock of another solid lies behind it; none = welded.
  Index interface = none;
  Place place = {};
};

/// A regular polygon's default number of sides (finite discs).
constexpr Index default_disc_sides = 16;

/// A positive quantity drawn at random. Values outside [min, max] are drawn again.
struct Distribution {
  enum class Kind { constant, exponential, log_normal, power_law };
  Kind kind = Kind::constant;
  Real mean = 0;  ///< constant, exponential, log-normal: of the values themselves, > 0
  Real standard_deviation = 0;  ///< log-normal: of the values themselves, > 0
  Real exponent = 0;            ///< power law: density ∝ x^−exponent on [min, max], > 0
  Real min = 0;                 ///< ≥ 0 (power law: > 0)
  Real max = std::numeric_limits<Real>::infinity();  ///< (power law: finite)
};

/// [joint_set.random]. Orientations scatter about the set's own by Fisher's distribution. Either planes or discs are
/// placed one spacing after another along the set's normal through its origin (`spacing`), or discs lie uniformly
/// (Baecher) with as many as an intensity or a count asks for. What is given decides: exactly one of spacing, p32, p10,
/// count.
struct RandomSet {
  std::uint64_t seed = 1;
  Real fisher_kappa = std::numeric_limits<Real>::infinity();  ///< > 0; infinite = no scatter
  std::optional<Distribution>
      radius;  ///< m; overrides JointSet::radius; none and no radius: planes (spacing only)
  std::optional<Distribution> spacing;  ///< m, between neighbours along the mean normal
  std::optional<Real> p32;              ///< m²/m³, disc area in the region over its volume, > 0
  std::optional<Real> p10;              ///< 1/m, mean crossings along `scanline`, > 0
  std::array<Vec3, 2> scanline{};       ///< m, with p10
  std::optional<Index> count;           ///< discs whose centres lie in the region
};

/// Parallel planes or discs.
struct JointSet {
  std::string name;
  Orientation orientation;
  Real spacing = 0;  ///< m along the normal, > 0; 0 with `random`, which says where they lie
  Vec3 origin{};     ///< m, a point on one plane of the set
  std::optional<Index>
      count;           ///< that many planes, centred on origin; else all that meet the solids
  Index material = 0;  ///< into Model::joint_materials; none if the model has none
  /// m; none = through-going. Else each plane carries one disc, centred where the line along the normal through `origin`
  /// meets it: a regular polygon inscribed in the circle, its first corner down the dip.
  std::optional<Real> radius;
  Index sides = default_disc_sides;  ///< ≥ 3
  Index within = none;               ///< into Model::solids: only inside that solid's shape
  std::optional<RandomSet> random;
  Place place = {};
};

/// One discontinuity.
struct Joint {
  std::string name;
  GivenPlane plane;
  Index material = 0;          ///< likewise
  std::optional<Real> radius;  ///< m; a disc about plane.point, as in a set
  Index sides = default_disc_sides;
  /// m; not empty: the polygon (simple, may be concave) after projection on the plane along its normal
  std::vector<Vec3> polygon;
  Index within = none;
  Place place = {};
};

/// Joints from a file of triangles: each triangle is a joint of its own plane to cut along.
struct JointMesh {
  std::string name;
  std::string file;  ///< OBJ, OFF, STL or PLY; resolved against the model's folder
  Index material = 0;
  Index within = none;
  /// deg: connected facets on a block that lie within this of their mean plane are one plane in block theory
  Real flatness = 5;
  std::shared_ptr<const TriangleSurface>
      surface;  ///< open or closed; filled after the model is read
  Place place = {};
};

/// Discs from a CSV file with the columns dip, dip_direction, x, y, z, radius and, if it likes, material.
struct JointTable {
  struct Row {
    DipOrientation orientation;
    Vec3 center{};
    Real radius = 0;  ///< m; infinite where the field is empty: through-going
    Index material = 0;
    std::string name = {};  ///< of the set or joint that the row names; empty: the table's
  };
  /// What a column of persistences, trace lengths, … says of the rows' discs.
  enum class Extent : std::uint8_t { from_columns, through_going };
  std::string name;
  std::string file;
  Index material = 0;      ///< of rows that name none
  bool left_hand = false;  ///< planes dip to the left of their strikes, if the table has strikes
  Extent extent = Extent::from_columns;
  Index sides = default_disc_sides;
  Index within = none;
  std::vector<Row> rows;  ///< filled after the model is read
  Place place = {};
};

/// Rock that is removed at a stage. Its boundary cuts blocks; the walls are free faces for block theory.
struct Excavation {
  std::string name;
  Index stage = 1;  ///< ≥ 1; where excavations overlap the earliest counts
  Shape shape;
  Place place = {};
};

/// An axis-aligned box of a condition or a merge.
struct BoxRegion {
  Vec3 min{}, max{};
};

/// Block operation '+' after cutting: joints inside the region become intact rock. A joint on the region's boundary
/// stays.
struct Merge {
  using Box = BoxRegion;
  struct InSolid {
    Index solid;
  };
  struct Blocks {
    std::vector<Vec3> points;  ///< the blocks that hold these points become one
  };
  std::variant<Box, InSolid, Blocks> region;
  Place place = {};
};

/// What becomes of blocks that are far smaller than the others.
enum class Specks : std::uint8_t {
  keep,  ///< blocks as all others
  merge  ///< each goes to the neighbour with which it shares most area
};

/// [cut]: limits and what the report of the cutting flags.
struct CutSpec {
  std::int64_t max_cells = 20'000'000;
  Place place_of_max_cells = {};   ///< no file: not given
  std::optional<Real> min_volume;  ///< m³; smaller blocks are flagged, or merged as specks
  Specks specks = Specks::keep;
  std::optional<Real> max_aspect_ratio;  ///< longest over shortest extent; larger ones are flagged
};

/// A line along which P10 and RQD are measured.
struct Scanline {
  std::string name;
  Vec3 from{}, to{};  ///< m
  Place place = {};
};

enum class JointTreatment {
  separate,  ///< each block has covers of its own, and touches others in contact
  welded,    ///< covers go on across joints: the mass deforms as one continuum
};

/// What becomes of a joint that ends inside a manifold element.
enum class JointTips : std::uint8_t {
  keep,   ///< the element stays one
  extend  ///< the joint is prolonged to the element's boundary and cuts it in two
};

/// Mathematical cover.
struct CoverSpec {
  LatticeKind lattice = LatticeKind::tet6;
  /// m, > 0: distance between the planes of each family along their common normal, in the order of `directions`.
  /// Lattice `block`: the unit of length of the cover functions along z, y, x; 0 = from the size of the blocks
  Vec3 spacing{};
  /// Normals of the three plane families, of which no two are nearly parallel; listed z, y, x as in a model file:
  /// the last one is the lattice's first axis.
  std::array<DipOrientation, 3> directions{{{0, 0}, {90, 0}, {90, 90}}};
  std::optional<Vec3> origin;  ///< m, a lattice node; default the centre of the solids' box
  int order = 0;               ///< of the cover functions: 0, 1, 2
  JointTreatment joints = JointTreatment::separate;
  JointTips joint_tips = JointTips::keep;
  Index max_elements = 50'000'000;
  Place place = {};
};

/// A region of the model to which a condition applies.
struct FaceRegion {
  Index solid = 0;           ///< into Model::solids, or excavations
  std::vector<Index> faces;  ///< into face_names
  bool of_excavation = false;

  bool holds(const FaceOrigin& origin) const {
    return origin.lies_on(
        of_excavation ? FaceOrigin::Kind::excavation : FaceOrigin::Kind::solid_face, solid, faces);
  }
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

enum class FixMethod {
  penalty,               ///< springs
  augmented_lagrangian,  ///< held exactly
  lagrange,              ///< the same
};

/// Essential boundary condition: displacement `value` in the chosen components.
struct Fixed {
  Region where;
  std::array<bool, 3> components{true, true, true};
  Vec3 value{};     ///< m
  TimeTable table;  ///< m; if not empty, instead of `value`
  FixMethod method = FixMethod::augmented_lagrangian;
  /// Pa/m of the springs (N/m for a point), > 0; default from the rock and the cover spacing.
  std::optional<Real> stiffness;
  Place place = {};
};

/// A stress on free faces (natural boundary condition).
struct Traction {
  Region where;           ///< a face, or the free faces that lie in a plane or a box
  bool pressure = false;  ///< along the inward normal, else a vector fixed in space
  bool follows = false;   ///< a pressure whose direction and area go with the deformed face
  Vec3 value{};           ///< Pa; a pressure is its x component
  TimeTable table;        ///< likewise; if not empty, instead of `value`
  /// Water up to this elevation: m from (0, 0, 0) against gravity. A pressure; instead of `value`.
  std::optional<Real> head;
  Real density = 1000;  ///< kg/m³, > 0, of that water
  Place place = {};
};

struct PointLoad {
  Vec3 point{};     ///< m, in the rock
  Vec3 force{};     ///< N
  TimeTable table;  ///< N; if not empty, instead of `force`
  Place place = {};
};

/// Faces that let waves out.
struct QuietBoundary {
  Region where;  ///< as of a traction
  Place place = {};
};

/// Rigid motion of blocks at t = 0.
struct InitialVelocity {
  std::optional<Vec3> block_at;  ///< m, in the block; none: all blocks
  Vec3 velocity{};               ///< m/s, of the blocks' common mass centre
  Vec3 angular_velocity{};       ///< rad/s about it
  Place place = {};
};

/// Motion of the ground that carries the fixed points (an earthquake's record).
struct BaseAcceleration {
  std::string
      file;  ///< CSV; resolved against the model's folder; empty: the table stands in the model
  Real scale = 1;                 ///< of the record, not yet applied
  std::optional<Vec3> direction;  ///< unit, of a record with one component
  std::optional<Real> unit;       ///< m/s², of the record's numbers; none: the file says it
  Index stage = 0;  ///< into Analysis::stages: the record's t = 0 is that stage's start
  TimeTable table;  ///< m/s²; of a file: filled after the model is read
  Place place = {};
};

enum class AnalysisType { static_, quasi_static, dynamic };

enum class Kinematics {
  small,  ///< linear strain about the place where the rock lay at t = 0
  large
};

/// How steps are taken in time. automatic: implicit, until steps are dear that way.
enum class Scheme : std::uint8_t { automatic, implicit, explicit_ };

/// One of the analyses that follow each other: [[step]], or all of [analysis] where there is none.
struct AnalysisStage {
  std::string name;
  AnalysisType type = AnalysisType::dynamic;
  Real time_step = 0.01;  ///< s, > 0
  /// s, of the last step: shorter where end_time is no multiple of time_step.
  std::optional<Real> last_time_step;
  Scheme scheme = Scheme::automatic;
  /// > 0, of a quasi-static stage by substeps: forces out of balance over those that act, of the block where this is largest.
  Real tolerance_of_balance = 1e-5;
  /// ≥ 0, of a dynamic stage by substeps: of all mass, what may be added to the blocks with the shortest ones.
  Real mass_scaling = 0;
  Index steps = 100;                ///< resolved from `steps` or `end_time`; 1 for static
  Real dynamic_ratio = 1.0;         ///< [0, 1]: share of the velocity handed to the next step
  bool reset_displacement = false;  ///< displacements and monitors count from its start
  bool seismic = false;             ///< SupportSpec::seismic_coefficient acts on all rock
  /// Stage of excavation whose rock goes at its start; 0: none, as in the first.
  Index excavate = 0;
  /// s since its start, and the share of the tractions on the excavation's walls that is gone by then; empty: by default.
  std::vector<std::array<Real, 2>> release = {};
  Place place = {};
  /// Of the velocity, to the next step.
  Real share_handed_on() const { return type == AnalysisType::quasi_static ? 0 : dynamic_ratio; }
};

struct Analysis {
  std::vector<AnalysisStage> stages{1};        ///< in their order, at least one
  std::optional<Real> max_displacement_ratio;  ///< largest vertex displacement a step / model half
                                               ///< height, if limited
  /// As given; none: large for dynamic and quasi_static, small for static.
  std::optional<Kinematics> kinematics;
  bool large() const {
    return kinematics ? *kinematics == Kinematics::large
                      : has(AnalysisType::dynamic) || has(AnalysisType::quasi_static);
  }
  bool has(AnalysisType type) const {
    return std::any_of(stages.begin(), stages.end(), [&](const auto& s) { return s.type == type; });
  }
  bool is_seismic() const {
    return std::any_of(stages.begin(), stages.end(), [](const auto& s) { return s.seismic; });
  }
  /// Of all stages.
  Index steps() const {
    Index sum = 0;
    for (const AnalysisStage& stage : stages) sum += stage.steps;
    return sum;
  }
  Real newmark_beta = 0.25;  ///< ≥ 1e-4
  Real newmark_gamma = 0.5;  ///< ≥ 0
  Real rayleigh_alpha = 0;   ///< 1/s, ≥ 0: damping α M …
  Real rayleigh_beta = 0;    ///< s, ≥ 0: … + β K
  Place place = {};
};

/// [contact]: of blocks that come apart at joints.
struct ContactSpec {
  /// Into Model::joint_materials, where faces meet that no joint joined; none if the model has none.
  Index material = 0;
  bool material_given = false;
  Index max_iterations = 40;  ///< open–close (Newton) iterations before the step is halved, ≥ 1
  Real restitution = 0;       ///< normal velocity after an impact over that before, [0, 1]
  Real max_penetration = 0;   ///< m; > 0: augmented Lagrangian until no point is deeper; 0: springs
  /// m, > 0: how far coordinates of mesh files may be off; none: from the digits that they are written with.
  std::optional<Real> tolerance = {};
  Place place = {};  ///< no file: not given
};

/// How bodies from mesh files were fitted together: corners on one point, faces that touch on one plane.
struct BodyFit {
  Real tolerance = 0;  ///< m, that of [contact], or from the files
  bool is_given = false;
  Index bodies = 0;       ///< that touch others
  Index convex = 0;       ///< of these, bounded by planes that they share with their neighbours
  Index contacts = 0;     ///< pairs of faces that became one plane
  Real largest_move = 0;  ///< m, of a corner
};

/// [[contact_pair]]: what two surfaces give wherever they meet.
struct ContactPair {
  Index between[2] = {none, none};  ///< joint materials, or surface_of_solid()
  Index material = none;            ///< into Model::joint_materials
};

struct SolverSpec {
  Real tolerance = 1e-8;  ///< ‖r‖/‖b‖, (0, 1)
  Index max_iterations = 5000;
  Preconditioner preconditioner = Preconditioner::automatic;
};

struct Output {
  Index every = 10;             ///< steps between stored states; 0 = first and last
  float checkpoint_every = 60;  ///< s of wall time, ≥ 0; 0 = after each step
  Index compression = 0;        ///< of the states' motion: deflate's level, 0 (none) to 9
};

/// [reduction]: by how much the joints' strength may be divided before the mass no longer comes to rest.
struct StrengthReduction {
  std::array<Real, 2> factors{0.2, 5};  ///< between which it is looked for, 0 < first < second
  Real tolerance = 0.01;                ///< to which it is found, > 0
  Real max_displacement = 0.1;  ///< of a block's size, > 0: the mass fails where one moves further
  Place place = {};
};

struct Monitor {
  std::string name;
  Vec3 point{};  ///< m
  /// Name of a joint of any kind, or "solid.interface", whose place nearest to the point is watched;
  /// empty: the rock at the point.
  std::string joint = {};
  Place place = {};
  bool is_of_rock() const { return joint.empty(); }
};

/// How high water stands in joints.
struct WaterPressure {
  Real value = 0;  ///< Pa, everywhere
};
/// Hydrostatic below a plane, by the depth along gravity.
struct WaterTable {
  Vec3 point{}, normal{};
};
/// Up to where the water would rise: m from (0, 0, 0) against gravity.
struct WaterHead {
  Real elevation = 0;
};

/// How the pressure goes on from where water stands in a joint to where the joint meets a free face that drains.
enum class WaterLaw : std::uint8_t {
  hydrostatic,  ///< by the depth below the level alone, to the very edge
  drained,      ///< zero at edges that drain
  mid_height,  ///< zero at both ends of the wet height, half its head in the middle (Hoek & Bray 1981)
};

/// [[water]]: water in joints. Pressures below zero are none.
struct Water {
  std::vector<std::string>
      joints;           ///< names of joints of any kind; empty = all that no other names
  Real density = 1000;  ///< kg/m³, > 0
  Real factor = 1;      ///< share of the pressure that stands in these joints, 0 … 1
  std::variant<WaterPressure, WaterTable, WaterHead> level;
  std::optional<bool> drains;   ///< whether free faces let the water out; none: by default
  std::optional<WaterLaw> law;  ///< none: by default
  /// How `level` changes over time, in x: Pa or m; `level` is that at t = 1 s. Empty: it stays.
  TimeTable course = {};
  /// m: in `run` the pressure on an area falls, as its joint opens, to nothing at this opening; none: it stays.
  std::optional<Real> drained_at;
  Place place = {};
};

/// Of [initial_stress] on joints: as it is far from openings, or as the rock around them passes it on.
enum class JointStress { elastic, far_field };

struct SupportSpec {
  /// Only joints hold a block; if false, solid faces under a [[fixed]] face region hold it too.
  bool joint_faces_only = true;
  Real water_pressure = 0;             ///< Pa on joint faces, ≥ 0
  Vec3 seismic_coefficient{};          ///< fraction of g added to the resultant
  Real target_factor_of_safety = 1.5;  ///< > 0
  /// Unit, of the support force on every block; none = the direction that needs the least force.
  std::optional<Vec3> support_direction;
  bool rotation = true;  ///< look for rotations about edges and corners too
  /// Blocks that may fail together where none of them can alone, ≥ 1.
  Index largest_group = 8;
  /// Batches that are looked for, after each stage; 0: until none is left. None given: 1 where the model has
  /// excavations, else 0.
  std::optional<Index> batches;
  Real smallest_block = 0;  ///< m³: tables leave smaller key blocks out
  JointStress stress = JointStress::far_field;
  /// Whether in-situ stress may make a block safer than without it.
  bool clamping = false;
};

/// [[block_theory.tunnel]]: a long, straight tunnel.
struct TheoryTunnel {
  std::string name;
  Real trend = 0;                            ///< deg of the axis, clockwise from north, [0, 360]
  Real plunge = 0;                           ///< deg below the horizontal, [0, 90)
  std::vector<std::array<Real, 2>> section;  ///< as TunnelShape's, seen along the axis
  Place place = {};
};

/// [[block_theory.slope]]: a long slope with a bench of its height.
struct TheorySlope {
  std::string name;
  DipOrientation face;
  DipOrientation upper;  ///< the ground behind the crest
  Real height = 0;       ///< m, from toe to crest, > 0
  Place place = {};
};

/// [block_theory.scan]: the same tunnels and slopes, turned.
struct TheoryScan {
  Real step = 10;                ///< deg, (0, 90]
  std::vector<Real> plunges{0};  ///< deg, of the tunnel axes
};

/// [block_theory.monte_carlo]: tunnels in rock whose joints are drawn at random.
struct MonteCarloSpec {
  Index realisations = 1000;
  std::uint64_t seed = 1;
  Real length = 10;  ///< m of tunnel looked at in each
  /// m to the sides, up and down from the section's origin within which apexes are looked for;
  /// default five times the section's extent.
  std::optional<Real> reach;
  Real friction_deviation = 0;  ///< deg, standard deviation of each set's friction angle
  Real cohesion_variation = 0;  ///< coefficient of variation of each set's cohesion
  Real confidence = 0.95;       ///< of the bounds, (0, 1)
  Place place = {};
};

/// [block_theory]: what the joint sets alone say, without a cut model.
struct TheorySpec {
  Index material = 0;  ///< into Model::materials
  std::vector<TheoryTunnel> tunnels;
  std::vector<TheorySlope> slopes;
  std::optional<TheoryScan> scan;
  std::optional<MonteCarloSpec> monte_carlo;
  Place place = {};
};

/// A key that stands in the model file.
struct GivenKey {
  std::string path;  ///< "traction.value": without numbers, so once for all entries of a list
  Place place = {};  ///< of the first
  Index count = 1;
};

struct Model {
  std::string title;
  Vec3 gravity{0, 0, -9.81};  ///< m/s²
  std::vector<Material> materials;
  std::vector<JointMaterial> joint_materials;
  std::vector<Solid> solids;
  std::vector<JointSet> joint_sets;
  std::vector<Joint> joints;
  std::vector<JointMesh> joint_meshes;
  std::vector<JointTable> joint_tables;
  std::vector<Merge> merges;
  std::vector<Excavation> excavations;
  CutSpec cut;
  std::vector<Scanline> scanlines;
  std::optional<CoverSpec> cover;
  std::vector<Fixed> fixed;
  std::vector<Traction> tractions;
  std::vector<PointLoad> point_loads;
  std::vector<QuietBoundary> quiet_boundaries;
  std::vector<InitialVelocity> initial_velocities;
  InitialStress initial_stress;
  std::optional<BaseAcceleration> base_acceleration;
  std::optional<Analysis> analysis;
  ContactSpec contact;
  std::vector<ContactPair> contact_pairs;
  std::vector<Index> contact_solids;  ///< whose free faces contact pairs name
  std::optional<BodyFit> body_fit;    ///< where bodies from files touch each other
  SolverSpec solver;
  Output output;
  std::optional<StrengthReduction> reduction;
  std::vector<Monitor> monitors;
  std::optional<SupportSpec> support;
  std::vector<BoltType> bolt_types;
  std::vector<SpotBolt> bolts;
  std::vector<BoltPattern> bolt_patterns;
  std::optional<Shotcrete> shotcrete;
  std::optional<PatternSearch> pattern_search;
  std::optional<ClassificationSpec> classification;
  std::vector<Drawing> drawings;
  std::vector<TableFile> tables;
  std::vector<Water> waters;
  std::optional<TheorySpec> theory;

  std::string
      text;  ///< the model file as read, with overrides appended as comments; stored in results
  std::string path;                  ///< as given on the command line; for messages
  std::vector<Diagnostic> warnings;  ///< of reading: what is allowed and hardly meant
  std::vector<GivenKey> given;       ///< all keys, in the order of the file
};

/// Surfaces as contact tells them apart: joint materials, intact rock, and the free faces of solids that contact pairs name, in their order.
inline Index surface_of_solid(const Model& model, Index place) {
  return std::max<Index>(1, static_cast<Index>(model.joint_materials.size())) + 1 + place;
}

/// Whether blocks that joints cut apart touch each other in the analysis: large kinematics, in stages that take time. Between the
/// vertices of a face, which the lattice divides, surfaces are taken as plane: functions are of first order at most.
inline bool has_contact(const Model& model) {
  return model.cover && model.analysis && model.cover->joints == JointTreatment::separate &&
         model.cover->order <= 1 && model.cover->lattice != LatticeKind::tet5_mixed &&
         model.analysis->large() && !model.analysis->has(AnalysisType::static_);
}

}  // namespace rockfold
