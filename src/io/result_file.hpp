// Result files, NAME.vtkhdf: one HDF5 file that ParaView opens as it is and that holds all that the
// program knows of a run. What stands where (docs/result_file.md says it at length):
//
//   /VTKHDF                    what ParaView ≥ 5.13 reads: a VTKHDF 2.1 multi-block data set
//     Blocks, Joints           polygons of the blocks' faces and of the joints (PolyData)
//     DeadEnds                 polygons of the joints that end inside blocks (PolyData)
//     Elements                 the manifold elements as tetrahedra (UnstructuredGrid)
//     Bolts                    the pieces of steel of an analysis' bolts as lines (PolyData)
//     */PointData, */CellData  fields; those of the states are appended state by state, the mesh stands once
//     */Steps                  time of each state and where its values begin; absent without states
//   /xdmf                      what NAME.xdmf refers to, for ParaView 5.11, 5.12: a virtual data set a state and field
//   /rockfold                  the program's own data, in double precision
//     title, version, …        attributes: what made the file; totals as attributes of `totals`
//     model                    the model's text
//     blocks, covers           BlockArrays and CoverArrays, a data set for each array, under its name
//     block_theory             class, batch, mode, … of each block, if block theory was done
//     first_looks              FirstLookArrays: what the page does block theory again from, if it can be
//     energy                   time, kinetic, strain, … of every step
//     monitors/1, …            time, displacement, … of every step; attributes name, joint
//     contacts_history         time, open, stick, slide, … of every step
//     answer                   the JSON document of the command, without its blocks
//     run                      document: the whole one; origin: what the run was started with; of finished runs
//     states                   step, time, and displacement, velocity of the physical covers [S][P][3]
//
// All lengths in m, times in s, stresses in Pa, forces in N. The same input gives the same bytes:
// no dates, no host names. A file is written aside, as NAME.vtkhdf.partial-PID, closed after each
// state, and takes its name in finish().
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "src/arrays/block_arrays.hpp"
#include "src/arrays/bolt_arrays.hpp"
#include "src/arrays/contact_arrays.hpp"
#include "src/arrays/cover_arrays.hpp"
#include "src/arrays/element_arrays.hpp"
#include "src/arrays/first_look_arrays.hpp"
#include "src/arrays/polygon_mesh.hpp"
#include "src/base/error.hpp"
#include "src/io/history.hpp"
#include "src/io/run_journal.hpp"
#include "src/io/viewers/element_mesh.hpp"
#include "src/model/model.hpp"

namespace rockfold {

/// What made the file.
struct ResultHeader {
  std::string command;  ///< "cut", "support", "run"
  std::string version;  ///< of the program, "0.1.0"
  std::string commit;   ///< of its source, "" = unknown
};

/// What block theory says of each block, B long. In the file as numbers, with these meanings.
struct BlockFields {
  std::vector<std::uint8_t> block_class;  ///< [B] 0 infinite, 1 tapered, 2 stable, 3 key
  std::vector<Index> batch;               ///< [B] 1 moves first; 0 = not a key block
  std::vector<std::uint8_t> mode;         ///< [B] 0 none, 1 lifting, 2 single plane, 3 two planes
  std::vector<Real>
      factor_of_safety;             ///< [B] NaN where nothing resists or the block is no key block
  std::vector<Real> sliding_force;  ///< [B] N; 0 for others than key blocks
  std::vector<Real> support_force;  ///< [B] N; 0 likewise
  std::vector<Vec3> direction;      ///< [B] unit, of the motion; {0,0,0} likewise
  // Where the model has bolts or shotcrete, else empty.
  std::vector<Real> supported_factor_of_safety;  ///< [B] NaN likewise
  std::vector<Real> utilisation;  ///< [B] % of the capacity of its bolts; NaN without bolts
};

/// One state to store; nothing is kept of it after add_state().
struct ResultState {
  Index step = 0;                            ///< 0 = the start
  const StateArrays& covers;                 ///< time, and the motion of the P physical covers
  std::span<const Vec3> block_displacement;  ///< [V] m, at BlockArrays::vertex
  std::span<const Vec3> block_velocity;      ///< [V] m/s, likewise
  std::span<const std::array<Real, 6>>
      stress;  ///< [6R+E] Pa, xx yy zz xy yz zx of each element; may be empty
  std::span<const std::array<Real, 6>> block_stress = {};  ///< [B] Pa; empty where `stress` is
  std::span<const std::array<Real, 6>> nodal_stress =
      {};  ///< [K] Pa at the mesh's points; may be empty
  const std::vector<ContactSample>* contacts = nullptr;  ///< null: blocks do not touch each other
  std::uint64_t hash = 0;                                ///< of step, time and motion
  /// [B] 1: excavated on the way; empty where nothing goes in any state.
  std::span<const std::uint8_t> gone = {};
  const BoltLineState* bolts = nullptr;  ///< null without write_bolts
};

/// Writes one result file: the constructor, write_blocks, then for a `run` write_elements and
/// add_state as often as there are states, then finish. Every function throws Error(io), with the
/// file and the reason, where the disk is full, the folder cannot be written, ….
///
/// Space for a state is reserved before it is written: if add_state throws because the disk is
/// full, the states before it are whole, and finish() still gives them their final name. An older
/// file of that name stays as it is until then. Without finish() the destructor removes what was
/// written.
class ResultWriter {
 public:
  /// `path` is the final name, with .vtkhdf. Of the model the text, the title and the names are
  /// stored.
  ResultWriter(std::string path, const Model& model, const ResultHeader& header);
  ResultWriter(const ResultWriter&) = delete;
  ResultWriter& operator=(const ResultWriter&) = delete;
  ~ResultWriter();

