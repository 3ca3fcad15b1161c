// SPDX-License-Identifier: GPL-3.0-or-later
// Required and available memory.
#include "reducer/report/memory.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <limits>

#include <fmt/format.h>

#include "common/error.hpp"
#include "reducer/algebra/ranks.hpp"

namespace tisserand::reducer {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();
constexpr double gigabyte = 1e9;

/// Number of bytes in a file of the kernel; infinite without the file or with a word in it.
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

/// Upper limit of the number of vectors that are not modes, which are held four times while they are made.
int ritz_vectors(const formats::ModeSelection& modes, const Partition& p) {
  constexpr int rigid = 6;
  if (modes.method != formats::ReductionMethod::craig_bampton) return modes.count + rigid;
  const auto most = static_cast<int>(p.n_B());
  return modes.moments ? std::min(*modes.moments, most) : modes.accuracy ? most : 0;
}

/// Number of pairs of shapes, whose forces are also held four times, after the modes (trapped_energy()).
int pairs_of(int shapes) { return shapes * (shapes + 1) / 2; }

/// Text ", about 12 s" for a number of operations, by the rate of a dense matrix product; empty below 2 s.
std::string time_text(double operations) {
  constexpr double quick = 1e10, reported = 2.0;
  if (operations < quick) return "";
  constexpr Eigen::Index n = 384;
  constexpr double share_of_rate = 0.65;  // as measured for supernodal factorisations
  const Eigen::MatrixXd A = Eigen::MatrixXd::Constant(n, n, 0.5);
  Eigen::MatrixXd B(n, n);
  double best = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < 3; ++trial) {
    const auto start = std::chrono::steady_clock::now();
    B.noalias() = A * A;
    best = std::min(best, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  const double seconds = operations * best / (share_of_rate * 2.0 * n * n * n);
  return seconds < reported ? "" : fmt::format(", about {:.0f} s", seconds);
}

constexpr double number = 8.0;  ///< bytes

/// Number of vectors in the search for `modes` pairs: its basis, and a block of solutions with their working memory.
double search_vectors(const Partition& p, int modes) {
  constexpr double blocks = 8.0 * 8.0;
  return std::min(static_cast<double>(p.n_I()), 2.0 * modes + 80.0) + blocks;
}

}  // namespace

double memory_need(const FactorCost& cost, double stored_entries, const Partition& p, int modes, int ritz_vectors) {
  constexpr double entry = 12.0;
  const auto n = static_cast<double>(p.n_I());
  const double permuted = 2.0 * entry * stored_entries;
  const double vectors = number * n * (static_cast<double>(p.n_B()) + search_vectors(p, modes) + 4.0 * ritz_vectors);
  return cost.bytes() + std::max(permuted, vectors);
}

double available_memory() { return std::min({of_machine(), of_control_group(), of_limits()}); }

void require_memory(double need, double available, const Partition& p, const std::string& where) {
  if (need <= available) return;
  throw Error(
      fmt::format(
          "the reduction of {} internal coordinates needs another {:.3g} GB of memory, but only {:.3g} GB are free",
          p.n_I(), need / gigabyte, available / gigabyte),
      where, "use fewer elements or modes, or a machine with more memory");
}

void require_memory_of_modes(int modes, const Partition& p, const std::string& where) {
  require_memory(number * static_cast<double>(p.n_I()) * search_vectors(p, modes), available_memory(), p, where);
}

Factor factor_inside(const Blocks& blocks, const Partition& p, const formats::Part& part, const PhaseListener& begin) {
  constexpr double reported = 0.5 * gigabyte;
  begin("ordering");
  if (p.n_I() == 0) return {};
  Factor factor(blocks.S_II, [&](const FactorCost& cost) {
    const SymmetricRows rows = symmetric_rows(blocks.S_II);
    const double here = static_cast<double>(ranks_beside_leader()) / rank_count();  // share of a spread factor
    const double need = memory_need({here * cost.entries, cost.operations}, rows.begin[rows.size], p, part.modes.count,
                                    std::max(ritz_vectors(part.modes, p), pairs_of(part.double_curvature)));
    const double available = available_memory();
    require_memory(need, available, p, part.file);
    if (need >= reported)
      begin.tell(fmt::format(
          "{} internal coordinates: factorisation and modes need about {:.2g} GB of memory, {:.3g} GB are free",
          p.n_I(), need / gigabyte, available / gigabyte));
    begin(fmt::format("factorisation ({:.2g} GB{})", need / gigabyte, time_text(cost.operations)));
  });
  factor.report_solutions(begin.solve);
  return factor;
}

}  // namespace tisserand::reducer
