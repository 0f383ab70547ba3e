#include "host/cover/connect.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "host/cut/union_find.hpp"

namespace rockfold {

namespace {

using Facet = std::array<Index, 3>;  // lattice nodes, ascending

// Where a part of the rock stands in a lattice: a regular lattice cell or a piece.
struct Part {
  Index regular = none;
  Index piece = none;
};

class Connector {
 public:
  Connector(const Complex& complex, const Model& model, const Pieces& pieces, bool welded,
            CoverArrays& covers, PieceIndex& index)
      : complex_(complex),
        model_(model),
        pieces_(pieces),
        welded_(welded),
        covers_(covers),
        index_(index),
        piece_parts_(static_cast<Index>(pieces.pieces.size())),
        walker_(index.lattice, index.planes) {}

  void run() {
    write_regular();
    find_virtual_links();
    number_elements();
    write_elements();
    join_stars();
    number_covers();
  }

 private:
  // Two pieces that glue joins across the interior of a tetrahedron, or across one of its facets.
  struct Link {
    Part one, two;
    Facet facet;  // lattice nodes whose stars hold the link
    bool inside;  // of one tetrahedron: all four nodes
  };

  Index material(Index rock) const { return model_.solids[complex_.zone(rock).solid].material; }

  Index node(Index lattice_cell, int corner) const {
    const auto c = covers_.lattice.cell_ijk(lattice_cell);
    return covers_.lattice.node_index(c[0] + (corner & 1), c[1] + (corner >> 1 & 1),
                                      c[2] + (corner >> 2 & 1));
  }

  Facet facet_nodes(Index lattice_cell, int tet, int a) const {
    Facet f;
    for (int i = 0, k = 0; i < 4; ++i)
      if (i != a) f[k++] = node(lattice_cell, tet6_corner[tet][i]);
    std::sort(f.begin(), f.end());
    return f;
  }

  void write_regular() {
    for (const auto& r : pieces_.regular) {
      covers_.regular_cell.push_back(r.lattice_cell);
      covers_.regular_material.push_back(material(r.rock));
      covers_.regular_block.push_back(complex_.cell_block[r.rock]);
      index_.regular_rock.push_back(r.rock);
    }
  }

  Part find_part(Index lattice_cell, int tet, Index rock) const {
    const auto& list = pieces_.pieces;
    const auto it =
        std::lower_bound(list.begin(), list.end(), std::tuple{lattice_cell, tet, rock},
                         [](const PieceRecord& p, const std::tuple<Index, int, Index>& key) {
                           return std::tuple{p.lattice_cell, p.tet, p.rock} < key;
                         });
    if (it != list.end() && it->lattice_cell == lattice_cell && it->tet == tet && it->rock == rock)
      return {none, static_cast<Index>(it - list.begin())};
    const Index r = PieceIndex::find_regular(covers_, lattice_cell);
    if (r != none && index_.regular_rock[r] == rock) return {r, none};
    return {};
  }

  // Glue between cells of the complex. Inside a tetrahedron it joins pieces of one material to one element.
  void find_virtual_links() {
    for (const Fragment& f : complex_.fragments) {
      if (f.joint != none && !welded_) continue;
      if (complex_.zone(f.cell[0]).stage != 0 || complex_.zone(f.cell[1]).stage != 0) continue;
      const Polygon polygon = complex_.polygon_of(f);
      struct OnFacet {
        Facet nodes;
        Part part;
      };
      std::vector<OnFacet> below, above;
      for (const int s : {0, 1}) {
        const HalfSpaceId side = half_space(polygon.plane, s == 1);
        walker_.walk(polygon, side, [&](const std::array<Index, 3>& ijk, int tet, const Polygon&) {
          const Index lattice_cell = covers_.lattice.cell_index(ijk[0], ijk[1], ijk[2]);
          int on = none;  // the facet that the polygon lies on
          for (int a = 0; a < 4; ++a)
            if (plane_of(index_.lattice.facet(ijk, tet, a)) == polygon.plane) on = a;
          const Part part = find_part(lattice_cell, tet, f.cell[s]);
          if (on != none) {
            (s == 0 ? below : above).push_back({facet_nodes(lattice_cell, tet, on), part});
          } else if (s == 0) {
            const Part other = find_part(lattice_cell, tet, f.cell[1]);
            if (part.piece != none && other.piece != none) join_inside(part.piece, other.piece);
          }
        });
      }
      const auto by_nodes = [](const OnFacet& a, const OnFacet& b) { return a.nodes < b.nodes; };
      std::sort(above.begin(), above.end(), by_nodes);
      for (const OnFacet& b : below) {
        const auto [first, last] = std::equal_range(above.begin(), above.end(), b, by_nodes);
        for (auto a = first; a != last; ++a) links_.push_back({b.part, a->part, b.nodes, false});
      }
    }
  }

