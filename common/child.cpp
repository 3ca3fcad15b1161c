// SPDX-License-Identifier: GPL-3.0-or-later
// Starts a child process (fork, exec), waits for it and reads its output.
#include "common/child.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <sstream>
#include <utility>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {
namespace {

using Clock = std::chrono::steady_clock;

struct FileCloser {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using TemporaryFile = std::unique_ptr<std::FILE, FileCloser>;

/// Temporary file that other children, started meanwhile by other threads, do not inherit.
TemporaryFile temporary_file(const std::string& program) {
  TemporaryFile file(std::tmpfile());
  if (!file || ::fcntl(fileno(file.get()), F_SETFD, FD_CLOEXEC) != 0)
    throw Error("cannot create a temporary file", program, remedy_of_errno(errno));
  return file;
}

std::string content(std::FILE* file, std::size_t most) {
  std::fseek(file, 0, SEEK_END);
  const long size = std::ftell(file);
  std::string text(std::min(most, static_cast<std::size_t>(std::max(size, 0L))), '\0');
  std::rewind(file);
  text.resize(std::fread(text.data(), 1, text.size(), file));
  return text;
}

/// Descriptor closed at exec. Its number is at least 10, so it does not collide with descriptors 0 to 4 of a child.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(::fcntl(number, F_DUPFD_CLOEXEC, 10)) { ::close(number); }
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }
  int number() const { return number_; }

 private:
  int number_ = -1;
};

/// Both ends of the socket that `talk` uses.
struct Line {
  Descriptor own, child;
};

void open_line(Line& line, const std::string& program) {
  std::array<int, 2> ends{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()) != 0)
    throw Error("cannot create a socket", program, remedy_of_errno(errno));
  line.own = Descriptor(ends[0]);
  line.child = Descriptor(ends[1]);
}

/// Turns the child into the program. Calls only functions that are safe between fork and exec with threads.
[[noreturn]] void become(char* const* words, const std::array<int, 3>& streams, int line, int complaint, pid_t parent) {
  complaint = ::fcntl(complaint, F_DUPFD_CLOEXEC, 10);
  for (int k = 0; k < 3; ++k) ::dup2(streams[k], k);
  for (int k = 3; line >= 0 && k < 5; ++k) ::dup2(line, k);
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() == parent) ::execvp(words[0], words);
  const int number = errno;
  [[maybe_unused]] const ssize_t reported = ::write(complaint, &number, sizeof number);
  ::_exit(127);
}

/// Starts the child; throws Error with the reason if it does not become the program.
pid_t start(const ChildRequest& request, const std::array<int, 3>& streams, int line) {
  std::vector<char*> words;
  for (const std::string& word : request.words) words.push_back(const_cast<char*>(word.c_str()));
  words.push_back(nullptr);
  std::array<int, 2> ends{-1, -1};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    throw Error("cannot start a process", request.words[0], remedy_of_errno(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) become(words.data(), streams, line, ends[1], parent);
  int number = child < 0 ? errno : 0;
  ::close(ends[1]);
  if (child > 0 && ::read(ends[0], &number, sizeof number) > 0) ::waitpid(child, nullptr, 0);
  ::close(ends[0]);
  if (number == 0) return child;
  throw Error(fmt::format("cannot be started: {}", std::strerror(number)), request.words[0],
              number == ENOENT ? "install it, or add its folder to PATH" : remedy_of_errno(number));
}

/// Waits until the child ends. Terminates it if its time is over or the request stops it.
ChildEnding watch(const ChildRequest& request, pid_t child) {
  const auto begin = Clock::now();
  const auto seconds = [&begin] { return std::chrono::duration<double>(Clock::now() - begin).count(); };
  const int handle = static_cast<int>(::syscall(SYS_pidfd_open, child, 0));  // glibc 2.36 declares it for C alone
  pollfd end{handle, POLLIN, 0};
  const auto ended = [&](int milliseconds) { return ::poll(&end, 1, milliseconds) > 0; };
  ChildEnding ending = ChildEnding::left;
  while (handle >= 0 && !ended(100) && ending == ChildEnding::left) {
    if (request.seconds > 0.0 && seconds() > request.seconds) ending = ChildEnding::timed_out;
    if (request.is_stopped && request.is_stopped()) ending = ChildEnding::stopped;
  }
  if (ending != ChildEnding::left) {
    ::kill(child, SIGTERM);
    if (!ended(5000)) ::kill(child, SIGKILL);
  }
  if (handle >= 0) ::close(handle);
  return ending;
}

}  // namespace

ChildReport run_child(const ChildRequest& request) {
  const std::string& program = request.words.at(0);
  const TemporaryFile input = temporary_file(program), out = temporary_file(program), error = temporary_file(program);
  if (std::fwrite(request.input.data(), 1, request.input.size(), input.get()) != request.input.size() ||
      std::fflush(input.get()) != 0)
    throw Error("cannot write the input of this program", program, remedy_of_errno(errno));
  std::rewind(input.get());
  Line line;
  if (request.talk) open_line(line, program);
  const pid_t child =
      start(request, {fileno(input.get()), fileno(out.get()), fileno(error.get())}, line.child.number());
  line.child.close();
  try {
    if (request.talk) request.talk(line.own.number());
  } catch (...) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    throw;
  }
  line.own.close();
  ChildReport report;
  report.ending = watch(request, child);
  int status = 0;
  rusage used{};
  while (::wait4(child, &status, 0, &used) < 0)
    if (errno != EINTR) throw Error("cannot wait for the end of the process", program, std::strerror(errno));
  if (report.ending == ChildEnding::left && WIFSIGNALED(status)) report.ending = ChildEnding::killed;
  report.code = WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status);
  report.text = content(out.get(), request.most_text);
  report.complaint = content(error.get(), std::size_t{1} << 16);
  const auto seconds = [](const timeval& time) { return static_cast<double>(time.tv_sec) + 1e-6 * time.tv_usec; };
  report.cpu_seconds = seconds(used.ru_utime) + seconds(used.ru_stime);
  return report;
}

bool is_program(const std::string& program) {
  if (program.find('/') != std::string::npos) return ::access(program.c_str(), X_OK) == 0;
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (!folder.empty() && ::access((folder + "/" + program).c_str(), X_OK) == 0) return true;
  return false;
}

std::string own_program() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace tisserand
