// SPDX-License-Identifier: GPL-3.0-or-later
// Writes the rows of a running analysis to *.results.h5 so that a killed run leaves a readable file.
//
// The file appears as <path>.part when its head is complete. HDF5's single-writer mode then keeps it consistent on
// disk. Rows wait in memory that is allocated at the start. Outside this mode a kill between two writes can damage the
// file, so the report is written to a copy.
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <complex>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <random>
#include <utility>

#include "common/math/count.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/results/blocks.hpp"
#include "formats/results/held_file.hpp"
#include "formats/results/layout_file.hpp"
#include "formats/results/simulated_scene_file.hpp"

namespace tisserand::formats {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds flush_interval{1000};
constexpr std::uintmax_t most_copied = 64 << 20;  ///< bytes; copying takes some hundredths of a second
constexpr std::size_t buffer_bytes = 4u << 20;    // all waiting rows together
constexpr std::size_t chunk_bytes = 64u << 10;    // one chunk on disk, unless one row is larger
constexpr std::size_t max_chunk_rows = 256;
constexpr std::uint64_t disk_reserve = 256u << 10;  // kept free for the report and for closing the file

std::size_t chunk_rows(const Block& block) {
  return std::clamp<std::size_t>(chunk_bytes / (block.width() * sizeof(double)), 1, max_chunk_rows);
}

/// Creates an empty dataset 0 x shape that can grow in its first dimension.
void create_growing(const hdf5::Output& out, const Block& block) {
  std::vector<hsize_t> extent{0}, limit{H5S_UNLIMITED}, chunk{chunk_rows(block)};
  for (const std::uint64_t e : block.shape) {
    extent.push_back(e);
    limit.push_back(e);
    chunk.push_back(e);
  }
  const int rank = count_of(extent);
  const hdf5::Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  const hdf5::Handle space(H5Screate_simple(rank, extent.data(), limit.data()), H5Sclose);
  H5Pset_obj_track_times(creation.id(), false);
  H5Pset_chunk(creation.id(), rank, chunk.data());
  H5Pset_fletcher32(creation.id());
  H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER);
  hdf5::create_groups(out.id, block.dataset);
  const hdf5::Handle dataset(
      H5Dcreate2(out.id, block.dataset.c_str(), H5T_IEEE_F64LE, space.id(), H5P_DEFAULT, creation.id(), H5P_DEFAULT),
      H5Dclose);
  if (!dataset.valid())
    throw hdf5::last_error("cannot create dataset " + block.dataset, out.where,
                           "name fewer nodes or choose fewer channels");
  hdf5::write_attribute(out, block.dataset, "unit", block.unit);
}

void check_layout(const ResultsLayout& l) {
  const std::size_t n = l.superelements.size();
  TISSERAND_ENSURE(l.modes_offset.size() == (n == 0 && l.modes_offset.empty() ? 0 : n + 1), "{} modes_offset of {}",
                   l.modes_offset.size(), n);
  TISSERAND_ENSURE(l.boundary_offset.size() == (n == 0 && l.boundary_offset.empty() ? 0 : n + 1),
                   "{} boundary_offset of {}", l.boundary_offset.size(), n);
  const std::size_t boundary = l.boundary_offset.empty() ? 0 : static_cast<std::size_t>(l.boundary_offset.back());
  TISSERAND_ENSURE(l.boundary_nodes.empty() || l.boundary_nodes.size() == boundary, "{} boundary_nodes of {}",
                   l.boundary_nodes.size(), boundary);
}

/// Access with the format of HDF5 1.10, which allows appending with concurrent readers. No locks.
hdf5::Handle access_properties() {
  hdf5::Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access.id(), false, true);
  H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_LATEST);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  return access;
}

/// Creates a file with all data that do not change during the run.
void create_head(const std::string& path, const ResultsLayout& layout, const std::vector<Block>& blocks,
                 const std::string& run, const std::string& where) {
  const hdf5::Handle access = access_properties();  // kept open: closing it would lose the cause of a failure
  // Exclusive creation does not follow a link that somebody has put in place of the temporary file.
  hdf5::Handle file(H5Fcreate(path.c_str(), H5F_ACC_EXCL, H5P_DEFAULT, access.id()), H5Fclose);
  if (!file.valid()) throw hdf5::last_error("cannot create the file", where, "choose another folder or file name");
  const hdf5::Output out{file.id(), where};
  hdf5::write_attribute(out, "/", "format", "tisserand-results");
  hdf5::write_attribute(out, "/", "version", "1.13");
  hdf5::write_attribute(out, "/", "run", run);
  hdf5::write_attribute(out, "/", "scene", layout.scene);
  hdf5::write_attribute(out, "/", "producer", layout.producer);
  hdf5::write_units(out, layout.units);
  hdf5::write_attribute(out, "/", "completed", 0);
  hdf5::write_attribute(out, "/", "reason", "");
  for (const Block& block : blocks) create_growing(out, block);
  write_names(out, layout, blocks);
  write_simulated(out, layout.simulated);
  if (file.reset() < 0) throw hdf5::last_error("cannot write the file", where, "choose another folder or file name");
}

