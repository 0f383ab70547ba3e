#include "host/flatten/flatten.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "host/cut/cells/complex.hpp"
#include "host/flatten/balance_contacts.hpp"
#include "host/flatten/block_order.hpp"
#include "host/flatten/block_surface.hpp"
#include "host/flatten/bulk.hpp"
#include "host/flatten/grouping.hpp"
#include "host/flatten/plain_cell.hpp"
#include "host/parallel.hpp"
#include "src/base/vector.hpp"

namespace rockfold {

namespace {

constexpr Index chunk = 1024;  // blocks that a thread takes at a time

// Numbers of faces, loops, corners and vertices: of a block's surface, or of all blocks before it.
struct SurfaceSize {
  Index faces = 0, loops = 0, corners = 0, vertices = 0;
};

SurfaceSize size_of(const CellView& cell) {
  const auto faces = static_cast<Index>(cell.faces.size());
  return {faces, faces, static_cast<Index>(cell.corners.size()),
          static_cast<Index>(cell.vertices.size())};
}

SurfaceSize size_of(const BlockSurface& s) {
  return {static_cast<Index>(s.faces.size()), static_cast<Index>(s.corner_begin.size()) - 1,
          static_cast<Index>(s.corner_vertex.size()), static_cast<Index>(s.vertices.size())};
}

// Surfaces are measured first and written second, each block to its place in the arrays. A block that is one cell is
// cheap to do twice; the surfaces of others are kept in between. Blocks are visited by rank (BlockOrder).
class SurfaceWriter {
 public:
  SurfaceWriter(const Complex& complex, const BlockOrder& order, BlockArrays& out)
      : complex_(complex),
        order_(order),
        out_(out),
        sides_(2 * static_cast<Index>(complex.fragments.size())),
        before_beams_(sides_ + static_cast<Index>(complex.free_parts.size())),
        chunks_((complex.block_count + chunk - 1) / chunk) {}

  void run() {
    group_areas();
    measure();
    make_room();
    for_each_chunk([&](Index k, Index begin, Index end) { write_chunk(k, begin, end); });
    if (!complex_.beams.empty()) index_shown_faces();
    write_interfaces();
    if (!complex_.beams.empty()) balance_contacts(out_);
  }

 private:
  // What a wide cell sees through a fragment that it shares with a sliver.
  struct SideOfSliver {
    Index begin = 0, end = 0;  // beams that start there
    Index origin = none;       // that all of them show, or none inside a block
    bool mixed = false;        // they differ
  };
  struct KeptSurface {
    Index rank;
    BlockSurface surface;
  };
  // Part of a block's face on a joint.
  struct ShownFace {
    std::array<Index, 4> key;  // block, origin, cell, face of the cell
    Real area;
    Index face;
    bool operator<(const ShownFace& o) const {
      return std::tie(key, area, face) < std::tie(o.key, o.area, o.face);
    }
  };
  // Of one fragment; those of one pair of faces become one.
  struct KeyedInterface {
    BlockArrays::Interface shared;
    Index fragment;
    auto key() const {
      return std::tie(shared.block[0], shared.face[0], shared.block[1], shared.face[1]);
    }
    bool operator<(const KeyedInterface& o) const {
      return std::tuple_cat(key(), std::tie(fragment)) <
             std::tuple_cat(o.key(), std::tie(o.fragment));
    }
  };

  template <class Function>
  void for_each_chunk(const Function& f) const {
    parallel_for(chunks_, 1, [&](std::int64_t k) {
      const auto begin = static_cast<Index>(k * chunk);
      f(static_cast<Index>(k), begin, std::min(begin + chunk, complex_.block_count));
    });
  }

  // The areas of wide cells that bound each block. Items are numbered so: fragment i has the sides 2 i and 2 i + 1, then come
  // the free parts, then the beams, which stand for what is between wide cells and slivers where that differs from place to place.
  void group_areas() {
    find_returns();
    find_sides();
    areas_ = group_items(before_beams_ + static_cast<Index>(complex_.beams.size()),
                         complex_.block_count, [&](Index i) { return rank_of_item(i); });
  }

