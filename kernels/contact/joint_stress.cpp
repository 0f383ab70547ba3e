// Joints as the initial stress presses and shears them before anything moves.
#include "kernels/contact/contact_kernel.hpp"

namespace rockfold::contact {
namespace {

/// Place of the first side.
KOKKOS_INLINE_FUNCTION Real height(const ContactPoint& p, const Field& x) {
  Real z = 0;
  for (int k = 0; k < 3; ++k) z += p.weight[k] * x(p.vertex[k], 2);
  return z;
}

/// σ n, σ as xx yy zz xy yz zx.
KOKKOS_INLINE_FUNCTION Vector times(const Real* s, const Vector& n) {
  return {s[0] * n.x + s[3] * n.y + s[5] * n.z, s[3] * n.x + s[1] * n.y + s[4] * n.z,
          s[5] * n.x + s[4] * n.y + s[2] * n.z};
}

/// InitialStress in plain numbers: the members of std::array are functions of the host alone.
struct LinearStress {
  Real at[6], gradient[6], reference_z;
  explicit LinearStress(const InitialStress& s) : reference_z(s.reference_z) {
    for (std::size_t k = 0; k < 6; ++k) {
      at[k] = s.at[k];
      gradient[k] = s.gradient[k];
    }
  }
};

}  // namespace

void stress_joints(const DeviceContacts& c, const Field& x) {
  if (!c.options.initial_stress.any) return;
  const LinearStress stress(c.options.initial_stress);
  const auto point = c.accepted.point;
  const auto laws = c.laws;
  device::for_each(
      "rockfold::contact::stress_joints", c.accepted.count, KOKKOS_LAMBDA(const Index i) {
        ContactPoint& p = point(i);
        if (p.memory.state != Contact::stick) return;  // no joint of the cut
        Real s[6];
        for (int k = 0; k < 6; ++k)
          s[k] = stress.at[k] + (stress.reference_z - height(p, x)) * stress.gradient[k];
        const Vector n = to_vector(p.normal), a = to_vector(p.along);
        const Vector t = times(s, n);  // pulls at the second side
        const JointLaw& law = laws(p.law);
        p.memory.pressed = p.memory.dilation = -dot(n, t) / law.normal_stiffness;
        p.memory.shear[0] = dot(a, t) / law.shear_stiffness;
        p.memory.shear[1] = dot(cross(n, a), t) / law.shear_stiffness;
      });
}

}  // namespace rockfold::contact
