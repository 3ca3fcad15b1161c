// SPDX-License-Identifier: GPL-3.0-or-later
// Start, supervision and end of the child process.
#include "reducer/mesher/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/personality.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "common/progress.hpp"
#include "common/text.hpp"
#include "reducer/startup.hpp"

namespace tisserand::reducer {
namespace {

[[noreturn]] void cannot_start(int number, const std::string& program) {
  throw Error(fmt::format("cannot start the program that runs gmsh: {}", std::strerror(number)), program,
              number == ENOENT ? "keep it in the folder of reducer-solver, or install the programs again"
                               : remedy_of_errno(number));
}

/// Descriptor that is closed by its destructor.
class Descriptor {
 public:
  /// Moves the descriptor above the numbers that the child uses, so that none is overwritten during the start.
  explicit Descriptor(int file) : file_(file < 0 ? -1 : ::fcntl(file, F_DUPFD_CLOEXEC, 16)) {
    const int number = errno;
    if (file >= 0) ::close(file);
    if (file_ < 0) cannot_start(number, "gmsh");
  }
  ~Descriptor() { close(); }
  Descriptor(Descriptor&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
  Descriptor& operator=(Descriptor&&) = delete;
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return file_; }
  void close() {
    if (file_ >= 0) ::close(file_);
    file_ = -1;
  }

 private:
  int file_;
};

struct Pipe {
  Descriptor out;  ///< end for reading
  Descriptor in;
};

Pipe make_pipe() {
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) cannot_start(errno, "gmsh");
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

/// A file without a name that contains the request, positioned at its beginning.
Descriptor file_of(const std::string& bytes) {
  Descriptor file(::memfd_create("request", MFD_CLOEXEC));
  for (std::size_t done = 0; done < bytes.size();) {
    const ssize_t written = ::write(file.number(), bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) cannot_start(errno, "gmsh");
    done += static_cast<std::size_t>(written);
  }
  ::lseek(file.number(), 0, SEEK_SET);
  return file;
}

/// Variables that loader and sanitizers read before gmsh begins; the child then removes them.
std::vector<std::string> child_environment() {
  std::vector<std::string> result;
  for (const char* name : {"LD_LIBRARY_PATH", "ASAN_OPTIONS", "UBSAN_OPTIONS"})
    if (const char* value = std::getenv(name); value != nullptr) result.push_back(std::string(name) + "=" + value);
  return result;
}

/// While an object lives, programs that this process starts have their memory at the same addresses in every run. gmsh
/// orders some of its sets by address: otherwise the mesh of a solid, and so the content of the superelement, would
/// differ from run to run.
class SameAddresses {
 public:
  SameAddresses() : before_(::personality(query)) {
    if (before_ >= 0) ::personality(static_cast<unsigned long>(before_) | ADDR_NO_RANDOMIZE);
  }
  ~SameAddresses() {
    if (before_ >= 0) ::personality(static_cast<unsigned long>(before_));
  }
  SameAddresses(const SameAddresses&) = delete;
  SameAddresses& operator=(const SameAddresses&) = delete;

