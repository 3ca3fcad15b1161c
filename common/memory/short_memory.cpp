// SPDX-License-Identifier: GPL-3.0-or-later
// A reserve of memory, and signal handlers that check whether memory is left.
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
constexpr bool own_handlers = false;  // sanitizers have their own handlers and allocator
#else
constexpr bool own_handlers = true;
#endif
constexpr std::size_t reserve_bytes = std::size_t{8} << 20U;
void* reserve = nullptr;
const char* name_of_program = "";
pid_t own_process = 0;
std::terminate_handler former_terminate = std::abort;

/// Frees the reserve. `operator new` calls it and then tries again.
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
  if (::getpid() == own_process) (void)remove_temporaries();  // a forked reader must keep its parent's files
  put(name_of_program);
  put(": out of memory; close other programs, raise the limit (`ulimit -v`), or make the model smaller\n");
  ::_exit(1);
}

void on_crash(int signal) {
  if (!is_memory_left()) end_without_memory();
  std::signal(signal, SIG_DFL);
  (void)::raise(signal);
}

/// Exit handler. Some C libraries end the program silently by exit(-1) if they get no memory when they start.
void on_end(int status, void* /*unused*/) {
  if ((status & 0xff) == 0xff && !is_memory_left()) end_without_memory();
}

/// Terminate handler, for an exception in a destructor of a library, for example.
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

bool is_memory_left() { return are_left(std::size_t{64} << 20U); }  // for libraries loaded later and stacks of threads

void report_short_memory(const char* program) {
  if (!own_handlers) return;
  name_of_program = program;
  own_process = ::getpid();
  reserve = std::malloc(reserve_bytes);
  std::set_new_handler(give_reserve_back);
  ::on_exit(on_end, nullptr);
  former_terminate = std::set_terminate(on_terminate);
  static std::array<char, std::size_t{64} << 10U> stack;  // for the handlers: the normal stack may be full
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
