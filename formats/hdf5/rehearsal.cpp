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

/// Processor time that reading may take.
rlim_t seconds_for(const std::vector<std::string>& paths) {
  rlim_t bytes = 0;
  for (const std::string& path : paths) {
    struct stat file {};
    if (::stat(path.c_str(), &file) == 0) bytes += static_cast<rlim_t>(file.st_size);
  }
  return least_seconds + bytes / bytes_per_second;
}

[[noreturn]] void run_child(const std::vector<std::string>& paths,
                            const std::function<void(const std::string&)>& read) {
  const rlim_t seconds = seconds_for(paths);
  const rlimit time{seconds, seconds}, core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &core);
  const int silent = ::open("/dev/null", O_WRONLY);
  ::dup2(silent, STDOUT_FILENO);
  ::dup2(silent, STDERR_FILENO);
  for (const std::string& path : paths) {
    try {
      read(path);
    } catch (...) {
      // Met again, and told, in the parent.
    }
  }
  ::_exit(0);
}

}  // namespace

bool survives(const std::vector<std::string>& paths, const std::function<void(const std::string&)>& read) {
  if (paths.empty()) return true;
  silence();
  const pid_t child = ::fork();
  if (child < 0) return true;  // no process to spare: the caller reads without rehearsal
  if (child == 0) run_child(paths, read);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return !WIFSIGNALED(status) && !(WIFEXITED(status) && WEXITSTATUS(status) != 0);
}

void rehearse(const std::string& path, const std::function<void()>& read) {
  if (!survives({path}, [&read](const std::string&) { read(); }))
    throw Error("is an HDF5 file, but so damaged that HDF5 cannot read it", path, "write or copy the file again");
}

}  // namespace tisserand::formats::hdf5
