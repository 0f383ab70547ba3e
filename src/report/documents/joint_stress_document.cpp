// In-situ stress on joints round openings.
#include "host/keyblock/face_shape.hpp"
#include "src/base/vector.hpp"
#include "src/report/documents/document_parts.hpp"

namespace rockfold {

Json joint_stress_json(const BlockArrays& blocks, const JointStressReport& report,
                       BlockList faces) {
  Json states = Json::array();
  for (const ContinuumFacts& facts : report.stages) {
    states.push_back({{"stage", facts.stage},
                      {"radius", facts.radius},
                      {"spacing", facts.spacing},
                      {"unknowns", facts.unknowns}});
    if (faces != BlockList::whole) continue;
    const std::vector<Vec3>& traction = report.tractions.after(facts.stage);
    Json& list = states.back()["faces"] = Json::array();
    for (Index b = 0; b < blocks.block_count(); ++b)
      for (Index f = blocks.face_begin[b]; f < blocks.face_begin[b + 1]; ++f) {
        const FaceOrigin& origin = blocks.origins[blocks.face_origin[f]];
        if (blocks.finite[b] == 0 || origin.kind != FaceOrigin::Kind::joint) continue;
        const Vec3& n = blocks.face_normal[f];
        const Real normal = dot(traction[f], n);
        list.push_back({{"block", b + 1},
                        {"joint", origin.name},
                        {"area", blocks.face_area[f]},
                        {"centre", face_centre(blocks, f)},
                        {"normal", n},
                        {"normal_stress", normal},
                        {"shear_stress", norm(traction[f] - normal * n)}});
      }
  }
  return states;
}

}  // namespace rockfold
