// SPDX-License-Identifier: GPL-3.0-or-later
// Restricts the system calls of this process by seccomp, without a library.
#pragma once

#include <linux/filter.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace tisserand {

/// Filter of system calls (seccomp): a list of rules, of which the first that matches a call decides. A call without a
/// match fails as in a kernel that does not know it, so libraries use their fallback.
class CallFilter {
 public:
  enum class Action : std::uint32_t { allow, kill_process, no_terminal };

  /// Condition on argument number `argument` of a call: (argument & mask) == value. `wide`: compares all 64 bits;
  /// otherwise the lower 32.
  struct Condition {
    unsigned argument = 0;
    std::uint32_t mask = 0;
    std::uint32_t value = 0;
    bool wide = false;
  };

  CallFilter();
  void add(Action action, std::initializer_list<long> calls);
  void add(Action action, long call, const Condition& condition);

  /// Activates the rules for all threads and children of this process. Returns false if the kernel, a container or the
  /// processor forbids it.
  [[nodiscard]] bool install() const;

 private:
  void load(std::uint32_t offset);
  void unless_equal(std::uint32_t value, std::uint8_t skip);
  void conclude(std::uint32_t result);

  std::vector<sock_filter> code_;
};

}  // namespace tisserand
