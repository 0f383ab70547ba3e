#include "host/cover/connect.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "host/cover/glue.hpp"
#include "host/cover/piece_interfaces.hpp"
#include "host/cut/bodies/union_find.hpp"
#include "src/base/error.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

class Connector {
 public:
  Connector(const Complex& complex, const Model& model, const Pieces& pieces, CoverArrays& covers,
            PieceIndex& index)
      : complex_(complex),
        model_(model),
        heals_dead_ends_(heals_dead_ends(complex, model)),
        pieces_(pieces),
        is_block_(covers.lattice.kind == LatticeKind::block),
        covers_(covers),
        nodes_(covers.nodes_per_cell()),
        part_nodes_(covers.nodes_per_part()),
        index_(index),
        cells_(covers.lattice, pieces),
        piece_parts_(static_cast<Index>(pieces.pieces.size())),
        glue_(complex, index.lattice, index.planes, cells_),
        interfaces_(complex, index.lattice, index.planes, pieces) {
    find_face_nodes();
  }

  void run() {
    write_regular();
    if (is_block_)
      join_blocks();
    else
      find_virtual_links();
    number_elements();
    write_elements();
    join_stars();
    number_covers();
  }

 private:
  // A piece, or a sliver, in the element that it belongs to.
  struct Placed {
    Index element, piece, sliver;
  };
  // A regular lattice cell, a piece, or a sliver.
  struct Spot {
    Index regular = none, piece = none, sliver = none;
    int part = 0;
  };
  // Two spots that glue joins across a facet, or inside a part where they are not one element.
  struct Link {
    Spot one, two;
    const PartFacet* facet;  // of the first; null = inside
  };

  // The nodes on a lattice cell's upper face along each axis, and the same among those of the next cell.
  void find_face_nodes() {
    const auto& node = cell_split(covers_.lattice.kind).node;
    for (int axis = 0; axis < 3; ++axis)
      for (std::size_t a = 0; a < node.size(); ++a) {
        HalfSteps opposite = node[a];
        if (opposite[axis] != 2) continue;
        opposite[axis] = 0;
        const auto b = std::find(node.begin(), node.end(), opposite) - node.begin();
        face_nodes_[axis].emplace_back(static_cast<Index>(a), static_cast<Index>(b));
      }
  }

  Index material(Index rock) const { return model_.solids[complex_.zone(rock).solid].material; }
  const SplitTable::Form& form(Index lattice_cell) const {
    return index_.lattice.form(covers_.lattice.cell_ijk(lattice_cell));
  }
  const PieceRecord& record(Index piece) const { return pieces_.pieces[piece]; }

  void write_regular() {
    for (const auto& r : pieces_.regular) {
      covers_.regular_cell.push_back(r.lattice_cell);
      covers_.regular_material.push_back(material(r.rock));
      covers_.regular_block.push_back(complex_.cell_block[r.rock]);
      index_.regular_rock.push_back(r.rock);
    }
  }

  // Kind `block`: what a block has of one material is an element.
  void join_blocks() {
    for (const CellContent& c : cells_.all()) {
      std::map<Index, Index> first;  // piece of each material
      for (Index i = c.piece_begin; i < c.piece_end; ++i)
        piece_parts_.join(i, first.try_emplace(material(record(i).rock), i).first->second);
    }
  }

  // Glue between cells of the complex. Inside a part it joins pieces of one material to one element.
  void find_virtual_links() {
    for (const Fragment& f : complex_.fragments) {
      if (parts_covers(f) || f.narrow || complex_.touches_sliver(f)) continue;
      if (!complex_.is_analysed(f.cell[0]) || !complex_.is_analysed(f.cell[1])) continue;
      glue_.visit(f, [&](const GlueArea& c) { add_links(c); });
    }
    for (const Beam& b : complex_.beams)
      if (b.cell[1] != none && !parts_covers(b) && !b.narrow && complex_.is_analysed(b.cell[0]) &&
          complex_.is_analysed(b.cell[1]))
        add_beam_links(b);
  }

  // Whether a joint lies between two cells, and covers do not go on across it. `between`: a fragment, or a beam that ends in a cell.
  template <class Between>
  bool parts_covers(const Between& between) const {
    if (between.joint == none || model_.cover->joints == JointTreatment::welded) return false;
    return !heals_dead_ends_ ||
           complex_.cell_block[between.cell[0]] != complex_.cell_block[between.cell[1]];
  }

