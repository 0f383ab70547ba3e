#include "host/direct/front_tree.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>

namespace rockfold::host {
namespace {

/// Share of a front's entries that may be zeros taken in to make it wider.
constexpr double most_zeros = 0.15;
/// Fronts narrower than this (unknowns) take in any child that comes right before them.
constexpr Index narrow = 24;

/// The places of rows in an order of little fill.
std::vector<Index> order_rows(const BlockMatrix& a) {
  using Pattern = Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>;
  const Index n = a.rows();
  const std::vector<Real> ones(a.column.size(), 1);
  const Eigen::Map<const Pattern> pattern(n, n, static_cast<Index>(a.column.size()), a.begin.data(),
                                          a.column.data(), ones.data());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, Index> order;
  Eigen::AMDOrdering<Index>()(Pattern(pattern).selfadjointView<Eigen::Upper>(), order);
  // order.indices()[k]: the row that is eliminated as the k-th
  std::vector<Index> place(n);
  for (Index k = 0; k < n; ++k) place[order.indices()[k]] = k;
  return place;
}

/// Rows in the order, and for each the columns before it.
struct Lower {
  std::vector<Index> begin, column;
};

Lower lower_half(const BlockMatrix& a, const std::vector<Index>& place) {
  const Index n = a.rows();
  Lower half{std::vector<Index>(n + 1, 0), {}};
  const auto for_each = [&](const auto& f) {
    for (Index i = 0; i < n; ++i)
      for (Index m = a.begin[i]; m < a.begin[i + 1]; ++m)
        if (place[a.column[m]] < place[i]) f(place[i], place[a.column[m]]);
  };
  for_each([&](Index i, Index) { ++half.begin[i + 1]; });
  std::partial_sum(half.begin.begin(), half.begin.end(), half.begin.begin());
  half.column.resize(half.begin[n]);
  std::vector<Index> at(half.begin.begin(), half.begin.end() - 1);
  for_each([&](Index i, Index j) { half.column[at[i]++] = j; });
  return half;
}

/// The elimination tree (Liu 1990).
std::vector<Index> elimination_tree(const Lower& half) {
  const Index n = static_cast<Index>(half.begin.size()) - 1;
  std::vector<Index> parent(n, none), above(n, none);
  for (Index i = 0; i < n; ++i)
    for (Index m = half.begin[i]; m < half.begin[i + 1]; ++m)
      for (Index j = half.column[m], next; j != none && j < i; j = next) {
        next = above[j];
        above[j] = i;
        if (next == none) parent[j] = i;
      }
  return parent;
}

/// Places such that children come right before their parents.
std::vector<Index> postorder(const std::vector<Index>& parent) {
  const Index n = static_cast<Index>(parent.size());
  std::vector<Index> child(n, none), sibling(n, none), place(n), stack;
  for (Index j = n; j-- > 0;)
    if (parent[j] != none) {
      sibling[j] = child[parent[j]];
      child[parent[j]] = j;
    }
  Index next = 0;
  for (Index root = 0; root < n; ++root) {
    if (parent[root] != none) continue;
    stack.push_back(root);
    while (!stack.empty()) {
      const Index j = stack.back();
      if (child[j] != none) {
        stack.push_back(child[j]);
        child[j] = sibling[child[j]];
      } else {
        place[j] = next++;
        stack.pop_back();
      }
    }
  }
  return place;
}

/// [P] entries of each column of the factors, with the diagonal.
std::vector<Index> column_counts(const Lower& half, const std::vector<Index>& parent) {
  const Index n = static_cast<Index>(parent.size());
  std::vector<Index> count(n, 1), mark(n, none);
  for (Index i = 0; i < n; ++i) {
    mark[i] = i;
    for (Index m = half.begin[i]; m < half.begin[i + 1]; ++m)
      for (Index j = half.column[m]; mark[j] != i; j = parent[j]) {
        mark[j] = i;
        ++count[j];
      }
  }
  return count;
}

/// Entries of `columns` columns of a front with so many rows.
double trapezoid(double columns, double rows) {
  return columns * rows - 0.5 * columns * (columns - 1);
}

/// The first column of each front: columns that follow each other and have the same rows, or nearly.
std::vector<Index> join_columns(const std::vector<Index>& parent, const std::vector<Index>& count,
                                int width) {
  const Index n = static_cast<Index>(parent.size());
  std::vector<Index> first;
  double filled = 0;  // of the front so far
  for (Index j = 0; j < n; ++j) {
    bool joins = false;
    if (j > 0 && parent[j - 1] == j) {
      const double columns = j + 1 - first.back();
      const double all = trapezoid(columns, columns + count[j] - 1);
      const double zeros = all - filled - count[j];
      joins = zeros <= most_zeros * all || columns * width <= narrow;
    }
    if (!joins) {
      first.push_back(j);
      filled = 0;
    }
    filled += count[j];
  }
  first.push_back(n);
  return first;
}

/// Fills begin, row and parent, from the fronts' columns.
void find_rows(FrontTree& tree, const Lower& half) {
  const Index n = static_cast<Index>(half.begin.size()) - 1;
  const Index fronts = static_cast<Index>(tree.first.size()) - 1;
  std::vector<Index> front_of(n);
  for (Index f = 0; f < fronts; ++f)
    std::fill(front_of.begin() + tree.first[f], front_of.begin() + tree.first[f + 1], f);
  std::vector<std::vector<Index>> below(fronts);  // rows beyond a front's columns
  for (Index i = 0; i < n; ++i)
    for (Index m = half.begin[i]; m < half.begin[i + 1]; ++m)
      if (front_of[half.column[m]] != front_of[i]) below[front_of[half.column[m]]].push_back(i);
  tree.begin = {0};
  tree.parent.assign(fronts, none);
  for (Index f = 0; f < fronts; ++f) {
    auto& rows = below[f];
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    if (!rows.empty()) {
      const Index p = tree.parent[f] = front_of[rows.front()];
      for (Index i : rows)
        if (i >= tree.first[p + 1]) below[p].push_back(i);
    }
    for (Index j = tree.first[f]; j < tree.first[f + 1]; ++j) tree.row.push_back(j);
    tree.row.insert(tree.row.end(), rows.begin(), rows.end());
    tree.begin.push_back(static_cast<Index>(tree.row.size()));
    rows = {};
  }
}

void find_children(FrontTree& tree) {
  tree.child_begin.assign(tree.fronts() + 1, 0);
  for (Index p : tree.parent)
    if (p != none) ++tree.child_begin[p + 1];
  std::partial_sum(tree.child_begin.begin(), tree.child_begin.end(), tree.child_begin.begin());
  tree.child.resize(tree.child_begin.back());
  std::vector<Index> at(tree.child_begin.begin(), tree.child_begin.end() - 1);
  for (Index f = 0; f < tree.fronts(); ++f)
    if (tree.parent[f] != none) tree.child[at[tree.parent[f]]++] = f;
}

void count_work(FrontTree& tree, double width) {
  std::vector<double> waits(tree.fronts(), 0);  // what children have left for a front
  double waiting = 0;
  for (Index f = 0; f < tree.fronts(); ++f) {
    const double own = width * (tree.first[f + 1] - tree.first[f]);
    const double rows = width * (tree.begin[f + 1] - tree.begin[f]), left = rows - own;
    tree.entries += own * rows;
    tree.operations += own * own * own / 6 + own * own * left / 2 + own * left * left / 2;
    tree.most_at_once = std::max(tree.most_at_once, waiting + rows * rows);
    waiting += left * left - waits[f];
    if (tree.parent[f] != none) waits[tree.parent[f]] += left * left;
  }
}

}  // namespace

FrontTree make_front_tree(const BlockMatrix& a) {
  FrontTree tree;
  tree.place = order_rows(a);
  const std::vector<Index> after = postorder(elimination_tree(lower_half(a, tree.place)));
  for (Index& place : tree.place) place = after[place];
  const Lower half = lower_half(a, tree.place);
  const std::vector<Index> parent = elimination_tree(half);
  tree.first = join_columns(parent, column_counts(half, parent), a.width);
  find_rows(tree, half);
  find_children(tree);
  count_work(tree, a.width);
  return tree;
}

}  // namespace rockfold::host
