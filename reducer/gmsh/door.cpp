// SPDX-License-Identifier: GPL-3.0-or-later
// Sandbox: rlimits, Landlock and the filter of system calls.
#include "reducer/gmsh/door.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <filesystem>

#include "common/confined/call_filter.hpp"
#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {
namespace {

void limit(int resource, double value) {
  const auto whole = static_cast<rlim_t>(std::ceil(std::min(value, 1e18)));
  const rlimit both{whole, resource == RLIMIT_CPU ? whole + 2 : whole};  // SIGXCPU shows the reason; SIGKILL if ignored
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

int landlock_version() {
  return static_cast<int>(::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
}

/// All access rights that this kernel can restrict and these headers define.
std::uint64_t withheld_rights(int version) {
  std::uint64_t rights = LANDLOCK_ACCESS_FS_REFER - 1;  // version 1
  if (version >= 2) rights |= LANDLOCK_ACCESS_FS_REFER;
#ifdef LANDLOCK_ACCESS_FS_TRUNCATE
  if (version >= 3) rights |= LANDLOCK_ACCESS_FS_TRUNCATE;
#endif
#ifdef LANDLOCK_ACCESS_FS_IOCTL_DEV
  if (version >= 5) rights |= LANDLOCK_ACCESS_FS_IOCTL_DEV;
#endif
  return rights;
}

bool allow_reading(int rules, const std::string& path, std::uint64_t rights) {
  landlock_path_beneath_attr rule{};
  rule.allowed_access = rights;
  rule.parent_fd = ::open(path.c_str(), O_PATH | O_CLOEXEC);
  if (rule.parent_fd < 0) return true;  // then nothing can be opened there
  const bool done = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
  ::close(rule.parent_fd);
  return done;
}

bool is_alone() {
  std::error_code error;
  const std::filesystem::directory_iterator threads("/proc/self/task", error);
  return !error && std::distance(begin(threads), end(threads)) == 1;
}

/// Allows system calls for reading, computing, threads and the end. Sanitizers test addresses through pipes to
/// themselves.
void allow_harmless(CallFilter& filter) {
  using enum CallFilter::Action;
  filter.add(allow, {SYS_read,
                     SYS_pread64,
                     SYS_readv,
                     SYS_write,
                     SYS_writev,
                     SYS_lseek,
                     SYS_close,
                     SYS_fstat,
                     SYS_newfstatat,
                     SYS_statx,
                     SYS_faccessat,
                     SYS_faccessat2,
                     SYS_readlinkat,
                     SYS_getcwd,
                     SYS_getdents64,
                     SYS_dup,
                     SYS_ppoll,
                     SYS_munmap,
                     SYS_mprotect,
                     SYS_mremap,
                     SYS_madvise,
                     SYS_brk,
                     SYS_futex,
                     SYS_set_robust_list,
                     SYS_rseq,
                     SYS_set_tid_address,
                     SYS_exit,
                     SYS_exit_group,
                     SYS_rt_sigaction,
                     SYS_rt_sigprocmask,
                     SYS_rt_sigreturn,
                     SYS_sigaltstack,
                     SYS_restart_syscall,
                     SYS_sched_yield,
                     SYS_sched_getaffinity,
                     SYS_membarrier,
                     SYS_gettid,
                     SYS_getpid,
                     SYS_getppid,
                     SYS_getuid,
                     SYS_geteuid,
                     SYS_getgid,
                     SYS_getegid,
                     SYS_uname,
                     SYS_sysinfo,
                     SYS_getrlimit,
                     SYS_getrusage,
                     SYS_times,
                     SYS_gettimeofday,
                     SYS_clock_gettime,
                     SYS_clock_getres,
                     SYS_getrandom,
                     SYS_getcpu,
                     SYS_pipe2});
#if defined(__x86_64__)  // newer processors lack these and use others of the list
  filter.add(allow, {SYS_stat, SYS_lstat, SYS_access, SYS_readlink, SYS_poll, SYS_time, SYS_pipe});
#endif
}

/// Kills the process at calls that no geometry makes by accident; its parent reports the reason. Only `Sleep` of gmsh's
/// language sleeps. Sockets are not killed: the C library uses one to look up user names, which OpenCASCADE needs for
/// IGES.
void kill_harmful(CallFilter& filter) {
  using enum CallFilter::Action;
  filter.add(kill_process,
             {SYS_execve, SYS_execveat, SYS_mkdirat, SYS_unlinkat, SYS_renameat, SYS_renameat2, SYS_linkat,
              SYS_symlinkat, SYS_truncate, SYS_ftruncate, SYS_fchmod, SYS_fchmodat, SYS_fchown, SYS_fchownat,
              SYS_mknodat, SYS_ptrace, SYS_kill, SYS_nanosleep, SYS_clock_nanosleep});
#if defined(__x86_64__)
  filter.add(kill_process, {SYS_fork, SYS_vfork, SYS_mkdir, SYS_rmdir, SYS_unlink, SYS_rename, SYS_link, SYS_symlink,
                            SYS_chmod, SYS_chown, SYS_lchown, SYS_mknod});
#endif
}

/// Adds rules that also check arguments.
void add_conditional(CallFilter& filter) {
  using enum CallFilter::Action;
  constexpr std::uint32_t writing = O_ACCMODE | O_CREAT | O_TRUNC, thread = CLONE_THREAD | CLONE_VM | CLONE_SIGHAND,
                          uncounted = MAP_TYPE | MAP_GROWSDOWN, all = ~0u;
#if defined(__x86_64__)
  filter.add(allow, SYS_open, {1, writing, O_RDONLY});
#endif
  filter.add(allow, SYS_openat, {2, writing, O_RDONLY});
  // A clone without CLONE_VM or CLONE_THREAD is a process, as in posix_spawn and system.
  filter.add(allow, SYS_clone, {0, thread, thread});
  for (const std::uint32_t flag : {CLONE_THREAD, CLONE_VM, CLONE_SIGHAND})
    filter.add(kill_process, SYS_clone, {0, flag, 0});
  filter.add(allow, SYS_tgkill, {0, all, static_cast<std::uint32_t>(::getpid())});
  // No shared mappings and no stacks: the limit of memory would not count them.
  filter.add(allow, SYS_mmap, {3, uncounted, MAP_PRIVATE});
  filter.add(allow, SYS_prlimit64, {2, all, 0, true});
  for (const std::uint32_t question : {F_GETFD, F_SETFD, F_GETFL}) filter.add(allow, SYS_fcntl, {1, all, question});
  filter.add(no_terminal, {SYS_ioctl});
}

}  // namespace

void set_limits(double seconds, double bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0.0);
  limit(RLIMIT_CPU, seconds);
#if !defined(TISSERAND_SANITIZED)
  limit(RLIMIT_DATA, bytes);
#else
  static_cast<void>(bytes);
#endif
  std::set_new_handler([] { ::_exit(out_of_memory_code); });
}

bool close_paths(const std::string& file, bool whole_folder) {
  const int version = landlock_version();
  if (version < 1 || !is_alone()) return false;
  landlock_ruleset_attr handled{};
  handled.handled_access_fs = withheld_rights(version);
  const int rules = static_cast<int>(::syscall(SYS_landlock_create_ruleset, &handled, sizeof handled, 0));
  if (rules < 0) return false;
  bool done = allow_reading(rules, file, LANDLOCK_ACCESS_FS_READ_FILE);
  if (whole_folder) {
    const std::string folder = std::filesystem::path(file).parent_path().string();
    done = done && allow_reading(rules, folder.empty() ? "." : folder,
                                 LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR);
  }
  done = done && ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && ::syscall(SYS_landlock_restrict_self, rules, 0) == 0;
  ::close(rules);
  return done;
}

bool close_calls() {
  limit(RLIMIT_FSIZE, 0.0);
  // Other calls fail as on a kernel without them. Libraries then use alternatives, also for clone3 and openat2, whose
  // arguments a filter cannot see.
  CallFilter filter;
  allow_harmless(filter);
  kill_harmful(filter);
  add_conditional(filter);
  return filter.install();
}

}  // namespace tisserand::reducer