  // Both cells' pieces by the beam; where the lattice runs through the sliver between them, in neighbouring parts.
  void add_beam_links(const Beam& beam) {
    const Real reach = index_.planes.width_tolerance() + length(beam);
    visit_parts_near(
        index_.lattice, index_.planes, beam.polygon,
        [&](const std::array<Index, 3>& ijk, int part, const std::vector<Vec3>& area) {
          const Index cell = covers_.lattice.cell_index(ijk[0], ijk[1], ijk[2]);
          const Holding one = cells_.find_any(cell, part, beam.cell[0]);
          add_links(one, cells_.find_any(cell, part, beam.cell[1]), nullptr);
          for (const PartFacet& facet : form(cell).facet[part]) {
            auto next = ijk;
            if (facet.axis >= 0) {
              next[facet.axis] += facet.step;
              if (next[facet.axis] < 0 || next[facet.axis] >= covers_.lattice.cells[facet.axis])
                continue;
            }
            if (farthest(area, plane_of(index_.lattice.inside(ijk, facet))) < reach)
              add_links(one,
                        cells_.find_any(covers_.lattice.cell_index(next[0], next[1], next[2]),
                                        facet.other, beam.cell[1]),
                        &facet);
          }
        });
  }

  // m: across the slivers from the first cell to the second.
  Real length(const Beam& beam) const {
    return farthest(beam.polygon,
                    plane_of(complex_.cells[beam.cell[1]].faces[beam.face[1]].inside));
  }

  // m: of a polygon from a plane.
  Real farthest(const std::vector<Vec3>& polygon, Index plane) const {
    Real most = 0;
    for (const Vec3& x : polygon)
      most = std::max(most,
                      std::abs(dot(index_.planes.normal(plane), x) - index_.planes.offset(plane)));
    return most;
  }

  void add_links(const Holding& one, const Holding& two, const PartFacet* facet) {
    visit_spots(one, [&](const Spot& a) {
      visit_spots(two, [&](const Spot& b) {
        if (!interfaces_.apart(a.piece, b.piece)) add_link({a, b, facet});
      });
    });
  }

  void add_links(const GlueArea& c) {
    visit_spots(c.one, [&](const Spot& a) {
      visit_spots(c.two, [&](const Spot& b) {
        if (interfaces_.touch(a.piece, b.piece, c.polygon)) add_link({a, b, c.facet});
      });
    });
  }

  // Inside a part pieces of one material are one element.
  void add_link(const Link& l) {
    if (l.facet == nullptr && l.one.piece != none && l.two.piece != none &&
        material(record(l.one.piece).rock) == material(record(l.two.piece).rock))
      piece_parts_.join(l.one.piece, l.two.piece);
    else
      links_.push_back(l);
  }

  template <class Visit>
  static void visit_spots(const Holding& h, Visit visit) {
    if (h.regular != none) visit(Spot{h.regular, none, none, h.part});
    for (Index i = h.piece_begin; i < h.piece_end; ++i) visit(Spot{none, i, none, h.part});
    if (h.sliver != none) visit(Spot{none, none, h.sliver, h.part});
  }

  // Elements in the order of their first piece, so by lattice cell and part; pieces regrouped to follow it, slivers behind
  // the others.
  void number_elements() {
    element_of_piece_ = piece_parts_.components();
    const auto count = static_cast<Index>(pieces_.pieces.size());
    Index cut = 0;
    for (Index i = 0; i < count; ++i) {
      piece_order_.push_back({element_of_piece_[i], i, none});
      cut = std::max(cut, element_of_piece_[i] + 1);
    }
    for (Index s = 0; s < static_cast<Index>(pieces_.slivers.size()); ++s) {
      const auto& [piece, left_out, facet_area, owner] = pieces_.slivers[s];
      if (left_out) {
        index_.left_out.emplace_back(piece.key(), owner);
        continue;
      }
      const Holding h = cells_.find(owner.lattice_cell, owner.part, owner.rock);
      piece_order_.push_back({element_of_piece_[h.piece_begin], none, s});
    }
    std::stable_sort(piece_order_.begin(), piece_order_.end(),
                     [](const Placed& a, const Placed& b) { return a.element < b.element; });
    refuse_too_many(cut);
  }

