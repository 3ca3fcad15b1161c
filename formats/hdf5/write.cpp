// SPDX-License-Identifier: GPL-3.0-or-later
// Writes HDF5 objects, and composes files in memory so that they appear on disk complete or not at all.
#include <hdf5.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <vector>

#include "common/math/count.hpp"
#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {
namespace {

constexpr const char* remedy = "free some space, or choose another place for the file";
constexpr std::uint64_t compact_bytes = 4096;         // limit of datasets stored in their header
constexpr std::uint64_t compact_text_bytes = 60'000;  // limit of one string; HDF5 limits a header message to 64 KiB
// Values by Packing. A chunk roughly fits the cache of a dataset. Deflate levels above 4 take longer and save almost
// nothing. Level 4 takes three times as long as level 1 and saves 1 %.
constexpr std::uint64_t chunk_bytes[] = {256u << 10, 256u << 10, 1u << 20};
constexpr unsigned deflate_level[] = {0, 4, 1};

/// Type of zero-padded UTF-8 text of `size` bytes.
Handle text_type(std::size_t size) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(size, 1));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

/// Values in memory, with their types in memory and in the file.
struct Values {
  Id file_type = -1, memory_type = -1;
  const void* data = nullptr;
};

Values values_of(const double* values) { return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, values}; }
Values values_of(const std::int32_t* values) { return {H5T_STD_I32LE, H5T_NATIVE_INT32, values}; }

void write_one(const Output& out, const std::string& object, const std::string& name, const Values& value) {
  if (H5Aexists_by_name(out.id, object.c_str(), name.c_str(), H5P_DEFAULT) > 0)
    H5Adelete_by_name(out.id, object.c_str(), name.c_str(), H5P_DEFAULT);
  const Handle space(H5Screate(H5S_SCALAR), H5Sclose);
  const Handle attribute(H5Acreate_by_name(out.id, object.c_str(), name.c_str(), value.file_type, space.id(),
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose);
  if (!attribute.valid() || H5Awrite(attribute.id(), value.memory_type, value.data) < 0)
    throw last_error(fmt::format("cannot write attribute '{}' of {}", name, object), out.where, remedy);
}

/// Chooses a storage with checksums, so that damaged values are detected: small datasets in their header, others in
/// chunks with Fletcher's checksum. A scalar cannot have chunks, so a longer text has no checksum.
void set_checked_storage(Id creation, Id space, Id file_type, Packing packing) {
  const int rank = H5Sget_simple_extent_ndims(space);
  const auto count = static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space));
  const std::uint64_t bytes = count * H5Tget_size(file_type);
  if (bytes == 0) return;
  if (bytes <= (rank == 0 ? compact_text_bytes : compact_bytes)) {
    H5Pset_layout(creation, H5D_COMPACT);
    return;
  }
  if (rank == 0) return;
  std::vector<hsize_t> chunk(rank);
  H5Sget_simple_extent_dims(space, chunk.data(), nullptr);
  const hsize_t chunks = std::clamp<hsize_t>(bytes / chunk_bytes[static_cast<int>(packing)], 1, chunk[0]);
  chunk[0] = (chunk[0] + chunks - 1) / chunks;
  H5Pset_chunk(creation, rank, chunk.data());
  if (packing != Packing::none) {
    H5Pset_shuffle(creation);
    H5Pset_deflate(creation, deflate_level[static_cast<int>(packing)]);
  }
  H5Pset_fletcher32(creation);
}

/// Creates and writes a dataset. No times are stored, so that equal contents give equal bytes. The last values may
/// reach the disk only when the dataset is closed.
void write_values(const Output& out, const std::string& dataset, const Handle& space, const Values& values) {
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  set_checked_storage(creation.id(), space.id(), values.file_type, out.packing);
  create_groups(out.id, dataset);
  Handle handle(
      H5Dcreate2(out.id, dataset.c_str(), values.file_type, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
      H5Dclose);
  if (!handle.valid() || H5Dwrite(handle.id(), values.memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data) < 0 ||
      handle.reset() < 0)
    throw last_error(fmt::format("cannot write dataset {}", dataset), out.where, remedy);
}

Handle simple_space(const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return Handle(H5Screate_simple(count_of(extent), extent.data(), nullptr), H5Sclose);
}

/// Destination of the bytes of a file in memory when it is closed, up to its size; null: none.
thread_local std::string* closed_image = nullptr;

void* resize_image(void* bytes, std::size_t size, H5FD_file_image_op_t, void*) { return std::realloc(bytes, size); }

herr_t free_image(void* bytes, H5FD_file_image_op_t, void*) {
  if (closed_image != nullptr) std::memcpy(closed_image->data(), bytes, closed_image->size());
  std::free(bytes);
  return 0;
}

}  // namespace

