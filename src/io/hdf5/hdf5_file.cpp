#include "src/io/hdf5/hdf5_file.hpp"

#include <fcntl.h>
#define H5_USE_110_API  // the names of 1.10 in later versions too
#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

#include <hdf5.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include "src/io/hdf5/hdf5_id.hpp"
#include "src/io/hdf5/packed_rows.hpp"

namespace rockfold::hdf5 {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "HDF5 1.10 or later is needed");

/// Data sets above this size are compressed; smaller ones are not worth it.
constexpr std::int64_t compress_above = 16 * 1024;  // bytes
/// Rows of a compressed data set are packed in chunks of about this size (HDF5's chunk cache holds
/// 1 MiB).
constexpr std::int64_t chunk_bytes = 512 * 1024;
/// … of one that grows: rows that are appended to a chunk that is not full pack it anew.
constexpr std::int64_t growing_chunk_bytes = 32 * 1024;
/// What HDF5's own structures may add to the data of one step of writing.
constexpr std::int64_t metadata_bytes = 1024 * 1024;

hid_t file_type(Type type) {
  switch (type) {
    case Type::uint8:
      return H5T_STD_U8LE;
    case Type::int32:
      return H5T_STD_I32LE;
    case Type::int64:
      return H5T_STD_I64LE;
    case Type::float32:
      return H5T_IEEE_F32LE;
    case Type::float64:
      return H5T_IEEE_F64LE;
  }
  return -1;
}
hid_t memory_type(Type type) {
  switch (type) {
    case Type::uint8:
      return H5T_NATIVE_UINT8;
    case Type::int32:
      return H5T_NATIVE_INT32;
    case Type::int64:
      return H5T_NATIVE_INT64;
    case Type::float32:
      return H5T_NATIVE_FLOAT;
    case Type::float64:
      return H5T_NATIVE_DOUBLE;
  }
  return -1;
}
std::int64_t size_of(Type type) {
  switch (type) {
    case Type::uint8:
      return 1;
    case Type::int32:
    case Type::float32:
      return 4;
    case Type::int64:
    case Type::float64:
      return 8;
  }
  return 0;
}

std::int64_t count_of(const Shape& shape) {
  std::int64_t n = 1;
  for (const std::int64_t extent : shape) n *= extent;
  return n;
}

std::vector<hsize_t> extents(const Shape& shape) {
  return {shape.begin(), shape.end()};
}

/// The reason of a failure: the system's where HDF5 quotes it, else HDF5's innermost description.
herr_t collect_reason(unsigned n, const H5E_error2_t* entry, void* reason) {
  auto& text = *static_cast<std::string*>(reason);
  const std::string description = entry->desc ? entry->desc : "";
  if (n == 0) text = description;
  const std::string mark = "error message = '";
  const auto begin = description.find(mark);
  if (begin == std::string::npos) return 0;
  const auto end = description.find('\'', begin + mark.size());
  text = description.substr(begin + mark.size(), end - begin - mark.size());
  return 1;
}

std::string reason_of_failure() {
  std::string reason = "unknown HDF5 error";
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, collect_reason, &reason);
  return reason;
}

/// Group creation: link order is kept (VTKHDF readers need it), no time stamps.
hid_t group_properties(hid_t property_class) {
  const hid_t properties = H5Pcreate(property_class);
  H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

hid_t dataset_properties() {
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

void set_compression(hid_t properties, unsigned level) {
  H5Pset_shuffle(properties);
  H5Pset_deflate(properties, level);
}

/// What a growing data set is stored by. Its rows count along the first dimension, of three the second.
struct Chunks {
  std::vector<hsize_t> shape;
  unsigned level = 0;  ///< of deflate; 0: none

  explicit Chunks(hid_t dataset, std::size_t rank) : shape(rank) {
    const Id properties(H5Dget_create_plist(dataset), H5Pclose);
    H5Pget_chunk(properties, static_cast<int>(rank), shape.data());
    unsigned flags = 0;
    std::size_t values = 1;
    if (H5Pget_filter_by_id2(properties, H5Z_FILTER_DEFLATE, &flags, &values, &level, 0, nullptr,
                             nullptr) < 0)
      level = 0;
  }
  std::size_t along() const { return shape.size() == 3 ? 1 : 0; }
};

/// Writes `count` at `start` with the chunk that the rows before them have begun. False if HDF5 cannot.
bool append_packed(hid_t dataset, Type type, const Chunks& chunks, std::vector<hsize_t> start,
                   std::vector<hsize_t> count, const void* data) {
  const std::size_t along = chunks.along();
  ChunkedRows rows;
  rows.element_bytes = rows.row_bytes = size_of(type);
  for (std::size_t d = along + 1; d < count.size(); ++d)
    rows.row_bytes *= static_cast<std::int64_t>(count[d]);
  rows.data = {static_cast<const std::uint8_t*>(data),
               count[along] * static_cast<std::size_t>(rows.row_bytes)};
  rows.rows_a_chunk = static_cast<std::int64_t>(chunks.shape[along]);
  rows.first_row = static_cast<std::int64_t>(start[along]);
  rows.level = chunks.level;
  rows.worthwhile = 1;
  const hsize_t begun = start[along] % chunks.shape[along];
  std::vector<std::uint8_t> before(begun * static_cast<std::size_t>(rows.row_bytes));
  rows.before = before;
  if (begun > 0) {
    std::vector<hsize_t> from = start, there = count;
    from[along] -= begun;
    there[along] = begun;
    const Id space(H5Dget_space(dataset), H5Sclose);
    const Id memory(H5Screate_simple(static_cast<int>(there.size()), there.data(), nullptr),
                    H5Sclose);
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, from.data(), nullptr, there.data(), nullptr) <
            0 ||
        H5Dread(dataset, memory_type(type), memory, space, H5P_DEFAULT, before.data()) < 0)
      return false;
  }
  return write_packed(dataset, start, along, rows);
}

