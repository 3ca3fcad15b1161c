// Which system calls this process may still make: seccomp, written without a library.
#pragma once

#include <linux/filter.h>

#include <cstdint>
#include <initializer_list>
#include <vector>

namespace tisserand {

/// A list of rules, the first of which that fits decides. What fits none is answered as by a kernel that does not know
/// the call: libraries then do without.
class CallFilter {
 public:
  enum class Action : std::uint32_t { allow, kill_process, no_terminal };

  /// (argument & mask) == value. `wide`: all 64 bits of it count, of others the lower 32.
  struct Condition {
    unsigned argument = 0;
    std::uint32_t mask = 0;
    std::uint32_t value = 0;
    bool wide = false;
  };

  CallFilter();
  void add(Action action, std::initializer_list<long> calls);
  void add(Action action, long call, const Condition& condition);

  /// From here on, in all threads and in what they start. False if the kernel, a container or the processor forbids it.
  [[nodiscard]] bool install() const;

 private:
  void load(std::uint32_t offset);
  void unless_equal(std::uint32_t value, std::uint8_t skip);
  void conclude(std::uint32_t result);

  std::vector<sock_filter> code_;
};

}  // namespace tisserand
