// SPDX-License-Identifier: GPL-3.0-or-later
// Translates the rules to instructions of the kernel's packet filter, which reads struct seccomp_data.
#include "common/confined/call_filter.hpp"

#include <linux/audit.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>

namespace tisserand {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t own_architecture = AUDIT_ARCH_X86_64;
constexpr std::uint32_t first_of_another_kind = 0x40000000;  // calls of programs with 32-bit pointers
#elif defined(__aarch64__)
constexpr std::uint32_t own_architecture = AUDIT_ARCH_AARCH64;
constexpr std::uint32_t first_of_another_kind = 0;
#else
constexpr std::uint32_t own_architecture = 0;
constexpr std::uint32_t first_of_another_kind = 0;
#endif
constexpr std::uint32_t unknown_call = SECCOMP_RET_ERRNO | ENOSYS;

std::uint32_t result_of(CallFilter::Action action) {
  switch (action) {
    case CallFilter::Action::allow:
      return SECCOMP_RET_ALLOW;
    case CallFilter::Action::kill_process:
      return SECCOMP_RET_KILL_PROCESS;
    case CallFilter::Action::no_terminal:
      return SECCOMP_RET_ERRNO | ENOTTY;
  }
  return unknown_call;
}

}  // namespace

CallFilter::CallFilter() {
  load(offsetof(seccomp_data, arch));
  unless_equal(own_architecture, 1);
  code_.push_back(BPF_JUMP(BPF_JMP | BPF_JA, 1, 0, 0));
  conclude(SECCOMP_RET_KILL_PROCESS);
  load(offsetof(seccomp_data, nr));
  if (first_of_another_kind == 0) return;
  code_.push_back(BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, first_of_another_kind, 0, 1));
  conclude(unknown_call);
}

void CallFilter::load(std::uint32_t offset) { code_.push_back(BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offset)); }

/// Skips `skip` instructions unless the word loaded last equals `value`.
void CallFilter::unless_equal(std::uint32_t value, std::uint8_t skip) {
  code_.push_back(BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, skip));
}

void CallFilter::conclude(std::uint32_t result) { code_.push_back(BPF_STMT(BPF_RET | BPF_K, result)); }

void CallFilter::add(Action action, std::initializer_list<long> calls) {
  for (const long call : calls) {
    unless_equal(static_cast<std::uint32_t>(call), 1);
    conclude(result_of(action));
  }
}

void CallFilter::add(Action action, long call, const Condition& condition) {
  // An argument has two halves. The lower one comes first on both processors.
  const auto low = static_cast<std::uint32_t>(offsetof(seccomp_data, args) + 8 * condition.argument);
  const std::uint8_t upper_half = condition.wide ? 2 : 0;
  unless_equal(static_cast<std::uint32_t>(call), static_cast<std::uint8_t>(5 + upper_half));
  load(low);
  code_.push_back(BPF_STMT(BPF_ALU | BPF_AND | BPF_K, condition.mask));
  unless_equal(condition.value, static_cast<std::uint8_t>(1 + upper_half));
  if (condition.wide) {
    load(low + 4);
    unless_equal(0, 1);
  }
  conclude(result_of(action));
  load(offsetof(seccomp_data, nr));
}

bool CallFilter::install() const {
  if (own_architecture == 0) return false;
  std::vector<sock_filter> code = code_;
  code.push_back(BPF_STMT(BPF_RET | BPF_K, unknown_call));
  const sock_fprog program{static_cast<unsigned short>(code.size()), code.data()};
  return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         ::syscall(SYS_seccomp, SECCOMP_SET_MODE_FILTER, SECCOMP_FILTER_FLAG_TSYNC, &program) == 0;
}

}  // namespace tisserand
