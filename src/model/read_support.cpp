// [support].
#include "src/model/draft.hpp"

namespace rockfold {

void read_support(Draft& draft) {
  read_section(draft, "support", [&](TableReader& in) {
    SupportSpec support;
    in.read("joint_faces_only", support.joint_faces_only, Need::optional);
    in.read("water_pressure", support.water_pressure, not_negative("Pa"), Need::optional);
    in.read("seismic_coefficient", support.seismic_coefficient, any_number("fraction of g"),
            Need::optional);
    in.read("target_factor_of_safety", support.target_factor_of_safety, positive(""),
            Need::optional);
    Vec3 direction{};
    if (in.has("support_direction") && in.read_direction("support_direction", direction))
      support.support_direction = unit_normal(direction);
    draft.model.support = support;
  });
}

}  // namespace rockfold
