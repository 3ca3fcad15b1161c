// SPDX-License-Identifier: GPL-3.0-or-later
// Differences of two motions over the same windows.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/ledger/replay.hpp"

namespace tisserand::mechanism {

/// Largest change of one kind of measure by an effect.
struct LedgerChange {
  std::string of;     ///< name of the measure that changes most
  double part = 0.0;  ///< change, as a fraction of the size of its group
};

/// Comparison of two motions over the same windows. It finds the largest difference of each kind of measure at equal
/// instants, relative to the size of the group of the measure. If a group does not move, lengths are compared with the
/// size of the scene.
class Comparison {
 public:
  /// Starts a comparison without windows. `sizes`: sizes of the measures of the reference motion, which must outlive
  /// this object. `length`: size of the scene.
  Comparison(const MeasureSizes& sizes, double length) : sizes_(sizes), length_(length) {}

  /// Adds one window of both motions: `own` of the reference, `other` of the motion to compare.
  void add(const WindowHistory& own, const WindowHistory& other);
  /// Largest change of each kind of measure, in descending order.
  std::vector<LedgerChange> changes() const;

 private:
  void note(const Measured& measured, double size, double difference);

  const MeasureSizes& sizes_;
  double length_;
  std::map<MeasureKind, LedgerChange> largest_;
};

}  // namespace tisserand::mechanism