  // What a beam shows of the face that it starts from: the origin of that part of the surface, or none inside a block.
  Index origin_of(const Beam& b) const {
    if (b.cell[1] == none) return b.origin;
    return complex_.cell_block[b.cell[0]] == complex_.cell_block[b.cell[1]] ? none : b.joint;
  }

  // Beams about as narrow as the tolerance show what the largest one beside them does.
  void find_sides() {
    if (!complex_.beams.empty()) side_.assign(sides_, {});
    shown_.assign(complex_.beams.size(), none);
    const auto count = static_cast<Index>(complex_.beams.size());
    for (Index begin = 0, end = 0; begin < count; begin = end) {
      const Beam& first = complex_.beams[begin];
      Index largest = begin;
      for (end = begin; end < count && starts_with(complex_.beams[end], first); ++end)
        if (complex_.beams[end].area > complex_.beams[largest].area) largest = end;
      const Index origin = origin_of(complex_.beams[largest]);
      bool mixed = false;
      for (Index i = begin; i < end; ++i) {
        shown_[i] = complex_.beams[i].narrow ? origin : origin_of(complex_.beams[i]);
        mixed = mixed || shown_[i] != origin;
      }
      if (first.start != none)
        side_[first.start] = {begin, end, origin, mixed};
      else
        before_gap_.emplace(first.cell[0], first.face[0]);
    }
  }

  static bool starts_with(const Beam& b, const Beam& first) {
    return b.start == first.start && b.cell[0] == first.cell[0] && b.face[0] == first.face[0];
  }
  SideOfSliver side_of(Index i) const { return side_.empty() ? SideOfSliver{} : side_[i]; }
  // Whether beams are areas of their own: the side that they start from is not the same all over.
  bool stands_alone(const Beam& b) const { return b.start == none || side_[b.start].mixed; }

  Index rank_of_item(Index i) const {
    const auto& rank = order_.rank_of_cell;
    if (i < sides_) {
      const Fragment& f = complex_.fragments[i / 2];
      const Index cell = f.cell[i % 2];
      if (complex_.is_hidden[cell] != 0) return none;
      if (!complex_.touches_hidden(f))
        return rank[f.cell[0]] == rank[f.cell[1]] || (f.joint == none && !f.narrow) ? none
                                                                                    : rank[cell];
      // Where no beam leaves it is narrow: only with it the surface closes.
      const SideOfSliver side = side_of(i);
      const bool has_beams = side.begin < side.end;
      return has_beams && (side.mixed || side.origin == none) ? none : rank[cell];
    }
    if (i < before_beams_) {
      const FreePart& f = complex_.free_parts[i - sides_];
      const bool by_beams = f.gap != none && before_gap_.count({f.cell, f.face}) != 0;
      return complex_.is_hidden[f.cell] != 0 || by_beams ? none : rank[f.cell];
    }
    const Beam& b = complex_.beams[i - before_beams_];
    return stands_alone(b) && shown_[i - before_beams_] != none ? rank[b.cell[0]] : none;
  }

  void find_areas(Index rank, std::vector<BoundaryArea>& areas) const {
    areas.clear();
    for (const Index i : items_of(rank)) {
      BoundaryArea a;
      if (i < sides_) {
        const Fragment& f = complex_.fragments[i / 2];
        const SideOfSliver side = side_of(i);
        const bool has_beams = side.begin < side.end && !is_as_cut(rank);
        const Index joint = is_as_cut(rank) ? joint_between(f) : f.joint;
        a = {f.cell[i % 2], f.face[i % 2], has_beams ? side.origin : joint, f.area, i / 2,
             none,          none};
      } else if (i < before_beams_) {
        const FreePart& f = complex_.free_parts[i - sides_];
        a = {f.cell, f.face, f.origin, f.area, none, i - sides_, none};
      } else {
        const Beam& b = complex_.beams[i - before_beams_];
        a = {b.cell[0], b.face[0], shown_[i - before_beams_], b.area,
             none,      none,      i - before_beams_};
      }
      areas.push_back(a);
    }
  }

