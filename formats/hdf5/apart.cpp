// SPDX-License-Identifier: GPL-3.0-or-later
// The reading child: fork, sandbox, requests. Small messages use a socket, answers use shared memory.
#include "formats/hdf5/apart.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <optional>

#include "common/confined/call_filter.hpp"
#include "common/console.hpp"
#include "common/memory/short_memory.hpp"
#include "common/text.hpp"
#include "formats/hdf5/container.hpp"

namespace tisserand::formats::hdf5 {
namespace {

constexpr double least_processor_seconds = 2.0, least_wall_seconds = 30.0;
constexpr double bytes_per_processor_second = 20e6;  // a tenth of what HDF5 reads and unpacks in a second
constexpr double bytes_per_wall_second = 1e6;        // a slow disk behind a network
constexpr std::uint64_t window_bytes = 1u << 20;     // of the shared memory; fits the processor's cache
constexpr std::uint64_t most_text = 1u << 28, most_complaint = 1u << 16, longest_request = 1u << 17;
constexpr int socket_of_child = 3;
constexpr timeval glance{0, 200'000};  // interval at which the parent checks a computing child

constexpr char asks = 0, opens_closed = 1, opens_any = 2;

enum class Answer : std::uint64_t { values, complaint, opening_unconfined };

/// Header sent before each piece of an answer, which is then in the window.
struct Head {
  Answer answer = Answer::values;
  std::uint64_t bytes = 0;
};

// --- the child -----------------------------------------------------------------------------------------------------

/// Memory for an answer: the window if it fits, so that HDF5 reads directly into it.
class Room {
 public:
  explicit Room(char* window) : window_(window) {}

  char* take(std::uint64_t bytes) {
    bytes_ = bytes;
    larger_ = bytes > window_bytes ? std::make_unique_for_overwrite<char[]>(bytes) : nullptr;
    return larger_ ? larger_.get() : window_;
  }
  void put(const std::string& bytes) { std::memcpy(take(bytes.size()), bytes.data(), bytes.size()); }

  /// Sends the answer in pieces of one window, each on request of the parent.
  void send(Answer answer) {
    for (std::uint64_t done = 0; done == 0 || done < bytes_; done += window_bytes) {
      char next = 0;
      if (done > 0 && ::read(socket_of_child, &next, 1) != 1) ::_exit(0);
      if (larger_) std::memcpy(window_, larger_.get() + done, std::min(window_bytes, bytes_ - done));
      const Head head{answer, bytes_};
      if (::write(socket_of_child, &head, sizeof head) != sizeof head) ::_exit(0);
    }
    larger_.reset();
  }

 private:
  char* window_;
  std::unique_ptr<char[]> larger_;
  std::uint64_t bytes_ = 0;
};

/// Prepares the child: no descriptors except the socket, no core file, death with the parent, default crash handlers.
void leave_the_parent(int socket, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGSYS}) ::signal(signal, SIG_DFL);
  const rlimit none{0, 0};
  ::setrlimit(RLIMIT_CORE, &none);
  const int silent = ::open("/dev/null", O_RDWR);
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(silent, stream);
  ::dup2(socket, socket_of_child);
  ::closefrom(socket_of_child + 1);
}

/// Sandbox: allows only reading of open files, computing, answering and exit. False if it cannot be installed.
bool close_door() {
  using enum CallFilter::Action;
  CallFilter filter;
  filter.add(allow, {SYS_read,           SYS_write,        SYS_pread64,         SYS_munmap,  SYS_brk,
                     SYS_mremap,         SYS_madvise,      SYS_mprotect,        SYS_futex,   SYS_clock_gettime,
                     SYS_sched_yield,    SYS_getpid,       SYS_gettid,          SYS_sysinfo,
                     SYS_sigaltstack,                                         // sanitizers call it before they throw
                     SYS_rseq,           SYS_nanosleep,    SYS_gettimeofday,  // threads of sanitizers call them
                     SYS_rt_sigprocmask, SYS_rt_sigreturn, SYS_restart_syscall, SYS_exit,    SYS_exit_group});
  filter.add(allow, SYS_mmap, {3, MAP_TYPE, MAP_PRIVATE, false});
  return filter.install();
}

/// Exit status of a child without memory, equal to that of the programs (report_short_memory).
constexpr int left_without_memory = 1;

std::string pack_complaint(const Error& error) {
  Packer to;
  to.error(error);
  to.bytes.resize(std::min<std::size_t>(to.bytes.size(), most_complaint));
  return to.bytes;
}

/// Runs `work`, which fills the room, and sends the result or the error that it threw.
template <class Work>
void send_result(Room& room, const Work& work) {
  Answer answer = Answer::complaint;
  try {
    answer = work();
  } catch (const Error& error) {
    room.put(pack_complaint(error));
  } catch (const std::bad_alloc&) {
    ::_exit(left_without_memory);
  }
  room.send(answer);
}

/// File of the child, opened before the sandbox starts and read on request.
struct ServedFile {
  explicit ServedFile(const std::string& path) {
    try {
      file.emplace(path);
    } catch (const Error& error) {
      failure = error;
    }
  }
  /// The HDF5 container of the file, opened at the first call.
  const Container& open(Completeness completeness) {
    if (failure) throw Error(*failure);
    if (!container) container.emplace(*file, completeness);
    return *container;
  }

