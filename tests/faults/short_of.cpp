// SPDX-License-Identifier: GPL-3.0-or-later
// Library for LD_PRELOAD that makes an allocation or a write to a file fail, from `main` on. Environment:
// - TISSERAND_SHORT_OF = memory | disk
// - TISSERAND_SHORT_AT = number of the call, from 1; 0: none
// - TISSERAND_SHORT_FOR = once; or good: all writes from then on, or no address space beyond what the program has then
// - TISSERAND_SHORT_BY = new: only `operator new` counts, and no reserve helps (libraries in C ask malloc)
// - TISSERAND_SHORT_COUNT = file that receives the number of calls
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <string>

extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
}

namespace {

enum class Kind { none, memory, disk };

std::atomic<bool> counting{false};
std::atomic<long> calls{0};
Kind kind = Kind::none;
long at = 0;
bool for_good = false;
bool only_new = false;
pid_t process = 0;
constexpr const char* first_process = "TISSERAND_SHORT_PROCESS";

/// Limits the address space to what the program has.
void limit_addresses() {
  const int file = ::open("/proc/self/statm", O_RDONLY);
  char text[64] = {};
  if (file < 0 || ::read(file, text, sizeof text - 1) <= 0) return;
  ::close(file);
  const auto bytes = static_cast<rlim_t>(std::atol(text)) * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
  const struct rlimit limit { bytes, RLIM_INFINITY };
  ::setrlimit(RLIMIT_AS, &limit);
}

bool fails(Kind of) {
  if (!counting.load(std::memory_order_relaxed) || of != kind) return false;
  const long number = calls.fetch_add(1, std::memory_order_relaxed) + 1;
  if (at == 0 || number < at || (number > at && !for_good)) return false;
  if (kind == Kind::disk || !for_good) return true;
  if (number == at && ::getpid() == process) limit_addresses();  // children that it forks later inherit the limit
  return false;
}

bool no_memory() {
  if (!fails(Kind::memory)) return false;
  errno = ENOMEM;
  return true;
}

bool no_memory_for_c() { return !only_new && no_memory(); }

/// Whether a write to a regular file fails. Writes to standard streams and pipes never do.
bool no_space(int file) {
  struct stat status {};
  if (!counting.load(std::memory_order_relaxed) || kind != Kind::disk || file <= STDERR_FILENO) return false;
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode) || !fails(Kind::disk)) return false;
  errno = ENOSPC;
  return true;
}

int (*program)(int, char**, char**) = nullptr;

int counted_main(int argc, char** argv, char** environment) {
  const char* of = std::getenv("TISSERAND_SHORT_OF");
  const char* number = std::getenv("TISSERAND_SHORT_AT");
  const char* length = std::getenv("TISSERAND_SHORT_FOR");
  const char* by = std::getenv("TISSERAND_SHORT_BY");
  only_new = by != nullptr && std::strcmp(by, "new") == 0;
  if (of != nullptr) kind = std::strcmp(of, "disk") == 0 ? Kind::disk : Kind::memory;
  if (number != nullptr) at = std::atol(number);
  for_good = length != nullptr && std::strcmp(length, "good") == 0;
  ::setenv(first_process, std::to_string(::getpid()).c_str(), 0);
  process = ::getpid();
  counting = true;
  return program(argc, argv, environment);
}

/// Writes the number of calls of the first process, also if it became another program. Children may not open files.
__attribute__((destructor)) void report_count() {
  counting = false;
  const char* path = std::getenv("TISSERAND_SHORT_COUNT");
  const char* first = std::getenv(first_process);
  if (path == nullptr || first == nullptr || std::atol(first) != ::getpid()) return;
  const int file = ::open(path, O_WRONLY | O_CREAT | O_EXCL, 0644);
  if (file < 0) return;
  char text[32];
  const int length = std::snprintf(text, sizeof text, "%ld\n", calls.load());
  [[maybe_unused]] const auto written = ::write(file, text, static_cast<std::size_t>(length));
  ::close(file);
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

#define EXPORTED extern "C" __attribute__((visibility("default")))

EXPORTED int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(), void (*fini)(),
                               void (*loader_fini)(), void* stack_end) {
  program = main;
  using Start = int (*)(int (*)(int, char**, char**), int, char**, void (*)(), void (*)(), void (*)(), void*);
  return next<Start>("__libc_start_main")(counted_main, argc, argv, init, fini, loader_fini, stack_end);
}

EXPORTED void* malloc(size_t size) { return no_memory_for_c() ? nullptr : __libc_malloc(size); }
EXPORTED void* calloc(size_t count, size_t size) { return no_memory_for_c() ? nullptr : __libc_calloc(count, size); }
EXPORTED void* realloc(void* old, size_t size) {
  return size > 0 && no_memory_for_c() ? nullptr : __libc_realloc(old, size);
}
EXPORTED void* memalign(size_t alignment, size_t size) {
  return no_memory_for_c() ? nullptr : __libc_memalign(alignment, size);
}
EXPORTED void* aligned_alloc(size_t alignment, size_t size) {
  return no_memory_for_c() ? nullptr : __libc_memalign(alignment, size);
}
EXPORTED int posix_memalign(void** result, size_t alignment, size_t size) {
  if (no_memory_for_c()) return ENOMEM;
  *result = __libc_memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}

namespace {

void* allocate(std::size_t size, std::size_t alignment) noexcept {
  if (no_memory()) return nullptr;
  if (size == 0) size = 1;
  return alignment == 0 ? __libc_malloc(size) : __libc_memalign(alignment, size);
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  void* const result = allocate(size, alignment);
  if (result == nullptr) throw std::bad_alloc();
  return result;
}

}  // namespace

#define VISIBLE __attribute__((visibility("default")))
VISIBLE void* operator new(std::size_t size) { return allocate_or_throw(size, 0); }
VISIBLE void* operator new[](std::size_t size) { return allocate_or_throw(size, 0); }
VISIBLE void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
VISIBLE void* operator new[](std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
VISIBLE void* operator new(std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 0); }
VISIBLE void* operator new[](std::size_t size, const std::nothrow_t&) noexcept { return allocate(size, 0); }

EXPORTED ssize_t write(int file, const void* data, size_t size) {
  return no_space(file) ? -1 : ::syscall(SYS_write, file, data, size);
}
EXPORTED ssize_t pwrite64(int file, const void* data, size_t size, off64_t offset) {
  return no_space(file) ? -1 : ::syscall(SYS_pwrite64, file, data, size, offset);
}
EXPORTED ssize_t pwrite(int file, const void* data, size_t size, off_t offset) {
  return no_space(file) ? -1 : ::syscall(SYS_pwrite64, file, data, size, offset);
}

EXPORTED void _exit(int status) {
  report_count();
  ::syscall(SYS_exit_group, status);
  __builtin_unreachable();
}
