// [[joint_set]] and [[joint]].
#include "src/model/draft.hpp"

namespace rockfold {

void read_joint_sets(Draft& draft) {
  read_entries(draft, "joint_set", [&](TableReader& in, Index number) {
    JointSet set;
    set.name = in.read_name(draft.joints, "set" + std::to_string(number));
    set.place = in.place();
    read_orientation(in, set.orientation);
    in.read("spacing", set.spacing, length());
    in.read("origin", set.origin, coordinate(), Need::optional);
    Index count = 0;
    if (in.read("count", count, IntegerRange{.low = 1}, Need::optional)) set.count = count;
    in.read_reference("material", draft.joint_materials, set.material);
    for (const char* key : {"radius", "sides", "within"})
      in.not_yet(key, "joints are through-going");
    in.not_yet("random", "joints are given one by one or by a constant spacing");
    draft.model.joint_sets.push_back(set);
  });
}

void read_joints(Draft& draft) {
  read_entries(draft, "joint", [&](TableReader& in, Index number) {
    Joint joint;
    joint.name = in.read_name(draft.joints, "joint" + std::to_string(number));
    joint.place = in.place();
    read_plane(in, joint.plane);
    in.read_reference("material", draft.joint_materials, joint.material);
    for (const char* key : {"radius", "sides", "polygon", "within"})
      in.not_yet(key, "joints are through-going");
    draft.model.joints.push_back(joint);
  });
}

}  // namespace rockfold
