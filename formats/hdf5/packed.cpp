// SPDX-License-Identifier: GPL-3.0-or-later
// Chunks of rows with shuffle, deflate and Fletcher's checksum over the compressed bytes.
#include "formats/hdf5/packed.hpp"

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>

#include "common/math/count.hpp"
#include "common/text.hpp"

namespace tisserand::formats::hdf5 {
namespace {

constexpr const char* packed_remedy = "free some space, or choose another place for the file";
constexpr unsigned packed_deflate_level = 1;  // higher levels take three times as long and save 1 %

/// Selects rows [first, first + count) of `space` and returns the number of their values.
hsize_t select_rows(Id space, std::uint64_t first, std::uint64_t count) {
  std::vector<hsize_t> start(H5S_MAX_RANK, 0), extent(H5S_MAX_RANK, 0);
  const int rank = H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  TISSERAND_ENSURE(rank > 0 && first + count <= extent[0], "rows {} + {} of {}", first, count, extent[0]);
  start[0] = first;
  extent[0] = count;
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, extent.data(), nullptr);
  return static_cast<hsize_t>(H5Sget_select_npoints(space));
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), temporary_(temporary_beside(path)) {
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose), creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  // Since format 1.10 the index of the chunks has a checksum too. Before, a flipped bit there could make chunks vanish.
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_LATEST);
  H5Pset_file_locking(access.id(), false, true);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  H5Pset_obj_track_times(creation.id(), false);
  // Exclusive creation does not follow a link that somebody has put in place of the temporary file.
  file_ = Handle(H5Fcreate(temporary_.c_str(), H5F_ACC_EXCL, creation.id(), access.id()), H5Fclose);
  if (file_.valid()) return;
  const Error error = last_error("cannot create the file", path, packed_remedy);
  ::unlink(temporary_.c_str());
  throw error;
}

OutputFile::~OutputFile() {
  if (!file_.valid()) return;
  file_.reset();
  ::unlink(temporary_.c_str());
}

std::string OutputFile::stage() {
  if (file_.reset() < 0) {
    ::unlink(temporary_.c_str());
    throw last_error("cannot be written completely", path_, packed_remedy);
  }
  return temporary_;
}

void OutputFile::publish() { publish_file(stage(), path_); }

Handle create_packed(const Output& out, const std::string& dataset, const Shape& shape, std::uint64_t chunk) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  const Handle space(H5Screate_simple(count_of(extent), extent.data(), nullptr), H5Sclose);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  const bool empty = std::find(shape.begin(), shape.end(), 0u) != shape.end();
  if (!empty) {
    std::vector<hsize_t> rows = extent;
    rows[0] = std::clamp<hsize_t>(chunk, 1, extent[0]);
    H5Pset_chunk(creation.id(), count_of(rows), rows.data());
    H5Pset_shuffle(creation.id());
    H5Pset_deflate(creation.id(), packed_deflate_level);
    H5Pset_fletcher32(creation.id());
  }
  create_groups(out.id, dataset);
  Handle handle(
      H5Dcreate2(out.id, dataset.c_str(), H5T_IEEE_F32LE, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
      H5Dclose);
  if (!handle.valid()) throw last_error(fmt::format("cannot write dataset {}", dataset), out.where, packed_remedy);
  return handle;
}

void write_packed_rows(const Handle& dataset, std::uint64_t first, std::uint64_t count, const float* values,
                       const std::string& where) {
  const Handle space(H5Dget_space(dataset.id()), H5Sclose);
  const hsize_t total = select_rows(space.id(), first, count);
  const Handle memory(H5Screate_simple(1, &total, nullptr), H5Sclose);
  if (H5Dwrite(dataset.id(), H5T_NATIVE_FLOAT, memory.id(), space.id(), H5P_DEFAULT, values) < 0)
    throw last_error("cannot be written", where, packed_remedy);
}

void close_packed(Handle& handle, const std::string& dataset, const std::string& where) {
  if (handle.reset() < 0) throw last_error(fmt::format("cannot write dataset {}", dataset), where, packed_remedy);
}

}  // namespace tisserand::formats::hdf5
