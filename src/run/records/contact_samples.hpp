// Contact points as results tell of them: places, gaps and stresses instead of weights and memories.
#pragma once

#include "kernels/contact/contact.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

/// Where they are with the covers displaced by `displacement` (m). Points that are not in contact, and not within reach of it, are none.
std::vector<ContactSample> contact_samples(const RunInput& input, const std::vector<JointLaw>& laws,
                                           const std::vector<ContactPoint>& points,
                                           const std::vector<Vec3>& displacement);

/// m, by how much the first side of a contact point has gone away from the second since step 0.
Vec3 way_apart(const RunInput& input, const ContactPoint& point,
               const std::vector<Vec3>& displacement);

}  // namespace rockfold
