// Drawings and tables that a command writes beside its result.
#pragma once

#include <string>
#include <vector>

#include "src/base/error.hpp"
#include "src/base/types.hpp"
#include "src/model/bolting_spec.hpp"

namespace rockfold {

struct Drawing {
  enum class Kind { stereonet, bolt_layout };
  Kind kind = Kind::stereonet;
  std::string file;         ///< .svg; a plain name, in the result's folder
  bool upper = false;       ///< hemisphere: lower is the default of mapping, upper of block theory
  bool equal_area = false;  ///< projection: else equal angle
  bool joint_pyramids = false;  ///< circles whole, regions coded 000 … 111
  bool poles = true;
  WallFaces on;  ///< bolt_layout; and the free planes of a stereonet's pyramids
  Place place = {}, place_of_file = {};
};

/// A table of comma-separated values.
struct TableFile {
  enum class Kind {
    blocks,
    keyblocks,
    bolts,
    bolt_crossings,
    pattern_search,
    classification,
    monitors,
    energy
  };
  Kind kind = Kind::keyblocks;
  /// Of the analysis over time; the others are of block theory and support design.
  bool is_history() const { return kind == Kind::monitors || kind == Kind::energy; }
  std::string file;  ///< .csv; likewise
  Place place = {}, place_of_file = {};
};

}  // namespace rockfold
