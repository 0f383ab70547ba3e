#include "src/run/records/block_courses.hpp"

#include <algorithm>
#include <cmath>

#include "src/base/vector.hpp"
#include "src/run/records/block_motion.hpp"
#include "src/run/records/contact_samples.hpp"
#include "src/run/records/rest.hpp"

namespace rockfold {

BlockCourses::BlockCourses(const RunInput& input, const PieceMoments& moments,
                           const std::vector<JointLaw>& laws, std::vector<BlockCourse>& out)
    : input_(input),
      moments_(moments),
      laws_(laws),
      out_(out),
      resting_speed_(resting_speed(input)) {
  out_.resize(input.blocks.block_count());
}

void BlockCourses::look(const Motion& motion) {
  const StateArrays state = motion.state();
  const auto moved =
      average_block_motion(input_.covers, moments_, state.displacement, input_.blocks.block_count(),
                           input_.model.analysis->large());
  const auto velocity =
      average_block_motion(input_.covers, moments_, state.velocity, input_.blocks.block_count());
  if (!(largest_speed(velocity) <= resting_speed_))
    at_rest_since_ = std::numeric_limits<Real>::quiet_NaN();
  else if (std::isnan(at_rest_since_))
    at_rest_since_ = state.time;
  std::vector<std::size_t> begin;
  for (std::size_t b = 0; b < out_.size(); ++b) {
    BlockCourse& course = out_[b];
    course.displacement = moved[b].displacement;
    course.rotation = moved[b].rotation;
    if (!std::isnan(course.began) || !has_moved(course.displacement, input_.blocks.volume[b]))
      continue;
    course.began = state.time;
    course.first_displacement = moved[b].displacement;
    course.first_rotation = moved[b].rotation;
    begin.push_back(b);
  }
  if (begin.empty()) return;
  const std::vector<Real> force = pressing(motion, state);
  for (const std::size_t b : begin) out_[b].first_pressing = force[b];
}

std::vector<Real> BlockCourses::pressing(const Motion& motion, const StateArrays& state) const {
  std::vector<Real> force(out_.size(), 0);
  for (const ContactSample& s :
       contact_samples(input_, laws_, motion.contact_points(), state.displacement))
    for (int side = 0; side < 2; ++side) {
      const Index block = s.block[side], other = s.block[1 - side];
      if (2 * norm(out_[other].displacement) < norm(out_[block].displacement))
        force[block] += std::max(Real{0}, -s.normal_stress * s.area);
    }
  return force;
}

}  // namespace rockfold
