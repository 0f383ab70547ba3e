#include "host/keyblock/thin_contacts.hpp"

#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// A normal force below this share of the block's resultant is the rounding of one that is zero.
constexpr Real force_rounding = 1e-9;

void add_thin_contacts(const Keyblock& key, std::vector<ThinContact>& thin) {
  if (!key.movement || key.mode == SlidingMode::rotation) return;
  Real whole = 0;
  for (const ContactPlane& plane : key.contact) whole += plane.area;
  for (std::size_t k = 0; k < key.planes.size(); ++k) {
    const Real area = key.contact[static_cast<std::size_t>(key.movement->planes[k])].area;
    const Real force = key.movement->normal_force[k];
    if (area < thin_contact_share * whole && force > force_rounding * norm(key.resultant))
      thin.push_back({key.block, key.planes[k], area, area / whole, force});
  }
}

}  // namespace

std::vector<ThinContact> thin_contacts(const KeyblockReport& report) {
  std::vector<ThinContact> thin;
  for (const Keyblock& key : report.keyblocks) add_thin_contacts(key, thin);
  for (const Keyblock& key : report.stable) add_thin_contacts(key, thin);
  return thin;
}

}  // namespace rockfold