  void refuse_too_many(std::int64_t cut) const {
    const std::int64_t regular = covers_.regular_count();
    const std::int64_t elements = covers_.parts_per_cell() * regular + cut,
                       slivers = static_cast<std::int64_t>(pieces_.slivers.size()),
                       nodes = nodes_ * regular + part_nodes_ * (cut + slivers);
    refuse_elements(*model_.cover, static_cast<Real>(elements), false);
    if (nodes > std::numeric_limits<Index>::max())
      throw Error(
          ErrorKind::model,
          fmt::format("found {:.3g} nodes of elements, must be 2.1e9 or fewer: use a larger "
                      "spacing",
                      static_cast<Real>(nodes)),
          Place{model_.cover->place.file, model_.cover->place.line, model_.cover->place.column,
                "cover.spacing"});
  }

  void write_elements() {
    covers_.piece_begin = {0};
    covers_.triangle_begin = {0};
    covers_.vertex_begin = {0};
    index_.face_begin = {0};
    index_.piece_element.assign(piece_order_.size(), none);
    const CellPart& any_part = cell_split(covers_.lattice.kind).part.front();
    covers_.element_vertices =
        std::int64_t{covers_.parts_per_cell()} * any_part.nodes * covers_.regular_count();
    covers_.element_faces = std::int64_t{covers_.parts_per_cell()} * (any_part.nodes == 8 ? 6 : 4) *
                            covers_.regular_count();
    for (std::size_t i = 0; i < piece_order_.size(); ++i) {
      const auto [e, piece, sliver] = piece_order_[i];
      const PieceRecord& p = sliver != none ? pieces_.slivers[sliver].piece : record(piece);
      if (e == covers_.cut_count()) {
        covers_.element_cell.push_back(p.lattice_cell);
        covers_.element_part.push_back(static_cast<std::uint8_t>(p.part));
        covers_.element_material.push_back(material(p.rock));
        covers_.piece_begin.push_back(covers_.piece_begin.back());
      }
      ++covers_.piece_begin.back();
      index_.sliver_begin.resize(covers_.cut_count(), static_cast<Index>(i));
      if (sliver == none) index_.sliver_begin.back() = static_cast<Index>(i) + 1;
      covers_.piece_block.push_back(complex_.cell_block[p.rock]);
      index_.piece_element[i] = e;
      index_.piece_rock.push_back(p.rock);
      if (interfaces_.any_cut()) index_.piece_cuts.push_back(p.cuts);
      if (sliver != none)
        index_.slivers.emplace_back(pieces_.slivers[sliver].key(), static_cast<Index>(i));
      write_shape(p, covers_.lattice.cell_centre(p.lattice_cell) -
                         covers_.lattice.cell_centre(covers_.element_cell[e]));
    }
    std::sort(index_.slivers.begin(), index_.slivers.end());
  }

  // `shift`: m, of its own lattice cell from that of its element.
  void write_shape(const PieceRecord& p, const Vec3& shift) {
    index_.face_inside.insert(index_.face_inside.end(), p.faces.begin(), p.faces.end());
    index_.face_begin.push_back(static_cast<std::int64_t>(index_.face_inside.size()));
    const auto first = static_cast<Index>(covers_.vertex_xyz.size() / 3);
    for (const Vec3& local : p.vertices) {
      const Vec3 x = local + shift;
      covers_.vertex_xyz.insert(covers_.vertex_xyz.end(), x.begin(), x.end());
    }
    for (const auto& t : p.triangles)
      for (const Index v : t) covers_.triangle_vertex.push_back(first + v);
    covers_.vertex_begin.push_back(static_cast<Index>(covers_.vertex_xyz.size() / 3));
    covers_.triangle_begin.push_back(static_cast<Index>(covers_.triangle_vertex.size() / 3));
    covers_.element_vertices += static_cast<std::int64_t>(p.vertices.size());
    covers_.element_faces += static_cast<std::int64_t>(p.faces.size());
  }

  // An instance is one node of a regular lattice cell, of a cut element, or of a sliver's part: slivers have no functions, but what
  // they join in a star is one. `node` is one of the part's.
  Index instance(const Spot& at, int node) const {
    if (at.regular != none)
      return nodes_ * at.regular +
             form(covers_.regular_cell[at.regular]).split->part[at.part].node[node];
    return (at.piece != none ? piece_instance(at.piece) : sliver_instance(at.sliver)) + node;
  }
  Index piece_instance(Index piece) const {
    return nodes_ * covers_.regular_count() + part_nodes_ * element_of_piece_[piece];
  }
  Index sliver_instance(Index sliver) const { return element_instances() + part_nodes_ * sliver; }
  // Those before slivers'.
  Index element_instances() const {
    return nodes_ * covers_.regular_count() + part_nodes_ * covers_.cut_count();
  }