  void join_inside(Index one, Index two) {
    if (material(pieces_.pieces[one].rock) == material(pieces_.pieces[two].rock))
      piece_parts_.join(one, two);
    else
      links_.push_back({{none, one}, {none, two}, {}, true});
  }

  // Elements in the order of their first piece, so by lattice cell and tetrahedron; pieces regrouped to follow it.
  void number_elements() {
    const std::vector<Index> component = piece_parts_.components();
    piece_order_.resize(component.size());
    for (Index i = 0; i < static_cast<Index>(component.size()); ++i) piece_order_[i] = i;
    std::stable_sort(piece_order_.begin(), piece_order_.end(),
                     [&](Index a, Index b) { return component[a] < component[b]; });
    index_.piece_element.assign(component.size(), none);
    element_of_piece_ = component;
  }

  void write_elements() {
    covers_.piece_begin = {0};
    covers_.triangle_begin = {0};
    covers_.vertex_begin = {0};
    std::vector<Index> rock;
    covers_.element_vertices = covers_.element_faces =
        24 * static_cast<std::int64_t>(covers_.regular_count());
    for (std::size_t i = 0; i < piece_order_.size(); ++i) {
      const PieceRecord& p = pieces_.pieces[piece_order_[i]];
      const Index e = element_of_piece_[piece_order_[i]];
      if (e == covers_.cut_count()) {
        covers_.element_cell.push_back(p.lattice_cell);
        covers_.element_part.push_back(static_cast<std::uint8_t>(p.tet));
        covers_.element_material.push_back(material(p.rock));
        covers_.piece_begin.push_back(covers_.piece_begin.back());
      }
      ++covers_.piece_begin.back();
      covers_.piece_block.push_back(complex_.cell_block[p.rock]);
      index_.piece_element[i] = e;
      rock.push_back(p.rock);
      const auto first = static_cast<Index>(covers_.vertex_xyz.size() / 3);
      for (const Vec3& x : p.vertices)
        covers_.vertex_xyz.insert(covers_.vertex_xyz.end(), x.begin(), x.end());
      for (const auto& t : p.triangles)
        for (const Index v : t) covers_.triangle_vertex.push_back(first + v);
      covers_.vertex_begin.push_back(static_cast<Index>(covers_.vertex_xyz.size() / 3));
      covers_.triangle_begin.push_back(static_cast<Index>(covers_.triangle_vertex.size() / 3));
      covers_.element_vertices += p.vertex_count;
      covers_.element_faces += p.face_count;
    }
    index_.piece_rock = std::move(rock);
  }

  // An instance is one node of a regular lattice cell (8 each) or of a cut element (4 each).
  Index instance(const Part& part, Index lattice_node) const {
    if (part.regular != none) {
      for (int c = 0; c < 8; ++c)
        if (node(covers_.regular_cell[part.regular], c) == lattice_node)
          return 8 * part.regular + c;
      return none;
    }
    const Index e = element_of_piece_[part.piece];
    for (int a = 0; a < 4; ++a)
      if (node(covers_.element_cell[e], tet6_corner[covers_.element_part[e]][a]) == lattice_node)
        return 8 * covers_.regular_count() + 4 * e + a;
    return none;
  }

  void join_over(UnionFind& stars, const Part& one, const Part& two, const Facet& facet) const {
    if ((one.regular == none && one.piece == none) || (two.regular == none && two.piece == none))
      return;
    for (const Index n : facet) stars.join(instance(one, n), instance(two, n));
  }

  void join_stars() {
    UnionFind stars(8 * covers_.regular_count() + 4 * covers_.cut_count());
    join_regular(stars);
    join_pieces(stars);
    for (const Link& l : links_) {
      if (!l.inside) {
        join_over(stars, l.one, l.two, l.facet);
        continue;
      }
      const Index e1 = element_of_piece_[l.one.piece], e2 = element_of_piece_[l.two.piece];
      for (int a = 0; a < 4; ++a)
        stars.join(8 * covers_.regular_count() + 4 * e1 + a,
                   8 * covers_.regular_count() + 4 * e2 + a);
    }
    star_of_.resize(8 * static_cast<std::size_t>(covers_.regular_count()) +
                    4 * static_cast<std::size_t>(covers_.cut_count()));
    for (Index i = 0; i < static_cast<Index>(star_of_.size()); ++i) star_of_[i] = stars.find(i);
  }

