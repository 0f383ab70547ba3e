#include "src/model/text/given_keys.hpp"

#include <algorithm>
#include <string>
#include <unordered_map>
#include <utility>

#include "src/model/read/read_value.hpp"

namespace rockfold {

namespace {

class Collector {
 public:
  explicit Collector(const Diagnostics& out) : out_(out) {}

  /// `place` is the prefix with the numbers of entries.
  void visit_table(const Table& table, const std::string& prefix, const std::string& place) {
    for (const Entry& entry : table.entries)
      visit(entry.value, prefix + entry.key, place + entry.key);
  }
  std::vector<GivenKey> take() { return std::move(given_); }

 private:
  void visit(const Value& value, const std::string& path, const std::string& place) {
    if (const auto* table = std::get_if<Table>(&value.data))
      return visit_table(*table, path + ".", place + ".");
    const auto* list = std::get_if<Array>(&value.data);
    if (list && !list->empty() && std::holds_alternative<Table>(list->front().data)) {
      for (std::size_t i = 0; i < list->size(); ++i) visit((*list)[i], path, item_path(place, i));
      return;
    }
    const auto [at, fresh] = number_.try_emplace(path, given_.size());
    if (fresh)
      given_.push_back({path, out_.place(value.spot, place)});
    else
      ++given_[at->second].count;
  }

  const Diagnostics& out_;
  std::vector<GivenKey> given_;
  std::unordered_map<std::string, std::size_t> number_;
};

}  // namespace

std::vector<GivenKey> given_keys(const Table& root, const Diagnostics& out) {
  Collector collector(out);
  collector.visit_table(root, "", "");
  std::vector<GivenKey> given = collector.take();  // by name
  std::stable_sort(given.begin(), given.end(), [](const GivenKey& a, const GivenKey& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
  });
  return given;
}

}  // namespace rockfold
