// Reads one table of a model key by key. It remembers which keys were asked for, so that finish()
// can tell the unknown ones, with the nearest known key, and the missing ones.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/model/names.hpp"
#include "src/model/text/diagnostics.hpp"
#include "src/model/text/numbers/range.hpp"
#include "src/model/text/value.hpp"

namespace rockfold {

enum class Need { required, optional };

/// A key whose value is one of a few words.
struct Choice {
  std::vector<std::string> words;    ///< what may be given; the answer is an index into it
  std::vector<std::string> not_yet;  ///< words of the model's format that are not built yet
};

class TableReader {
 public:
  /// `path` is the table's key path, e.g. "joint_set[2]". Reports if `value` is no table; then
  /// nothing is missing.
  TableReader(const Value& value, std::string path, Diagnostics& out);
  /// Reports the unknown and the missing keys: when the table's reader ends, all keys have been
  /// asked for.
  ~TableReader();
  TableReader(const TableReader&) = delete;
  TableReader& operator=(const TableReader&) = delete;

  bool has(std::string_view key);
  /// Likewise; the key is not one of those that belong here by that.
  bool gives(std::string_view key) { return entry(key) != nullptr; }
  /// Null if absent; noted as missing if `expected` says what should stand there.
  const Value* find(const std::string& key, const std::string& expected = "");

  // Each stores a good value and says whether there was one. A wrong one is reported, the target
  // left as it was.
  bool read(const std::string& key, Real& target, const Range& range, Need need = Need::required);
  bool read(const std::string& key, std::optional<Real>& target, const Range& range);
  bool read(const std::string& key, Index& target, const IntegerRange& range,
            Need need = Need::required);
  bool read(const std::string& key, bool& target, Need need = Need::required);
  bool read(const std::string& key, std::string& target, Need need = Need::required);
  bool read(const std::string& key, Vec3& target, const Range& range, Need need = Need::required);
  bool read_direction(const std::string& key, Vec3& target);
  std::optional<std::size_t> choose(const std::string& key, const Choice& choice,
                                    Need need = Need::required);

  /// The entry's "name", or `fallback`; from here on messages carry it. Reports a name that is
  /// taken.
  std::string read_name(Names& names, const std::string& fallback);
  /// The entry's "name", or `fallback`, where the entry itself has none: it only begins those of what it stands for.
  std::string read_prefix(const std::string& fallback);
  /// Adds a name of what the entry stands for, which differs from all before it: if need be by a number behind it.
  std::string add_name(Names& names, const std::string& wanted);
  /// Stores the id that the name under `key` refers to; default: the first, or none if there is
  /// none.
  bool read_reference(const std::string& key, const Names& names, Index& target);
  /// Likewise; default: none.
  bool read_optional_reference(const std::string& key, const Names& names, Index& target);

  bool is_table() const { return table_ != nullptr; }

  /// A key of the model's format that is not built yet; `instead` says what is. Whether it is
  /// there.
  bool not_yet(const std::string& key, const std::string& instead = "");
  /// None of `keys` is there, one should be. The first one is named; "" names the table itself.
  void missing(std::vector<std::string> keys, const std::string& message);
  /// The value under `key` (or the table, if the key is absent) is wrong.
  void wrong(const std::string& key, const std::string& message);
  /// What is wrong in the file that the table names.
  void wrong_in_file(Diagnostic found) { out_.add(spot_, std::move(found)); }
  /// Likewise: the file that it names is not there.
  void unreadable(const std::string& key, const std::string& message);
  /// What else belongs to this table is not known: its other keys are unknown only if a missing one
  /// was meant.
  void give_up() { given_up_ = true; }

  std::string path_of(const std::string& key) const {
    return path_.empty() || key.empty() ? path_ + key : path_ + "." + key;
  }
  Place place() const { return out_.place(spot_, path_); }
  /// Of the value under `key`, or of the table.
  Place place_of(const std::string& key);
  Diagnostics& out() { return out_; }

 private:
  struct Missing {
    std::vector<std::string> keys;
    std::string message;
  };
  const Entry* entry(std::string_view key) { return table_ ? table_->find(key) : nullptr; }
  void know(std::string_view key);
  bool is_missing(const std::string& key) const;
  std::string about_unknown(const std::string& key, const Value& value,
                            const std::string& nearest) const;
  void report_unknown();
  void report_missing();

  const Table* table_ = nullptr;
  Spot spot_;
  std::string path_;
  Diagnostics& out_;
  std::string label_before_;
  std::vector<std::string> known_;      ///< keys asked for
  std::vector<std::string> supported_;  ///< of these, the ones to list in messages
  std::vector<Missing> missing_;
  bool given_up_ = false;
};

}  // namespace rockfold
