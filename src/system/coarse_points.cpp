#include "src/system/coarse_points.hpp"

#include <map>

namespace rockfold::solve {

MaterialPoints coarsen_points(const MaterialPoints& points, const CoarseCovers& coarse,
                              const std::vector<Real>& step) {
  const Index fines = static_cast<Index>(coarse.parent_begin.size()) - 1, coarses = coarse.count();
  MaterialPoints result;
  result.element = points.element;
  for (std::size_t n = 0; n < points.size(); ++n) {
    std::map<Index, Real> weight;
    for (Index i = points.begin[n]; i < points.begin[n + 1]; ++i) {
      const Index p = points.unknown[i] % fines;
      const int k = points.unknown[i] / fines;
      for (Index q = coarse.parent_begin[p]; q < coarse.parent_begin[p + 1]; ++q) {
        const Real w = points.weight[i] * coarse.weight[q];
        const auto add = [&](int f, Real share) {
          weight[f * coarses + coarse.parent[q]] += share * w;
        };
        add(k, 1);
        if (step.empty() || k < 1 || k > 3) continue;
        const int d = k - 1, e = (d + 1) % 3, g = (d + 2) % 3;
        const Real* s = &step[3 * static_cast<std::size_t>(q)];
        add(4 + d, s[d]);
        add(7 + d, 0.5 * s[e]);
        add(7 + g, 0.5 * s[g]);
      }
    }
    for (const auto& [unknown, w] : weight) {
      if (w == 0) continue;
      result.unknown.push_back(unknown);
      result.weight.push_back(w);
    }
    result.begin.push_back(static_cast<Index>(result.unknown.size()));
  }
  return result;
}

}  // namespace rockfold::solve