hid_t fixed_text(std::size_t length) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  return type;
}

/// ASCII where that is enough: VTK insists on it for its `Type`.
void set_characters(hid_t type, std::string_view text) {
  const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return (c & 0x80) == 0; });
  H5Tset_cset(type, ascii ? H5T_CSET_ASCII : H5T_CSET_UTF8);
}

std::string parent_of(const std::string& path) {
  return path.substr(0, path.rfind('/'));
}

/// How many bytes the file system still gives, at least; −1 = it cannot say.
std::int64_t free_bytes(int file) {
  struct statvfs system {};
  if (fstatvfs(file, &system) != 0) return -1;
  return static_cast<std::int64_t>(system.f_bavail) * static_cast<std::int64_t>(system.f_frsize);
}

/// Reserves disk space from `size` on without changing the file's size. Returns an errno, 0 =
/// reserved.
int reserve_space(const std::string& path, std::int64_t size, std::int64_t bytes) {
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY &&
      static_cast<std::uint64_t>(size + bytes) > limit.rlim_cur)
    return EFBIG;
  const int file = open(path.c_str(), O_RDWR | O_CLOEXEC);
  if (file < 0) return errno;
  int error = fallocate(file, FALLOC_FL_KEEP_SIZE, size, bytes) == 0 ? 0 : errno;
  if (error == EOPNOTSUPP || error == ENOSYS) {
    const std::int64_t available = free_bytes(file);
    error = available >= 0 && available < bytes ? ENOSPC : 0;
  }
  ::close(file);
  return error;
}

}  // namespace

File::File(const std::string& path, Mode mode, std::string shown_as)
    : path_(path), shown_as_(std::move(shown_as)) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  // Superblock 2, which a killed process leaves readable (3 would mark the file as still being
  // written).
  H5Pset_libver_bounds(access, H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  if (mode == Mode::create) {
    const Id creation(group_properties(H5P_FILE_CREATE), H5Pclose);
    id_ = check(H5Fcreate(path.c_str(), H5F_ACC_EXCL, creation, access), "create");
  } else {
    const bool extend = mode == Mode::extend;
    id_ = check(H5Fopen(path.c_str(), extend ? H5F_ACC_RDWR : H5F_ACC_RDONLY, access), "open");
  }
}

File::~File() {
  if (id_ >= 0) H5Fclose(id_);
}

void File::close() {
  const hid_t id = std::exchange(id_, -1);
  const herr_t flushed = H5Fflush(id, H5F_SCOPE_LOCAL);
  const std::string reason = flushed < 0 ? reason_of_failure() : "";
  const herr_t closed = H5Fclose(id);
  if (flushed < 0) throw failure("cannot write: " + reason);
  check(closed, "write");
  struct stat status {};
  if (reserved_ && stat(path_.c_str(), &status) == 0 &&
      truncate(path_.c_str(), status.st_size) != 0)
    throw failure(std::string("cannot write: ") + std::strerror(errno));
}

std::int64_t File::check(std::int64_t result, const char* action) const {
  if (result < 0) throw failure(std::string("cannot ") + action + ": " + reason_of_failure());
  return result;
}