  // For each beam the largest that comes back from the face where it ends.
  void find_returns() {
    const auto key = [&](Index b, int from) {
      const Beam& beam = complex_.beams[b];
      return std::array{beam.cell[from], beam.face[from], beam.cell[1 - from], beam.face[1 - from]};
    };
    std::map<std::array<Index, 4>, Index> largest;
    for (Index b = 0; b < static_cast<Index>(complex_.beams.size()); ++b) {
      if (complex_.beams[b].cell[1] == none) continue;
      const auto [at, fresh] = largest.try_emplace(key(b, 0), b);
      if (!fresh && complex_.beams[b].area > complex_.beams[at->second].area) at->second = b;
    }
    return_of_.assign(complex_.beams.size(), none);
    for (Index b = 0; b < static_cast<Index>(complex_.beams.size()); ++b)
      if (complex_.beams[b].cell[1] != none)
        if (const auto at = largest.find(key(b, 1)); at != largest.end())
          return_of_[b] = at->second;
  }

  // The boundary of all cells of a block, slivers too, as they were cut: it closes by construction. For blocks whose beams are so
  // entangled, at the size of the tolerance, that what they show does not.
  Index rank_of_cut_item(Index i) const {
    const auto& rank = order_.rank_of_cell;
    if (i < sides_) {
      const Fragment& f = complex_.fragments[i / 2];
      return rank[f.cell[0]] == rank[f.cell[1]] ? none : rank[f.cell[i % 2]];
    }
    return i < before_beams_ ? rank[complex_.free_parts[i - sides_].cell] : none;
  }

  // Between a sliver of one block and another block may be no more than glue, with the joint on the sliver's other side.
  Index joint_between(const Fragment& f) const {
    for (const Index cell : f.cell)
      if (f.joint == none && complex_.is_sliver[cell] != 0 && joint_of_sliver_[cell] != none)
        return joint_of_sliver_[cell];
    return f.joint;
  }

  // The joint of the largest beam between two blocks that passes each sliver.
  void find_joints_of_slivers() {
    joint_of_sliver_.assign(complex_.cells.size(), none);
    std::vector<Real> largest(complex_.cells.size(), 0);
    for (const Beam& b : complex_.beams) {
      if (b.cell[1] == none || complex_.cell_block[b.cell[0]] == complex_.cell_block[b.cell[1]])
        continue;
      for (const Index s : b.slivers)
        if (b.area > largest[s]) {
          largest[s] = b.area;
          joint_of_sliver_[s] = b.joint;
        }
    }
  }

  void group_cut_areas() {
    std::vector<bool> any(chunks_, false);
    for (Index k = 0; k < chunks_; ++k)
      for (const KeptSurface& kept : kept_[k]) any[k] = any[k] || kept.surface.open_edges > 0;
    if (std::find(any.begin(), any.end(), true) == any.end()) return;
    find_joints_of_slivers();
    as_cut_.assign(complex_.block_count, false);
    for (auto& chunk_surfaces : kept_)
      for (const KeptSurface& kept : chunk_surfaces)
        if (kept.surface.open_edges > 0) as_cut_[kept.rank] = true;
    cut_areas_ = group_items(before_beams_, complex_.block_count, [&](Index i) {
      const Index rank = rank_of_cut_item(i);
      return rank != none && as_cut_[rank] ? rank : none;
    });
    std::vector<BoundaryArea> areas;
    for (auto& chunk_surfaces : kept_)
      for (KeptSurface& kept : chunk_surfaces) {
        if (!as_cut_[kept.rank]) continue;
        find_areas(kept.rank, areas);
        kept.surface = make_block_surface(complex_, areas);
        begin_[order_.block[kept.rank] + 1] = size_of(kept.surface);
      }
  }

  std::span<const Index> items_of(Index rank) const {
    return is_as_cut(rank) ? cut_areas_[rank] : areas_[rank];
  }
  bool is_as_cut(Index rank) const { return !as_cut_.empty() && as_cut_[rank]; }

