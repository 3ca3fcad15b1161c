// SPDX-License-Identifier: GPL-3.0-or-later
// System calls that a process may make, tried in a child each.
#include "common/confined/call_filter.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include <gtest/gtest.h>

namespace tisserand::call_filter_test {
namespace {

using enum CallFilter::Action;

/// The exit code of a child that may do what all need and what `add` adds, and then returns work(); or 1000 and the
/// signal that ended it.
template <class Add, class Work>
int code_of(const Add& add, const Work& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    CallFilter filter;
    // The last one is of sanitizers, when a function ends that does not return.
    filter.add(allow, {SYS_exit_group, SYS_write, SYS_mmap, SYS_munmap, SYS_brk, SYS_sigaltstack});
    add(filter);
    ::_exit(filter.install() ? work() : 255);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFSIGNALED(status) ? 1000 + WTERMSIG(status) : WEXITSTATUS(status);
}

/// The error number of a call; 0: it went well.
int error_of(long result) { return result < 0 ? errno : 0; }

#define SKIP_WITHOUT_SECCOMP() \
  if (::prctl(PR_GET_SECCOMP) < 0) GTEST_SKIP() << "not tested: this kernel lacks seccomp"

TEST(CallFilter, WhatIsNotListedIsUnknown) {
  SKIP_WITHOUT_SECCOMP();
  const auto nothing = [](CallFilter&) {};
  EXPECT_EQ(code_of(nothing, [] { return error_of(::open("/dev/null", O_RDONLY)); }), ENOSYS);
  EXPECT_EQ(code_of(nothing, [] { return error_of(::syscall(SYS_getuid)); }), ENOSYS);
  EXPECT_EQ(code_of([](CallFilter& filter) { filter.add(allow, {SYS_getuid}); },
                    [] { return error_of(::syscall(SYS_getuid)); }),
            0);
#if defined(__x86_64__)
  // The same call by its number in programs with 32-bit pointers.
  EXPECT_EQ(code_of(
                [](CallFilter& filter) {
                  filter.add(allow, {SYS_getuid, SYS_getuid | 0x40000000});
                },
                [] { return error_of(::syscall(SYS_getuid | 0x40000000)); }),
            ENOSYS);
#endif
}

TEST(CallFilter, ArgumentsDecide) {
  SKIP_WITHOUT_SECCOMP();
  const auto questions = [](CallFilter& filter) {
    filter.add(allow, SYS_fcntl, {1, ~0u, F_GETFD});
    filter.add(no_terminal, SYS_fcntl, {1, ~0u, F_GETFL});
  };
  EXPECT_EQ(code_of(questions, [] { return error_of(::fcntl(0, F_GETFD)); }), 0);
  EXPECT_EQ(code_of(questions, [] { return error_of(::fcntl(0, F_GETFL)); }), ENOTTY);
  EXPECT_EQ(code_of(questions, [] { return error_of(::fcntl(0, F_DUPFD)); }), ENOSYS);
  const auto reading = [](CallFilter& filter) { filter.add(allow, SYS_openat, {2, O_ACCMODE | O_CREAT, O_RDONLY}); };
  EXPECT_EQ(code_of(reading, [] { return error_of(::openat(AT_FDCWD, "/dev/null", O_RDONLY | O_CLOEXEC)); }), 0);
  EXPECT_EQ(code_of(reading, [] { return error_of(::openat(AT_FDCWD, "/dev/null", O_WRONLY)); }), ENOSYS);
}

/// An address may have nothing in its lower half.
TEST(CallFilter, WideArgumentsAreLookedAtWhole) {
  SKIP_WITHOUT_SECCOMP();
  const auto no_address = [](CallFilter& filter) { filter.add(allow, SYS_getrlimit, {1, ~0u, 0, true}); };
  EXPECT_EQ(code_of(no_address, [] { return error_of(::syscall(SYS_getrlimit, RLIMIT_CORE, 0L)); }), EFAULT);
  EXPECT_EQ(code_of(no_address, [] { return error_of(::syscall(SYS_getrlimit, RLIMIT_CORE, 1L << 32)); }), ENOSYS);
}

TEST(CallFilter, SomeCallsEndTheProcess) {
  SKIP_WITHOUT_SECCOMP();
  EXPECT_EQ(code_of([](CallFilter& filter) { filter.add(kill_process, {SYS_getppid}); },
                    [] { return error_of(::syscall(SYS_getppid)); }),
            1000 + SIGSYS);
}

}  // namespace
}  // namespace tisserand::call_filter_test
