#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <stdexcept>

#include <fcntl.h>
#include <unistd.h>

#include "src/io/hdf5/native_arrays.hpp"
#include "src/io/partial_file.hpp"
#include "src/io/result_file.hpp"
#include "src/io/viewers/block_mesh.hpp"
#include "src/io/viewers/element_mesh.hpp"
#include "src/io/viewers/stress_fields.hpp"
#include "src/io/viewers/vtkhdf.hpp"
#include "src/io/viewers/xdmf.hpp"

namespace rockfold {
namespace {

using hdf5::File;
using vtkhdf::Grid;

const std::string state_times = "/rockfold/states/time";

void expect(bool holds, const char* what) {
  if (!holds) throw std::invalid_argument(std::string("ResultWriter: ") + what);
}

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::io, what, Place{path, 0, 0, {}});
}

/// Single precision: what viewers draw need not be better.
template <typename T, std::size_t n>
std::vector<std::array<float, n>> single(std::span<const std::array<T, n>> values) {
  std::vector<std::array<float, n>> out(values.size());
  for (std::size_t i = 0; i < out.size(); ++i)
    for (std::size_t d = 0; d < n; ++d) out[i][d] = static_cast<float>(values[i][d]);
  return out;
}

/// values[index[i]] for each i, as float or with ids from 1 where T is Index.
template <typename To, typename From>
std::vector<To> gather(const std::vector<From>& values, const std::vector<Index>& index,
                       To shift = 0) {
  std::vector<To> out(index.size());
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = static_cast<To>(values[index[i]]) + shift;
  return out;
}

std::vector<Index> from_one(std::vector<Index> ids) {
  for (Index& id : ids) ++id;
  return ids;
}

/// Bytes on their way to the disk survive a crash of the machine after this.
void synchronize(const std::string& path, const std::string& shown_as) {
  const int file = open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool done = file >= 0 && fsync(file) == 0;
  const int error = errno;
  if (file >= 0) close(file);
  if (!done && error != EINVAL && error != EROFS)
    fail(shown_as, std::string("cannot write: ") + std::strerror(error));
}

void write_text_file(const std::string& path, const std::string& text) {
  PartialFile file(path);
  std::ofstream out(file.aside(), std::ios::binary);
  out << text;
  out.close();
  if (!out) fail(path, std::string("cannot write: ") + std::strerror(errno));
  file.take_name();
}

}  // namespace

struct ResultWriter::Implementation {
  PartialFile target;
  bool finished = false;
  bool damaged = false;  ///< a state was written in part
  bool with_stress = false, with_nodal_stress = false;
  bool with_blocks = false;
  std::size_t block_count = 0, block_vertices = 0, unknowns = 0, elements = 0;
  std::vector<Index> polygon_block, polygon_material;  ///< [cells of Blocks]
  std::vector<Index> joint_vertex;  ///< [points of Joints] into BlockArrays::vertex
  std::vector<Index> joint_block;   ///< [cells of Joints]
  unsigned compression = 0;         ///< of states
  const ElementMesh* mesh = nullptr;
  std::vector<Index> point_material;  ///< [K] of the mesh's points
  StressFields stresses;
  std::vector<Grid> grids;
  std::vector<Real> times;

  Implementation(std::string path, const Model& model)
      : target(std::move(path)),
        compression(static_cast<unsigned>(model.output.compression)),
        stresses(model.materials) {}
  File extend() const { return {target.aside(), File::Mode::extend, target.path()}; }
  /// Adds what belongs to no state: a signal in between finds the states that were whole before.
  template <typename Write>
  void extend_at_once(Write write) {
    const SignalsWait until_it_is_written;
    const bool states = !times.empty() && !damaged;
    target.set_worth_keeping(false);
    File file = extend();
    write(file);
    file.close();
    target.set_worth_keeping(states);
  }
  std::int64_t bytes_of(const ResultState& state) const;
  void append_grids(File& file, const ResultState& state, std::int64_t number);
  void append_bolts(File& file, Grid& grid, const BoltLineState& bolts, std::int64_t number);
  void append_element_stress(File& file, Grid& grid, const ResultState& state, std::int64_t number);
  void write_block_grid(File& file, const BlockArrays& blocks, const BlockFields& fields,
                        const std::vector<std::uint8_t>& flags, const PolygonMesh& mesh);
  void write_dead_end_grid(File& file, const BlockArrays& blocks);
  void write_joint_grid(File& file, const BlockArrays& blocks, const PolygonMesh& mesh);
};

