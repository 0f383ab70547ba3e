// The state of a motion as bytes: what MovingState holds, one after the other.
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "kernels/time/motion_kernel.hpp"

namespace rockfold {
namespace {

/// Of the layout below: changed with it.
constexpr std::uint64_t format = 0x000a'5441'5453'4652;  // "RFSTAT", 10

/// Everything but the fields.
struct Plain {
  std::uint64_t format;
  std::int64_t unknowns, fixed;
  motion::StateNumbers numbers;
  std::int64_t contact;  ///< bytes of contacts behind the fields …
  std::int64_t bolts;    ///< … and of bolts behind those
};
static_assert(std::is_trivially_copyable_v<Plain> && sizeof(Plain) == 22 * 8);

std::size_t length_of(const device::Field& field) {
  return field.extent(0) * sizeof(Vec3);
}

}  // namespace

std::vector<std::byte> Motion::bytes() const {
  const Data& m = *data_;
  Plain plain{};
  plain.format = format;
  plain.unknowns = m.unknowns;
  plain.fixed = m.system.springs.points.count;
  plain.numbers = m.now;
  std::vector<std::byte> contacts, of_bolts = bolts::bytes(m.bolts);
  if (m.contact) contacts = contact::bytes(m.contact->contacts);
  plain.contact = static_cast<std::int64_t>(contacts.size());
  plain.bolts = static_cast<std::int64_t>(of_bolts.size());
  std::vector<std::byte> bytes(sizeof plain);
  std::memcpy(bytes.data(), &plain, sizeof plain);
  for (const device::Field& field : m.now.fields()) {
    const std::vector<Vec3> values = device::copy_to_host(field);
    const auto* first = reinterpret_cast<const std::byte*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof(Vec3));
  }
  bytes.insert(bytes.end(), contacts.begin(), contacts.end());
  bytes.insert(bytes.end(), of_bolts.begin(), of_bolts.end());
  return bytes;
}

void Motion::restore(std::span<const std::byte> bytes) {
  Data& m = *data_;
  Plain plain{};
  if (bytes.size() >= sizeof plain) std::memcpy(&plain, bytes.data(), sizeof plain);
  std::size_t length = sizeof plain + static_cast<std::size_t>(plain.contact + plain.bolts);
  for (const device::Field& field : m.now.fields()) length += length_of(field);
  if (plain.format != format || plain.unknowns != m.unknowns ||
      plain.fixed != m.system.springs.points.count || bytes.size() != length ||
      (plain.contact > 0) != (m.contact != nullptr))
    throw std::invalid_argument("not the state of such a motion");
  static_cast<motion::StateNumbers&>(m.now) = plain.numbers;
  std::size_t at = sizeof plain;
  for (const device::Field& field : m.now.fields()) {
    std::vector<Vec3> values(field.extent(0));
    if (!values.empty()) std::memcpy(values.data(), &bytes[at], length_of(field));
    device::copy_to_device(values, field);
    at += length_of(field);
  }
  const auto of_contacts = static_cast<std::size_t>(plain.contact);
  if (m.contact) contact::restore(m.contact->contacts, bytes.subspan(at, of_contacts));
  bolts::restore(m.bolts, bytes.subspan(at + of_contacts));
  motion::set_time(m, m.now.time);
}

}  // namespace rockfold
