// [[monitor]] joint: what a joint does where it is nearest to a point.
#pragma once

#include "kernels/contact/contact.hpp"
#include "kernels/time/motion.hpp"
#include "src/run/run_analysis.hpp"

namespace rockfold {

class JointMonitors {
 public:
  /// The histories begin empty, one for each monitor that has a joint.
  JointMonitors(const RunInput& input, std::vector<JointLaw> laws, std::vector<JointHistory>& out);

  /// Adds the present state. The first call finds the places: throws Error(model) where a joint parts no two blocks.
  void record(const Motion& motion);
  /// The places that it watches.
  void pass(Archive& archive) { archive.pass(watched_); }

 private:
  /// Points of two blocks that lay opposite each other at first.
  struct Watched {
    ContactPoint point;  ///< the nearest then; of it vertices and weights
    Index block[2] = {};
    Index joint = none;
    Vec3 normal{};  ///< from the second block to the first, of the contact as it was last
  };

  void find_places(const Motion& motion);
  Watched nearest(const Monitor& monitor, const std::vector<ContactPoint>& points,
                  const std::vector<ContactSample>& samples) const;
  void add(Watched& watched, const std::vector<ContactSample>& samples,
           const std::vector<Vec3>& displacement, JointHistory& history) const;

  const RunInput& input_;
  std::vector<JointLaw> laws_;
  std::vector<JointHistory>& out_;
  std::vector<Watched> watched_;
};

}  // namespace rockfold
