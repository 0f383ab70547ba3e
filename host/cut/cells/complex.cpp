#include "host/cut/cells/complex.hpp"

#include <algorithm>
#include <array>

#include "host/parallel.hpp"

namespace rockfold {

CellView CellStore::operator[](Index cell) const {
  const auto slice = [cell](const auto& array, const std::vector<std::int64_t>& begin) {
    return std::span(array).subspan(begin[cell], begin[cell + 1] - begin[cell]);
  };
  return {slice(vertices_, vertex_begin_), slice(faces_, face_begin_),
          slice(corners_, corner_begin_)};
}

void CellStore::append(const CellView& cell) {
  const auto copy = [](auto& array, auto& begin, const auto& part) {
    array.insert(array.end(), part.begin(), part.end());
    begin.push_back(static_cast<std::int64_t>(array.size()));
  };
  copy(vertices_, vertex_begin_, cell.vertices);
  copy(faces_, face_begin_, cell.faces);
  copy(corners_, corner_begin_, cell.corners);
}

void CellStore::truncate(Index count) {
  vertices_.resize(vertex_begin_[count]);
  faces_.resize(face_begin_[count]);
  corners_.resize(corner_begin_[count]);
  for (auto* begin : {&vertex_begin_, &face_begin_, &corner_begin_})
    begin->resize(static_cast<std::size_t>(count) + 1);
}

CellStore CellStore::join(const std::vector<const CellStore*>& stores,
                          const std::vector<std::vector<Index>>& chosen) {
  // Where each store's part begins in the result: cells, then vertices, faces, corners.
  std::vector<std::array<std::int64_t, 4>> begin(stores.size() + 1);
  for (std::size_t s = 0; s < stores.size(); ++s) {
    auto& next = begin[s + 1] = begin[s];
    next[0] += static_cast<std::int64_t>(chosen[s].size());
    for (const Index c : chosen[s]) {
      const CellView cell = (*stores[s])[c];
      next[1] += static_cast<std::int64_t>(cell.vertices.size());
      next[2] += static_cast<std::int64_t>(cell.faces.size());
      next[3] += static_cast<std::int64_t>(cell.corners.size());
    }
  }
  CellStore result;
  result.vertex_begin_.resize(begin.back()[0] + 1);
  result.face_begin_.resize(begin.back()[0] + 1);
  result.corner_begin_.resize(begin.back()[0] + 1);
  result.vertices_.resize(begin.back()[1]);
  result.faces_.resize(begin.back()[2]);
  result.corners_.resize(begin.back()[3]);
  const auto copy_store = [&](std::int64_t s) {
    auto at = begin[s];
    const auto copy = [](const auto& part, auto& array, auto& array_begin, std::int64_t cell,
                         std::int64_t& next) {
      std::copy(part.begin(), part.end(), array.begin() + next);
      next += static_cast<std::int64_t>(part.size());
      array_begin[cell + 1] = next;
    };
    for (const Index c : chosen[s]) {
      const CellView cell = (*stores[s])[c];
      copy(cell.vertices, result.vertices_, result.vertex_begin_, at[0], at[1]);
      copy(cell.faces, result.faces_, result.face_begin_, at[0], at[2]);
      copy(cell.corners, result.corners_, result.corner_begin_, at[0], at[3]);
      ++at[0];
    }
  };
  parallel_for(static_cast<std::int64_t>(stores.size()), 1, copy_store, begin.back()[0] > 1000);
  return result;
}

Polygon Complex::polygon_of(const Fragment& f) const {
  if (f.polygon != none) return polygons[f.polygon];
  const CellView cell = cells[f.cell[0]];
  return face_polygon(cell, cell.faces[f.face[0]]);
}

Polygon Complex::polygon_of(const FreePart& f) const {
  if (f.polygon != none) return polygons[f.polygon];
  const CellView cell = cells[f.cell];
  return face_polygon(cell, cell.faces[f.face]);
}

}  // namespace rockfold