  void measure() {
    begin_.resize(complex_.block_count + 1);
    kept_.resize(chunks_);
    std::vector<Index> identified(chunks_, 0);
    for_each_chunk([&](Index k, Index begin, Index end) {
      std::vector<BoundaryArea> areas;
      CellFaces workspace;
      for (Index r = begin; r < end; ++r) {
        SurfaceSize& size = begin_[order_.block[r] + 1];
        find_areas(r, areas);
        if (is_plain_cell(complex_, order_.cells_of_block[order_.block[r]], areas, workspace)) {
          size = size_of(complex_.cells[areas.front().cell]);
        } else {
          kept_[k].push_back({r, make_block_surface(complex_, areas)});
          identified[k] += kept_[k].back().surface.vertices_identified;
          size = size_of(kept_[k].back().surface);
        }
      }
    });
    group_cut_areas();
    out_.vertices_identified = std::accumulate(identified.begin(), identified.end(), Index{0});
    for (Index b = 0; b < complex_.block_count; ++b) {
      SurfaceSize& next = begin_[b + 1];
      next.faces += begin_[b].faces;
      next.loops += begin_[b].loops;
      next.corners += begin_[b].corners;
      next.vertices += begin_[b].vertices;
    }
  }

  // Each array by one thread: the first to write to new memory is slow.
  void make_room() {
    const auto blocks = static_cast<std::size_t>(complex_.block_count);
    const SurfaceSize& all = begin_.back();
    const std::vector<std::function<void()>> tasks = {
        [&] { out_.vertex.resize(all.vertices); },
        [&] { out_.face_normal.resize(all.faces); },
        [&] { out_.corner_vertex.resize(all.corners); },
        [&] { out_.face_area.resize(all.faces); },
        [&] { out_.face_origin.resize(all.faces, none); },
        [&] { out_.face_plane.resize(all.faces); },
        [&] { out_.loop_begin.resize(all.faces + 1); },
        [&] { out_.corner_begin.resize(all.loops + 1); },
        [&] { face_of_item_.resize(before_beams_ + complex_.beams.size(), none); },
        [&] {
          out_.face_up.resize(all.faces);
          for (auto* array : {&out_.edge_count, &out_.shell_count, &out_.genus})
            array->resize(blocks);
          for (auto* array : {&out_.face_begin, &out_.vertex_begin}) array->resize(blocks + 1);
          for (auto* array : {&out_.convex, &out_.finite}) array->resize(blocks);
        }};
    parallel_for(
        static_cast<std::int64_t>(tasks.size()), 1, [&](std::int64_t i) { tasks[i](); },
        blocks > chunk);
  }

  void write_chunk(Index k, Index begin, Index end) {
    std::vector<BoundaryArea> areas;
    auto kept = kept_[k].begin();
    for (Index r = begin; r < end; ++r) {
      find_areas(r, areas);
      if (kept != kept_[k].end() && kept->rank == r)
        write_surface(r, (kept++)->surface);
      else
        write_cell(r, areas);
    }
    kept_[k] = {};
  }

  void write_surface(Index rank, const BlockSurface& s) {
    const Index b = order_.block[rank];
    const SurfaceSize at = begin_[b];
    bool finite = true;
    for (std::size_t f = 0; f < s.faces.size(); ++f) {
      write_face(at.faces + static_cast<Index>(f), s.faces[f]);
      finite = finite && !complex_.origins[s.faces[f].origin].continues;
      out_.loop_begin[at.faces + f + 1] = at.loops + s.loop_begin[f + 1];
    }
    for (std::size_t i = 1; i < s.corner_begin.size(); ++i)
      out_.corner_begin[at.loops + i] = at.corners + s.corner_begin[i];
    for (std::size_t i = 0; i < s.corner_vertex.size(); ++i)
      out_.corner_vertex[at.corners + i] = at.vertices + s.corner_vertex[i];
    for (std::size_t i = 0; i < s.vertices.size(); ++i)
      out_.vertex[at.vertices + i] = s.vertices[i] + complex_.planes.centre();
    write_counts(b, s.edge_count, s.shell_count, s.genus, s.convex, finite);
    const auto items = items_of(rank);
    for (std::size_t i = 0; i < items.size(); ++i)
      if (s.face_of_area[i] != none) face_of_item_[items[i]] = at.faces + s.face_of_area[i];
  }

