// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of inertia options with F, or with one another.
#include "mechanism/ledger/inertia_verdict.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "common/text.hpp"
#include "mechanism/ledger/table.hpp"

namespace tisserand::mechanism {
namespace {

/// Largest relative difference from F at which an option is called right.
constexpr double right_option = 0.01;

double difference(const InertiaRun& a, const InertiaRun& b, const MeasureSizes& sizes, double length) {
  Comparison comparison(sizes, length);
  for (std::size_t w = 0; w < a.windows->size(); ++w) comparison.add((*a.windows)[w], (*b.windows)[w]);
  const std::vector<LedgerChange> changes = comparison.changes();
  return changes.empty() ? 0.0 : changes.front().part;
}

std::string verdict_among_equals(const std::string& body, const std::vector<InertiaRun>& runs,
                                 const MeasureSizes& sizes, double length) {
  double largest = 0.0;
  for (const InertiaRun& a : runs)
    for (const InertiaRun& b : runs) largest = std::max(largest, difference(a, b, sizes, length));
  if (largest <= right_option)
    return fmt::format("inertia of '{}': its options agree within {}, so any of them is right", body,
                       percent_text(largest));
  return fmt::format(
      "inertia of '{}': its options differ by up to {}. Without F (a companion file) it is not known which of them is "
      "right. Write a companion file, or cut the body into several superelements",
      body, percent_text(largest));
}

}  // namespace

std::string inertia_verdict(const std::string& body, const std::vector<InertiaRun>& runs, const MeasureSizes& sizes,
                            double length) {
  const auto best = std::ranges::find(runs, "F", &InertiaRun::option);
  if (best == runs.end()) return verdict_among_equals(body, runs, sizes, length);
  const InertiaRun* right = &*best;
  std::vector<std::string> parts;
  for (const InertiaRun& run : runs) {
    if (&run == &*best) continue;
    const double error = difference(*best, run, sizes, length);
    parts.push_back(fmt::format("{} {}", run.option, percent_text(error)));
    if (run.differs != nullptr) *run.differs = error;
    if (error <= right_option && run.cost < right->cost) right = &run;
  }
  return fmt::format("inertia of '{}': difference from F, which contains all of the mass: {}. Use {}", body,
                     join(parts, ", "), right->option);
}

}  // namespace tisserand::mechanism
