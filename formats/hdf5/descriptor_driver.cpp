// SPDX-License-Identifier: GPL-3.0-or-later
// A driver of HDF5's virtual file layer that reads by pread() and writes into memory.
#include "formats/hdf5/descriptor_driver.hpp"

#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace tisserand::formats::hdf5 {
namespace {

struct OpenedFile {
  H5FD_t head{};  ///< HDF5's base part; must be first
  int descriptor = -1;
  haddr_t end_of_addresses = 0, end_of_file = 0;
  std::vector<std::pair<haddr_t, std::string>> written;  ///< written pieces, later ones override earlier ones
};

/// File that the next H5Fopen() opens.
OpenedFile next_file;

OpenedFile& opened(H5FD_t* file) { return *reinterpret_cast<OpenedFile*>(file); }
const OpenedFile& opened(const H5FD_t* file) { return *reinterpret_cast<const OpenedFile*>(file); }

H5FD_t* open_driver(const char*, unsigned, hid_t, haddr_t) { return &(new OpenedFile(next_file))->head; }

herr_t close_driver(H5FD_t* file) {
  delete &opened(file);
  return 0;
}

/// Reports the features of HDF5's driver of ordinary files.
herr_t query_driver(const H5FD_t*, unsigned long* flags) {
  if (flags != nullptr)
    *flags = H5FD_FEAT_AGGREGATE_METADATA | H5FD_FEAT_ACCUMULATE_METADATA | H5FD_FEAT_DATA_SIEVE |
             H5FD_FEAT_AGGREGATE_SMALLDATA | H5FD_FEAT_SUPPORTS_SWMR_IO | H5FD_FEAT_DEFAULT_VFD_COMPATIBLE;
  return 0;
}

haddr_t end_of_addresses(const H5FD_t* file, H5FD_mem_t) { return opened(file).end_of_addresses; }
haddr_t end_of_file(const H5FD_t* file, H5FD_mem_t) { return opened(file).end_of_file; }

herr_t set_end_of_addresses(H5FD_t* file, H5FD_mem_t, haddr_t address) {
  opened(file).end_of_addresses = address;
  return 0;
}

/// Reads bytes. Beyond the end of the file they are zero, as in HDF5's own driver.
herr_t read_driver(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, void* buffer) {
  char* to = static_cast<char*>(buffer);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t more = ::pread(opened(file).descriptor, to + done, size - done, static_cast<off_t>(address + done));
    if (more < 0 && errno == EINTR) continue;
    if (more < 0) return -1;
    if (more == 0) break;
    done += static_cast<std::size_t>(more);
  }
  std::memset(to + done, 0, size - done);
  for (const auto& [begin, bytes] : opened(file).written) {
    const haddr_t first = std::max(begin, address), last = std::min(begin + bytes.size(), address + size);
    if (first < last) std::memcpy(to + (first - address), bytes.data() + (first - begin), last - first);
  }
  return 0;
}

herr_t write_driver(H5FD_t* file, H5FD_mem_t, hid_t, haddr_t address, std::size_t size, const void* buffer) {
  opened(file).written.emplace_back(address, std::string(static_cast<const char*>(buffer), size));
  return 0;
}

// HDF5 checks the mark of a writer only if the driver can lock files.
herr_t lock_driver(H5FD_t*, hbool_t) { return 0; }
herr_t unlock_driver(H5FD_t*) { return 0; }

H5FD_class_t driver_class() {
  H5FD_class_t driver{};
  driver.name = "descriptor";
  driver.maxaddr = (haddr_t{1} << 62) - 1;
  driver.fc_degree = H5F_CLOSE_STRONG;
  driver.open = open_driver;
  driver.close = close_driver;
  driver.query = query_driver;
  driver.get_eoa = end_of_addresses;
  driver.set_eoa = set_end_of_addresses;
  driver.get_eof = end_of_file;
  driver.read = read_driver;
  driver.write = write_driver;
  driver.lock = lock_driver;
  driver.unlock = unlock_driver;
  const H5FD_mem_t map[] = H5FD_FLMAP_DICHOTOMY;
  std::copy(std::begin(map), std::end(map), std::begin(driver.fl_map));
  return driver;
}

}  // namespace

Handle access_through(int descriptor, std::uint64_t size) {
  static const H5FD_class_t driver = driver_class();
  static const hid_t id = H5FDregister(&driver);
  next_file.descriptor = descriptor;
  next_file.end_of_file = size;
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_driver(access.id(), id, nullptr);
  H5Pset_file_locking(access.id(), false, true);
  H5Pset_fclose_degree(access.id(), H5F_CLOSE_STRONG);
  return access;
}

}  // namespace tisserand::formats::hdf5