  // A plain cell, from where it lies to where it belongs.
  void write_cell(Index rank, const std::vector<BoundaryArea>& areas) {
    const Index b = order_.block[rank];
    const SurfaceSize at = begin_[b];
    const CellView cell = complex_.cells[areas.front().cell];
    const auto items = items_of(rank);
    for (std::size_t i = 0; i < items.size(); ++i) {
      out_.face_origin[at.faces + areas[i].face] = areas[i].origin;
      out_.face_area[at.faces + areas[i].face] += areas[i].area;
      face_of_item_[items[i]] = at.faces + areas[i].face;
    }
    bool finite = true;
    Index corner = at.corners;
    for (std::size_t f = 0; f < cell.faces.size(); ++f) {
      const auto& face = cell.faces[f];
      const Index number = at.faces + static_cast<Index>(f);
      const Index origin = out_.face_origin[number];
      write_face(number, {face.inside, origin, out_.face_area[number]});
      finite = finite && !complex_.origins[origin].continues;
      for (const auto& of_face : cell.corners.subspan(face.begin, face.count))
        out_.corner_vertex[corner++] = at.vertices + of_face.vertex;
      out_.corner_begin[at.loops + f + 1] = corner;
      out_.loop_begin[number + 1] = at.loops + static_cast<Index>(f) + 1;
    }
    for (std::size_t v = 0; v < cell.vertices.size(); ++v)
      out_.vertex[at.vertices + v] = cell.vertices[v].x + complex_.planes.centre();
    write_counts(b, static_cast<Index>(cell.corners.size() / 2), 1, 0, true, finite);
  }

  void write_face(Index number, const BlockSurface::Face& face) {
    const Vec3& n = complex_.planes.normal(plane_of(face.inside));
    out_.face_normal[number] = is_above(face.inside) ? -n : n;
    out_.face_area[number] = face.area;
    out_.face_origin[number] = face.origin;
    out_.face_up[number] = is_above(face.inside) ? 0 : 1;
    out_.face_plane[number] = plane_of(face.inside);
  }

  void write_counts(Index b, Index edges, Index shells, Index genus, bool convex, bool finite) {
    out_.face_begin[b + 1] = begin_[b + 1].faces;
    out_.vertex_begin[b + 1] = begin_[b + 1].vertices;
    out_.edge_count[b] = edges;
    out_.shell_count[b] = shells;
    out_.genus[b] = genus;
    out_.convex[b] = convex ? 1 : 0;
    out_.finite[b] = finite ? 1 : 0;
  }

  // Fragments between a block and those of higher numbers are its own, so that blocks need not wait for each other.
  void write_interfaces() {
    std::vector<std::vector<BlockArrays::Interface>> found(chunks_);
    std::vector<Index> place(complex_.block_count + 1,
                             0);  // of each block's first; before: numbers
    for_each_chunk([&](Index k, Index begin, Index end) {
      std::vector<KeyedInterface> keyed;
      for (Index r = begin; r < end; ++r) {
        const auto before = found[k].size();
        find_interfaces(r, keyed);
        for (std::size_t i = 0; i < keyed.size(); ++i) {
          if (i > 0 && keyed[i - 1].key() == keyed[i].key())
            found[k].back().area += keyed[i].shared.area;
          else
            found[k].push_back(keyed[i].shared);
        }
        place[order_.block[r] + 1] = static_cast<Index>(found[k].size() - before);
      }
    });
    std::partial_sum(place.begin(), place.end(), place.begin());
    out_.interfaces.resize(place.back());
    for_each_chunk([&](Index k, Index, Index) {
      for (const auto& shared : found[k]) out_.interfaces[place[shared.block[0]]++] = shared;
      found[k] = {};
    });
  }

