#include "host/bolting/bolt_elements.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host/bolting/bolt_law.hpp"
#include "host/bolting/shotcrete.hpp"
#include "host/cover/points/locate.hpp"
#include "host/cut/cells/complex.hpp"
#include "src/base/gauss.hpp"
#include "src/base/vector.hpp"

namespace rockfold {
namespace {

/// λh, h the distance of nodes and λ² = k/EA: the force along a bolt dies away by e in 1/λ, and is then right within (λh)²/24 of its slope.
constexpr Real resolution = 0.2;
/// Nodes in one link, at most: stiffer bonds are resolved no better.
constexpr Index most_pieces = 2000;
/// Of the length over which load builds up: what of a bolt stretches at a joint, which is none.
constexpr Real next_to_nothing = 0.01;
/// Of a cell of the lattice: how far points of a bolt are apart in it.
constexpr Real of_cell = 0.5;

class Builder {
 public:
  Builder(const Model& model, const BlockArrays& blocks, const Covering& covering,
          BoltArrays& arrays)
      : model_(model), blocks_(blocks), locator_(covering), covers_(covering.arrays), all_(arrays) {
    const auto& edge = covers_.lattice.edge;
    apart_ = covers_.lattice.kind == LatticeKind::block
                 ? 0
                 : of_cell * std::min({norm(edge[0]), norm(edge[1]), norm(edge[2])});
  }

  void add(const Bolt& bolt, const BoltGroup& group);
  /// A bar across a joint at x, normal to the wall.
  void bridge(const ShotcreteTrace& trace, const Vec3& x, const BoltLaw& law, Index install);

 private:
  void begin(const Bolt& bolt, const BoltGroup& group);
  void add_point(Real at, Index block) { add_point(bolt_->collar + at * bolt_->direction, block); }
  void add_point(const Vec3& x, Index block);
  void add_node(Real at, Index element);
  void add_piece(Real from, Real to, Index block);
  void add_gap(Real from, Real to, const Dowel* dowel);
  void hold_anchor();
  void go_on_beyond(const RockSegment& last);

