#include "kernels/operator/elements/sampled_elements_kernel.hpp"
#include "src/space/element_points.hpp"
#include "src/space/shape_functions.hpp"

namespace rockfold::solve {
namespace {

template <class F>
void for_each_on_host(Index n, const F& f) {
  using Host = Kokkos::DefaultHostExecutionSpace;
  Kokkos::parallel_for(
      "rockfold::solve::sample",
      Kokkos::RangePolicy<Host, Kokkos::Schedule<Kokkos::Dynamic>, Kokkos::IndexType<Index>>(0, n),
      f);
}

}  // namespace

Array<Real> sampled_mean_slopes(const CoverArrays& covers) {
  const ElementPoints points(covers, sampling_degree(covers));
  const ElementFunctions functions(covers);
  const Index elements = covers.element_count();
  const std::size_t width = functions.width();
  std::vector<Real> slopes(3 * width * elements, 0.0);
  for_each_on_host(elements, [&](Index e) {
    std::vector<RockPoint> of_element;
    points.add_element(e, of_element);
    const ElementNodes nodes = element_nodes(covers, e);
    std::vector<FunctionValue> function(width);
    Real* mean = &slopes[3 * width * e];
    Real volume = 0;
    for (const RockPoint& point : of_element) {
      functions.at(nodes, point.eta, function.data());
      volume += point.weight;
      for (std::size_t f = 0; f < width; ++f)
        for (int d = 0; d < 3; ++d) mean[3 * f + d] += point.weight * function[f].gradient[d];
    }
    for (std::size_t i = 0; i < 3 * width; ++i) mean[i] /= volume;
  });
  return device::to_device("solve::mean_slopes", slopes);
}

PointSlopes sampled_slopes(const CoverArrays& covers, const std::vector<Index>& element,
                           const std::vector<Vec3>& local) {
  if (!covers.sampled()) return {};
  const ElementFunctions functions(covers);
  const std::size_t width = functions.width();
  std::vector<Real> slopes(3 * width * element.size());
  for_each_on_host(static_cast<Index>(element.size()), [&](Index n) {
    std::vector<FunctionValue> f(width);
    functions.at(element_nodes(covers, element[n]), covers.lattice.to_local(local[n]), f.data());
    for (std::size_t i = 0; i < width; ++i)
      for (int d = 0; d < 3; ++d) slopes[3 * (width * n + i) + d] = f[i].gradient[d];
  });
  return {device::to_device("solve::point_slopes", slopes), 3 * width};
}

}  // namespace rockfold::solve