ResultWriter::ResultWriter(std::string path, const Model& model, const ResultHeader& header)
    : implementation_(std::make_unique<Implementation>(std::move(path), model)) {
  auto& my = *implementation_;
  const std::string& name = my.target.path();
  if (std::filesystem::is_directory(name)) fail(name, "cannot write: it is a folder");
  my.target.set_companion(xdmf_path(name));
  File file(my.target.aside(), File::Mode::create, name);
  vtkhdf::write_root(file);
  write_origin(file, model, header);
  file.close();
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::Implementation::write_block_grid(File& file, const BlockArrays& blocks,
                                                    const BlockFields& fields,
                                                    const std::vector<std::uint8_t>& flags,
                                                    const PolygonMesh& faces) {
  Grid grid = vtkhdf::write_polygons(file, "Blocks", static_cast<int>(grids.size()), blocks.vertex,
                                     faces.polygon_begin, faces.polygon_vertex);
  const std::vector<Index> block = gather<Index>(block_of_face(blocks), faces.polygon_face);
  polygon_block = block;
  polygon_material = gather<Index>(blocks.material, block);
  vtkhdf::write_cell_field(file, grid, "block", from_one(block));
  vtkhdf::write_cell_field(file, grid, "origin",
                           gather<Index>(blocks.face_origin, faces.polygon_face, 1));
  vtkhdf::write_cell_field(file, grid, "material", gather<Index>(blocks.material, block, 1));
  vtkhdf::write_cell_field(file, grid, "finite", gather<std::uint8_t>(blocks.finite, block));
  vtkhdf::write_cell_field(file, grid, "volume", gather<float>(blocks.volume, block));
  const auto goes = [](Index stage) { return stage != 0; };
  if (std::any_of(blocks.stage.begin(), blocks.stage.end(), goes))
    vtkhdf::write_cell_field(file, grid, "stage", gather<Index>(blocks.stage, block));
  if (!flags.empty())
    vtkhdf::write_cell_field(file, grid, "flags", gather<std::uint8_t>(flags, block));
  if (!fields.block_class.empty()) {
    vtkhdf::write_cell_field(file, grid, "class", gather<std::uint8_t>(fields.block_class, block));
    vtkhdf::write_cell_field(file, grid, "batch", gather<Index>(fields.batch, block));
    vtkhdf::write_cell_field(file, grid, "mode", gather<std::uint8_t>(fields.mode, block));
    vtkhdf::write_cell_field(file, grid, "factor_of_safety",
                             gather<float>(fields.factor_of_safety, block));
    vtkhdf::write_cell_field(file, grid, "sliding_force",
                             gather<float>(fields.sliding_force, block));
    vtkhdf::write_cell_field(file, grid, "support_force",
                             gather<float>(fields.support_force, block));
    if (!fields.supported_factor_of_safety.empty()) {
      vtkhdf::write_cell_field(file, grid, "supported_factor_of_safety",
                               gather<float>(fields.supported_factor_of_safety, block));
      vtkhdf::write_cell_field(file, grid, "utilisation", gather<float>(fields.utilisation, block));
    }
  }
  grids.push_back(std::move(grid));
}

/// Only the vertices that joints use are points of theirs.
void ResultWriter::Implementation::write_joint_grid(File& file, const BlockArrays& blocks,
                                                    const PolygonMesh& joints) {
  std::vector<Index> point(blocks.vertex.size(), none), connectivity;
  connectivity.reserve(joints.polygon_vertex.size());
  for (const Index v : joints.polygon_vertex) {
    if (point[v] == none) {
      point[v] = static_cast<Index>(joint_vertex.size());
      joint_vertex.push_back(v);
    }
    connectivity.push_back(point[v]);
  }
  std::vector<Vec3> points;
  points.reserve(joint_vertex.size());
  for (const Index v : joint_vertex) points.push_back(blocks.vertex[v]);
  Grid grid = vtkhdf::write_polygons(file, "Joints", static_cast<int>(grids.size()), points,
                                     joints.polygon_begin, connectivity);
  vtkhdf::write_cell_field(file, grid, "joint",
                           gather<Index>(blocks.face_origin, joints.polygon_face, 1));
  joint_block = gather<Index>(block_of_face(blocks), joints.polygon_face);
  vtkhdf::write_cell_field(file, grid, "block", from_one(joint_block));
  grids.push_back(std::move(grid));
}

/// Each dead end once. Its points belong to no block's vertices, so it has no motion of its own.
void ResultWriter::Implementation::write_dead_end_grid(File& file, const BlockArrays& blocks) {
  std::vector<Index> connectivity(blocks.dead_end_vertex.size());
  std::iota(connectivity.begin(), connectivity.end(), 0);
  Grid grid =
      vtkhdf::write_polygons(file, "DeadEnds", static_cast<int>(grids.size()),
                             blocks.dead_end_vertex, blocks.dead_end_corner_begin, connectivity);
  vtkhdf::write_cell_field(file, grid, "joint", from_one(blocks.dead_end_origin));
  vtkhdf::write_cell_field(file, grid, "block", from_one(blocks.dead_end_block));
  grids.push_back(std::move(grid));
}

void ResultWriter::write_blocks(const BlockArrays& blocks, const PolygonMesh& faces,
                                const BlockFields& fields, const std::vector<std::uint8_t>& flags) {
  auto& my = *implementation_;
  expect(!my.finished && !my.with_blocks && my.times.empty(),
         "write_blocks comes once, before states");
  expect(fields.block_class.empty() || fields.block_class.size() == blocks.volume.size(),
         "BlockFields are not [B]");
  expect(flags.empty() || flags.size() == blocks.volume.size(), "flags are not [B]");
  File file = my.extend();
  write_block_arrays(file, blocks);
  if (!fields.block_class.empty()) write_block_theory(file, fields);
  if (!flags.empty()) file.write("/rockfold/blocks/flags", flags);
  if (faces.size() > 0) my.write_block_grid(file, blocks, fields, flags, faces);
  const PolygonMesh joints = joint_polygons(blocks, faces);
  if (joints.size() > 0) my.write_joint_grid(file, blocks, joints);
  if (!blocks.dead_end_block.empty()) my.write_dead_end_grid(file, blocks);
  const bool same =
      faces.size() > 0 && faces.polygon_vertex == blocks.corner_vertex;  // no face was triangulated
  const std::string native = "/rockfold/blocks/", drawn = "/VTKHDF/Blocks/";
  if (faces.size() > 0)
    file.hard_link(drawn + "Points", native + "vertex");
  else
    file.write(native + "vertex", blocks.vertex);
  if (same) {
    file.hard_link(drawn + "Polygons/Offsets", native + "corner_begin");
    file.hard_link(drawn + "Polygons/Connectivity", native + "corner_vertex");
  } else {
    file.write(native + "corner_begin", blocks.corner_begin);
    file.write(native + "corner_vertex", blocks.corner_vertex);
  }
  file.close();
  my.with_blocks = true;
  my.block_vertices = blocks.vertex.size();
  my.block_count = blocks.volume.size();
}

void ResultWriter::write_first_looks(const FirstLookArrays& looks) {
  expect(!implementation_->finished, "first looks come before finish");
  File file = implementation_->extend();
  rockfold::write_first_looks(file, looks);
  file.close();
}

void ResultWriter::write_elements(const CoverArrays& covers, const ElementMesh& mesh) {
  auto& my = *implementation_;
  expect(!my.finished && my.unknowns == 0 && my.times.empty(),
         "write_elements comes once, before states");
  File file = my.extend();
  my.mesh = &mesh;
  write_cover_arrays(file, covers);
  if (!mesh.tetrahedron.empty()) {
    Grid grid = vtkhdf::write_tetrahedra(file, "Elements", static_cast<int>(my.grids.size()), mesh);
    vtkhdf::write_cell_field(file, grid, "element", from_one(mesh.element));
    vtkhdf::write_cell_field(file, grid, "block", from_one(mesh.block));
    vtkhdf::write_cell_field(file, grid, "material", from_one(mesh.material));
    my.grids.push_back(std::move(grid));
  }
  file.close();
  my.unknowns = static_cast<std::size_t>(covers.unknown_count());
  my.elements = static_cast<std::size_t>(covers.element_count());
  my.point_material.resize(mesh.point_count());
  for (std::size_t t = 0; t < mesh.tetrahedron.size(); ++t)
    for (const Index k : mesh.tetrahedron[t]) my.point_material[k] = mesh.material[t];
}

void ResultWriter::write_bolts(const BoltLines& lines) {
  auto& my = *implementation_;
  expect(!my.finished && my.times.empty(), "write_bolts comes before states");
  if (lines.steel.empty()) return;
  File file = my.extend();
  Grid grid = vtkhdf::write_lines(file, "Bolts", static_cast<int>(my.grids.size()), lines.node,
                                  lines.steel);
  vtkhdf::write_cell_field(file, grid, "bolt", from_one(lines.bolt));
  my.grids.push_back(std::move(grid));
  file.close();
}

/// All that a state adds to the file, with room for the entries in HDF5's own tables.
std::int64_t ResultWriter::Implementation::bytes_of(const ResultState& state) const {
  const auto points = 2 * (block_vertices + joint_vertex.size() + mesh->point_count());
  const auto native = static_cast<std::int64_t>(2 * unknowns * sizeof(Vec3) +
                                                state.block_stress.size() * 6 * sizeof(Real)) +
                      (state.contacts ? contact_bytes() * std::ssize(*state.contacts) : 0);
  const auto stress = [&](const auto& of, std::size_t rows) {
    return of.empty() ? 0 : stresses.state_bytes(rows);
  };
  return native + vtkhdf::state_bytes(points, 3) + stress(state.stress, mesh->element.size()) +
         stress(state.nodal_stress, mesh->point_count()) +
         stress(state.block_stress, polygon_block.size()) +
         (state.gone.empty() ? 0 : std::ssize(polygon_block) + std::ssize(joint_block)) +
         (state.bolts ? vtkhdf::state_bytes(state.bolts->displacement.size(), 3) +
                            vtkhdf::state_bytes(state.bolts->force.size(), 3)
                      : 0);
}

/// Stress of the elements, and its mean at their points.
void ResultWriter::Implementation::append_element_stress(File& file, Grid& grid,
                                                         const ResultState& state,
                                                         std::int64_t number) {
  if (!state.stress.empty())
    stresses.append(file, grid, {false, "", state.stress, mesh->element, mesh->material}, number);
  if (!state.nodal_stress.empty())
    stresses.append(file, grid, {true, "nodal_", state.nodal_stress, {}, point_material}, number);
}

void ResultWriter::Implementation::append_bolts(File& file, Grid& grid, const BoltLineState& bolts,
                                                std::int64_t number) {
  const auto to_float = [](const std::vector<Real>& values) {
    return std::vector<float>(values.begin(), values.end());
  };
  std::vector<std::uint8_t> status;
  for (const BoltStatus s : bolts.status) status.push_back(static_cast<std::uint8_t>(s));
  vtkhdf::append_point_field(file, grid, "displacement", number,
                             single(std::span<const Vec3>(bolts.displacement)));
  vtkhdf::append_cell_field(file, grid, "force", number, to_float(bolts.force));
  vtkhdf::append_cell_field(file, grid, "mobilisation", number, to_float(bolts.mobilisation));
  vtkhdf::append_cell_field(file, grid, "status", number, status);
}

void ResultWriter::Implementation::append_grids(File& file, const ResultState& state,
                                                std::int64_t number) {
  const auto displacement = single(state.block_displacement),
             velocity = single(state.block_velocity);
  for (Grid& grid : grids) {
    if (grid.name == "Elements") {
      vtkhdf::append_point_field(file, grid, "displacement", number,
                                 interpolate(*mesh, state.covers.displacement));
      vtkhdf::append_point_field(file, grid, "velocity", number,
                                 interpolate(*mesh, state.covers.velocity));
      append_element_stress(file, grid, state, number);
      continue;
    }
    if (grid.name == "DeadEnds") continue;
    if (grid.name == "Bolts") {
      append_bolts(file, grid, *state.bolts, number);
      continue;
    }
    if (grid.name == "Blocks" && !state.block_stress.empty())
      stresses.append(file, grid, {false, "", state.block_stress, polygon_block, polygon_material},
                      number);
    const bool joints = grid.name == "Joints";
    if (!state.gone.empty())
      vtkhdf::append_cell_field(
          file, grid, "excavated", number,
          gather<std::uint8_t>(std::vector(state.gone.begin(), state.gone.end()),
                               joints ? joint_block : polygon_block));
    const auto of_joints = [&](const auto& values) {
      std::vector<std::array<float, 3>> out;
      for (const Index v : joint_vertex) out.push_back(values[v]);
      return out;
    };
    vtkhdf::append_point_field(file, grid, "displacement", number,
                               joints ? of_joints(displacement) : displacement);
    vtkhdf::append_point_field(file, grid, "velocity", number,
                               joints ? of_joints(velocity) : velocity);
  }
}

void ResultWriter::add_state(const ResultState& state) {
  auto& my = *implementation_;
  expect(!my.finished && my.with_blocks && my.unknowns > 0,
         "add_state comes after write_blocks and write_elements");
  expect(state.block_displacement.size() == my.block_vertices &&
             state.block_velocity.size() == my.block_vertices,
         "block displacement and velocity are not [V]");
  expect(state.covers.displacement.size() == my.unknowns &&
             state.covers.velocity.size() == my.unknowns &&
             state.covers.acceleration.size() == my.unknowns,
         "the state is not [U]");
  expect(state.stress.empty() || state.stress.size() == my.elements, "stress is not [nR+E]");
  expect(state.block_stress.empty() || state.block_stress.size() == my.block_count,
         "block stress is not [B]");
  expect(state.nodal_stress.empty() || state.nodal_stress.size() == my.mesh->point_count(),
         "nodal stress is not [K]");
  expect(my.times.empty() ||
             (state.covers.time >= my.times.back() && my.with_stress == !state.stress.empty() &&
              my.with_nodal_stress == !state.nodal_stress.empty()),
         "time runs backwards, or stress comes and goes");
  const auto lines = std::find_if(my.grids.begin(), my.grids.end(),
                                  [](const Grid& grid) { return grid.name == "Bolts"; });
  expect(lines == my.grids.end() ||
             (state.bolts && std::ssize(state.bolts->displacement) == lines->points &&
              std::ssize(state.bolts->force) == lines->cells),
         "bolts are not those of write_bolts");
  if (my.damaged) fail(my.target.path(), "cannot write: an earlier state was written in part");
  const SignalsWait until_it_is_written;
  File file = my.extend();
  file.deflate_growing(my.compression);
  file.reserve(my.bytes_of(state));
  my.damaged = true;
  my.target.set_worth_keeping(false);
  const auto number = static_cast<std::int64_t>(my.times.size());
  append_state(file, state.step, state.covers);
  const auto hash = static_cast<std::int64_t>(state.hash);
  file.append("/rockfold/states/hash", std::span<const std::int64_t>(&hash, 1));
  if (state.contacts) append_contacts(file, *state.contacts);
  if (!state.block_stress.empty())
    file.append_entry<std::array<Real, 6>>("/rockfold/states/block_stress", state.block_stress);
  my.append_grids(file, state, number);
  vtkhdf::append_step(file, my.grids, state_times, number);
  file.close();
  my.damaged = false;
  my.target.set_worth_keeping(true);
  my.with_stress = !state.stress.empty();
  my.with_nodal_stress = !state.nodal_stress.empty();
  my.times.push_back(state.covers.time);
}

void ResultWriter::write_histories(const std::map<std::string, History>& groups) {
  auto& my = *implementation_;
  expect(!my.finished, "histories come before finish");
  for (const auto& [group, history] : groups)
    for (const auto& column : history.columns)
      expect(column.values.size() == history.time.size() * static_cast<std::size_t>(column.width),
             "a column is not as long as its times");
  my.extend_at_once([&](File& file) {
    for (const auto& [group, history] : groups) write_history(file, "/rockfold/" + group, history);
  });
}

void ResultWriter::write_answer(const std::string& document) {
  expect(!implementation_->finished, "the answer comes before finish");
  implementation_->extend_at_once([&](File& file) {
    file.write("/rockfold/answer", std::vector<std::uint8_t>(document.begin(), document.end()));
  });
}

void ResultWriter::write_run(const std::string& document, const RunOrigin& origin) {
  expect(!implementation_->finished, "the run comes before finish");
  implementation_->extend_at_once([&](File& file) {
    file.write("/rockfold/run/document",
               std::vector<std::uint8_t>(document.begin(), document.end()));
    std::vector<std::uint8_t> bytes;
    for (const std::byte b : packed(origin)) bytes.push_back(static_cast<std::uint8_t>(b));
    file.write("/rockfold/run/origin", bytes);
  });
}

void ResultWriter::finish() {
  auto& my = *implementation_;
  expect(!my.finished, "finish comes once");
  const std::string& name = my.target.path();
  if (my.damaged) fail(name, "cannot be finished: a state was written in part");
  synchronize(my.target.aside(), name);
  my.target.take_name();
  my.finished = true;
  const std::filesystem::path path(name);
  synchronize(path.has_parent_path() ? path.parent_path().string() : ".", name);
  if (!my.grids.empty())
    write_text_file(xdmf_path(name), xdmf_text(path.filename().string(), my.grids, my.times));
}

std::string xdmf_path(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".xdmf").string();
}

const std::string& ResultWriter::path() const {
  return implementation_->target.path();
}
const std::string& ResultWriter::partial_path() const {
  return implementation_->target.aside();
}
Index ResultWriter::state_count() const {
  return static_cast<Index>(implementation_->times.size());
}

}  // namespace rockfold
