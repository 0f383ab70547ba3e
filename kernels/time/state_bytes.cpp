// The state of a motion as bytes: what MovingState holds, one after the other.
#include <cstring>
#include <stdexcept>
#include <type_traits>

#include "kernels/time/motion_kernel.hpp"

namespace rockfold {
namespace {

/// Of the layout below: changed with it.
constexpr std::uint64_t format = 0x0001'5441'5453'4652;  // "RFSTAT", 1

/// Everything but the fields.
struct Plain {
  std::uint64_t format;
  std::int64_t unknowns, fixed;
  Real time, initial_energy, learned_in;
  motion::Work work;
  std::int64_t steps;
  std::int64_t learned;  ///< numbers behind the fields
};
static_assert(std::is_trivially_copyable_v<Plain> && sizeof(Plain) == 13 * 8);

std::array<device::Field, 5> fields_of(const motion::MovingState& state) {
  return {state.displacement, state.velocity, state.acceleration, state.multiplier, state.reaction};
}

std::size_t length_of(const device::Field& field) {
  return field.extent(0) * sizeof(Vec3);
}

}  // namespace

std::vector<std::byte> Motion::bytes() const {
  const Data& m = *data_;
  const std::vector<Real> learned = m.now.learned.knowledge();
  Plain plain{};
  plain.format = format;
  plain.unknowns = m.unknowns;
  plain.fixed = m.held.springs.points.count;
  plain.time = m.now.time;
  plain.initial_energy = m.now.initial_energy;
  plain.learned_in = m.now.learned_in;
  plain.work = m.now.work;
  plain.steps = m.now.steps;
  plain.learned = static_cast<std::int64_t>(learned.size());
  std::vector<std::byte> bytes(sizeof plain);
  std::memcpy(bytes.data(), &plain, sizeof plain);
  for (const device::Field& field : fields_of(m.now)) {
    const std::vector<Vec3> values = device::copy_to_host(field);
    const auto* first = reinterpret_cast<const std::byte*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof(Vec3));
  }
  const auto* first = reinterpret_cast<const std::byte*>(learned.data());
  bytes.insert(bytes.end(), first, first + learned.size() * sizeof(Real));
  return bytes;
}

void Motion::restore(std::span<const std::byte> bytes) {
  Data& m = *data_;
  Plain plain{};
  if (bytes.size() >= sizeof plain) std::memcpy(&plain, bytes.data(), sizeof plain);
  std::size_t length = sizeof plain + static_cast<std::size_t>(plain.learned) * sizeof(Real);
  for (const device::Field& field : fields_of(m.now)) length += length_of(field);
  if (plain.format != format || plain.unknowns != m.unknowns ||
      plain.fixed != m.held.springs.points.count || bytes.size() != length)
    throw std::invalid_argument("not the state of such a motion");
  m.now.time = plain.time;
  m.now.initial_energy = plain.initial_energy;
  m.now.learned_in = plain.learned_in;
  m.now.work = plain.work;
  m.now.steps = static_cast<Index>(plain.steps);
  std::size_t at = sizeof plain;
  for (const device::Field& field : fields_of(m.now)) {
    std::vector<Vec3> values(field.extent(0));
    if (!values.empty()) std::memcpy(values.data(), &bytes[at], length_of(field));
    device::copy_to_device(values, field);
    at += length_of(field);
  }
  std::vector<Real> learned(plain.learned);
  if (!learned.empty()) std::memcpy(learned.data(), &bytes[at], learned.size() * sizeof(Real));
  m.now.learned.learn(learned, 3 * static_cast<std::size_t>(m.held.springs.points.count));
  motion::set_time(m, m.now.time);
}

}  // namespace rockfold
