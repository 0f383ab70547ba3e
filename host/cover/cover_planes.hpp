// The planes of the cutting and of the lattice, and who decides where they nearly meet.
#pragma once

#include <optional>
#include <vector>

#include "host/exact/plane_table.hpp"

namespace rockfold {

/// A lattice means to meet rock to rounding or not at all. Where planes of it and of a cell of the complex miss by more, but by
/// little, arithmetic alone decides in that cell: the rules of intent, made for what users mean, would lose slivers of rock
/// (docs/decisions/0005-near-planes.md).
class CoverPlanes {
 public:
  explicit CoverPlanes(PlaneTable planes) : table(std::move(planes)) {}

  PlaneTable table;  ///< by the rules of intent

  /// What to ask about a cell of the complex.
  const PlaneTable& of(Index rock) const { return by_arithmetic(rock) ? *exact_ : table; }
  bool by_arithmetic(Index rock) const { return exact_ && by_arithmetic_[rock]; }
  /// For areas between two cells.
  bool by_arithmetic(Index rock, Index other) const {
    return by_arithmetic(rock) || by_arithmetic(other);
  }
  /// Null as long as no cell is decided by arithmetic.
  const PlaneTable* exact() const { return exact_ ? &*exact_ : nullptr; }

  /// `which`: [cells of the complex]
  void decide_by_arithmetic(std::vector<bool> which) {
    by_arithmetic_ = std::move(which);
    exact_.emplace(table);
    exact_->know_exactly();
  }
  /// Takes that back for one cell.
  void decide_by_intent(Index rock) { by_arithmetic_[rock] = false; }

 private:
  std::optional<PlaneTable> exact_;
  std::vector<bool> by_arithmetic_;
};

/// One Tool (a walker, a clipper) for the rules of intent and one for arithmetic.
template <class Tool>
class ToolPair {
 public:
  template <class Make>
  ToolPair(const CoverPlanes& planes, Make make) : intent_(make(planes.table)) {
    if (planes.exact() != nullptr) exact_.emplace(make(*planes.exact()));
  }
  Tool& get(bool by_arithmetic) { return by_arithmetic ? *exact_ : intent_; }

 private:
  Tool intent_;
  std::optional<Tool> exact_;
};

}  // namespace rockfold
