#include "src/model/text/diagnostics.hpp"

#include <algorithm>
#include <tuple>

namespace rockfold {

namespace {

constexpr std::size_t most_told =
    1000;  // bounds the memory that a broken file of megabytes can take

bool earlier(const Spot& a, const Spot& b) {
  return std::tie(a.source, a.line, a.column) < std::tie(b.source, b.line, b.column);
}

}  // namespace

Place Diagnostics::place(const Spot& spot, const std::string& key) const {
  const bool in_file = spot.source == 0;  // a --set is its own place
  return {sources_[spot.source], in_file ? spot.line : 0, in_file ? spot.column : 0, key};
}

void Diagnostics::add(const Spot& spot, const std::string& key, const std::string& message) {
  explain(key);
  add(spot, {place(spot, key), label_.empty() ? message : message + " (in \"" + label_ + "\")"});
}

void Diagnostics::add(const Spot& spot, Diagnostic of_file) {
  if (found_.size() == most_told)
    ++left_out_;
  else
    found_.push_back({spot, std::move(of_file)});
}

void Diagnostics::add_unreadable(const Spot& spot, const std::string& key,
                                 const std::string& message) {
  add(spot, key, message);
  ++unreadable_;
}

Error Diagnostics::error() {
  const bool model_is_right = unreadable_ == found_.size() + left_out_;
  std::stable_sort(found_.begin(), found_.end(),
                   [](const auto& a, const auto& b) { return earlier(a.first, b.first); });
  std::vector<Diagnostic> all;
  for (auto& [spot, diagnostic] : found_) all.push_back(std::move(diagnostic));
  if (left_out_ > 0)
    all.push_back({{sources_[0], 0, 0, ""}, "and " + std::to_string(left_out_) + " more errors"});
  return {model_is_right ? ErrorKind::io : ErrorKind::model, std::move(all)};
}

}  // namespace rockfold