  std::optional<Error> failure;
  std::optional<OpenFile> file;
  std::optional<Container> container;
};

struct Request {
  std::size_t file = 0;
  std::optional<Completeness> opens;
  std::string_view question;
};

Request parse_request(std::string_view bytes) {
  std::size_t file = 0;
  if (bytes.size() <= sizeof file) ::_exit(2);
  std::memcpy(&file, bytes.data(), sizeof file);
  const char opens = bytes[sizeof file];
  const std::string_view question = bytes.substr(sizeof file + 1);
  if (opens == asks) return {file, std::nullopt, question};
  return {file, opens == opens_any ? Completeness::any : Completeness::closed, question};
}

[[noreturn]] void serve(const std::vector<std::string>& paths, char* window) {
  Room room(window);
  std::vector<std::unique_ptr<ServedFile>> files;
  for (const std::string& path : paths) files.push_back(std::make_unique<ServedFile>(path));
  const Answer opening = close_door() ? Answer::values : Answer::opening_unconfined;
  std::array<char, longest_request> bytes;
  for (;;) {
    const ssize_t size = ::read(socket_of_child, bytes.data(), bytes.size());
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) ::_exit(0);
    const Request request = parse_request({bytes.data(), static_cast<std::size_t>(size)});
    send_result(room, [&] {
      const Container& container = files.at(request.file)->open(request.opens.value_or(Completeness::closed));
      if (request.opens) room.put(opening_of(container));
      if (request.opens) return opening;
      answer(container, request.question, [&room](std::uint64_t count) { return room.take(count); });
      return Answer::values;
    });
  }
}

// --- the parent ----------------------------------------------------------------------------------------------------

ReadingLimits limits_for(const std::vector<std::string>& paths) {
  double bytes = 0.0;
  for (const std::string& path : paths) {
    struct stat file {};
    if (::stat(path.c_str(), &file) == 0) bytes += static_cast<double>(file.st_size);
  }
  return {least_processor_seconds + bytes / bytes_per_processor_second,
          least_wall_seconds + bytes / bytes_per_wall_second};
}

double seconds_of(clockid_t clock) {
  timespec time{};
  ::clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void report_unconfined() {
  static bool reported = false;
  if (!reported)
    complain("note",
             "HDF5 files are read without a sandbox, because this system lacks seccomp or forbids it. A malicious file "
             "could do more harm");
  reported = true;
}

Place place_in(std::string& text, const std::string& path) {
  return [&](std::uint64_t bytes) {
    if (bytes > most_text)
      throw Error(fmt::format("holds more than {} bytes of names", most_text), path,
                  "compare the file with its specification");
    text.resize(bytes);
    return text.data();
  };
}

/// Bytes of a request: index of a file, action, question.
std::string bytes_of(std::size_t file, char act, const std::string& question) {
  Packer to;
  to.value(file);
  to.value(act);
  return to.bytes + question;
}

std::weak_ptr<Apart> together;

}  // namespace

struct Apart::Impl {
  std::vector<std::string> paths;
  std::string path;  ///< file of the current request
  ReadingLimits limits;
  pid_t child = -1;
  int socket = -1;
  char* window = nullptr;
  int status = 0;  ///< exit status of the child

  void end();
  [[noreturn]] void give_up();
  Head next_head();
  void send(const char* bytes, std::size_t size);
  void receive(const Place& place);
};

Apart::Apart(const std::vector<std::string>& paths, const ReadingLimits& limits) : impl_(std::make_unique<Impl>()) {
  silence();
  impl_->paths = paths;
  impl_->limits = limits.wall_seconds > 0.0 ? limits : limits_for(paths);
  std::array<int, 2> ends{-1, -1};
  void* const window = ::mmap(nullptr, window_bytes, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (window != MAP_FAILED) impl_->window = static_cast<char*>(window);
  const bool ready = window != MAP_FAILED && ::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) == 0;
  const pid_t parent = ::getpid();
  if (ready) impl_->child = ::fork();
  const int number = errno;
  if (impl_->child == 0) {
    leave_the_parent(ends[1], parent);
    serve(paths, impl_->window);
  }
  if (ready) ::close(ends[1]);
  impl_->socket = ends[0];
  if (impl_->child > 0) {
    ::setsockopt(impl_->socket, SOL_SOCKET, SO_RCVTIMEO, &glance, sizeof glance);
    return;
  }
  impl_->end();
  throw Error(fmt::format("cannot start a process that reads the file: {}", std::strerror(number)), paths.front(),
              remedy_of_errno(number));
}