  void join_across(UnionFind& stars, const Spot& one, const Spot& two,
                   const PartFacet& facet) const {
    for (int k = 0; k < facet.nodes; ++k)
      stars.join(instance(one, facet.node[k]), instance(two, facet.across[k]));
  }

  void join_stars() {
    UnionFind stars(sliver_instance(static_cast<Index>(pieces_.slivers.size())));
    for (const CellContent& c : cells_.all())
      if (c.regular == none) join_inside(stars, c);
    for (int axis = 0; axis < 3 && !is_block_; ++axis)
      cells_.visit_neighbours(axis, [&](const CellContent& low, const CellContent& high) {
        if (low.regular != none && high.regular != none)
          join_regular(stars, low.regular, high.regular, axis);
        else
          join_face(stars, low, high, axis);
      });
    for (const Link& l : links_) join_link(stars, l);
    star_of_.resize(
        element_instances());  // a star's first instance is not a sliver's, unless all are
    for (Index i = 0; i < element_instances(); ++i) star_of_[i] = stars.find(i);
  }

  void join_link(UnionFind& stars, const Link& l) const {
    if (l.facet != nullptr) return join_across(stars, l.one, l.two, *l.facet);
    for (int a = 0; a < part_nodes_; ++a) stars.join(instance(l.one, a), instance(l.two, a));
  }

  // What a node's star has of a lattice cell is convex in every split (of two overlaid ones, the smaller star lies in the
  // larger), and so is what it has of a cell of the complex there: all of its pieces there are one. So is a block.
  // Prolonged joints part it: then only pieces that touch are.
  void join_inside(UnionFind& stars, const CellContent& cell) {
    first_at_.clear();
    for (Index i = cell.piece_begin; i < cell.piece_end; ++i)
      if (interfaces_.is_parted(cell, record(i).rock))
        join_touching(stars, cell, i);
      else
        join_body(stars, record(i), piece_instance(i));
    for (Index s = cell.sliver_begin; s < cell.sliver_end; ++s)
      if (const PieceRecord& p = pieces_.slivers[s].piece; !interfaces_.is_parted(cell, p.rock))
        join_body(stars, p, sliver_instance(s));
  }

  void join_body(UnionFind& stars, const PieceRecord& p, Index instance) {
    const Index body = is_block_ ? p.lattice_cell : p.rock;
    auto seen = std::find_if(first_at_.begin(), first_at_.end(),
                             [&](const FirstAt& f) { return f.body == body; });
    if (seen == first_at_.end()) {
      first_at_.push_back({body, {}});
      seen = first_at_.end() - 1;
      seen->instance.fill(none);
    }
    const CellPart& part = form(p.lattice_cell).split->part[p.part];
    for (int a = 0; a < part.nodes; ++a) {
      Index& first = seen->instance[part.node[a]];
      if (first == none)
        first = instance + a;
      else
        stars.join(first, instance + a);
    }
  }

  void join_touching(UnionFind& stars, const CellContent& cell, Index i) {
    const auto& nodes = form(cell.lattice_cell).split->part;
    for (Index j = cell.piece_begin; j < i; ++j) {
      if (record(j).rock != record(i).rock || !interfaces_.touch_inside_cell(i, j)) continue;
      const CellPart &one = nodes[record(i).part], &two = nodes[record(j).part];
      for (int a = 0; a < one.nodes; ++a)
        for (int b = 0; b < two.nodes; ++b)
          if (one.node[a] == two.node[b]) stars.join(piece_instance(i) + a, piece_instance(j) + b);
    }
  }

  // Neighbouring regular lattice cells of one cell of the complex share a whole face.
  void join_regular(UnionFind& stars, Index low, Index high, int axis) const {
    if (index_.regular_rock[low] != index_.regular_rock[high]) return;
    for (const auto& [a, b] : face_nodes_[axis]) stars.join(nodes_ * low + a, nodes_ * high + b);
  }

