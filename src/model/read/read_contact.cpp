// [contact].
#include "src/model/read/draft.hpp"

namespace rockfold {

void read_contact(Draft& draft) {
  ContactSpec& contact = draft.model.contact;
  contact.material = draft.joint_materials.empty() ? none : 0;
  read_section(draft, "contact", [&](TableReader& in) {
    contact.place = in.place();
    in.read_reference("material", draft.joint_materials, contact.material);
    in.read("max_iterations", contact.max_iterations, IntegerRange{.low = 1}, Need::optional);
    in.read("restitution", contact.restitution, between(0, 1, "0 plastic, 1 elastic impact"),
            Need::optional);
    Range depth = not_negative("m");
    depth.largest = largest_coordinate;
    in.read("max_penetration", contact.max_penetration, depth, Need::optional);
  });
}

}  // namespace rockfold
