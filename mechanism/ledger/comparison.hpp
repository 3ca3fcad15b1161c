// What two motions over the same windows differ by.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mechanism/ledger/replay.hpp"

namespace tisserand::mechanism {

struct LedgerChange {
  std::string of;     ///< name of what changes most
  double part = 0.0;  ///< of the size of its group
};

/// Adds up windows: the largest difference at the same instants of each kind of measure, over the size of its group.
/// Where a group does not move, lengths are compared with the size of the scene.
class Comparison {
 public:
  /// `sizes` of what `own` measures, which lives as long as this; `length` of the scene.
  Comparison(const MeasureSizes& sizes, double length) : sizes_(sizes), length_(length) {}

  void add(const WindowHistory& own, const WindowHistory& other);
  /// One of each kind, the largest first.
  std::vector<LedgerChange> changes() const;

 private:
  void note(const Measured& measured, double size, double difference);

  const MeasureSizes& sizes_;
  double length_;
  std::map<MeasureKind, LedgerChange> largest_;
};

}  // namespace tisserand::mechanism
