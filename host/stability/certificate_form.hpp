// Whether a certificate is whole, before anything is computed from it.
#pragma once

#include <string>

#include "host/stability/certificate.hpp"

namespace rockfold {

/// Whether strength is spread over the area: then it has points inside beside its corners.
inline bool is_strong(const ContactArea& area) {
  return area.cohesion > 0 || area.tension > 0;
}

/// "block 12", as users count them; "body 3" where it has no number.
std::string body_text(const RigidMass& mass, Index body);
/// "contact 3 (J1)", counted from 1.
std::string contact_text(const RigidMass& mass, Index contact);
/// "tie 3 (north.12)", counted from 1.
std::string tie_text(const RigidMass& mass, Index tie);

/// What is missing, out of range or no number in a certificate, the first such thing; empty: nothing.
std::string lack_of_form(const Certificate& certificate);

}  // namespace rockfold
