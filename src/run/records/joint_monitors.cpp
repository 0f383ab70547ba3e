#include "src/run/records/joint_monitors.hpp"

#include <limits>

#include "src/base/error.hpp"
#include "src/base/vector.hpp"
#include "src/model/joint_name.hpp"
#include "src/run/records/contact_samples.hpp"

namespace rockfold {

JointMonitors::JointMonitors(const RunInput& input, std::vector<JointLaw> laws,
                             std::vector<JointHistory>& out)
    : input_(input), laws_(std::move(laws)), out_(out) {
  for (const Monitor& monitor : input.model.monitors) {
    if (monitor.is_of_rock()) continue;
    JointHistory& history = out_.emplace_back();
    history.name = monitor.name;
    history.joint = monitor.joint;
  }
}

JointMonitors::Watched JointMonitors::nearest(const Monitor& monitor,
                                              const std::vector<ContactPoint>& points,
                                              const std::vector<ContactSample>& samples) const {
  Real least = std::numeric_limits<Real>::infinity();
  Watched found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const ContactSample& s = samples[i];
    if (s.joint == none || !is_joint_of(input_.blocks.origins[s.joint].name, monitor.joint))
      continue;
    const Real distance = norm(s.place - monitor.point);
    if (!(distance < least)) continue;
    least = distance;
    found = {points[i], {s.block[0], s.block[1]}, s.joint, s.normal};
  }
  if (found.joint != none) return found;
  Place place = monitor.place;
  place.key += ".joint";
  throw Error(ErrorKind::model,
              "\"" + monitor.joint + "\" parts no two blocks: there is nothing to record (in \"" +
                  monitor.name + "\")",
              place);
}

void JointMonitors::find_places(const Motion& motion) {
  const auto points = motion.contact_points();
  const auto samples = contact_samples(input_, laws_, points, motion.state().displacement);
  for (const Monitor& monitor : input_.model.monitors)
    if (!monitor.is_of_rock()) watched_.push_back(nearest(monitor, points, samples));
}

void JointMonitors::add(Watched& watched, const std::vector<ContactSample>& samples,
                        const std::vector<Vec3>& displacement, JointHistory& history) const {
  Real area = 0, pressure = 0;
  Vec3 shear{}, normal{};
  Contact state = Contact::open;
  for (const ContactSample& s : samples) {
    const bool same = s.block[0] == watched.block[0] && s.block[1] == watched.block[1];
    const bool turned = s.block[0] == watched.block[1] && s.block[1] == watched.block[0];
    if (s.joint != watched.joint || !(same || turned)) continue;
    area += s.area;
    pressure += s.area * s.normal_stress;
    shear += (turned ? -s.area : s.area) * s.shear;
    normal += (turned ? -s.area : s.area) * s.normal;
    if (s.state != Contact::open && state != Contact::slide) state = s.state;
  }
  if (norm(normal) > 0) watched.normal = (1 / norm(normal)) * normal;
  const Vec3 apart = way_apart(input_, watched.point, displacement);
  const Real opening = dot(watched.normal, apart);
  history.opening.push_back(opening);
  history.slip.push_back(norm(apart - opening * watched.normal));
  history.normal_stress.push_back(area > 0 ? pressure / area : 0);
  history.shear_stress.push_back(area > 0 ? norm(shear) / area : 0);
  history.state.push_back(state);
}

void JointMonitors::record(const Motion& motion) {
  if (out_.empty()) return;
  if (watched_.empty()) find_places(motion);
  const std::vector<Vec3> displacement = motion.state().displacement;
  const auto samples = contact_samples(input_, laws_, motion.contact_points(), displacement);
  for (std::size_t n = 0; n < out_.size(); ++n) {
    out_[n].time.push_back(motion.time());
    add(watched_[n], samples, displacement, out_[n]);
  }
}

}  // namespace rockfold
