// SPDX-License-Identifier: GPL-3.0-or-later
// Replacement of mmap that ends the program if OpenBLAS repeats its request for 128 MB for ever when memory is short.
// OpenBLAS finds it first, since the program precedes the C library in the search for symbols.
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <string_view>

#include "common/temporaries.hpp"

#if !defined(TISSERAND_SANITIZED)

namespace {

/// Only OpenBLAS repeats a refused request this often. Others give up at the first refusal.
constexpr int most_refusals = 1000;
std::atomic<int> refusals{0};

/// Ends the program with a message, without allocating memory.
[[noreturn]] void end_without_memory() {
  constexpr std::string_view text =
      "reducer: out of memory: the linear algebra needs 128 MB more for each thread; raise the limit (`ulimit -v`), or "
      "close other programs\n";
  (void)tisserand::remove_temporaries();
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
  ::_exit(1);
}

}  // namespace

extern "C" __attribute__((visibility("default"))) void* mmap(void* address, size_t length, int protection, int flags,
                                                             int file, off_t offset) noexcept {
  const long result = ::syscall(SYS_mmap, address, length, protection, flags, file, offset);
  if (result != -1)
    refusals = 0;
  else if (errno == ENOMEM && ++refusals >= most_refusals)
    end_without_memory();
  return reinterpret_cast<void*>(result);
}

#endif