  const Model& model_;
  const BlockArrays& blocks_;
  Locator locator_;
  const CoverArrays& covers_;
  BoltArrays& all_;
  Real apart_ = 0;
  const Bolt* bolt_ = nullptr;
  const BoltType* type_ = nullptr;
  Real bond_begins_ = 0;
  Index element_ = none;  // of the last point
};

void Builder::begin(const Bolt& bolt, const BoltGroup& group) {
  bolt_ = &bolt;
  type_ = &group.type;
  all_.law.push_back(bolt_law(group.type, bolt.length));
  all_.direction.push_back(bolt.direction);
  all_.toe.push_back(bolt.length);
  all_.install.push_back(group.install);
  bond_begins_ = 0;
  if (group.type.coupling == Coupling::dmfc)
    bond_begins_ = bolt.length - group.type.anchor_length.value_or(0);
}

void Builder::add_point(const Vec3& x, Index block) {
  Holder holder = locator_.find_firm(x, block);
  if (!holder.found()) holder = locator_.nearest_of(x, block);
  locator_.add(x, holder, all_.points);
  all_.place.push_back(x);
  element_ = holder.element;
}

void Builder::add_node(Real at, Index element) {
  all_.node_place.push_back(at);
  all_.bond_from.push_back(at);
  all_.bond_to.push_back(at);
  all_.node_element.push_back(element);
}

/// Between two points of one block, of which the first is there.
void Builder::add_piece(Real from, Real to, Index block) {
  const BoltLaw& law = all_.law.back();
  const bool stiff = type_->coupling == Coupling::dmfc && !type_->bond_stiffness;  // as one
  const bool holds = to > bond_begins_ && !stiff;
  const Real h = resolution * std::sqrt(law.section / law.bond_stiffness);
  const Real wanted = holds ? std::ceil((to - from) / h) : 1;
  const Index pieces =
      static_cast<Index>(std::clamp(wanted, Real{1}, static_cast<Real>(most_pieces)));
  const Index near = element_;
  add_point(to, block);
  for (Index k = 1; k <= pieces; ++k) {
    const Real share = static_cast<Real>(k) / static_cast<Real>(pieces);
    const Real before = all_.node_place.back(), at = from + share * (to - from);
    const Real middle = 0.5 * (before + at);
    if (middle > bond_begins_) {
      if (!(all_.bond_to.back() > all_.bond_from.back()))
        all_.bond_from.back() = std::max(before, bond_begins_);
      all_.bond_to.back() = middle;
    }
    add_node(at, share < 0.5 ? near : element_);
    if (at > bond_begins_) all_.bond_from.back() = std::max(middle, bond_begins_);
  }
  all_.link.push_back(BoltLink::piece);
  all_.link_length.push_back(to - from);
  all_.elastic_length.push_back(to - from);
  all_.dowel.push_back(0);
  all_.steel_begin.push_back(all_.steel_begin.back() + pieces);
}

/// Across a joint, or air; the last point is before it and the next one behind it.
void Builder::add_gap(Real from, Real to, const Dowel* dowel) {
  add_node(to, element_);
  all_.link.push_back(dowel ? BoltLink::crossing : BoltLink::piece);
  all_.link_length.push_back(to - from + (dowel ? dowel->length : 0));
  const BoltLaw& law = all_.law.back();
  const bool stiff = type_->coupling == Coupling::dmfc;
  const Real builds_up = stiff ? 0.1 * bolt_->length : std::sqrt(law.section / law.bond_stiffness);
  all_.elastic_length.push_back(to - from +
                                (dowel ? std::min(dowel->length, next_to_nothing * builds_up) : 0));
  all_.dowel.push_back(dowel && type_->shear_capacity > 0 ? dowel->stiffness : 0);
  all_.steel_begin.push_back(all_.steel_begin.back() + 1);
}

/// A bolt that is anchored at its toe alone does not give there.
void Builder::hold_anchor() {
  if (type_->coupling != Coupling::dmfc || type_->anchor_length) return;
  all_.bond_from.back() = all_.node_place[all_.node_place.size() - 2];
  all_.bond_to.back() = all_.node_place.back();
}

/// Where the rock goes on beyond the model the bolt does too, in rock that moves as that before it.
void Builder::go_on_beyond(const RockSegment& last) {
  const bool beyond =
      last.exit_face != none && blocks_.origins[blocks_.face_origin[last.exit_face]].continues;
  if (!beyond || !(bolt_->length > last.to)) return;
  if (!(all_.bond_to.back() > all_.bond_from.back()))
    all_.bond_from.back() = std::max(last.to, bond_begins_);
  all_.bond_to.back() = bolt_->length;
}

void Builder::add(const Bolt& bolt, const BoltGroup& group) {
  begin(bolt, group);
  const RockSegment* before = nullptr;
  for (const RockSegment& segment : bolt.rock) {
    add_point(segment.from, segment.block);
    if (!before) {
      add_node(segment.from, element_);
    } else {
      const Material &one = model_.materials[blocks_.material[before->block]],
                     &other = model_.materials[blocks_.material[segment.block]];
      const Dowel dowel =
          dowel_of(group.type, one.young_modulus < other.young_modulus ? one : other);
      add_gap(before->to, segment.from,
              segment.from - before->to < dowel.length ? &dowel : nullptr);
    }
    const Real length = segment.to - segment.from;
    const Index parts =
        apart_ > 0 ? static_cast<Index>(std::max(Real{1}, std::ceil(length / apart_))) : 1;
    for (Index k = 1; k <= parts; ++k) {
      const Real from = segment.from + length * static_cast<Real>(k - 1) / static_cast<Real>(parts),
                 to = segment.from + length * static_cast<Real>(k) / static_cast<Real>(parts);
      add_piece(from, to, segment.block);
    }
    before = &segment;
  }
  hold_anchor();
  go_on_beyond(bolt.rock.back());
  all_.point_begin.push_back(static_cast<Index>(all_.place.size()));
  all_.node_begin.push_back(static_cast<Index>(all_.node_place.size()));
}

void Builder::bridge(const ShotcreteTrace& trace, const Vec3& x, const BoltLaw& law,
                     Index install) {
  all_.law.push_back(law);
  all_.direction.push_back(trace.into_rock);
  all_.install.push_back(install);
  all_.toe.push_back(1);
  for (const Index block : trace.block) {
    add_point(x, block);
    add_node(0, element_);
    all_.bond_to.back() = 1;
  }
  all_.link.push_back(BoltLink::crossing);
  all_.link_length.push_back(1);
  all_.elastic_length.push_back(1);
  all_.dowel.push_back(0);
  all_.steel_begin.push_back(all_.steel_begin.back() + 1);
  all_.point_begin.push_back(static_cast<Index>(all_.place.size()));
  all_.node_begin.push_back(static_cast<Index>(all_.node_place.size()));
}

/// Whether a block is not there any more when support of a stage comes in.
class GoneBlocks {
 public:
  GoneBlocks(const Model& model, const BlockArrays& blocks,
             const std::vector<std::uint8_t>& analysed)
      : stages_(model.analysis->stages), blocks_(blocks), analysed_(analysed) {}