void File::reserve(std::int64_t bytes) {
  hsize_t size = 0;
  check(H5Fget_filesize(id_, &size), "measure");
  const int error = reserve_space(path_, static_cast<std::int64_t>(size), bytes + metadata_bytes);
  if (error != 0) throw failure(std::string("cannot write: ") + std::strerror(error));
  reserved_ = true;
}

void File::make_group(const std::string& path) {
  if (path.empty() || exists(path)) return;
  make_group(parent_of(path));
  const Id properties(group_properties(H5P_GROUP_CREATE), H5Pclose);
  const Id group(H5Gcreate2(id_, path.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose);
  check(group, "write");
}

bool File::exists(const std::string& path) const {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    if (H5Lexists(id_, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

void File::write_rows(const std::string& path, Type type, const Shape& shape, const void* data) {
  make_group(parent_of(path));
  const std::int64_t bytes = count_of(shape) * size_of(type);
  reserve(bytes);
  const Id properties(dataset_properties(), H5Pclose);
  const bool compressed = bytes > compress_above;
  Shape chunk = shape;
  if (compressed) {
    chunk[0] = std::clamp<std::int64_t>(chunk_bytes * shape[0] / bytes, 1, shape[0]);
    H5Pset_chunk(properties, static_cast<int>(chunk.size()), extents(chunk).data());
    set_compression(properties, deflate_level);
  }
  const Id space(H5Screate_simple(static_cast<int>(shape.size()), extents(shape).data(), nullptr),
                 H5Sclose);
  const Id dataset(
      H5Dcreate2(id_, path.c_str(), file_type(type), space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose);
  check(dataset, "write");
  if (compressed && std::endian::native == std::endian::little) {
    const ChunkedRows rows{
        {static_cast<const std::uint8_t*>(data), static_cast<std::size_t>(bytes)},
        size_of(type),
        bytes / shape[0],
        chunk[0]};
    const std::vector<hsize_t> at(shape.size(), 0);
    check(write_packed(dataset, at, 0, rows) ? 0 : -1, "write");
  } else if (bytes > 0) {
    check(H5Dwrite(dataset, memory_type(type), H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write");
  }
}

void File::write_text(const std::string& path, std::string_view text) {
  make_group(parent_of(path));
  reserve(static_cast<std::int64_t>(text.size()));
  const Id type(fixed_text(text.size()), H5Tclose);
  set_characters(type, text);
  const Id properties(dataset_properties(), H5Pclose);
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  const Id dataset(H5Dcreate2(id_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                   H5Dclose);
  check(dataset, "write");
  check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text.empty() ? "\0" : text.data()),
        "write");
}

void File::write_names(const std::string& path, const std::vector<std::string>& names) {
  make_group(parent_of(path));
  std::size_t longest = 1;
  std::string all;
  for (const std::string& name : names) longest = std::max(longest, name.size());
  for (const std::string& name : names) all += name + std::string(longest - name.size(), '\0');
  const Id type(fixed_text(longest), H5Tclose);
  set_characters(type, all);
  const Id properties(dataset_properties(), H5Pclose);
  const hsize_t count = names.size();
  const Id space(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Id dataset(H5Dcreate2(id_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                   H5Dclose);
  check(dataset, "write");
  if (count > 0) check(H5Dwrite(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, all.data()), "write");
}

void File::make_growing(const std::string& path, Type type, const Shape& block, bool compressed) {
  make_group(parent_of(path));
  const std::int64_t bytes = count_of(block) * size_of(type);
  Shape first = block, chunk = block;
  first[0] = 0;
  if (bytes < 4096)
    chunk[0] = std::max<std::int64_t>(1, 4096 / std::max<std::int64_t>(1, bytes / block[0]));
  constexpr std::int64_t largest = std::int64_t{1} << 30;  // HDF5's own limit is 4 GiB
  if (bytes > largest && block[0] > 1)
    chunk[0] = (block[0] + bytes / largest) / (bytes / largest + 1);
  const bool deflated = (compressed || growing_level_ > 0) && bytes > compress_above;
  if (deflated) {  // threads take a chunk each
    const std::size_t along = block.size() == 3 ? 1 : 0;
    const std::int64_t chunks = (bytes + growing_chunk_bytes - 1) / growing_chunk_bytes;
    chunk[along] = std::max<std::int64_t>(1, (block[along] + chunks - 1) / chunks);
  }
  std::vector<hsize_t> limit = extents(block);
  limit[0] = H5S_UNLIMITED;
  const Id properties(dataset_properties(), H5Pclose);
  H5Pset_chunk(properties, static_cast<int>(chunk.size()), extents(chunk).data());
  if (deflated) set_compression(properties, growing_level_ > 0 ? growing_level_ : deflate_level);
  const Id space(
      H5Screate_simple(static_cast<int>(first.size()), extents(first).data(), limit.data()),
      H5Sclose);
  const Id dataset(
      H5Dcreate2(id_, path.c_str(), file_type(type), space, H5P_DEFAULT, properties, H5P_DEFAULT),
      H5Dclose);
  check(dataset, "write");
}

void File::append_block(const std::string& path, Type type, const Shape& block, const void* data,
                        bool compressed) {
  if (count_of(block) == 0) return;
  if (!exists(path)) make_growing(path, type, block, compressed);
  const Id dataset(H5Dopen2(id_, path.c_str(), H5P_DEFAULT), H5Dclose);
  check(dataset, "write");
  std::vector<hsize_t> size = extents(shape(path)), start(size.size(), 0);
  start[0] = size[0];
  size[0] += static_cast<hsize_t>(block[0]);
  check(H5Dset_extent(dataset, size.data()), "write");
  if (const Chunks chunks(dataset, size.size());
      chunks.level > 0 && std::endian::native == std::endian::little)
    return void(
        check(append_packed(dataset, type, chunks, start, extents(block), data) ? 0 : -1, "write"));
  const Id space(H5Dget_space(dataset), H5Sclose);
  const std::vector<hsize_t> count = extents(block);
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "write");
  const Id memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                  H5Sclose);
  check(H5Dwrite(dataset, memory_type(type), memory, space, H5P_DEFAULT, data), "write");
}

void File::write_virtual_rows(const std::string& path, const std::string& source,
                              std::int64_t first, std::int64_t rows) {
  make_group(parent_of(path));
  const Id original(H5Dopen2(id_, source.c_str(), H5P_DEFAULT), H5Dclose);
  check(original, "write");
  const Id type(H5Dget_type(original), H5Tclose);
  const Id from(H5Dget_space(original), H5Sclose);
  std::vector<hsize_t> count = extents(shape(source)), start(count.size(), 0);
  start[0] = static_cast<hsize_t>(first);
  count[0] = static_cast<hsize_t>(rows);
  check(H5Sselect_hyperslab(from, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "write");
  const Id space(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr), H5Sclose);
  const Id properties(dataset_properties(), H5Pclose);
  check(H5Pset_virtual(properties, space, ".", source.c_str(), from), "write");
  const Id dataset(H5Dcreate2(id_, path.c_str(), type, space, H5P_DEFAULT, properties, H5P_DEFAULT),
                   H5Dclose);
  check(dataset, "write");
}

void File::hard_link(const std::string& existing, const std::string& path) {
  make_group(parent_of(path));
  check(H5Lcreate_hard(id_, existing.c_str(), id_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        "write");
}

void File::soft_link(const std::string& existing, const std::string& path) {
  make_group(parent_of(path));
  check(H5Lcreate_soft(existing.c_str(), id_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT), "write");
}

void File::set_text(const std::string& object, const std::string& name, std::string_view text) {
  const Id type(fixed_text(text.size()), H5Tclose);
  set_characters(type, text);
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  write_attribute(object, name, type, type, space, text.empty() ? "\0" : text.data());
}

void File::set_integers(const std::string& object, const std::string& name,
                        const std::vector<std::int64_t>& values) {
  const hsize_t count = values.size();
  const Id space(count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr),
                 H5Sclose);
  write_attribute(object, name, H5T_STD_I64LE, H5T_NATIVE_INT64, space, values.data());
}

void File::set_real(const std::string& object, const std::string& name, double value) {
  const Id space(H5Screate(H5S_SCALAR), H5Sclose);
  write_attribute(object, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, space, &value);
}

/// Overwrites an attribute of the same name, type and size in place.
void File::write_attribute(const std::string& object, const std::string& name,
                           std::int64_t type_in_file, std::int64_t type_in_memory,
                           std::int64_t space, const void* value) {
  make_group(object);
  const Id owner(H5Oopen(id_, object.c_str(), H5P_DEFAULT), H5Oclose);
  check(owner, "write");
  const bool there = H5Aexists(owner, name.c_str()) > 0;
  const Id attribute(
      there ? H5Aopen(owner, name.c_str(), H5P_DEFAULT)
            : H5Acreate2(owner, name.c_str(), type_in_file, space, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  check(attribute, "write");
  check(H5Awrite(attribute, type_in_memory, value), "write");
}

}  // namespace rockfold::hdf5
