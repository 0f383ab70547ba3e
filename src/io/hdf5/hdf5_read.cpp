// The reading half of hdf5_file.hpp.
#define H5_USE_110_API  // the names of 1.10 in later versions too
#include <algorithm>
#include <limits>
#include <map>

#include <hdf5.h>

#include "src/io/hdf5/hdf5_file.hpp"
#include "src/io/hdf5/hdf5_id.hpp"

namespace rockfold::hdf5 {
namespace {

std::string type_name(hid_t type) {
  switch (H5Tget_class(type)) {
    case H5T_INTEGER:
      return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") +
             std::to_string(8 * H5Tget_size(type));
    case H5T_FLOAT:
      return "float" + std::to_string(8 * H5Tget_size(type));
    case H5T_STRING:
      return "string";
    default:
      return "other";
  }
}

Shape shape_of_space(hid_t space) {
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank <= 0) return {};
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  return {extent.begin(), extent.end()};
}

/// A string as it was before it was padded.
std::string unpadded(std::string text) {
  text.resize(std::min(text.size(), text.find('\0')));
  return text;
}

struct Visit {
  std::map<haddr_t, DatasetInfo> found;  // by address: a data set may have several names
  std::string group;
};

/// For H5Lvisit: keeps each data set under the first of its names, whatever the order of the calls.
herr_t visit_link(hid_t group, const char* name, const H5L_info_t* link, void* data) {
  auto& visit = *static_cast<Visit*>(data);
  if (link->type != H5L_TYPE_HARD) return 0;
  const Id object(H5Oopen(group, name, H5P_DEFAULT), H5Oclose);
  if (object < 0) return -1;
  if (H5Iget_type(object) != H5I_DATASET) return 0;
  H5L_info_t info;
  if (H5Lget_info(group, name, &info, H5P_DEFAULT) < 0) return -1;
  std::string path = visit.group + "/" + name;
  const auto [met, is_new] = visit.found.try_emplace(info.u.address);
  if (is_new) {
    const Id type(H5Dget_type(object), H5Tclose);
    const Id space(H5Dget_space(object), H5Sclose);
    met->second = {std::move(path), type_name(type), shape_of_space(space),
                   static_cast<std::int64_t>(H5Dget_storage_size(object))};
  } else if (path < met->second.path) {
    met->second.path = std::move(path);
  }
  return 0;
}

}  // namespace

Shape File::shape(const std::string& path) const {
  const Id dataset(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset, "read");
  const Id space(H5Dget_space(dataset), H5Sclose);
  return shape_of_space(space);
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  return exists(object) && H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

std::string File::text_attribute(const std::string& object, const std::string& name) const {
  const Id attribute(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose);
  check(attribute, "read");
  const Id type(H5Aget_type(attribute), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
    throw failure("cannot read: attribute '" + name + "' is no text");
  std::string text(H5Tget_size(type), '\0');
  check(H5Aread(attribute, type, text.data()), "read");
  return unpadded(text);
}

double File::number_attribute(const std::string& object, const std::string& name) const {
  const Id attribute(H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT),
                     H5Aclose);
  check(attribute, "read");
  const Id space(H5Aget_space(attribute), H5Sclose);
  if (H5Sget_simple_extent_npoints(space) != 1)
    throw failure("cannot read: attribute '" + name + "' is not one number");
  double value = 0;
  check(H5Aread(attribute, H5T_NATIVE_DOUBLE, &value), "read");
  return value;
}

std::string File::read_text(const std::string& path) const {
  const Id dataset(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset, "read");
  const Id type(H5Dget_type(dataset), H5Tclose);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || !shape(path).empty())
    throw failure("cannot read: '" + path + "' is no text");
  std::string text(H5Tget_size(type), '\0');
  check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.data()), "read");
  return unpadded(text);
}

template <typename T>
std::vector<T> File::read_all(const std::string& path, std::int64_t memory_type) const {
  const Id dataset(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset, "read");
  std::int64_t count = 1;
  for (const std::int64_t extent : shape(path)) count *= extent;
  if (count < 0 || count > std::numeric_limits<Index>::max())
    throw failure("cannot read: '" + path + "' is too large");
  std::vector<T> numbers(static_cast<std::size_t>(count));
  check(H5Dread(dataset, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers.data()), "read");
  return numbers;
}

std::vector<double> File::read_numbers(const std::string& path) const {
  return read_all<double>(path, H5T_NATIVE_DOUBLE);
}

std::vector<std::int64_t> File::read_integers(const std::string& path) const {
  return read_all<std::int64_t>(path, H5T_NATIVE_INT64);
}

std::vector<std::byte> File::read_bytes(const std::string& path) const {
  return read_all<std::byte>(path, H5T_NATIVE_UINT8);
}

std::vector<float> File::read_rows(const std::string& path, std::int64_t first,
                                   std::int64_t rows) const {
  const Id dataset(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset, "read");
  const Shape extent = shape(path);
  if (extent.empty() || first < 0 || rows < 0 || first > extent[0] - rows)
    throw failure("cannot read: '" + path + "' has too few rows");
  std::vector<hsize_t> start(extent.size(), 0), count(extent.begin(), extent.end());
  start[0] = static_cast<hsize_t>(first);
  count[0] = static_cast<hsize_t>(rows);
  hsize_t values = 1;
  for (const hsize_t n : count) values *= n;
  if (values > static_cast<hsize_t>(std::numeric_limits<Index>::max()))
    throw failure("cannot read: '" + path + "' is too large");
  std::vector<float> numbers(values);
  if (values == 0) return numbers;
  const Id in_file(H5Dget_space(dataset), H5Sclose);
  check(H5Sselect_hyperslab(in_file, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "read");
  const Id in_memory(H5Screate_simple(1, &values, nullptr), H5Sclose);
  check(H5Dread(dataset, H5T_NATIVE_FLOAT, in_memory, in_file, H5P_DEFAULT, numbers.data()),
        "read");
  return numbers;
}

std::vector<std::string> File::read_names(const std::string& path) const {
  const Id dataset(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset, "read");
  const Id type(H5Dget_type(dataset), H5Tclose);
  const Shape extent = shape(path);
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0 || extent.size() != 1)
    throw failure("cannot read: '" + path + "' is no list of names");
  const std::size_t width = H5Tget_size(type);
  std::string all(width * static_cast<std::size_t>(extent[0]), '\0');
  if (!all.empty())
    check(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), "read");
  std::vector<std::string> names;
  for (std::size_t n = 0; n < all.size(); n += width)
    names.push_back(unpadded(all.substr(n, width)));
  return names;
}

std::vector<DatasetInfo> File::datasets(const std::vector<std::string>& groups) const {
  Visit visit;
  for (const std::string& group : groups) {
    if (!exists(group)) continue;
    visit.group = group;
    // In the file's own order: for any other HDF5 1.10 makes a table of links, and where it cannot
    // read them all, as in a damaged file, it frees entries of the table that it never filled.
    check(H5Lvisit_by_name(id_, group.c_str(), H5_INDEX_NAME, H5_ITER_NATIVE, visit_link, &visit,
                           H5P_DEFAULT),
          "read");
  }
  std::vector<DatasetInfo> sorted;
  for (auto& [address, dataset] : visit.found) sorted.push_back(std::move(dataset));
  std::sort(sorted.begin(), sorted.end(),
            [](const auto& a, const auto& b) { return a.path < b.path; });
  return sorted;
}

}  // namespace rockfold::hdf5
