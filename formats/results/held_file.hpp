// The lock on the results of a running program, between its writer and others that would take the same name.
#pragma once

#include <string>

namespace tisserand::formats {

/// A file that this program holds until its end, however it ends: an open-file-description lock of the kernel on a byte
/// far behind the data. It cannot go stale, and nobody who reads, HDF5's own locks included, meets it. On disks without
/// locks nothing is held, and nothing refused.
class HeldFile {
 public:
  HeldFile() = default;
  HeldFile(HeldFile&& other) noexcept;
  HeldFile& operator=(HeldFile&& other) noexcept;
  ~HeldFile();

  /// Gives `from`, a complete file of this program, the name `to` and holds it. Throws Error if another program holds
  /// the file of that name.
  static HeldFile publish(const std::string& from, const std::string& to);
  /// Throws Error if there is such a file and another program holds it. `told`: its name in the message.
  static void require_unheld(const std::string& path, const std::string& told);

  /// What was written to the file is on the disk when this returns.
  void synchronise() const;

 private:
  explicit HeldFile(int file) : file_(file) {}
  int file_ = -1;
};

}  // namespace tisserand::formats
