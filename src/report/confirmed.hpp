// Block theory beside motion: what it says of each key block, and what the block did in an analysis with contact.
#pragma once

#include <string>
#include <vector>

#include "src/report/documents/documents.hpp"

namespace rockfold {

/// How a block began to move.
enum class SeenMode { stays, sliding, falling, rotation };

/// A key block, a group that fails together, or a finite block that moved without being one.
struct Confirmed {
  const Keyblock* key = nullptr;  ///< what was predicted; null: that it stays
  const BlockSupport* support =
      nullptr;  ///< of a key block, where bolts or shotcrete hold it in the analysis too
  std::vector<Index> members;  ///< ascending
  Vec3 displacement{};         ///< m, from t = 0 to the end, mean of the volume
  Real rotation = 0;           ///< deg, likewise, of the member that has turned most
  SeenMode seen = SeenMode::stays;
  Vec3 direction{};  ///< unit, in which it began to move; 0 of what stays
  Real began = 0;    ///< s; NaN of what stays
  Real off = 0;  ///< deg between that direction and the one predicted; NaN where there are not both
  std::string reason;  ///< why not as predicted, most likely; empty where it agrees
  /// What was predicted counts loads that do not act in the analysis (water, seismic_coefficient).
  bool other_loads = false;
  bool agrees = false;  ///< as predicted: the mode, and the direction within 5°

  /// Predicted to stay, though it is a key block.
  bool is_held() const { return support && support->held.factor_of_safety >= 1; }
};

/// Key blocks in their order, then the others that moved, by id. The whole run counts, whatever displacements are reset.
std::vector<Confirmed> confirmed_motion(const RunReport& report);

constexpr const char* seen_name(SeenMode mode) {
  switch (mode) {
    case SeenMode::stays:
      return "none";
    case SeenMode::sliding:
      return "sliding";
    case SeenMode::falling:
      return "falling";
    case SeenMode::rotation:
      return "rotation";
  }
  return "";
}

}  // namespace rockfold
