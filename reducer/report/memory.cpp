// Need and supply of memory.
#include "reducer/report/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "common/error.hpp"

namespace tisserand::reducer {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double gigabyte = 1e9;

/// A number of bytes that stands alone in a file of the kernel; without the file or with a word in it: no limit.
double number_in(const std::string& path) {
  std::ifstream file(path);
  double value = 0.0;
  return file >> value ? value : unlimited;
}

double of_machine() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word)
    if (double kilobytes = 0.0; word == "MemAvailable:" && file >> kilobytes) return 1024.0 * kilobytes;
  return unlimited;
}

double of_control_group() {
  const double most = number_in("/sys/fs/cgroup/memory.max");
  return most == unlimited ? unlimited : most - number_in("/sys/fs/cgroup/memory.current");
}

double of_limits() {
  rlimit limit{};
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return unlimited;
  std::ifstream file("/proc/self/statm");
  double pages = 0.0;
  file >> pages;
  return static_cast<double>(limit.rlim_cur) - 4096.0 * pages;
}

}  // namespace

double memory_need(const FactorCost& cost, double stored_entries, const Partition& p, int modes) {
  constexpr double entry = 12.0, blocks = 8.0 * 8.0;
  const auto n = static_cast<double>(p.n_I());
  const double permuted = 2.0 * entry * stored_entries;
  const double basis = std::min(n, 2.0 * modes + 80.0);
  const double vectors = 8.0 * n * (static_cast<double>(p.n_B()) + basis + blocks);
  return cost.bytes() + std::max(permuted, vectors);
}

double available_memory() { return std::min({of_machine(), of_control_group(), of_limits()}); }

void require_memory(double need, double available, const Partition& p, const std::string& where) {
  if (need <= available) return;
  throw Error(
      fmt::format("the reduction of {} internal coordinates needs {:.3g} GB of memory more, but {:.3g} GB are free",
                  p.n_I(), need / gigabyte, available / gigabyte),
      where, "use fewer elements or modes, or a machine with more memory");
}

Factor factor_inside(const Blocks& blocks, const Partition& p, const formats::Part& part,
                     const std::function<void(const std::string&)>& begin) {
  begin("ordering");
  if (p.n_I() == 0) return {};
  return Factor(blocks.S_II, [&](const FactorCost& cost) {
    const SymmetricRows rows = symmetric_rows(blocks.S_II);
    const double need = memory_need(cost, rows.begin[rows.size], p, part.modes.count);
    require_memory(need, available_memory(), p, part.file);
    begin(fmt::format("factorisation ({:.2g} GB)", need / gigabyte));
  });
}

}  // namespace tisserand::reducer
