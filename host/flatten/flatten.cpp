#include "host/flatten/flatten.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "host/cut/complex.hpp"
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
// cheap to do twice; the surfaces of others are kept in between.
class SurfaceWriter {
 public:
  SurfaceWriter(const Complex& complex, BlockArrays& out)
      : complex_(complex),
        out_(out),
        sides_(2 * static_cast<Index>(complex.fragments.size())),
        chunks_((complex.block_count + chunk - 1) / chunk) {}

  void run() {
    group_areas();
    measure();
    make_room();
    for_each_chunk([&](Index k, Index begin, Index end) { write_chunk(k, begin, end); });
    write_interfaces();
  }

 private:
  struct KeptSurface {
    Index block;
    BlockSurface surface;
  };
  // Of one fragment; those of one pair of faces become one.
  struct Contact {
    BlockArrays::Interface shared;
    Index fragment;
    auto key() const {
      return std::tie(shared.block[0], shared.face[0], shared.block[1], shared.face[1]);
    }
    bool operator<(const Contact& o) const {
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

  // The boundary areas of each block: the sides of joint fragments with another block behind them, then free parts.
  // Items are numbered so: fragment i has the sides 2 i and 2 i + 1.
  void group_areas() {
    const auto& block = complex_.cell_block;
    const auto block_of_item = [&](Index i) {
      if (i >= sides_) return block[complex_.free_parts[i - sides_].cell];
      const Fragment& f = complex_.fragments[i / 2];
      if (f.joint == none || block[f.cell[0]] == block[f.cell[1]]) return none;
      return block[f.cell[i % 2]];
    };
    areas_ = group_items(sides_ + static_cast<Index>(complex_.free_parts.size()),
                         complex_.block_count, block_of_item);
  }

  void find_areas(Index block, std::vector<BoundaryArea>& areas) const {
    areas.clear();
    for (const Index i : areas_[block]) {
      if (i < sides_) {
        const Fragment& f = complex_.fragments[i / 2];
        areas.push_back({f.cell[i % 2], f.face[i % 2], f.joint, i / 2, none});
      } else {
        const FreePart& f = complex_.free_parts[i - sides_];
        areas.push_back({f.cell, f.face, f.origin, none, i - sides_});
      }
    }
  }

  void measure() {
    begin_.resize(complex_.block_count + 1);
    kept_.resize(chunks_);
    for_each_chunk([&](Index k, Index begin, Index end) {
      std::vector<BoundaryArea> areas;
      std::vector<Index> origin;
      for (Index b = begin; b < end; ++b) {
        find_areas(b, areas);
        if (is_plain_cell(complex_, areas, origin)) {
          begin_[b + 1] = size_of(complex_.cells[areas.front().cell]);
        } else {
          kept_[k].push_back({b, make_block_surface(complex_, areas)});
          begin_[b + 1] = size_of(kept_[k].back().surface);
        }
      }
    });
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
        [&] { out_.face_origin.resize(all.faces); },
        [&] { out_.face_plane.resize(all.faces); },
        [&] { out_.loop_begin.resize(all.faces + 1); },
        [&] { out_.corner_begin.resize(all.loops + 1); },
        [&] { face_of_side_.resize(sides_, none); },
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
    std::vector<Index> origin;
    BlockSurface plain;
    auto kept = kept_[k].begin();
    for (Index b = begin; b < end; ++b) {
      if (kept != kept_[k].end() && kept->block == b) {
        write_surface(b, kept->surface);
        ++kept;
      } else {
        find_areas(b, areas);
        is_plain_cell(complex_, areas, origin);
        write_cell_surface(complex_, areas, origin, plain);
        write_surface(b, plain);
      }
    }
    kept_[k] = {};
  }

  void write_surface(Index b, const BlockSurface& s) {
    const SurfaceSize at = begin_[b];
    bool finite = true;
    Index face = at.faces;
    for (const auto& f : s.faces) {
      const Vec3& n = complex_.planes.normal(plane_of(f.inside));
      out_.face_normal[face] = is_above(f.inside) ? -n : n;
      out_.face_area[face] = f.area;
      out_.face_origin[face] = f.origin;
      out_.face_up[face] = is_above(f.inside) ? 0 : 1;
      out_.face_plane[face++] = plane_of(f.inside);
      finite = finite && !complex_.origins[f.origin].continues;
    }
    for (std::size_t i = 1; i < s.loop_begin.size(); ++i)
      out_.loop_begin[at.faces + i] = at.loops + s.loop_begin[i];
    for (std::size_t i = 1; i < s.corner_begin.size(); ++i)
      out_.corner_begin[at.loops + i] = at.corners + s.corner_begin[i];
    for (std::size_t i = 0; i < s.corner_vertex.size(); ++i)
      out_.corner_vertex[at.corners + i] = at.vertices + s.corner_vertex[i];
    for (std::size_t i = 0; i < s.vertices.size(); ++i)
      out_.vertex[at.vertices + i] = s.vertices[i] + complex_.planes.centre();
    out_.face_begin[b + 1] = begin_[b + 1].faces;
    out_.vertex_begin[b + 1] = begin_[b + 1].vertices;
    out_.edge_count[b] = s.edge_count;
    out_.shell_count[b] = s.shell_count;
    out_.genus[b] = s.genus;
    out_.convex[b] = s.convex ? 1 : 0;
    out_.finite[b] = finite ? 1 : 0;
    const auto items = areas_[b];
    for (std::size_t i = 0; i < items.size() && items[i] < sides_; ++i)
      face_of_side_[items[i]] = at.faces + s.face_of_area[i];
  }

  // Fragments between a block and those of higher numbers are its own, so that blocks need not wait for each other.
  void write_interfaces() {
    std::vector<std::vector<BlockArrays::Interface>> found(chunks_);
    for_each_chunk([&](Index k, Index begin, Index end) {
      std::vector<Contact> contacts;
      for (Index b = begin; b < end; ++b) {
        find_contacts(b, contacts);
        for (std::size_t i = 0; i < contacts.size(); ++i) {
          if (i > 0 && contacts[i - 1].key() == contacts[i].key())
            found[k].back().area += contacts[i].shared.area;
          else
            found[k].push_back(contacts[i].shared);
        }
      }
    });
    std::size_t all = 0;
    for (const auto& part : found) all += part.size();
    out_.interfaces.reserve(all);
    for (auto& part : found) {
      out_.interfaces.insert(out_.interfaces.end(), part.begin(), part.end());
      part = {};
    }
  }

  void find_contacts(Index b, std::vector<Contact>& contacts) const {
    contacts.clear();
    for (const Index i : areas_[b]) {
      if (i >= sides_) break;
      const Fragment& f = complex_.fragments[i / 2];
      const Index other = i ^ 1, behind = complex_.cell_block[f.cell[other % 2]];
      if (behind < b) continue;
      contacts.push_back({{{b, behind}, {face_of_side_[i], face_of_side_[other]}, f.area}, i / 2});
    }
    std::sort(contacts.begin(), contacts.end());
  }

  const Complex& complex_;
  BlockArrays& out_;
  const Index sides_, chunks_;
  Grouping areas_;
  std::vector<SurfaceSize> begin_;              // [blocks + 1]
  std::vector<std::vector<KeptSurface>> kept_;  // [chunks] by block
  std::vector<Index> face_of_side_;             // [sides] of all faces; none = on no surface
};

}  // namespace

BlockArrays flatten_blocks(const Cutting& cutting, const Model& model) {
  const Complex& complex = *cutting.complex;
  BlockArrays out;
  out.origins = complex.origins;
  add_bulk(complex, model, out);
  add_dead_ends(complex, out);
  SurfaceWriter(complex, out).run();
  return out;
}

}  // namespace rockfold
