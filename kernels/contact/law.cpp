#include "kernels/contact/law.hpp"

#include "kernels/contact/law_kernel.hpp"

namespace rockfold {

ImpactRule impact_rule(Real restitution, Real period, Real dt) {
  return contact::impact_rule(restitution, period, dt);
}

PointTraction point_traction(const JointLaw& law, const ImpactRule& impact,
                             const ContactMemory& memory, const PointMotionInStep& motion) {
  return contact::traction(law, impact, memory, motion);
}

bool bonds_fail(const JointLaw& law, const ContactMemory& memory, const PointTraction& now) {
  return contact::overloads_bonds(law, memory, now);
}

}  // namespace rockfold