Apart::~Apart() { impl_->end(); }

void Apart::Impl::end() {
  if (socket >= 0) ::close(socket);
  if (child > 0) ::kill(child, SIGKILL);
  while (child > 0 && ::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (window != nullptr) ::munmap(window, window_bytes);
  child = socket = -1;
  window = nullptr;
}

void Apart::Impl::give_up() {
  end();
  if ((WIFEXITED(status) && WEXITSTATUS(status) == left_without_memory) || !is_memory_left())
    throw Error("there is not enough memory to read the file: it is damaged, or memory is short", path,
                "close other programs, raise the limit (`ulimit -v`), or write the file again");
  throw Error("is an HDF5 file, but so damaged that HDF5 cannot read it", path, "write or copy the file again");
}

/// Waits for the next header from the child. The parent trusts nothing that the child sends.
Head Apart::Impl::next_head() {
  const auto begin = std::chrono::steady_clock::now();
  std::optional<double> computed;
  for (;;) {
    Head head;
    const ssize_t size = ::recv(socket, &head, sizeof head, 0);
    if (size == sizeof head) return head;
    if (size >= 0 || (errno != EAGAIN && errno != EINTR)) give_up();
    clockid_t clock{};
    const double now = ::clock_getcpuclockid(child, &clock) == 0 ? seconds_of(clock) : 0.0;
    if (!computed) computed = now;
    if (now - *computed > limits.processor_seconds) give_up();
    if (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() < limits.wall_seconds) continue;
    end();
    throw Error(fmt::format("could not be read within {} s: it is damaged, or its disk does not respond",
                            std::ceil(limits.wall_seconds)),
                path, "copy the file to another disk, or write it again");
  }
}

void Apart::Impl::send(const char* bytes, std::size_t size) {
  if (socket < 0 || ::send(socket, bytes, size, MSG_NOSIGNAL) != static_cast<ssize_t>(size)) give_up();
}

void Apart::Impl::receive(const Place& place) {
  Head head = next_head();
  const std::uint64_t bytes = head.bytes;
  std::string complaint;
  if (head.answer == Answer::complaint && bytes > most_complaint) give_up();
  if (head.answer == Answer::complaint) complaint.resize(bytes);
  char* to = complaint.data();
  try {
    if (head.answer != Answer::complaint) to = place(bytes);
  } catch (...) {
    end();
    throw;
  }
  for (std::uint64_t done = 0; done < bytes; done += window_bytes) {
    if (done > 0) {
      send("", 1);
      next_head();
    }
    std::memcpy(to + done, window, std::min(window_bytes, bytes - done));
  }
  if (head.answer == Answer::opening_unconfined) report_unconfined();
  if (head.answer == Answer::complaint) throw Unpacker(complaint, path, "HDF5 cannot read it").error();
}

std::optional<std::size_t> Apart::number_of(const std::string& path) const {
  const auto found = std::ranges::find(impl_->paths, path);
  if (found == impl_->paths.end()) return std::nullopt;
  return static_cast<std::size_t>(found - impl_->paths.begin());
}

bool Apart::is_gone() const { return impl_->child < 0; }

std::string Apart::open(std::size_t file, Completeness completeness) {
  std::string text;
  impl_->path = impl_->paths.at(file);
  const std::string request = bytes_of(file, completeness == Completeness::any ? opens_any : opens_closed, "");
  impl_->send(request.data(), request.size());
  impl_->receive(place_in(text, impl_->path));
  return text;
}

void Apart::ask(std::size_t file, const std::string& request, const Place& place) {
  impl_->path = impl_->paths.at(file);
  const std::string bytes = bytes_of(file, asks, request);
  if (bytes.size() > longest_request)
    throw Error("cannot look up an object, because its name is too long", impl_->path, "shorten the name");
  impl_->send(bytes.data(), bytes.size());
  impl_->receive(place);
}

std::string Apart::ask(std::size_t file, const std::string& request) {
  std::string text;
  ask(file, request, place_in(text, impl_->paths.at(file)));
  return text;
}

Together::Together(const std::vector<std::string>& paths) : apart_(std::make_shared<Apart>(paths)) {
  together = apart_;
}

Together::~Together() { together.reset(); }

std::shared_ptr<Apart> Together::child_of(const std::string& path) {
  const std::shared_ptr<Apart> apart = together.lock();
  return apart && apart->number_of(path) ? apart : nullptr;
}

}  // namespace tisserand::formats::hdf5