/// Creates the file of create_head() under its name, complete or not at all, and holds it.
HeldFile publish_head(const std::string& part, const ResultsLayout& layout, const std::vector<Block>& blocks,
                      const std::string& run) {
  const std::string temporary = temporary_beside(part);
  try {
    create_head(temporary, layout, blocks, run, part);
    return HeldFile::publish(temporary, part);
  } catch (...) {  // also short memory
    ::unlink(temporary.c_str());
    throw;
  }
}

/// Identity of a run: 128 random bits.
std::string name_of_run() {
  std::random_device random;
  std::string name;
  for (int k = 0; k < 4; ++k) name += fmt::format("{:08x}", random());
  return name;
}

hdf5::Handle open_for_writing(const std::string& path, unsigned mode) {
  const hdf5::Handle access = access_properties();
  hdf5::Handle file(H5Fopen(path.c_str(), H5F_ACC_RDWR | mode, access.id()), H5Fclose);
  if (!file.valid())
    throw hdf5::last_error("cannot open the file for writing", path, "choose another folder or file name");
  return file;
}

/// Writes /modes: eigenvalues, frequencies, damping ratios and shapes, modes x nodes x 3 x [real, imaginary].
void write_modes(const hdf5::Output& out, const ModesTable& table) {
  const auto modes = static_cast<std::uint64_t>(table.eigenvalue.size());
  const auto nodes = static_cast<std::uint64_t>(table.translation.rows() / 3);
  const auto complex = [&](const char* name, hdf5::Shape shape, const std::complex<double>* values) {
    shape.push_back(2);
    hdf5::write_dataset(out, std::string("/modes/") + name, shape, reinterpret_cast<const double*>(values));
  };
  complex("eigenvalue", {modes}, table.eigenvalue.data());
  hdf5::write_dataset(out, "/modes/frequency", table.frequency);
  hdf5::write_dataset(out, "/modes/damping_ratio", table.damping_ratio);
  complex("translation", {modes, nodes, 3}, table.translation.data());
  complex("rotation", {modes, nodes, 3}, table.rotation.data());
  for (const auto& [name, rows] : {std::pair("y", &table.y), std::pair("w", &table.w)})
    if (rows->rows() > 0) complex(name, {modes, static_cast<std::uint64_t>(rows->rows())}, rows->data());
}

}  // namespace

struct ResultsWriter::Impl {
  /// Block with its open dataset and its waiting rows.
  struct Column {
    Block block;
    hdf5::Handle dataset;
    std::unique_ptr<double[]> waiting;  ///< capacity x width, allocated once; not zeroed, so short runs touch few pages
  };

  std::string path;
  std::string part;
  std::string run = name_of_run();
  HeldFile held;
  hdf5::Handle file;
  std::vector<Column> columns;
  std::size_t capacity = 0;   ///< largest number of waiting rows
  std::size_t waiting = 0;    ///< number of waiting rows
  std::uint64_t written = 0;  ///< number of rows in the file
  std::uint64_t bytes_per_row = 0;
  Clock::time_point last_flush = Clock::now();
  bool broken = false;  ///< a write failed: the file stays as the last good write left it
  bool finished = false;
  bool published = false;  ///< `part` belongs to this writer

  std::optional<ModesTable> modes;
  ResultsLayout layout;
  std::string shortage;  ///< reason for dropped rows, or empty

  void create();
  void begin_with(const ResultsBeginning& beginning);
  std::uint64_t bytes_needed(std::size_t rows) const;
  std::size_t rows_that_fit();
  void write_rows(std::size_t rows);
  void write_waiting();
  void flush();
  void close();
  std::string write_end_apart(int completed, const std::string& reason, const std::string& report_json) const;
  void write_end(const std::string& target, int completed, const std::string& reason,
                 const std::string& report_json) const;
  void rename_to_final(const std::string& last) const;
};

