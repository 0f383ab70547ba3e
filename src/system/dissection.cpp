#include "src/system/dissection.hpp"

#include <algorithm>
#include <utility>

namespace rockfold::solve {
namespace {

class Dissection {
 public:
  Dissection(const std::vector<Index>& begin, const std::vector<Index>& column)
      : begin_(begin), column_(column), level_(begin.size() - 1, none), part_(level_.size(), 0) {}

  std::vector<Index> run() {
    std::vector<Index> all(level_.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<Index>(i);
    std::vector<std::vector<Index>> open;
    open.push_back(std::move(all));
    // From the end: what divides a part comes after it.
    while (!open.empty()) {
      std::vector<Index> rows = std::move(open.back());
      open.pop_back();
      if (rows.empty()) continue;
      if (rows.size() <= small) {
        order_.insert(order_.end(), rows.begin(), rows.end());
        continue;
      }
      divide(rows, open);
    }
    std::reverse(order_.begin(), order_.end());
    return std::move(order_);
  }

 private:
  static constexpr std::size_t small = 24;  ///< rows that are not divided

  /// Breadth first from `from` within the part of its rows: those met, by level.
  std::vector<Index> levels_from(Index from, Index part) {
    std::vector<Index> met{from};
    level_[from] = 0;
    for (std::size_t at = 0; at < met.size(); ++at)
      for (Index m = begin_[met[at]]; m < begin_[met[at] + 1]; ++m)
        if (const Index j = column_[m]; part_[j] == part && level_[j] == none) {
          level_[j] = level_[met[at]] + 1;
          met.push_back(j);
        }
    return met;
  }

  /// Puts the level in the midst of a part last, and what is left of it on both sides among the open ones.
  void divide(const std::vector<Index>& rows, std::vector<std::vector<Index>>& open) {
    const Index part = ++parts_;
    for (const Index i : rows) part_[i] = part, level_[i] = none;
    std::vector<Index> met = levels_from(rows.front(), part);
    if (met.size() < rows.size()) {  // another piece
      std::vector<Index> rest;
      for (const Index i : rows)
        if (level_[i] == none) rest.push_back(i);
      open.push_back(std::move(rest));
      open.push_back(std::move(met));
      return;
    }
    for (const Index i : rows) level_[i] = none;
    met = levels_from(met.back(), part);  // from its end
    const Index middle = level_[met[met.size() / 2]];
    std::vector<Index> before, after;
    for (const Index i : met) {
      if (level_[i] < middle)
        before.push_back(i);
      else if (level_[i] > middle)
        after.push_back(i);
      else
        order_.push_back(i);
    }
    open.push_back(std::move(before));
    open.push_back(std::move(after));
  }

  const std::vector<Index>&begin_, &column_;
  std::vector<Index> level_, part_, order_;
  Index parts_ = 0;
};

}  // namespace

std::vector<Index> dissect(const std::vector<Index>& begin, const std::vector<Index>& column) {
  return Dissection(begin, column).run();
}

}  // namespace rockfold::solve
