#include "host/direct/front_tree.hpp"

#include <algorithm>
#include <numeric>

#include "host/direct/order.hpp"

namespace rockfold::host {
namespace {

/// Share of a front's entries that may be zeros taken in to make it wider.
constexpr double most_zeros = 0.15;
/// Fronts narrower than this (unknowns) take in any child that comes right before them.
constexpr Index narrow = 24;
/// Of all operations: what a subtree has at most, so that threads that do not take part in the last ones wait for little.
constexpr double largest_subtree = 1.0 / 32;
/// Operations a row that take as long as to look for a second order: 10 µs.
constexpr double worth_dissecting = 1e5;

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

/// Where each row that a front hands on stands among its parent's.
void find_in_parent(FrontTree& tree) {
  tree.in_parent.assign(tree.row.size(), none);
  for (Index f = 0; f < tree.fronts(); ++f) {
    if (tree.parent[f] == none) continue;
    Index at = tree.begin[tree.parent[f]];
    for (Index m = tree.handed_on(f); m < tree.begin[f + 1]; ++m) {
      while (tree.row[at] < tree.row[m]) ++at;
      tree.in_parent[m] = at - tree.begin[tree.parent[f]];
    }
  }
}

double operations_of(const FrontTree& tree, Index f, double width) {
  const double own = width * (tree.first[f + 1] - tree.first[f]);
  const double left = width * (tree.begin[f + 1] - tree.begin[f]) - own;
  return own * own * own / 6 + own * own * left / 2 + own * left * left / 2;
}

/// Divides the tree into subtrees, the heaviest first, and what is above them.
void find_subtrees(FrontTree& tree, double width) {
  const Index n = tree.fronts();
  std::vector<double> below(n, 0);  // operations of a front and those below it
  std::vector<Index> first(n);      // of those
  for (Index f = 0; f < n; ++f) {
    const Index children = tree.child_begin[f];
    first[f] = children < tree.child_begin[f + 1] ? first[tree.child[children]] : f;
    below[f] += operations_of(tree, f, width);
    tree.operations += operations_of(tree, f, width);
    if (tree.parent[f] != none) below[tree.parent[f]] += below[f];
  }
  std::vector<std::uint8_t> above(n, 0);
  for (Index f = n; f-- > 0;) {
    if (tree.parent[f] != none && above[tree.parent[f]] == 0) continue;
    above[f] = below[f] > largest_subtree * tree.operations ? 1 : 0;
    if (above[f] != 0)
      tree.top.push_back(f);
    else
      tree.subtree.push_back({first[f], f + 1});
  }
  std::reverse(tree.top.begin(), tree.top.end());
  std::stable_sort(tree.subtree.begin(), tree.subtree.end(),
                   [&](const auto& s, const auto& t) { return below[s[1] - 1] > below[t[1] - 1]; });
}

/// Subtrees as if one came after the other: several at once take more, but what they leave is what counts.
void count_memory(FrontTree& tree, double width) {
  std::vector<double> waits(tree.fronts(), 0);  // what children have left for a front
  double waiting = 0;
  const auto count = [&](Index f) {
    const double own = width * (tree.first[f + 1] - tree.first[f]);
    const double rows = width * (tree.begin[f + 1] - tree.begin[f]), left = rows - own;
    tree.entries += own * rows;
    tree.most_at_once = std::max(tree.most_at_once, waiting + rows * own + left * left);
    waiting += left * left - waits[f];
    if (tree.parent[f] != none) waits[tree.parent[f]] += left * left;
  };
  for (const auto& [from, to] : tree.subtree)
    for (Index f = from; f < to; ++f) count(f);
  for (const Index f : tree.top) count(f);
}

FrontTree tree_in_order(const BlockMatrix& a, std::vector<Index> place) {
  FrontTree tree;
  tree.place = std::move(place);
  const std::vector<Index> after = postorder(elimination_tree(lower_half(a, tree.place)));
  for (Index& at : tree.place) at = after[at];
  const Lower half = lower_half(a, tree.place);
  const std::vector<Index> parent = elimination_tree(half);
  tree.first = join_columns(parent, column_counts(half, parent), a.width);
  find_rows(tree, half);
  find_children(tree);
  find_in_parent(tree);
  find_subtrees(tree, a.width);
  count_memory(tree, a.width);
  return tree;
}

}  // namespace

FrontTree make_front_tree(const BlockMatrix& a) {
  FrontTree by_degree = tree_in_order(a, order_by_degree(a));
  if (by_degree.operations <= worth_dissecting * a.rows()) return by_degree;
  std::vector<Index> place = order_by_dissection(a);
  if (place.empty()) return by_degree;
  FrontTree by_dissection = tree_in_order(a, std::move(place));
  if (by_dissection.operations < by_degree.operations) return by_dissection;
  return by_degree;
}

}  // namespace rockfold::host
