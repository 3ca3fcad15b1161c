// Reading untrusted files in a child process first, because HDF5 can crash on damaged ones.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdint>

#include "formats/hdf5/file.hpp"

namespace tisserand::formats::hdf5 {

namespace {

constexpr unsigned least_processor_seconds = 2, least_wall_seconds = 30;
constexpr std::uint64_t bytes_per_processor_second = 20u << 20;  // a tenth of what HDF5 reads and unpacks in a second
constexpr std::uint64_t bytes_per_wall_second = 1u << 20;        // a slow disk at the other end of a network

ReadingLimits limits_for(const std::vector<std::string>& paths) {
  std::uint64_t bytes = 0;
  for (const std::string& path : paths) {
    struct stat file {};
    if (::stat(path.c_str(), &file) == 0) bytes += static_cast<std::uint64_t>(file.st_size);
  }
  return {least_processor_seconds + static_cast<unsigned>(bytes / bytes_per_processor_second),
          least_wall_seconds + static_cast<unsigned>(bytes / bytes_per_wall_second)};
}

/// Limits of a child, and silence: the alarm ends it also where it waits and uses no processor time.
void prepare_child(const ReadingLimits& limits) {
  const rlimit time{limits.processor_seconds, limits.processor_seconds}, core{0, 0};
  ::setrlimit(RLIMIT_CPU, &time);
  ::setrlimit(RLIMIT_CORE, &core);
  sigset_t alarm;
  ::sigemptyset(&alarm);
  ::sigaddset(&alarm, SIGALRM);
  ::signal(SIGALRM, SIG_DFL);
  ::sigprocmask(SIG_UNBLOCK, &alarm, nullptr);
  ::alarm(limits.wall_seconds);
  const int silent = ::open("/dev/null", O_WRONLY);
  ::dup2(silent, STDOUT_FILENO);
  ::dup2(silent, STDERR_FILENO);
}

[[noreturn]] void run_child(const std::vector<std::string>& paths, const std::function<void(const std::string&)>& read,
                            const ReadingLimits& limits) {
  prepare_child(limits);
  for (const std::string& path : paths) {
    try {
      read(path);
    } catch (...) {
      // The parent meets it again and reports it.
    }
  }
  ::_exit(0);
}

/// False if `read` throws or nobody takes its bytes.
bool write_all(int file, const std::function<std::string()>& read) {
  try {
    const std::string bytes = read();
    std::size_t sent = 0;
    for (ssize_t more; sent < bytes.size(); sent += static_cast<std::size_t>(more)) {
      more = ::write(file, bytes.data() + sent, bytes.size() - sent);
      if (more < 0) return false;
    }
    return true;
  } catch (...) {
    return false;
  }
}

/// How a child ended, as waitpid() says it.
int status_of(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

/// The same of a child that reads; 0 without one.
int status_of_child(const std::vector<std::string>& paths, const std::function<void(const std::string&)>& read,
                    const ReadingLimits& limits) {
  if (paths.empty()) return 0;
  silence();
  const pid_t child = ::fork();
  if (child < 0) return 0;  // no process to spare: the caller reads without rehearsal
  if (child == 0) run_child(paths, read, limits);
  return status_of(child);
}

}  // namespace

std::string read_apart(const std::string& path, const std::function<std::string()>& read) {
  int channel[2];
  if (::pipe(channel) != 0) return "";
  const pid_t child = ::fork();
  if (child == 0) {
    prepare_child(limits_for({path}));
    ::_exit(write_all(channel[1], read) ? 0 : 1);
  }
  ::close(channel[1]);
  std::string bytes;
  char some[4096];
  for (ssize_t size; (size = ::read(channel[0], some, sizeof some)) > 0 || (size < 0 && errno == EINTR);)
    bytes.append(some, size > 0 ? static_cast<std::size_t>(size) : 0);
  ::close(channel[0]);
  return child > 0 && status_of(child) == 0 ? bytes : "";
}

bool survives(const std::vector<std::string>& paths, const std::function<void(const std::string&)>& read) {
  return status_of_child(paths, read, limits_for(paths)) == 0;
}

void rehearse(const std::string& path, const std::function<void()>& read) { rehearse(path, read, limits_for({path})); }

void rehearse(const std::string& path, const std::function<void()>& read, const ReadingLimits& limits) {
  const int status = status_of_child(
      {path}, [&read](const std::string&) { read(); }, limits);
  if (status == 0) return;
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGALRM)
    throw Error(
        fmt::format("could not be read within {} s: it is damaged, or its disk does not answer", limits.wall_seconds),
        path, "copy it to another disk, or write it again");
  throw Error("is an HDF5 file, but so damaged that HDF5 cannot read it", path, "write or copy the file again");
}

}  // namespace tisserand::formats::hdf5