void create_groups(Id file, const std::string& dataset) {
  const Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  for (std::size_t end = dataset.find('/', 1); end != std::string::npos; end = dataset.find('/', end + 1)) {
    const std::string group = dataset.substr(0, end);
    if (H5Lexists(file, group.c_str(), H5P_DEFAULT) > 0) continue;
    const Handle made(H5Gcreate2(file, group.c_str(), H5P_DEFAULT, creation.id(), H5P_DEFAULT), H5Gclose);
  }
}

void write_attribute(const Output& out, const std::string& object, const std::string& name, const std::string& value) {
  const Handle type = text_type(value.size());  // an empty value needs its closing zero
  write_one(out, object, name, {type.id(), type.id(), value.c_str()});
}

void write_attribute(const Output& out, const std::string& object, const std::string& name, double value) {
  write_one(out, object, name, values_of(&value));
}

void write_attribute(const Output& out, const std::string& object, const std::string& name, std::int32_t value) {
  write_one(out, object, name, values_of(&value));
}

void write_dataset(const Output& out, const std::string& dataset, const Shape& shape, const double* values) {
  write_values(out, dataset, simple_space(shape), values_of(values));
}

void write_dataset(const Output& out, const std::string& dataset, const Shape& shape, const std::int32_t* values) {
  write_values(out, dataset, simple_space(shape), values_of(values));
}

void write_texts(const Output& out, const std::string& dataset, const std::vector<std::string>& values) {
  std::size_t size = 1;
  for (const std::string& value : values) size = std::max(size, value.size());
  std::vector<char> buffer(size * values.size() + 1, '\0');
  for (std::size_t i = 0; i < values.size(); ++i)
    std::memcpy(buffer.data() + i * size, values[i].data(), values[i].size());
  const Handle type = text_type(size);
  write_values(out, dataset, simple_space({values.size()}), {type.id(), type.id(), buffer.data()});
}

void write_text(const Output& out, const std::string& dataset, const std::string& value) {
  if (H5Lexists(out.id, dataset.c_str(), H5P_DEFAULT) > 0) H5Ldelete(out.id, dataset.c_str(), H5P_DEFAULT);
  const Handle type = text_type(value.size());
  write_values(out, dataset, Handle(H5Screate(H5S_SCALAR), H5Sclose), {type.id(), type.id(), value.c_str()});
}

Handle create_in_memory(const std::string& where) {
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_fapl_core(access.id(), 1u << 20, false);
  H5FD_file_image_callbacks_t callbacks{};
  callbacks.image_realloc = resize_image;
  callbacks.image_free = free_image;
  H5Pset_file_image_callbacks(access.id(), &callbacks);
  H5Pset_meta_block_size(access.id(), 0);  // no space reserved in advance, which would remain at the end
  H5Pset_small_data_block_size(access.id(), 0);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  // Since format 1.8 headers (names, attributes, small datasets) have checksums. All current programs read them.
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V18, H5F_LIBVER_LATEST);
  H5Pset_obj_track_times(creation.id(), false);
  Handle file(H5Fcreate("memory", H5F_ACC_TRUNC, creation.id(), access.id()), H5Fclose);
  if (!file.valid()) throw last_error("cannot compose the file in memory", where, "check the installation of HDF5");
  return file;
}

std::string file_image(Handle file, const std::string& where) {
  // H5Fget_file_image() would spoil the superblock's checksum, because it clears the mark of the writer afterwards.
  const bool flushed = H5Fflush(file.id(), H5F_SCOPE_GLOBAL) >= 0;
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  std::string image(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  closed_image = &image;
  const bool closed = file.reset() >= 0;
  closed_image = nullptr;
  if (size <= 0 || !flushed || !closed)
    throw last_error("cannot compose the file in memory", where, "check the installation of HDF5");
  return image;
}

}  // namespace tisserand::formats::hdf5
