// SPDX-License-Identifier: GPL-3.0-or-later
// Locks results that are being written.
#include "formats/results/held_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::formats {
namespace {

constexpr off_t locked_byte = off_t{1} << 62;

enum class Hold { mine, of_another, impossible };

Hold hold(int file) {
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = locked_byte;
  lock.l_len = 1;
  if (::fcntl(file, F_OFD_SETLK, &lock) == 0) return Hold::mine;
  return errno == EAGAIN || errno == EACCES ? Hold::of_another : Hold::impossible;
}

[[noreturn]] void refuse(const std::string& path) {
  throw Error("another program is writing these results now", path,
              "wait until it ends, stop it, or choose another name with -o; the stored results can be read meanwhile");
}

[[noreturn]] void fail_to_publish(const std::string& path, int number) {
  throw Error(fmt::format("cannot write the file: {}", std::strerror(number)), path, remedy_of_errno(number));
}

/// Opens and locks the file `path`. -1 if it does not exist or cannot be opened for writing.
int hold_present(const std::string& path) {
  for (;;) {
    const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK);
    if (file < 0) return -1;
    const Hold outcome = hold(file);
    struct stat opened {
    }, present{};
    const bool same = ::fstat(file, &opened) == 0 && ::stat(path.c_str(), &present) == 0 &&
                      opened.st_ino == present.st_ino && opened.st_dev == present.st_dev;
    if (outcome != Hold::of_another && same) return file;
    ::close(file);
    if (same) refuse(path);
  }
}

}  // namespace

HeldFile::HeldFile(HeldFile&& other) noexcept : file_(other.file_) { other.file_ = -1; }

HeldFile& HeldFile::operator=(HeldFile&& other) noexcept {
  std::swap(file_, other.file_);
  return *this;
}

HeldFile::~HeldFile() {
  if (file_ >= 0) ::close(file_);
}

HeldFile HeldFile::publish(const std::string& from, const std::string& to) {
  HeldFile made(::open(from.c_str(), O_RDWR | O_CLOEXEC));
  if (made.file_ < 0 || ::fsync(made.file_) != 0) fail_to_publish(to, errno);
  static_cast<void>(hold(made.file_));  // no other program knows this name yet
  for (;;) {
    // If two programs start at the same time, one creates the name and the other finds it locked.
    if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0) return made;
    if (errno == EEXIST) {
      const HeldFile older(hold_present(to));
      if (older.file_ < 0 && ::access(to.c_str(), F_OK) != 0) continue;  // removed meanwhile
      if (::rename(from.c_str(), to.c_str()) == 0) return made;
    } else if (errno == EINVAL || errno == ENOSYS) {  // the disk does not support it
      if (::rename(from.c_str(), to.c_str()) == 0) return made;
    }
    fail_to_publish(to, errno);
  }
}

void HeldFile::require_unheld(const std::string& path, const std::string& reported) {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (file < 0) return;
  struct flock lock {};
  lock.l_type = F_WRLCK;
  lock.l_whence = SEEK_SET;
  lock.l_start = locked_byte;
  lock.l_len = 1;
  const bool held = ::fcntl(file, F_OFD_GETLK, &lock) == 0 && lock.l_type != F_UNLCK;
  ::close(file);
  if (held) refuse(reported);
}

void HeldFile::synchronise() const {
  if (file_ >= 0) ::fsync(file_);
}

}  // namespace tisserand::formats