/// Bytes that the next `rows` rows may need, with new chunks and the reserve for closing the file.
std::uint64_t ResultsWriter::Impl::bytes_needed(std::size_t rows) const {
  std::uint64_t needed = disk_reserve + rows * bytes_per_row;
  for (const Column& column : columns) {
    const std::size_t chunk = chunk_rows(column.block);
    const bool opens_chunk = written % chunk == 0 || written % chunk + rows > chunk;
    if (opens_chunk) needed += chunk * column.block.width() * sizeof(double);
  }
  return needed;
}

/// Number of waiting rows for which the disk has space. HDF5 cannot recover from a full disk, so check before writing.
std::size_t ResultsWriter::Impl::rows_that_fit() {
  struct statvfs disk {};
  struct stat status {};
  if (::statvfs(part.c_str(), &disk) != 0 || ::stat(part.c_str(), &status) != 0) return waiting;
  const std::uint64_t free = static_cast<std::uint64_t>(disk.f_bavail) * disk.f_frsize;
  struct rlimit limit {};
  const bool limited = ::getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  const auto size = static_cast<std::uint64_t>(status.st_size);
  const std::uint64_t growth = !limited ? free : limit.rlim_cur > size ? limit.rlim_cur - size : 0;
  const std::uint64_t needed = bytes_needed(waiting);
  if (needed <= std::min(free, growth)) return waiting;
  shortage = growth < free
                 ? fmt::format("the file may not grow beyond {} kB (`ulimit -f`), but the next {} rows need {} kB more",
                               limit.rlim_cur / 1024, waiting, needed / 1024)
                 : fmt::format("the disk is full: {} kB are free, but the next {} rows need {} kB", free / 1024,
                               waiting, needed / 1024);
  std::size_t rows = waiting;
  while (rows > 0 && bytes_needed(rows) > std::min(free, growth)) rows /= 2;
  return rows;
}

void ResultsWriter::Impl::write_waiting() {
  if (waiting == 0) return;
  const std::size_t rows = rows_that_fit();
  write_rows(rows);
  waiting = 0;
  if (!shortage.empty()) throw Error(shortage, part, "free some space, write to another disk, or store fewer channels");
}

void ResultsWriter::Impl::write_rows(std::size_t rows) {
  if (rows == 0) return;
  for (Column& column : columns) {
    std::vector<hsize_t> extent{written + rows}, start{written}, count{rows};
    for (const std::uint64_t e : column.block.shape) {
      extent.push_back(e);
      start.push_back(0);
      count.push_back(e);
    }
    const hsize_t total = rows * column.block.width();
    bool ok = H5Dset_extent(column.dataset.id(), extent.data()) >= 0;
    const hdf5::Handle space(H5Dget_space(column.dataset.id()), H5Sclose),
        memory(H5Screate_simple(1, &total, nullptr), H5Sclose);
    ok = ok && H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr) >= 0;
    ok = ok && H5Dwrite(column.dataset.id(), H5T_NATIVE_DOUBLE, memory.id(), space.id(), H5P_DEFAULT,
                        column.waiting.get()) >= 0;
    if (!ok) {
      broken = true;
      throw hdf5::last_error(
          fmt::format("cannot write rows {} to {} of {}", written, written + rows, column.block.dataset), part,
          "choose another folder for the results");
    }
  }
  written += rows;
}

void ResultsWriter::Impl::flush() {
  write_waiting();
  if (H5Fflush(file.id(), H5F_SCOPE_GLOBAL) < 0) {
    broken = true;
    throw hdf5::last_error("cannot write results", part, "choose another folder for the results");
  }
  last_flush = Clock::now();
}

/// Closes the file, except after a failed write, when closing by HDF5 would damage what the last good write left.
void ResultsWriter::Impl::close() {
  if (broken) {
    for (Column& column : columns) column.dataset.abandon();
    file.abandon();
    return;
  }
  for (Column& column : columns)
    if (column.dataset.reset() < 0) broken = true;
  if (file.reset() < 0) broken = true;
}

