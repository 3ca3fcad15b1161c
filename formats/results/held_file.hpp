// SPDX-License-Identifier: GPL-3.0-or-later
// The lock on the results of a running program, which protects them from other writers of the same name.
#pragma once

#include <string>

namespace tisserand::formats {

/// File that this program holds until its end, however it ends. The hold is an open-file-description lock of the kernel
/// on a byte far beyond the data. The lock cannot become stale, and affects neither readers nor HDF5's own locks. On
/// disks without locks no file is held or refused.
class HeldFile {
 public:
  HeldFile() = default;
  HeldFile(HeldFile&& other) noexcept;
  HeldFile& operator=(HeldFile&& other) noexcept;
  ~HeldFile();

  /// Renames the complete file `from` of this program to `to`, and holds it. Throws Error if another program holds the
  /// file `to`.
  static HeldFile publish(const std::string& from, const std::string& to);
  /// Throws Error if another program holds the file `path`. `told`: name of the file in the message.
  static void require_unheld(const std::string& path, const std::string& reported);

  /// Waits until the data written to the file are on the disk.
  void synchronise() const;

 private:
  explicit HeldFile(int file) : file_(file) {}
  int file_ = -1;
};

}  // namespace tisserand::formats
