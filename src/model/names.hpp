// The names of one kind of entry, in the order of their ids.
#pragma once

#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "src/base/types.hpp"
#include "src/model/text/value.hpp"

namespace rockfold {

class Names {
 public:
  /// `kind` as messages say it ("joint material"), `section` as the model does ("joint_material").
  Names(std::string kind, std::string section)
      : kind_(std::move(kind)), section_(std::move(section)) {}

  const std::string& kind() const { return kind_; }
  const std::string& section() const { return section_; }
  const std::vector<std::string>& all() const { return names_; }
  bool empty() const { return names_.empty(); }

  /// `path` and `spot` say which entry has the name.
  void add(const std::string& name, const Spot& spot, std::string path) {
    id_.emplace(name, static_cast<Index>(names_.size()));  // of two with one name, the first counts
    names_.push_back(name);
    spots_.push_back(spot);
    paths_.push_back(std::move(path));
  }
  Index find(const std::string& name) const {
    const auto found = id_.find(name);
    return found == id_.end() ? none : found->second;
  }
  const Spot& spot(Index id) const { return spots_[id]; }
  const std::string& path(Index id) const { return paths_[id]; }

  /// Some names could not be read: a reference that is not found may be right.
  void set_incomplete() { complete_ = false; }
  bool complete() const { return complete_; }

 private:
  std::string kind_, section_;
  std::vector<std::string> names_;
  std::unordered_map<std::string, Index> id_;
  std::vector<Spot> spots_;
  std::vector<std::string> paths_;
  bool complete_ = true;
};

}  // namespace rockfold