  // What one cell of the complex has on the two sides of a lattice cell's face shares what it has of the face.
  void join_face(UnionFind& stars, const CellContent& low, const CellContent& high, int axis) {
    const auto& facets = form(low.lattice_cell).facet;
    for (std::size_t part = 0; part < facets.size(); ++part)
      for (std::size_t a = 0; a < facets[part].size(); ++a)
        if (const PartFacet& facet = facets[part][a]; facet.axis == axis && facet.step == 1)
          cells_.visit_open(low, static_cast<int>(part), static_cast<int>(a),
                            [&](Index rock, const Holding& one) {
                              join_on_facet(stars, one, cells_.find_any_in(high, facet.other, rock),
                                            facet);
                            });
  }

  void join_on_facet(UnionFind& stars, const Holding& one, const Holding& two,
                     const PartFacet& facet) {
    visit_spots(one, [&](const Spot& a) {
      visit_spots(two, [&](const Spot& b) {
        if (interfaces_.touch_on_facet(a.piece, b.piece, facet)) join_across(stars, a, b, facet);
      });
    });
  }

  Index node_of_instance(Index i) const {
    const Index n = nodes_, m = part_nodes_, regular = n * covers_.regular_count();
    if (i < regular) return covers_.lattice.cell_node(covers_.regular_cell[i / n], i % n);
    const Index e = (i - regular) / m, cell = covers_.element_cell[e];
    return covers_.lattice.cell_node(
        cell, covers_.lattice.split(cell).part[covers_.element_part[e]].node[(i - regular) % m]);
  }

  void number_covers() {
    std::vector<std::pair<Index, Index>> roots;  // lattice node, instance
    for (Index i = 0; i < static_cast<Index>(star_of_.size()); ++i)
      if (star_of_[i] == i) roots.emplace_back(node_of_instance(i), i);
    std::sort(roots.begin(), roots.end());
    std::vector<Index> cover_of(star_of_.size(), none);
    for (std::size_t p = 0; p < roots.size(); ++p) {
      covers_.cover_node.push_back(roots[p].first);
      cover_of[roots[p].second] = static_cast<Index>(p);
    }
    const std::size_t regular =
        static_cast<std::size_t>(nodes_) * static_cast<std::size_t>(covers_.regular_count());
    for (std::size_t i = 0; i < star_of_.size(); ++i)
      (i < regular ? covers_.regular_cover : covers_.element_cover)
          .push_back(cover_of[star_of_[i]]);
  }

  struct FirstAt {
    Index body;                      // a cell of the complex, or a block
    std::array<Index, 15> instance;  // [nodes of the cell]
  };

  const Complex& complex_;
  const Model& model_;
  const bool heals_dead_ends_;
  const Pieces& pieces_;
  const bool is_block_;
  CoverArrays& covers_;
  const Index nodes_, part_nodes_;  // of a lattice cell, of a part
  std::array<std::vector<std::pair<Index, Index>>, 3> face_nodes_;
  PieceIndex& index_;
  const OccupiedCells cells_;
  UnionFind piece_parts_;
  GlueFinder glue_;
  PieceInterfaces interfaces_;
  std::vector<Link> links_;
  std::vector<Index> element_of_piece_;
  std::vector<Placed> piece_order_;
  std::vector<Index> star_of_;
  std::vector<FirstAt> first_at_;
};

}  // namespace

void refuse_elements(const CoverSpec& cover, Real elements, bool at_least) {
  if (elements <= cover.max_elements) return;
  throw Error(ErrorKind::model,
              fmt::format("makes {}{} elements, must make cover.max_elements = {} or fewer: use a "
                          "larger spacing or raise the limit",
                          std::isfinite(elements) ? at_least ? "at least " : "" : "more than ",
                          elements < 1e9            ? fmt::format("{:.0f}", elements)
                          : std::isfinite(elements) ? fmt::format("{:.3g}", elements)
                                                    : "1e300",
                          cover.max_elements),
              Place{cover.place.file, cover.place.line, cover.place.column, "cover.spacing"});
}

bool heals_dead_ends(const Complex& complex, const Model& model) {
  return has_contact(model) && complex.block_count > 1;
}

void connect(const Complex& complex, const Model& model, const Pieces& pieces, CoverArrays& covers,
             PieceIndex& index) {
  Connector(complex, model, pieces, covers, index).run();
}

}  // namespace rockfold
