// Collects everything that is wrong with a model, so that all of it is told at once.
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "src/base/error.hpp"
#include "src/model/text/value.hpp"

namespace rockfold {

class Diagnostics {
 public:
  /// `sources[Spot::source]` names each source: the model file, then "--set key=value", ….
  explicit Diagnostics(std::vector<std::string> sources) : sources_(std::move(sources)) {}

  /// `key` is the full key path. The label of the entry being read is appended to the message.
  void add(const Spot& spot, const std::string& key, const std::string& message);

  /// Likewise for a file that is not there: if nothing else is wrong, the model itself is not.
  void add_unreadable(const Spot& spot, const std::string& key, const std::string& message);

  /// What was found wrong in a file that the entry at `spot` names.
  void add(const Spot& spot, Diagnostic of_file);

  /// Says that a message already explains why this key is missing or wrong: another one would be
  /// noise.
  void explain(const std::string& key) { explained_.insert(key); }
  bool explained(const std::string& key) const { return explained_.count(key) > 0; }

  /// Sections of the model: where one stands within another, a message says where it belongs.
  void know_section(const std::string& key) { sections_.insert(key); }
  bool is_section(const std::string& key) const { return sections_.count(key) > 0; }

  /// The name of the entry being read; "" = none.
  const std::string& label() const { return label_; }
  void set_label(std::string name) { label_ = std::move(name); }

  Place place(const Spot& spot, const std::string& key) const;
  bool empty() const { return found_.empty(); }

  /// Error(model) with all of them, by line and column, those of --set last; Error(io) if all are of files that are not there. Never
  /// call if empty.
  Error error();

 private:
  std::vector<std::string> sources_;
  std::vector<std::pair<Spot, Diagnostic>> found_;
  std::size_t left_out_ = 0, unreadable_ = 0;
  std::set<std::string> explained_, sections_;
  std::string label_;
};

}  // namespace rockfold