  // What an area of a face leans on is told by what is before it alone: the other side, through slivers, may look past it.
  void find_interfaces(Index rank, std::vector<KeyedInterface>& keyed) const {
    keyed.clear();
    const Index b = order_.block[rank];
    const auto add = [&](Index face, Index other, Index cell, Index cell_face, Real area,
                         Index item) {
      const Index behind = complex_.cell_block[cell];
      if (behind <= b || face == none || out_.face_origin[face] == none) return;
      if (other == none) other = shown_face(behind, cell, cell_face, out_.face_origin[face]);
      if (other != none) keyed.push_back({{{b, behind}, {face, other}, area}, item});
    };
    const auto add_beam = [&](Index i) {
      const Beam& beam = complex_.beams[i];
      if (beam.cell[1] == none) return;
      const bool returns = return_of_[i] != none && !is_as_cut(order_.rank_of_cell[beam.cell[1]]);
      add(face_of_beam(i), returns ? face_of_beam(return_of_[i]) : none, beam.cell[1], beam.face[1],
          beam.area, i);
    };
    for (const Index i : items_of(rank)) {
      if (i >= before_beams_) {
        add_beam(i - before_beams_);
      } else if (i < sides_) {
        const Fragment& f = complex_.fragments[i / 2];
        const SideOfSliver side = is_as_cut(rank) ? SideOfSliver{} : side_of(i);
        for (Index k = side.begin; k < side.end; ++k) add_beam(k);
        if (side.begin == side.end)
          add(face_of_item_[i], face_of_item_[i ^ 1], f.cell[1 - i % 2], f.face[1 - i % 2], f.area,
              i / 2);
      }
    }
    std::sort(keyed.begin(), keyed.end());
  }

  // Faces of joints by the faces of cells that they are made of, and by their blocks: where beams end.
  void index_shown_faces() {
    for (Index r = 0; r < complex_.block_count; ++r) {
      std::vector<BoundaryArea> areas;
      find_areas(r, areas);
      const auto items = items_of(r);
      for (std::size_t i = 0; i < items.size(); ++i)
        if (const Index face = face_of_item_[items[i]]; face != none && areas[i].origin != none)
          shown_faces_.push_back({{order_.block[r], areas[i].origin, areas[i].cell, areas[i].face},
                                  areas[i].area,
                                  face});
    }
    std::sort(shown_faces_.begin(), shown_faces_.end());
  }

  // The face of a block on an area of a joint: of the cell's face there, or else the largest that the joint has on the block.
  Index shown_face(Index block, Index cell, Index face, Index joint) const {
    const auto largest = [&](const std::array<Index, 4>& from, const std::array<Index, 4>& to) {
      const auto begin = std::lower_bound(shown_faces_.begin(), shown_faces_.end(),
                                          ShownFace{from, -1, none}),
                 end = std::lower_bound(begin, shown_faces_.end(), ShownFace{to, -1, none});
      const auto best = std::max_element(
          begin, end, [](const ShownFace& a, const ShownFace& b) { return a.area < b.area; });
      return best == end ? none : best->face;
    };
    const Index at = largest({block, joint, cell, face}, {block, joint, cell, face + 1});
    return at != none ? at : largest({block, joint, none, none}, {block, joint + 1, none, none});
  }

  Index face_of_beam(Index i) const {
    const Beam& b = complex_.beams[i];
    return face_of_item_[stands_alone(b) ? before_beams_ + i : b.start];
  }

  const Complex& complex_;
  const BlockOrder& order_;
  BlockArrays& out_;
  const Index sides_, before_beams_, chunks_;
  Grouping areas_;                              // by rank
  std::vector<SurfaceSize> begin_;              // [blocks + 1]
  std::vector<std::vector<KeptSurface>> kept_;  // [chunks] by rank
  std::vector<Index> face_of_item_;             // of all faces; none = on no surface
  std::vector<Index> return_of_;                // [beams]
  std::vector<bool> as_cut_;                    // by rank; empty: none
  Grouping cut_areas_;                          // by rank, of those
  std::vector<Index> joint_of_sliver_;          // [cells] into the origins; empty: none as cut
  std::vector<SideOfSliver> side_;              // [sides] of fragments; empty: no beams
  std::vector<Index> shown_;                    // [beams] origin_of(), or that of a larger one
  std::vector<ShownFace> shown_faces_;          // ordered; empty: no beams
  std::set<std::pair<Index, Index>>
      before_gap_;  // faces of cells that beams leave into a narrow void
};

}  // namespace

BlockArrays flatten_blocks(const Cutting& cutting, const Model& model) {
  const Complex& complex = *cutting.complex;
  BlockArrays out;
  out.origins = complex.origins;
  const BlockOrder order(complex);
  add_bulk(complex, order, model, out);
  add_dead_ends(complex, out);
  SurfaceWriter(complex, order, out).run();
  return out;
}

}  // namespace rockfold