/// Writes the report into a copy of the closed file and returns its name, since a kill during write_end() can damage a
/// file. It writes into the file itself, with this risk for some milliseconds, in three cases: the file is large, the
/// disk has no space, or a reader in this process has the file open, which marks a copy as still running.
std::string ResultsWriter::Impl::write_end_apart(int completed, const std::string& reason,
                                                 const std::string& report_json) const {
  const std::string copy = part + ".end";
  std::error_code failure;
  const bool is_small = std::filesystem::file_size(part, failure) <= most_copied && !failure;
  if (is_small) std::filesystem::remove(copy, failure);  // left by a killed run; a link is not followed
  if (is_small && std::filesystem::copy_file(part, copy, failure)) {
    try {
      write_end(copy, completed, reason, report_json);
      return copy;
    } catch (const std::exception&) {
      // If the copy was not the cause, the write below fails and reports it.
    }
  }
  if (is_small) std::filesystem::remove(copy, failure);
  write_end(part, completed, reason, report_json);
  return part;
}

void ResultsWriter::Impl::write_end(const std::string& target, int completed, const std::string& reason,
                                    const std::string& report_json) const {
  hdf5::Handle end = open_for_writing(target, 0);
  const hdf5::Output out{end.id(), target};
  hdf5::write_text(out, "/report", report_json);
  if (modes) write_modes(out, *modes);
  if (modes && H5Lexists(end.id(), "/nodes", H5P_DEFAULT) <= 0) write_node_names(out, layout);
  hdf5::write_attribute(out, "/", "reason", reason.substr(0, 4096));
  hdf5::write_attribute(out, "/", "completed", completed);
  if (end.reset() < 0)
    throw hdf5::last_error("cannot write the run report", target, "choose another folder for the results");
}

/// Renames `last`, the part or a copy that replaces it, to the final name.
void ResultsWriter::Impl::rename_to_final(const std::string& last) const {
  if (::rename(last.c_str(), path.c_str()) == 0) {
    if (last != part) ::unlink(part.c_str());
    return;
  }
  const int number = errno;
  throw Error(fmt::format("cannot rename the results to their final name: {}", std::strerror(number)), path,
              fmt::format("the complete results are in {}", last));
}

void ResultsWriter::Impl::create() {
  const std::vector<Block> blocks = chosen_blocks(layout, layout.scene);
  held = publish_head(part, layout, blocks, run);
  published = true;
  file = open_for_writing(part, H5F_ACC_SWMR_WRITE);
  std::size_t width = 0;
  for (const Block& block : blocks) width += block.width();
  bytes_per_row = width * sizeof(double);
  capacity = std::clamp<std::size_t>(buffer_bytes / bytes_per_row, 1, 4096);
  for (const Block& block : blocks) {
    hdf5::Handle dataset(H5Dopen2(file.id(), block.dataset.c_str(), H5P_DEFAULT), H5Dclose);
    if (!dataset.valid())
      throw hdf5::last_error("cannot open dataset " + block.dataset, part, "choose another folder for the results");
    columns.push_back({block, std::move(dataset), std::make_unique_for_overwrite<double[]>(capacity * block.width())});
  }
}

/// Copies the older rows in pieces that fit the waiting memory.
void ResultsWriter::Impl::begin_with(const ResultsBeginning& beginning) {
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const ResultsReader old(beginning.file);
  std::vector<std::string> names;
  std::size_t same = 0;
  std::vector<Channel> known = old.channels();
  std::erase_if(known, [](const Channel& channel) { return !channel.same_as.empty(); });
  for (const Column& column : columns)
    for (std::size_t c = 0; c < column.block.width(); ++c) {
      const std::string& last = column.block.columns[c];
      names.push_back(column.block.dataset.substr(1) + (last.empty() ? "" : "/" + last));
      const std::size_t at = names.size() - 1;
      if (at < known.size() && known[at].name == names[at] && known[at].unit == column.block.units[c]) ++same;
    }
  if (same != names.size() || same != known.size())
    throw Error("has channels or units that differ from those of this run", old.path(),
                "use the `output.channels` and the units of that run, or remove --append");
  for (std::size_t k = 0; k < std::min(layout.stiffened.size(), old.layout().stiffened.size()); ++k)
    if (layout.stiffened[k] != old.layout().stiffened[k])
      throw Error(fmt::format("body {}: it {} geometric stiffening in this file, and this run would store the opposite",
                              layout.superelements[k], old.layout().stiffened[k] != 0 ? "has" : "has no"),
                  old.path(), "use the `effects` and `second_order` of that run, or remove --append");
  if (old.rows() < beginning.rows)
    throw Error(fmt::format("holds {} instants, {} were expected", old.rows(), beginning.rows), old.path(),
                "continue from an instant that this file contains");
  while (written < beginning.rows) {
    const std::size_t count = std::min<std::size_t>(capacity, beginning.rows - written);
    const Eigen::MatrixXd rows = old.read_rows(names, written, count);
    Eigen::Index at = 0;
    for (Column& column : columns) {
      const auto width = static_cast<Eigen::Index>(column.block.width());
      Eigen::Map<RowMajor>(column.waiting.get(), rows.rows(), width) = rows.middleCols(at, width);
      at += width;
    }
    waiting = count;
    write_waiting();
  }
  flush();
}

