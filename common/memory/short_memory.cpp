// A reserve, and handlers of signals that look whether memory is left.
#include "common/memory/short_memory.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>

#include "common/temporaries.hpp"

namespace tisserand {
namespace {

#if defined(TISSERAND_SANITIZED)
constexpr bool own_handlers = false;  // sanitizers have handlers and an allocator of their own
#else
constexpr bool own_handlers = true;
#endif
constexpr std::size_t reserve_bytes = std::size_t{8} << 20U;
void* reserve = nullptr;
const char* name_of_program = "";
pid_t own_process = 0;
std::terminate_handler former_terminate = std::abort;

/// Called by `operator new`, which then tries once more.
void give_reserve_back() {
  if (reserve == nullptr) throw std::bad_alloc();
  std::free(reserve);
  reserve = nullptr;
}

bool are_left(std::size_t bytes) {
  void* const tried = ::mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (tried == MAP_FAILED) return false;
  ::munmap(tried, bytes);
  return true;
}

void put(const char* text) { [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text, std::strlen(text)); }

[[noreturn]] void end_without_memory() {
  if (::getpid() == own_process) (void)remove_temporaries();  // not those of the parent of a child that reads
  put(name_of_program);
  put(": out of memory; raise the limit (`ulimit -v`), close other programs, or make the model smaller\n");
  ::_exit(1);
}

void on_crash(int signal) {
  if (!is_memory_left()) end_without_memory();
  std::signal(signal, SIG_DFL);
  (void)::raise(signal);
}

/// Libraries in C that get no memory when they begin end the program without a word, by exit(-1).
void on_end(int status, void* /*unused*/) {
  if ((status & 0xff) == 0xff && !is_memory_left()) end_without_memory();
}

/// An exception where none may leave: in destructors of a library.
void on_terminate() {
  try {
    if (std::current_exception()) throw;
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (...) {
    former_terminate();
  }
  former_terminate();
}

}  // namespace

void require_addresses(std::size_t bytes) {
  while (!are_left(bytes)) give_reserve_back();
}

bool is_memory_left() { return are_left(std::size_t{64} << 20U); }  // libraries that they open, stacks of threads

void report_short_memory(const char* program) {
  if (!own_handlers) return;
  name_of_program = program;
  own_process = ::getpid();
  reserve = std::malloc(reserve_bytes);
  std::set_new_handler(give_reserve_back);
  ::on_exit(on_end, nullptr);
  former_terminate = std::set_terminate(on_terminate);
  static std::array<char, std::size_t{64} << 10U> stack;  // of the handlers: the own one may be at its end
  stack_t alternative{};
  alternative.ss_sp = stack.data();
  alternative.ss_size = stack.size();
  ::sigaltstack(&alternative, nullptr);
  struct sigaction action {};
  action.sa_handler = on_crash;
  action.sa_flags = SA_ONSTACK | SA_NODEFER;
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT}) ::sigaction(signal, &action, nullptr);
}

}  // namespace tisserand
