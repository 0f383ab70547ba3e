#include "kernels/time/explicit/explicit_kernel.hpp"

namespace rockfold::motion {
namespace {

/// x = 1 in component d of function k of all blocks.
void set_unit(const Field& x, Index covers, int k, int d) {
  Kokkos::deep_copy(x, 0.0);
  device::for_each(
      "rockfold::motion::unit", covers, KOKKOS_LAMBDA(const Index p) { x(k * covers + p, d) = 1; });
}

/// Blocks share no function, so that one product finds a column of all matrices.
void find_mass(Motion::Data& m) {
  const ExplicitScheme& s = m.explicit_scheme;
  const Index covers = m.covers;
  const int n = s.functions;
  const auto mass = s.mass;
  const Field y = m.right;
  for (int k = 0; k < n; ++k) {
    set_unit(m.work, covers, k, 0);
    m.rock->apply({0, 1}, m.work, y);
    device::for_each(
        "rockfold::motion::mass_column", covers, KOKKOS_LAMBDA(const Index p) {
          for (int l = 0; l < n; ++l)
            mass((static_cast<std::size_t>(p) * n + l) * n + k) = y(l * covers + p, 0);
        });
  }
}

void find_stiffness(Motion::Data& m) {
  Kokkos::deep_copy(m.work, 0.0);
  m.rock->begin_step(m.work, {});
  m.rock->drop_geometric_stiffness();
  m.step_length = 0;
  const ExplicitScheme& s = m.explicit_scheme;
  const Index covers = m.covers;
  const int n = s.functions, width = 3 * n;
  const auto stiffness = s.stiffness;
  const Field y = m.right;
  for (int column = 0; column < width; ++column) {
    set_unit(m.work, covers, column / 3, column % 3);
    m.rock->apply({1, 0}, m.work, y);
    device::for_each(
        "rockfold::motion::stiffness_column", covers, KOKKOS_LAMBDA(const Index p) {
          for (int i = 0; i < width; ++i)
            stiffness((static_cast<std::size_t>(p) * width + i) * width + column) =
                y(i / 3 * covers + p, i % 3);
        });
  }
}

/// Each surface vertex is of one block.
void list_vertices(Motion::Data& m) {
  ExplicitScheme& s = m.explicit_scheme;
  std::vector<Index> begin(m.covers + 1, 0), vertex;
  if (m.contact) {
    const std::vector<Index> first = device::to_host(m.contact->vertex.begin),
                             unknown = device::to_host(m.contact->vertex.unknown);
    std::vector<std::vector<Index>> of_block(m.covers);
    for (Index n = 0; n < m.contact->vertex.count; ++n)
      of_block[unknown[first[n]] % m.covers].push_back(n);
    for (Index p = 0; p < m.covers; ++p) {
      vertex.insert(vertex.end(), of_block[p].begin(), of_block[p].end());
      begin[p + 1] = static_cast<Index>(vertex.size());
    }
  }
  s.vertex_begin = device::to_device("motion::vertex_begin", begin);
  s.vertex = device::to_device("motion::vertex", vertex);
}

}  // namespace

void find_inertia(Motion::Data& m) {
  ExplicitScheme& s = m.explicit_scheme;
  s.functions = m.system.op.functions;
  const std::size_t small = static_cast<std::size_t>(m.covers) * s.functions * s.functions;
  if (s.mass.extent(0) != small) {
    s.mass = device::allocate<Real>("motion::block_mass", small);
    s.factor = device::allocate<Real>("motion::mass_factor", m.covers);
    s.stiffness = device::allocate<Real>("motion::block_stiffness", 9 * small);
    s.damped = device::allocate<Real>("motion::damped", 9 * small);
    s.rigid = device::allocate<Real>("motion::rigid", 9 * small);
    s.slowed = device::allocate<Real>("motion::slowed", 9 * small);
    s.turn = device::allocate<Real>("motion::block_turn", 9 * static_cast<std::size_t>(m.covers));
    s.lost = device::allocate<Real>("motion::lost", m.covers);
    s.unbalanced = device::allocate<Real>("motion::unbalanced", m.covers);
    s.ahead = device::allocate<Real>("motion::ahead", m.covers);
    s.step = device::allocate<Real>("motion::block_step", m.covers);
    s.turning = device::allocate<Real>("motion::turning_step", m.covers);
  }
  list_vertices(m);
  find_stiffness(m);
  find_mass(m);
  find_rigid(m);
}

}  // namespace rockfold::motion
