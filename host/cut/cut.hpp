// Exact block cutting: a model's solids and joints become a complex of convex cells, and its cells blocks.
// The geometry itself is host/cut/cells/complex.hpp.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "src/base/progress.hpp"
#include "src/base/stage_keys.hpp"
#include "src/base/types.hpp"
#include "src/model/model.hpp"

namespace rockfold {

struct Complex;  // complex.hpp

/// Where numbers were taken for what the user meant (docs/decisions/0005-exact-inside.md): before cutting, and after it.
struct IntentReport {
  Index planes_identified = 0;  ///< joints' planes that coincide with another given one to 1e-10
  Index edges_identified =
      0;  ///< edges of finite joints that lie on a given plane but for 1e-10 of the model's size
  Index corners_identified = 0;  ///< corners of finite joints nearer than that to another one
  Index slivers = 0;             ///< cells of rock narrower than 1e-9 of the model's size
  Index openings_closed = 0;     ///< areas of glue narrower than that, which join nothing
  Index doubts = 0;  ///< widths of cells and of glue within a factor 100 of it, on either side
  std::vector<std::string>
      identified;  ///< names of what coincides with another given plane (at most 20), sorted
  std::vector<std::string> near_planes;  ///< names of what doubts lie between (at most 20), sorted
  bool doubts_decide =
      false;  ///< blocks would be others if these widths were clearly narrow, or clearly wide
  Real least_doubt = 0;  ///< m: the least of these widths, 0 = none
  Vec3 doubt_at{};       ///< m: where it is
};

/// Of the mean block's volume: smaller blocks are specks where no cut.min_volume is given. A hundredth of its size: less than the
/// roughness of a joint of that length, so that whether such a block is there is more than a survey of joints says.
constexpr Real speck_share = 1e-6;

/// A block far smaller than the others that [cut] joined to a neighbour.
struct Speck {
  Index id = none;     ///< number of the block that it was, as with specks = "keep"
  Real volume = 0;     ///< m³
  Vec3 centroid{};     ///< m
  Index block = none;  ///< into which it went
};

/// What became of blocks below a volume, where [cut] says specks = "merge".
struct SpeckReport {
  Real limit = 0;               ///< m³: smaller blocks are specks
  bool limit_is_given = false;  ///< as cut.min_volume; else from the mean block
  std::vector<Speck> merged;    ///< by id
  std::vector<Index> left;      ///< blocks still below the limit: no neighbour may take them
};

struct CutTotals {
  Index cells = 0;
  Real solid_volume = 0;         ///< m³, of the solids before any joint cuts them
  Real joint_area = 0;           ///< m², joints inside the rock, each counted once
  Real dangling_joint_area = 0;  ///< m², of these with one block on both sides
  IntentReport intent;
  std::optional<SpeckReport> specks;  ///< none: specks are blocks as all others
};

struct Cutting {
  std::shared_ptr<const Complex> complex;
  CutTotals totals;
};

/// The rock before joints cut it.
struct UncutRock {
  enum class At : std::uint8_t { outside, excavated, stays };
  Real volume = 0;  ///< m³, of what is there as an analysis begins
  std::vector<At>
      of_point;  ///< [points] where each lies; on a boundary to 1e-9 of the model's size: in what stays
};

StageKeys keys_of_cutting();

/// A model that joints would cut into more blocks than this is asked about: hardly any site is meant so.
constexpr Real blocks_without_asking = 100'000;
/// Of a model that is not asked about.
constexpr Real any_number_of_blocks = std::numeric_limits<Real>::infinity();

/// Throws what cut_blocks would throw before joints cut the rock: of shapes, the placing of joints, merges, estimated cells and blocks.
UncutRock check_cutting(const Model& model, const std::vector<Vec3>& points,
                        Real most_blocks = any_number_of_blocks);

/// Cuts the model's solids by its joints. Throws Error(model) if no rock remains or the joints would make too many cells, or by an estimate
/// (block_forecast.hpp) more than `most_blocks`, with what to do about it.
/// Independent of the number of threads, bit for bit, and of the order of joints but for the last digits of areas: where
/// polygons of one plane overlap, the first listed is taken away from the others.
Cutting cut_blocks(const Model& model, Progress& progress, Real most_blocks = any_number_of_blocks);

}  // namespace rockfold
