// Reading untrusted files in a child process first, because HDF5 can crash on damaged ones.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

namespace {

constexpr rlim_t least_seconds = 2;
constexpr rlim_t bytes_per_second = 20u << 20;  // a tenth of what HDF5 reads and unpacks in a second

[[noreturn]] void run_child(const std::string& path, const std::function<void()>& read) {
  struct stat file {};
  const bool known = ::stat(path.c_str(), &file) == 0;
  const rlim_t seconds = least_seconds + (known ? static_cast<rlim_t>(file.st_size) / bytes_per_second : 0);
  const rlimit time{seconds, seconds}, core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &core);
  const int silent = ::open("/dev/null", O_WRONLY);
  ::dup2(silent, STDOUT_FILENO);
  ::dup2(silent, STDERR_FILENO);
  try {
    read();
  } catch (...) {
    // Met again, and told, in the parent.
  }
  ::_exit(0);
}

}  // namespace

void rehearse(const std::string& path, const std::function<void()>& read) {
  silence();
  const pid_t child = ::fork();
  if (child < 0) return;  // no process to spare: the caller reads without rehearsal
  if (child == 0) run_child(path, read);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFSIGNALED(status) || (WIFEXITED(status) && WEXITSTATUS(status) != 0))
    throw Error("is an HDF5 file, but so damaged that HDF5 cannot read it", path, "write or copy the file again");
}

}  // namespace tisserand::formats::hdf5
