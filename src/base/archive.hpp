// Plain data as bytes of this machine and back. One function lists what belongs to a record, with an Archive that either
// packs or unpacks, so that the two never differ.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace rockfold {

class Archive {
 public:
  /// Packs.
  Archive() = default;
  /// Unpacks; `source` must live as long.
  explicit Archive(std::span<const std::byte> source) : source_(source), packs_(false) {}

  bool packs() const { return packs_; }
  /// What has been packed.
  std::vector<std::byte>& bytes() { return bytes_; }
  /// Whether all has been unpacked.
  bool at_end() const { return at_ == source_.size(); }

  /// Packs `value`, or replaces it. Throws std::runtime_error where the source ends too early.
  template <typename T>
  void pass(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    move(&value, sizeof value);
  }
  template <typename T>
  void pass(std::vector<T>& values) {
    resize(values, std::is_trivially_copyable_v<T> ? sizeof(T) : 1);
    if constexpr (std::is_trivially_copyable_v<T>) {
      if (!values.empty()) move(values.data(), values.size() * sizeof(T));
    } else {
      for (T& value : values) pass(value);
    }
  }
  void pass(std::string& text) {
    resize(text, 1);
    if (!text.empty()) move(text.data(), text.size());
  }
  template <typename T>
  void pass(std::optional<T>& value) {
    bool there = value.has_value();
    pass(there);
    if (!there) return value.reset();
    if (!value) value.emplace();
    pass(*value);
  }
  template <typename... More>
  void all(More&... values) {
    (pass(values), ...);
  }

 private:
  template <typename Container>
  void resize(Container& values, std::size_t entry) {
    auto count = static_cast<std::uint64_t>(values.size());
    pass(count);
    if (packs_) return;
    if (count > (source_.size() - at_) / entry + 1) throw std::runtime_error("cut short");
    values.resize(count);
  }
  void move(void* data, std::size_t length) {
    if (packs_) {
      const auto* first = static_cast<const std::byte*>(data);
      bytes_.insert(bytes_.end(), first, first + length);
      return;
    }
    if (length > source_.size() - at_) throw std::runtime_error("cut short");
    std::memcpy(data, source_.data() + at_, length);
    at_ += length;
  }

  std::vector<std::byte> bytes_;
  std::span<const std::byte> source_;
  std::size_t at_ = 0;
  bool packs_ = true;
};

/// FNV-1a over 64 bits (Fowler, Noll & Vo): tells damage and differences, not enemies.
class Hash {
 public:
  Hash& add(std::span<const std::byte> bytes) {
    for (const std::byte b : bytes)
      value_ = (value_ ^ static_cast<std::uint64_t>(b)) * 0x100000001b3;
    return *this;
  }
  std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325;
};

}  // namespace rockfold
