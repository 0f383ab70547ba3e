#include "host/cut/complex.hpp"

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

void CellStore::append(const CellStore& other) {
  const auto join = [](auto& array, auto& begin, const auto& more, const auto& more_begin) {
    const auto shift = static_cast<std::int64_t>(array.size());
    array.insert(array.end(), more.begin(), more.end());
    for (std::size_t i = 1; i < more_begin.size(); ++i) begin.push_back(more_begin[i] + shift);
  };
  join(vertices_, vertex_begin_, other.vertices_, other.vertex_begin_);
  join(faces_, face_begin_, other.faces_, other.face_begin_);
  join(corners_, corner_begin_, other.corners_, other.corner_begin_);
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