  // Neighbouring regular lattice cells of one cell of the complex share a whole face.
  void join_regular(UnionFind& stars) const {
    for (Index r = 0; r < covers_.regular_count(); ++r) {
      const auto c = covers_.lattice.cell_ijk(covers_.regular_cell[r]);
      for (int d = 0; d < 3; ++d) {
        auto next = c;
        if (++next[d] == covers_.lattice.cells[d]) continue;
        const Index o = d == 0 && r + 1 < covers_.regular_count() &&
                                covers_.regular_cell[r + 1] == covers_.regular_cell[r] + 1
                            ? r + 1
                            : PieceIndex::find_regular(
                                  covers_, covers_.lattice.cell_index(next[0], next[1], next[2]));
        if (o == none || index_.regular_rock[o] != index_.regular_rock[r]) continue;
        for (int corner = 0; corner < 8; ++corner)
          if ((corner >> d & 1) != 0) stars.join(8 * r + corner, 8 * o + (corner & ~(1 << d)));
      }
    }
  }

  // Pieces of one cell of the complex on the two sides of a facet share what the cell has of it.
  void join_pieces(UnionFind& stars) const {
    struct Side {
      Facet facet;
      Index rock;
      Index piece;
    };
    std::vector<Side> sides;
    for (Index i = 0; i < static_cast<Index>(pieces_.pieces.size()); ++i) {
      const PieceRecord& p = pieces_.pieces[i];
      for (int a = 0; a < 4; ++a) {
        if ((p.open_facets >> a & 1) == 0) continue;
        const Facet facet = facet_nodes(p.lattice_cell, p.tet, a);
        const Index across = regular_across(p, facet);
        if (across != none)
          join_over(stars, {none, i}, {across, none}, facet);
        else
          sides.push_back({facet, p.rock, i});
      }
    }
    const auto key = [](const Side& s) { return std::tie(s.facet, s.rock); };
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
      return std::tie(a.facet, a.rock, a.piece) < std::tie(b.facet, b.rock, b.piece);
    });
    for (std::size_t i = 0; i + 1 < sides.size(); ++i)
      if (key(sides[i]) == key(sides[i + 1]))
        join_over(stars, {none, sides[i].piece}, {none, sides[i + 1].piece}, sides[i].facet);
  }

  // The regular lattice cell of the same cell of the complex across a facet on the lattice cell's boundary, or none.
  Index regular_across(const PieceRecord& p, const Facet& facet) const {
    const auto c = covers_.lattice.cell_ijk(p.lattice_cell);
    std::array<Index, 3> ijk[3];
    for (int i = 0; i < 3; ++i) ijk[i] = covers_.lattice.node_ijk(facet[i]);
    for (int d = 0; d < 3; ++d) {
      if (ijk[0][d] != ijk[1][d] || ijk[0][d] != ijk[2][d]) continue;
      auto next = c;
      next[d] += ijk[0][d] == c[d] ? -1 : 1;
      if (next[d] < 0 || next[d] >= covers_.lattice.cells[d]) return none;
      const Index r =
          PieceIndex::find_regular(covers_, covers_.lattice.cell_index(next[0], next[1], next[2]));
      return r != none && index_.regular_rock[r] == p.rock ? r : none;
    }
    return none;
  }

  Index node_of_instance(Index i) const {
    const Index regular = 8 * covers_.regular_count();
    if (i < regular) return node(covers_.regular_cell[i / 8], i % 8);
    const Index e = (i - regular) / 4;
    return node(covers_.element_cell[e], tet6_corner[covers_.element_part[e]][(i - regular) % 4]);
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
    const auto regular = 8 * static_cast<std::size_t>(covers_.regular_count());
    for (std::size_t i = 0; i < star_of_.size(); ++i)
      (i < regular ? covers_.regular_cover : covers_.element_cover)
          .push_back(cover_of[star_of_[i]]);
  }

  const Complex& complex_;
  const Model& model_;
  const Pieces& pieces_;
  const bool welded_;
  CoverArrays& covers_;
  PieceIndex& index_;
  UnionFind piece_parts_;
  LatticeWalker walker_;
  std::vector<Link> links_;
  std::vector<Index> element_of_piece_;
  std::vector<Index> piece_order_;
  std::vector<Index> star_of_;
};

}  // namespace

void connect(const Complex& complex, const Model& model, const Pieces& pieces, bool welded,
             CoverArrays& covers, PieceIndex& index) {
  Connector(complex, model, pieces, welded, covers, index).run();
}

}  // namespace rockfold
