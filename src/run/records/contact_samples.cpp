#include "src/run/records/contact_samples.hpp"

#include "src/base/vector.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold {

std::vector<ContactSample> contact_samples(const RunInput& input, const std::vector<JointLaw>& laws,
                                           const std::vector<ContactPoint>& points,
                                           const std::vector<Vec3>& displacement) {
  const MaterialPoints& vertices = input.contact->points;
  const SurfaceArrays& surfaces = input.contact->surfaces;
  std::vector<ContactSample> samples;
  samples.reserve(points.size());
  for (const ContactPoint& p : points) {
    const JointLaw& law = laws[p.law];
    const ContactMemory& memory = p.memory;
    ContactSample sample;
    Vec3 apart{};
    for (int k = 0; k < 6; ++k) {
      if (p.weight[k] == 0) continue;
      const auto v = static_cast<std::size_t>(p.vertex[k]);
      const Vec3 x =
          point_position(input.covers, vertices, v) + interpolate(vertices, v, displacement);
      apart += p.weight[k] * x;
      if (k < 3) sample.place += p.weight[k] * x;
    }
    for (int side = 0; side < 2; ++side)
      sample.block[side] = surfaces.vertex_block[p.vertex[3 * side]];
    sample.normal = {p.normal[0], p.normal[1], p.normal[2]};
    sample.joint = p.joint;
    if (p.law < static_cast<Index>(input.model.joint_materials.size())) sample.material = p.law;
    sample.state = memory.state;
    sample.gap = dot(sample.normal, apart) + p.offset;
    sample.area = p.area;
    if (memory.state != Contact::open) {
      sample.normal_stress = -law.normal_stiffness * memory.pressed;
      const Vec3 along = {p.along[0], p.along[1], p.along[2]};
      sample.shear = -law.shear_stiffness *
                     (memory.shear[0] * along + memory.shear[1] * cross(sample.normal, along));
    }
    sample.slip = memory.slip;
    samples.push_back(sample);
  }
  return samples;
}

Vec3 way_apart(const RunInput& input, const ContactPoint& point,
               const std::vector<Vec3>& displacement) {
  Vec3 apart{};
  for (int k = 0; k < 6; ++k)
    if (point.weight[k] != 0)
      apart +=
          point.weight[k] * interpolate(input.contact->points,
                                        static_cast<std::size_t>(point.vertex[k]), displacement);
  return apart;
}

}  // namespace rockfold
