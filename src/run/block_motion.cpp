#include "src/run/block_motion.hpp"

#include "kernels/solve/part_functions.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// Sums over the parts of a block: displacement and rotation times volume until they are divided by it.
class Averages {
 public:
  Averages(const CoverArrays& covers, const std::vector<Vec3>& displacement, Index blocks)
      : covers_(covers), functions_(lattice_functions(covers)), d_(displacement), sums_(blocks) {}

  const LatticeFunctions& functions() const { return functions_; }

  /// A body of a part (counted through all forms) with covers `cover`, its moments in m³ times `share`.
  void add(Index block, int part, const Index* cover, const Real* moments, Real share) {
    BlockMotion& sum = sums_[block];
    sum.volume += share * moments[0];
    const PartFunctions& of = functions_.part[part];
    const int n = functions_.functions;
    const auto integral = [&](const Real* coefficients, int terms) {
      Real total = 0;
      for (int m = 0; m < terms; ++m) total += coefficients[m] * moments[m];
      return share * total;
    };
    for (int f = 0; f < functions_.nodes * n; ++f) {
      const Vec3& d = d_[f % n * covers_.cover_count() + cover[f / n]];
      sum.displacement += integral(&of.value[f * functions_.terms()], functions_.terms()) * d;
      Vec3 slope{};
      for (int i = 0; i < 3; ++i)
        slope[i] =
            integral(&of.slope[(3 * f + i) * functions_.slope_terms()], functions_.slope_terms());
      // Half the curl of φ d; functions 0 by differences to the first node's, so that a translation turns nothing.
      sum.rotation += 0.5 * cross(slope, f % n == 0 ? d - d_[cover[0]] : d);
    }
  }

  std::vector<BlockMotion> take() {
    for (BlockMotion& block : sums_) {
      if (!(block.volume > 0)) continue;
      block.displacement = (1 / block.volume) * block.displacement;
      block.rotation = (1 / block.volume) * block.rotation;
    }
    return std::move(sums_);
  }

 private:
  const CoverArrays& covers_;
  LatticeFunctions functions_;
  const std::vector<Vec3>& d_;
  std::vector<BlockMotion> sums_;
};

/// The part of a cut element, counted through all forms.
int part_of(const CoverArrays& covers, Index e) {
  return covers.element_part[e] +
         covers.parts_per_cell() * LatticeFunctions::form(covers.lattice, covers.element_cell[e]);
}

}  // namespace

std::vector<BlockMotion> average_block_motion(const CoverArrays& covers,
                                              const PieceMoments& moments,
                                              const std::vector<Vec3>& displacement, Index blocks) {
  Averages sums(covers, displacement, blocks);
  const LatticeFunctions& all = sums.functions();
  for (Index r = 0; r < covers.regular_count(); ++r) {
    const int first = all.parts * LatticeFunctions::form(covers.lattice, covers.regular_cell[r]);
    for (int part = first; part < first + all.parts; ++part) {
      std::array<Index, 8> cover{};
      for (int a = 0; a < all.nodes; ++a)
        cover[a] = covers.regular_cover[all.cell_nodes * r + all.part[part].node[a]];
      sums.add(covers.regular_block[r], part, cover.data(), all.part[part].moment.data(), 1);
    }
  }
  const std::size_t terms =
      moments.volume.empty() ? 0 : moments.local.size() / moments.volume.size();
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      sums.add(covers.piece_block[q], part_of(covers, e),
               &covers.element_cover[static_cast<std::size_t>(all.nodes) * e],
               &moments.local[terms * q], all.share);
  return sums.take();
}

std::vector<Stress> average_block_stress(const CoverArrays& covers, const PieceMoments& moments,
                                         const std::vector<Stress>& element_stress, Index blocks) {
  const LatticeFunctions all = lattice_functions(covers);
  std::vector<Stress> sums(blocks);
  std::vector<Real> volumes(blocks, 0.0);
  const auto add = [&](Index block, Real volume, const Stress& stress) {
    volumes[block] += volume;
    for (int k = 0; k < 6; ++k) sums[block][k] += volume * stress[k];
  };
  for (Index r = 0; r < covers.regular_count(); ++r) {
    const int first = all.parts * LatticeFunctions::form(covers.lattice, covers.regular_cell[r]);
    for (int part = 0; part < all.parts; ++part)
      add(covers.regular_block[r], all.part[first + part].moment[0],
          element_stress[static_cast<std::size_t>(all.parts) * r + part]);
  }
  const std::size_t whole = static_cast<std::size_t>(all.parts) * covers.regular_count();
  for (Index e = 0; e < covers.cut_count(); ++e)
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      add(covers.piece_block[q], all.share * moments.volume[q], element_stress[whole + e]);
  for (Index b = 0; b < blocks; ++b)
    for (int k = 0; k < 6 && volumes[b] > 0; ++k) sums[b][k] /= volumes[b];
  return sums;
}

LargestDisplacement find_largest_displacement(const CoverArrays& covers,
                                              const std::vector<Vec3>& displacement) {
  LargestDisplacement largest;
  const auto offer = [&](const Vec3& u, const Vec3& point, Index block) {
    if (largest.block == none || norm(u) > largest.length) largest = {norm(u), point, block};
  };
  // At a node of a whole cell all functions of its cover vanish but the constant one.
  const int cell_nodes = covers.nodes_per_cell();
  for (Index r = 0; r < covers.regular_count(); ++r)
    for (int c = 0; c < cell_nodes; ++c)
      offer(displacement[covers.regular_cover[cell_nodes * r + c]],
            covers.lattice.node_position(covers.lattice.cell_node(covers.regular_cell[r], c)),
            covers.regular_block[r]);
  const LatticeFunctions all = lattice_functions(covers);
  for (Index e = 0; e < covers.cut_count(); ++e) {
    const Vec3 centre = covers.lattice.cell_centre(covers.element_cell[e]);
    for (Index q = covers.piece_begin[e]; q < covers.piece_begin[e + 1]; ++q)
      for (Index v = covers.vertex_begin[q]; v < covers.vertex_begin[q + 1]; ++v) {
        const Vec3 x{covers.vertex_xyz[3 * v], covers.vertex_xyz[3 * v + 1],
                     covers.vertex_xyz[3 * v + 2]};
        const auto value = all.values(part_of(covers, e), covers.lattice.to_local(x));
        Vec3 u{};
        for (std::size_t f = 0; f < value.size(); ++f)
          u += value[f] * displacement[f % all.functions * covers.cover_count() +
                                       covers.element_cover[all.nodes * e + f / all.functions]];
        offer(u, centre + x, covers.piece_block[q]);
      }
  }
  return largest;
}

}  // namespace rockfold
