// The door: rlimits, Landlock and seccomp.
#include "reducer/gmsh/door.hpp"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sched.h>
#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <initializer_list>
#include <new>

#include "reducer/mesher/parcel.hpp"

namespace tisserand::reducer {
namespace {

void limit(int resource, double value) {
  const auto whole = static_cast<rlim_t>(std::ceil(std::min(value, 1e18)));
  const rlimit both{whole, resource == RLIMIT_CPU ? whole + 2 : whole};  // SIGXCPU says why; SIGKILL if it is ignored
  ::setrlimit(static_cast<__rlimit_resource>(resource), &both);
}

int landlock_version() {
  return static_cast<int>(::syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION));
}

/// All rights that this kernel can withhold and these headers know.
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
  if (rule.parent_fd < 0) return true;  // then nothing is opened there
  const bool done = ::syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0) == 0;
  ::close(rule.parent_fd);
  return done;
}

bool is_alone() {
  std::error_code error;
  const std::filesystem::directory_iterator threads("/proc/self/task", error);
  return !error && std::distance(begin(threads), end(threads)) == 1;
}

using Calls = std::initializer_list<int>;

/// What reading, computing, threads and giving up need. Through pipes to themselves sanitizers see which memory is
/// there.
constexpr Calls harmless{SCMP_SYS(read),
                         SCMP_SYS(pread64),
                         SCMP_SYS(readv),
                         SCMP_SYS(write),
                         SCMP_SYS(writev),
                         SCMP_SYS(lseek),
                         SCMP_SYS(_llseek),
                         SCMP_SYS(close),
                         SCMP_SYS(fstat),
                         SCMP_SYS(fstat64),
                         SCMP_SYS(stat),
                         SCMP_SYS(stat64),
                         SCMP_SYS(lstat),
                         SCMP_SYS(lstat64),
                         SCMP_SYS(newfstatat),
                         SCMP_SYS(fstatat64),
                         SCMP_SYS(statx),
                         SCMP_SYS(access),
                         SCMP_SYS(faccessat),
                         SCMP_SYS(faccessat2),
                         SCMP_SYS(readlink),
                         SCMP_SYS(readlinkat),
                         SCMP_SYS(getcwd),
                         SCMP_SYS(getdents64),
                         SCMP_SYS(dup),
                         SCMP_SYS(poll),
                         SCMP_SYS(ppoll),
                         SCMP_SYS(munmap),
                         SCMP_SYS(mprotect),
                         SCMP_SYS(mremap),
                         SCMP_SYS(madvise),
                         SCMP_SYS(brk),
                         SCMP_SYS(futex),
                         SCMP_SYS(futex_time64),
                         SCMP_SYS(set_robust_list),
                         SCMP_SYS(rseq),
                         SCMP_SYS(set_tid_address),
                         SCMP_SYS(exit),
                         SCMP_SYS(exit_group),
                         SCMP_SYS(rt_sigaction),
                         SCMP_SYS(rt_sigprocmask),
                         SCMP_SYS(rt_sigreturn),
                         SCMP_SYS(sigreturn),
                         SCMP_SYS(sigaltstack),
                         SCMP_SYS(restart_syscall),
                         SCMP_SYS(sched_yield),
                         SCMP_SYS(sched_getaffinity),
                         SCMP_SYS(membarrier),
                         SCMP_SYS(gettid),
                         SCMP_SYS(getpid),
                         SCMP_SYS(getppid),
                         SCMP_SYS(getuid),
                         SCMP_SYS(geteuid),
                         SCMP_SYS(getgid),
                         SCMP_SYS(getegid),
                         SCMP_SYS(uname),
                         SCMP_SYS(sysinfo),
                         SCMP_SYS(getrlimit),
                         SCMP_SYS(ugetrlimit),
                         SCMP_SYS(getrusage),
                         SCMP_SYS(times),
                         SCMP_SYS(time),
                         SCMP_SYS(gettimeofday),
                         SCMP_SYS(clock_gettime),
                         SCMP_SYS(clock_gettime64),
                         SCMP_SYS(clock_getres),
                         SCMP_SYS(clock_nanosleep),
                         SCMP_SYS(clock_nanosleep_time64),
                         SCMP_SYS(nanosleep),
                         SCMP_SYS(getrandom),
                         SCMP_SYS(getcpu),
                         SCMP_SYS(pipe),
                         SCMP_SYS(pipe2)};

