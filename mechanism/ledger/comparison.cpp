// SPDX-License-Identifier: GPL-3.0-or-later
// Comparison of rows at equal instants, measure by measure.
#include "mechanism/ledger/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "common/stable_sort.hpp"

namespace tisserand::mechanism {
namespace {

/// Fraction of the size of the scene. Smaller motions are within tolerances and count as rest.
constexpr double least_size = 1e-9;

}  // namespace

void Comparison::add(const WindowHistory& own, const WindowHistory& other) {
  if (!own.measures || !other.measures || own.time.empty()) return;
  const std::vector<int> there = own.measures->places_in(*other.measures);
  const double round_off = 1e-9 * (own.time.back() - own.time.front());
  const std::size_t rows = std::min(own.rows.size(), other.rows.size());
  for (std::size_t k = 0; k < rows; ++k) {
    if (std::abs(own.time[k] - other.time[k]) > round_off) continue;
    for (std::size_t i = 0; i < there.size(); ++i)
      if (there[i] >= 0)
        note(own.measures->list()[i], sizes_.of(i),
             (own.rows[k].col(static_cast<Eigen::Index>(i)) - other.rows[k].col(there[i])).norm());
  }
}

void Comparison::note(const Measured& measured, double size, double difference) {
  const bool is_length = measured.kind == MeasureKind::position || measured.kind == MeasureKind::deflection;
  if (is_length && size < least_size * length_) size = length_;
  if (!(size > 0.0) || !(difference >= 0.0)) return;  // not a number: no value in this row
  LedgerChange& change = largest_[measured.kind];
  const double part = difference / size;
  if (part > change.part || change.of.empty()) change = {measured.name, std::max(part, 0.0)};
}

std::vector<LedgerChange> Comparison::changes() const {
  std::vector<LedgerChange> list;
  for (const auto& [kind, change] : largest_) list.push_back(change);
  sort_stably(list, std::greater{}, &LedgerChange::part);
  return list;
}

}  // namespace tisserand::mechanism