void require_unheld_results(const std::string& path) { HeldFile::require_unheld(path + ".part", path); }

ResultsWriter::ResultsWriter(const std::string& path, const ResultsLayout& layout)
    : ResultsWriter(path, layout, ResultsBeginning{}) {}

ResultsWriter::ResultsWriter(const std::string& path, const ResultsLayout& layout, const ResultsBeginning& beginning)
    : impl_(std::make_unique<Impl>()) {
  check_layout(layout);
  hdf5::silence();
  impl_->path = path;
  impl_->part = path + ".part";
  impl_->layout = layout;
  if (path.empty()) return;
  ResultsBeginning old = beginning;
  if (old.file == impl_->part) {
    HeldFile::require_unheld(impl_->part, path);
    impl_->rename_to_final(impl_->part);
    old.file = path;
  }
  try {
    impl_->create();
    if (!old.file.empty()) impl_->begin_with(old);
  } catch (...) {  // its rows also exist in the older file
    if (impl_->published) ::unlink(impl_->part.c_str());
    throw;
  }
}

ResultsWriter::~ResultsWriter() {
  if (impl_->finished) return;
  try {
    finish(false, "the run ended before it was complete", "{}");
  } catch (const std::exception&) {
    // No one can receive the error. Flushed rows stay readable under the .part name.
  }
}

void ResultsWriter::append(const ResultsRow& row) {
  TISSERAND_ENSURE(!impl_->finished, "append() after finish() of {}", impl_->path);
  if (impl_->path.empty()) {
    ++impl_->written;
    return;
  }
  if (impl_->broken) throw Error("an earlier write has failed", impl_->part, "choose another folder for the results");
  if (impl_->waiting == impl_->capacity) impl_->flush();
  for (Impl::Column& column : impl_->columns) {
    const std::size_t width = column.block.width();
    std::copy_n(column.block.values(row), width,
                column.waiting.get() + static_cast<std::ptrdiff_t>(impl_->waiting * width));
  }
  ++impl_->waiting;
  if (Clock::now() - impl_->last_flush >= flush_interval) impl_->flush();
}

void ResultsWriter::flush() {
  if (impl_->path.empty()) return;
  if (impl_->broken) throw Error("an earlier write has failed", impl_->part, "choose another folder for the results");
  impl_->flush();
  impl_->held.synchronise();
}

std::size_t ResultsWriter::rows() const { return impl_->written + impl_->waiting; }
const std::string& ResultsWriter::run() const { return impl_->run; }

void ResultsWriter::set_modes(ModesTable modes) { impl_->modes = std::move(modes); }

void ResultsWriter::discard() {
  TISSERAND_ENSURE(!impl_->finished, "discard() after finish() of {}", impl_->path);
  impl_->finished = true;
  if (impl_->path.empty()) return;
  impl_->close();
  ::unlink(impl_->part.c_str());
}

void ResultsWriter::finish(bool completed, const std::string& reason, const std::string& report_json) {
  TISSERAND_ENSURE(!impl_->finished, "finish() twice of {}", impl_->path);
  constexpr const char* without_memory = "out of memory at the end of the run";
  impl_->finished = true;
  if (impl_->path.empty()) return;
  std::string problem = impl_->shortage;
  try {
    if (!impl_->broken) impl_->flush();
  } catch (const Error& error) {
    problem = error.what();
  } catch (const std::bad_alloc&) {
    problem = without_memory;
  }
  impl_->close();
  if (problem.empty() && impl_->broken) problem = hdf5::last_error("some rows could not be written", "", "").message();
  const std::string reported = reason.empty() || problem.empty() ? reason + problem : reason + "; " + problem;
  std::string last = impl_->part;
  try {
    if (!impl_->broken) last = impl_->write_end_apart(completed && problem.empty() ? 1 : 0, reported, report_json);
  } catch (const Error& error) {
    if (problem.empty()) problem = error.what();
  } catch (const std::bad_alloc&) {
    if (problem.empty()) problem = without_memory;
  }
  impl_->rename_to_final(last);
  if (completed && !problem.empty()) throw Error(problem, "", "the results until then are in " + impl_->path);
}

}  // namespace tisserand::formats