 private:
  static constexpr unsigned long query = 0xffffffff;
  int before_;
};

/// Settings of posix_spawn: no signal blocked or ignored, descriptors 0 to 4 and no others.
class SpawnSettings {
 public:
  SpawnSettings(int request, int answer, int words) {
    ::posix_spawn_file_actions_init(&files_);
    ::posix_spawn_file_actions_addopen(&files_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    ::posix_spawn_file_actions_addopen(&files_, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    ::posix_spawn_file_actions_adddup2(&files_, words, STDERR_FILENO);
    ::posix_spawn_file_actions_adddup2(&files_, request, request_descriptor);
    ::posix_spawn_file_actions_adddup2(&files_, answer, answer_descriptor);
    ::posix_spawn_file_actions_addclosefrom_np(&files_, answer_descriptor + 1);
    sigset_t none, all;
    ::sigemptyset(&none);
    ::sigfillset(&all);
    ::posix_spawnattr_init(&attributes_);
    ::posix_spawnattr_setsigmask(&attributes_, &none);
    ::posix_spawnattr_setsigdefault(&attributes_, &all);
    ::posix_spawnattr_setflags(&attributes_, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  }
  ~SpawnSettings() {
    ::posix_spawnattr_destroy(&attributes_);
    ::posix_spawn_file_actions_destroy(&files_);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  pid_t start(const std::string& program) const {
    std::vector<std::string> texts = child_environment();
    std::vector<char*> environment;
    for (std::string& text : texts) environment.push_back(text.data());
    environment.push_back(nullptr);
    std::string name = program;
    const std::array<char*, 2> arguments{name.data(), nullptr};
    pid_t child = -1;
    const SameAddresses same;
    const int number =
        ::posix_spawn(&child, program.c_str(), &files_, &attributes_, arguments.data(), environment.data());
    if (number != 0) cannot_start(number, program);
    return child;
  }

 private:
  posix_spawn_file_actions_t files_;
  posix_spawnattr_t attributes_;
};

/// Share of the child's memory: gmsh needs ten times the size of the answer or more, and unpacking six times its size.
constexpr double answer_share = 0.125;

struct Heard {
  std::string answer;
  std::string words;
  std::optional<MesherEnding> stopped = std::nullopt;  ///< reason for which the child must end
};

/// Reads the available bytes; returns false at the end.
bool read_some(Descriptor& from, std::string& to) {
  std::array<char, 1 << 16> buffer;
  const ssize_t count = ::read(from.number(), buffer.data(), buffer.size());
  if (count < 0 && errno == EINTR) return true;
  if (count > 0) to.append(buffer.data(), static_cast<std::size_t>(count));
  if (count <= 0) from.close();
  return count > 0;
}

/// End of the phase bytes at the beginning of the answer, and the last of them.
std::pair<std::size_t, MesherPhase> phase_of(const std::string& answer) {
  MesherPhase phase = MesherPhase::starting;
  std::size_t k = 0;
  for (; k < answer.size() && phase != MesherPhase::answering; ++k) phase = static_cast<MesherPhase>(answer[k]);
  return {k, phase};
}

/// Reads the clock and the child's processor time, and shows both to the user.
class Watch {
 public:
  Watch(pid_t child, const GeometryRequest& request)
      : request_(request), progress_("gmsh, " + std::filesystem::path(request.file).filename().string(), 0.0) {
    if (::clock_getcpuclockid(child, &clock_) != 0) clock_ = CLOCK_MONOTONIC;
  }

  /// Reason for which the child must end, if any.
  std::optional<MesherEnding> look(MesherPhase phase) {
    const double now = seconds(CLOCK_MONOTONIC), used = seconds(clock_);
    if (phase != phase_) phase_ = phase, used_at_phase_ = used;
    if (used > used_ + least_work) used_ = used, worked_at_ = now;
    const bool reads = phase == MesherPhase::reading;
    const double limit = reads ? request_.reading_seconds : request_.seconds, of_phase = used - used_at_phase_;
    progress_.update(0.0, fmt::format("{}: {:.0f} s of at most {:.4g} s", doing(phase), reads ? of_phase : used, limit));
    if (reads && of_phase > limit) return MesherEnding::reading_time;
    if (now - worked_at_ > request_.idle_seconds) return MesherEnding::idle;
    if (now - start_ > request_.wall_seconds) return MesherEnding::wall_time;
    return std::nullopt;
  }
  void finish() { progress_.finish(); }

 private:
  static constexpr double least_work = 1e-4;  // [s]

  static double seconds(clockid_t clock) {
    timespec time{};
    return ::clock_gettime(clock, &time) == 0 ? static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec)
                                              : 0.0;
  }

  const GeometryRequest& request_;
  Progress progress_;
  clockid_t clock_ = CLOCK_MONOTONIC;
  MesherPhase phase_ = MesherPhase::starting;
  double start_ = seconds(CLOCK_MONOTONIC), worked_at_ = start_, used_ = 0.0, used_at_phase_ = 0.0;
};

/// Reads both pipes until the child has closed them, or must end.
Heard listen(Descriptor& answer, Descriptor& words, pid_t child, const GeometryRequest& request) {
  constexpr std::size_t most_words = 4000;
  constexpr int look_every = 100;  // [ms]
  Watch watch(child, request);
  Heard heard;
  while (answer.number() >= 0 || words.number() >= 0) {
    heard.stopped = watch.look(phase_of(heard.answer).second);
    if (static_cast<double>(heard.answer.size()) > answer_share * request.bytes) heard.stopped = MesherEnding::memory;
    if (heard.stopped) return heard;
    std::array<pollfd, 2> files{pollfd{answer.number(), POLLIN, 0}, pollfd{words.number(), POLLIN, 0}};
    if (::poll(files.data(), files.size(), look_every) <= 0) continue;
    if (files[0].revents != 0) read_some(answer, heard.answer);
    if (files[1].revents != 0) read_some(words, heard.words);
    if (heard.words.size() > most_words) heard.words.erase(0, heard.words.size() - most_words);
  }
  if (phase_of(heard.answer).second == MesherPhase::answering) watch.finish();
  return heard;
}

/// Last error of gmsh, or else the last line that is not empty.
std::string last_message(std::string text) {
  constexpr std::string_view error = "Error   : ";
  if (const std::size_t at = text.rfind(error); at != std::string::npos) {
    text.erase(0, at + error.size());
    text.erase(std::min(text.find('\n'), text.size()));
  }
  while (!text.empty() && (text.back() == '\n' || text.back() == '\r' || text.back() == ' ')) text.pop_back();
  return printable_line(text.substr(text.rfind('\n') + 1), 300);  // npos + 1 is 0
}

MesherEnding ending_of(const Heard& heard, int status, const rusage& used, const GeometryRequest& request) {
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * time.tv_usec; };
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return MesherEnding::answered;
  if (WIFEXITED(status) && WEXITSTATUS(status) == out_of_memory_code) return MesherEnding::memory;
  if (WIFSIGNALED(status)) {
    const bool spent = seconds(used.ru_utime) + seconds(used.ru_stime) >= request.seconds;
    if (WTERMSIG(status) == SIGXCPU || (WTERMSIG(status) == SIGKILL && spent)) return MesherEnding::processor_time;
    if (heard.stopped) return *heard.stopped;
    if (WTERMSIG(status) == SIGSYS) return MesherEnding::forbidden;
  }
  // C code without memory ends in various ways.
  if (1024.0 * static_cast<double>(used.ru_maxrss) > 0.8 * request.bytes) return MesherEnding::memory;
  return WIFSIGNALED(status) ? MesherEnding::crashed : MesherEnding::left;
}

}  // namespace

MesherReport run_mesher(const GeometryRequest& request) {
  Pipe answer = make_pipe(), words = make_pipe();
  const std::string program = program_folder() + "reducer-mesher";
  const Descriptor parcel = file_of(pack(request));
  const pid_t child = SpawnSettings(parcel.number(), answer.in.number(), words.in.number()).start(program);
  answer.in.close();
  words.in.close();
  Heard heard = listen(answer.out, words.out, child, request);
  ::kill(child, SIGKILL);  // a child that has closed both pipes has ended, or is malicious
  int status = 0;
  rusage used{};
  while (::wait4(child, &status, 0, &used) < 0 && errno == EINTR) {
  }
  MesherReport report;
  const auto [begin, phase] = phase_of(heard.answer);
  heard.answer.erase(0, begin);
  report.phase = phase;
  report.ending = ending_of(heard, status, used, request);
  if (report.ending == MesherEnding::answered && report.phase != MesherPhase::answering)
    report.ending = MesherEnding::left;
  report.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  report.answer = std::move(heard.answer);
  report.last_words = last_message(heard.words);
  return report;
}

}  // namespace tisserand::reducer
