#include "src/io/exports/writers.hpp"
#include "src/io/viewers/block_mesh.hpp"

namespace rockfold {

namespace {

/// Bytes as the numbers that VTK's XML writes strings of, each ended by a 0.
void write_names(const std::vector<FaceOrigin>& origins, TextFile& file) {
  file.print(
      "<FieldData>\n<Array type=\"String\" Name=\"origin_name\" NumberOfTuples=\"{}\" "
      "format=\"ascii\">\n",
      origins.size());
  for (const FaceOrigin& origin : origins) {
    for (const char c : origin.name) file.print("{} ", static_cast<unsigned char>(c));
    file.print("0\n");
  }
  file.print("</Array>\n</FieldData>\n");
}

template <class Value>
void write_cells(TextFile& file, const char* type, const char* name, Index count, Value value) {
  file.print("<DataArray type=\"{}\" Name=\"{}\" format=\"ascii\">\n", type, name);
  for (Index p = 0; p < count; ++p) file.print("{}\n", value(p));
  file.print("</DataArray>\n");
}

void write_polygons(const PolygonMesh& polygons, TextFile& file) {
  file.print("<Polys>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n");
  for (Index p = 0; p < polygons.size(); ++p) {
    for (Index c = polygons.polygon_begin[p]; c < polygons.polygon_begin[p + 1]; ++c)
      file.print("{} ", polygons.polygon_vertex[c]);
    file.print("\n");
  }
  file.print("</DataArray>\n");
  write_cells(file, "Int64", "offsets", polygons.size(),
              [&](Index p) { return polygons.polygon_begin[p + 1]; });
  file.print("</Polys>\n");
}

}  // namespace

void write_vtp(const ExportData& data, TextFile& file) {
  const BlockArrays& blocks = data.blocks;
  const PolygonMesh& polygons = data.triangles;  // viewers fill concave polygons wrongly
  const std::vector<Index> block = block_of_face(blocks);
  const Index n = polygons.size();
  const auto block_of = [&](Index p) { return block[polygons.polygon_face[p]]; };
  file.print(
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
      "byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n");
  write_names(blocks.origins, file);
  file.print(
      "<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"0\" NumberOfLines=\"0\" "
      "NumberOfStrips=\"0\" NumberOfPolys=\"{}\">\n",
      blocks.vertex.size(), n);
  file.print(
      "<Points>\n<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" "
      "format=\"ascii\">\n");
  for (const Vec3& x : blocks.vertex) file.print("{}\n", spaced(x));
  file.print("</DataArray>\n</Points>\n");
  write_polygons(polygons, file);
  file.print("<CellData Scalars=\"block\">\n");
  write_cells(file, "Int32", "block", n, [&](Index p) { return block_of(p) + 1; });
  write_cells(file, "Int32", "face", n, [&](Index p) { return polygons.polygon_face[p] + 1; });
  write_cells(file, "Int32", "origin", n,
              [&](Index p) { return blocks.face_origin[polygons.polygon_face[p]] + 1; });
  write_cells(file, "Float64", "volume", n, [&](Index p) { return blocks.volume[block_of(p)]; });
  write_cells(file, "Int32", "stage", n, [&](Index p) { return stage_of(blocks, block_of(p)); });
  if (data.theory) {
    const BlockFields& theory = *data.theory;
    write_cells(file, "Int32", "class", n,
                [&](Index p) { return int{theory.block_class[block_of(p)]}; });
    write_cells(file, "Int32", "batch", n, [&](Index p) { return theory.batch[block_of(p)]; });
    write_cells(file, "Float64", "factor_of_safety", n,
                [&](Index p) { return theory.factor_of_safety[block_of(p)]; });
  }
  file.print("</CellData>\n</Piece>\n</PolyData>\n</VTKFile>\n");
}

}  // namespace rockfold