/// What no geometry does by accident: the process ends, and its parent says why. Sockets are not among them: the C
/// library asks for names of users through one, which OpenCASCADE wants to know for IGES.
constexpr Calls harmful{
    SCMP_SYS(execve),    SCMP_SYS(execveat),  SCMP_SYS(fork),      SCMP_SYS(vfork),    SCMP_SYS(mkdir),
    SCMP_SYS(mkdirat),   SCMP_SYS(rmdir),     SCMP_SYS(unlink),    SCMP_SYS(unlinkat), SCMP_SYS(rename),
    SCMP_SYS(renameat),  SCMP_SYS(renameat2), SCMP_SYS(link),      SCMP_SYS(linkat),   SCMP_SYS(symlink),
    SCMP_SYS(symlinkat), SCMP_SYS(truncate),  SCMP_SYS(ftruncate), SCMP_SYS(chmod),    SCMP_SYS(fchmod),
    SCMP_SYS(fchmodat),  SCMP_SYS(chown),     SCMP_SYS(fchown),    SCMP_SYS(lchown),   SCMP_SYS(fchownat),
    SCMP_SYS(mknod),     SCMP_SYS(mknodat),   SCMP_SYS(ptrace),    SCMP_SYS(kill)};

/// Condition on the argument at a position; SCMP_A0 and the like are compound literals, which C++ does not have.
constexpr scmp_arg_cmp argument(unsigned position, scmp_compare compare, scmp_datum_t a, scmp_datum_t b = 0) {
  return {position, compare, a, b};
}

/// Rules that look at arguments too.
bool add_conditional(scmp_filter_ctx filter) {
  constexpr scmp_datum_t writing = O_ACCMODE | O_CREAT | O_TRUNC, thread = CLONE_THREAD | CLONE_VM | CLONE_SIGHAND,
                         uncounted = MAP_TYPE | MAP_GROWSDOWN;
  const auto own = static_cast<scmp_datum_t>(::getpid());
  const auto allow = [filter](int call, const scmp_arg_cmp& condition) {
    return seccomp_rule_add(filter, SCMP_ACT_ALLOW, call, 1, condition) == 0;
  };
  bool done = allow(SCMP_SYS(open), argument(1, SCMP_CMP_MASKED_EQ, writing, O_RDONLY)) &&
              allow(SCMP_SYS(openat), argument(2, SCMP_CMP_MASKED_EQ, writing, O_RDONLY)) &&
              allow(SCMP_SYS(clone), argument(0, SCMP_CMP_MASKED_EQ, thread, thread)) &&
              allow(SCMP_SYS(tgkill), argument(0, SCMP_CMP_EQ, own)) &&
              // Nothing shared and no stacks: the limit of memory would not count them.
              allow(SCMP_SYS(mmap), argument(3, SCMP_CMP_MASKED_EQ, uncounted, MAP_PRIVATE)) &&
              allow(SCMP_SYS(mmap2), argument(3, SCMP_CMP_MASKED_EQ, uncounted, MAP_PRIVATE)) &&
              allow(SCMP_SYS(prlimit64), argument(2, SCMP_CMP_EQ, 0));
  for (const int question : {F_GETFD, F_SETFD, F_GETFL})
    done = done && allow(SCMP_SYS(fcntl), argument(1, SCMP_CMP_EQ, static_cast<scmp_datum_t>(question)));
  // Without CLONE_VM or CLONE_THREAD a clone is a process, as in posix_spawn and system.
  for (const scmp_datum_t flag : {CLONE_THREAD, CLONE_VM, CLONE_SIGHAND})
    done = done && seccomp_rule_add(filter, SCMP_ACT_KILL_PROCESS, SCMP_SYS(clone), 1,
                                    argument(0, SCMP_CMP_MASKED_EQ, flag, 0)) == 0;
  return done && seccomp_rule_add(filter, SCMP_ACT_ERRNO(ENOTTY), SCMP_SYS(ioctl), 0) == 0;
}

bool add_all(scmp_filter_ctx filter, Calls calls, std::uint32_t action) {
  return std::ranges::all_of(calls, [&](int call) { return seccomp_rule_add(filter, action, call, 0) == 0; });
}

}  // namespace

void set_limits(double seconds, double bytes) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  limit(RLIMIT_CORE, 0.0);
  limit(RLIMIT_CPU, seconds);
#if !defined(__SANITIZE_ADDRESS__)
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
  // As on a kernel that knows no other calls: libraries then do without, also without clone3 and openat2, whose
  // arguments a filter cannot see.
  const scmp_filter_ctx filter = seccomp_init(SCMP_ACT_ERRNO(ENOSYS));
  if (filter == nullptr) return false;
  const bool done = add_all(filter, harmless, SCMP_ACT_ALLOW) && add_all(filter, harmful, SCMP_ACT_KILL_PROCESS) &&
                    add_conditional(filter) && seccomp_attr_set(filter, SCMP_FLTATR_CTL_TSYNC, 1) == 0 &&
                    seccomp_load(filter) == 0;
  seccomp_release(filter);
  return done;
}

}  // namespace tisserand::reducer
