#include "kernels/device/launches.hpp"

#include <Kokkos_Core.hpp>

namespace rockfold::device {
namespace {

namespace tools = Kokkos::Tools::Experimental;

Launches launches;
tools::EventSet others;

void note_kernel(const char* label, std::uint32_t /*device*/, std::uint64_t* /*kernel*/) {
  ++launches.kernels[label];
}

void note_copy(Kokkos::Tools::SpaceHandle /*to*/, const char* /*label*/, const void* /*at*/,
               Kokkos::Tools::SpaceHandle /*from*/, const char* /*source*/, const void* /*of*/,
               std::uint64_t /*bytes*/) {
  ++launches.copies;
}

}  // namespace

std::int64_t Launches::count(const std::string& label) const {
  const auto found = kernels.find(label);
  return found == kernels.end() ? 0 : found->second;
}

LaunchCounter::LaunchCounter() {
  launches = {};
  others = tools::get_callbacks();
  tools::set_begin_parallel_for_callback(note_kernel);
  tools::set_begin_parallel_reduce_callback(note_kernel);
  tools::set_begin_parallel_scan_callback(note_kernel);
  tools::set_begin_deep_copy_callback(note_copy);
}

LaunchCounter::~LaunchCounter() {
  tools::set_callbacks(others);
}

const Launches& LaunchCounter::seen() const {
  return launches;
}

}  // namespace rockfold::device