  bool are_gone(Index block, Index install) const {
    if (analysed_[block] == 0) return true;
    const Index stage = blocks_.stage.empty() ? 0 : blocks_.stage[block];
    for (Index s = 0; stage > 0 && s <= install; ++s)
      if (stages_[s].excavate == stage) return true;
    return false;
  }

 private:
  const std::vector<AnalysisStage>& stages_;
  const BlockArrays& blocks_;
  const std::vector<std::uint8_t>& analysed_;
};

/// Of a strip of shotcrete, one metre of joint: a band as wide as it is thick, sheared by the block that comes out.
BoltLaw law_of_shotcrete(const Shotcrete& shotcrete, Real strength) {
  constexpr Real concrete = 20e9, poisson_ratio = 0.2, rigid = 1e6;
  BoltLaw law;
  law.section = concrete / (2 * (1 + poisson_ratio));
  law.yield = law.strength = strength;
  law.stiffness = law.section;
  law.reach = shotcrete.thickness;
  law.bond_stiffness = rigid * law.section;
  law.bond_strength = std::numeric_limits<Real>::infinity();
  law.pushed = 1;
  return law;
}

/// Bars for each part of a trace, as long as this at most, m: exact while what they bear is linear along it, and its moments.
constexpr int bars_of_part = 2;
constexpr Real longest_part = 1;

void add_shotcrete(const Model& model, const BlockArrays& blocks, const GoneBlocks& gone,
                   Builder& builder, std::vector<Real>& bridged) {
  const Shotcrete& shotcrete = *model.shotcrete;
  for (const WallFaces& wall : shotcrete.on)
    Wall(blocks, model, wall, shotcrete.place);  // refuses walls that are not there
  const ShotcreteCover cover(blocks, shotcrete);
  for (const ShotcreteTrace& trace : cover.traces()) {
    if (gone.are_gone(trace.block[0], shotcrete.install) ||
        gone.are_gone(trace.block[1], shotcrete.install))
      continue;
    const Real length = norm(trace.to - trace.from);
    const auto parts = static_cast<Index>(std::ceil(length / longest_part));
    const Real share = length / static_cast<Real>(bars_of_part * parts);
    BoltLaw law = law_of_shotcrete(shotcrete, cover.strength());
    for (Real* of_metre :
         {&law.section, &law.yield, &law.strength, &law.stiffness, &law.bond_stiffness})
      *of_metre *= share;
    for (Index k = 0; k < parts; ++k)
      for (const GaussPoint& at : gauss_points(bars_of_part)) {
        const Real along = (static_cast<Real>(k) + at.x) / static_cast<Real>(parts);
        builder.bridge(trace, trace.from + along * (trace.to - trace.from), law, shotcrete.install);
        bridged.push_back(share);
      }
  }
}

}  // namespace

BoltLines BoltElements::lines() const {
  BoltLines lines;
  for (Index b = 0; b < bolts(); ++b) {
    const Bolt& bolt = drilled.bolts[b];
    for (Index n = arrays.node_begin[b]; n < arrays.node_begin[b + 1]; ++n) {
      lines.node.push_back(bolt.collar + arrays.node_place[n] * bolt.direction);
      if (n == arrays.node_begin[b]) continue;
      lines.steel.push_back({n - 1, n});
      lines.bolt.push_back(b);
    }
  }
  return lines;
}

bool has_bolts(const Model& model) {
  return model.analysis && model.analysis->large() &&
         (!model.bolts.empty() || !model.bolt_patterns.empty());
}

bool has_shotcrete(const Model& model) {
  return model.analysis && model.analysis->large() && model.shotcrete.has_value();
}

BoltElements bolt_elements(const Cutting& cutting, const Covering& covering,
                           const BlockArrays& blocks, const Model& model) {
  BoltElements elements;
  if (!has_bolts(model) && !has_shotcrete(model)) return elements;
  const GoneBlocks gone(model, blocks, cutting.complex->block_is_analysed);
  Builder builder(model, blocks, covering, elements.arrays);
  if (has_bolts(model)) {
    DrilledBolts& drilled = elements.drilled;
    drilled = drill_model(blocks, model);
    for (Bolt& bolt : drilled.bolts)
      std::erase_if(bolt.rock, [&](const RockSegment& segment) {
        return gone.are_gone(segment.block, drilled.groups[bolt.group].install);
      });
    require_rock(model, drilled);
    std::erase_if(drilled.bolts, [](const Bolt& bolt) { return bolt.rock.empty(); });
    for (const Bolt& bolt : drilled.bolts) builder.add(bolt, drilled.groups[bolt.group]);
  }
  if (has_shotcrete(model)) add_shotcrete(model, blocks, gone, builder, elements.bridged);
  return elements;
}

}  // namespace rockfold