  /// The blocks and the joints between them, drawn as `faces`: convex polygons of all faces;
  /// `fields` of block theory, if it was done (empty vectors = not).
  /// `flags`: bits of each block, 1 small volume, 2 elongated; [B], or empty where none were asked for.
  void write_blocks(const BlockArrays& blocks, const PolygonMesh& faces,
                    const BlockFields& fields = {}, const std::vector<std::uint8_t>& flags = {});

  /// What pages do block theory again from, once.
  void write_first_looks(const FirstLookArrays& looks);

  /// Lattice, covers and elements. `mesh` is that of the covers and must live as long as states are added.
  void write_elements(const CoverArrays& covers, const ElementMesh& mesh);

  /// Bolts of an analysis, as they are before it, once; before states.
  void write_bolts(const BoltLines& lines);

  /// Appends a state. Times must not decrease. After write_elements; all states have stress or none
  /// has.
  void add_state(const ResultState& state);

  /// What was recorded at every step, once: a group of /rockfold, "energy" or "monitors/1", for each history.
  void write_histories(const std::map<std::string, History>& groups);

  /// What the command answered, as its JSON document, once: what pages and reports tell of.
  void write_answer(const std::string& document);

  /// Of a run that came to its end, once: the whole document, and what the run was started with.
  void write_run(const std::string& document, const RunOrigin& origin);

  /// Gives the file its final name and writes NAME.xdmf beside it. Call it for interrupted runs
  /// too. Nothing can be written afterwards.
  void finish();

  const std::string& path() const;          ///< the final name
  const std::string& partial_path() const;  ///< where it is written until finish()
  Index state_count() const;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The small file for older readers that stands beside the result file `path`.
std::string xdmf_path(const std::string& path);

/// What a result file holds, for `rockfold info`.
struct ResultInfo {
  /// One data set of the file.
  struct Dataset {
    std::string path;                 ///< "/rockfold/blocks/volume"
    std::string type;                 ///< "float64", "int32", "string", …
    std::vector<std::int64_t> shape;  ///< empty = one value
    std::int64_t bytes = 0;           ///< on disk, compressed where it is
  };

  std::string title, command, version, commit, units;
  std::string model_text;

  std::int64_t blocks = 0, faces = 0, vertices = 0, joint_faces = 0;
  Real volume = 0;                                    ///< m³ of all blocks
  std::int64_t elements = 0, pieces = 0, covers = 0;  ///< 0 for `cut` and `support`
  bool block_theory = false;
  std::vector<Index> step;          ///< [S] stored states
  std::vector<Real> time;           ///< [S] s
  std::vector<std::uint64_t> hash;  ///< [S] of step, time and motion; empty in older files

  /// Of a run that is under way, or was interrupted or killed.
  struct Unfinished {
    std::string journal;       ///< its path
    Index checkpoint = 0;      ///< step that `resume` goes on from
    Real checkpoint_time = 0;  ///< s
  };
  std::optional<Unfinished> unfinished;

  std::int64_t file_bytes = 0;
  std::vector<Dataset> datasets;  ///< ordered by path; one with several names once; no virtual ones
};

/// Throws Error(io) where the file is missing, no HDF5, not one of ours, of a later format, or cut
/// short.
ResultInfo read_result_info(const std::string& path);

/// The document of a run that came to its end; nothing of other results. Throws as read_result_info does.
std::optional<std::string> read_run_document(const std::string& path);
/// What it was started with.
std::optional<RunOrigin> read_stored_origin(const std::string& path);

}  // namespace rockfold
