// Rules that every cutting keeps, whatever the model. Each broken rule is one line that starts with the rule's name.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tests/cut/models/sample_models.hpp"

namespace rockfold::test {

using Faults = std::vector<std::string>;

/// "volume": blocks' volumes are positive and finite; their sum is the solids' volume to 1e-12.
void check_volumes(const Blocks& blocks, Faults& faults);

/// "volume": the sum of the blocks' volumes is `expected`, m³, to `relative`.
void check_total(const Blocks& blocks, long double expected, Real relative, Faults& faults);

/// "surface": every edge of a block's loops is run through as often in each sense, V − E + F − holes = 2·(shells − genus), and all
/// numbers are finite.
void check_surfaces(const BlockArrays& a, Faults& faults);

/// "order": the joints of all kinds in another order give as many blocks, of the same volumes to 1e-7 of each + 1e-8·size³.
void check_order(const Model& model, const BlockArrays& as_listed, unsigned seed, Real size,
                 Faults& faults);

/// All of the above but check_total, what `further` finds, and "error" where the cutting throws.
Faults faults_of_cutting(const Model& model, unsigned seed, Real size,
                         const std::function<void(const Blocks&, Faults&)>& further = {});

std::string rule_of(const std::string& fault);

/// A part of the model, fewer joints first, from which nothing more can be left out: `faults_of` it still breaks the rule that
/// the whole model breaks first.

template <class FaultsOf>
Model smallest_faulty(Model model, const FaultsOf& faults_of) {
  const Faults whole = faults_of(model);
  if (whole.empty()) return model;
  const auto still = [&](const Model& m) {
    for (const std::string& line : faults_of(m))
      if (rule_of(line) == rule_of(whole.front())) return true;
    return false;
  };
  const auto reduce = [&](auto Model::*list, std::size_t keep) {
    for (std::size_t i = (model.*list).size(); i-- > keep;) {
      Model less = model;
      (less.*list).erase((less.*list).begin() + static_cast<std::ptrdiff_t>(i));
      if (still(less)) model = std::move(less);
    }
  };
  reduce(&Model::joints, 0);
  reduce(&Model::joint_sets, 0);
  reduce(&Model::excavations, 0);
  reduce(&Model::solids, 1);
  return model;
}

}  // namespace rockfold::test
