// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities that the ledger compares: positions, deflections and reactions, or channels that the user names.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// Kinds of measures: position of a place, direction of an axis of a body, reaction force of a joint, value of a
/// channel. A deflection is that of a node against the first node of its body, in axes of this first node.
enum class MeasureKind { position, deflection, direction, force, channel };
struct Measured {
  MeasureKind kind = MeasureKind::position;
  std::string name;   ///< "nodes/position/rod/mid", "deflection of rod/mid"
  std::string group;  ///< changes are compared with the largest size in the group
};

/// Values of one row: three per measure. A channel has one value and two zeros.
using MeasuredRow = Eigen::Matrix3Xd;

/// Reads the measures from the rows of a layout. Another layout of the same scene may lack some of them.
class Measures {
 public:
  enum class Missing { is_error, is_left_out };
  /// Default without `channels`: positions of all places, axes of all bodies with a node of their name, deflections of
  /// all deformable bodies, forces of all joints. Throws Error for a missing channel if `missing` is is_error.
  Measures(const formats::Scene& scene, const formats::ResultsLayout& layout, const std::vector<std::string>& channels,
           Missing missing);

  const std::vector<Measured>& list() const { return list_; }
  /// Values of all measures in a row; not-a-number where the row has no value.
  MeasuredRow values(const formats::ResultsRow& row) const;
  /// Index of each measure in the list of `other`; −1 if it is missing there.
  std::vector<int> places_in(const Measures& other) const;

 private:
  /// Source of a measure in a row: column of a node, of a joint or of a channel.
  struct Source {
    int index = 0;
    int base = -1;  ///< deflections: first node of the body; directions: number of the axis
    const double* (*values)(const formats::ResultsRow&) = nullptr;
  };

  void add_defaults(const formats::Scene& scene, const formats::ResultsLayout& layout, Missing missing);
  void add_channel(const std::string& given, const formats::ResultsLayout& layout, const std::string& where,
                   Missing missing);

  std::vector<Measured> list_;
  std::vector<Source> sources_;
};

/// Size of each group: largest value (forces, channels) or largest distance from the first row (others).
class MeasureSizes {
 public:
  explicit MeasureSizes(const std::vector<Measured>& list);
  void observe(const MeasuredRow& row);
  /// Size of the group of measure i.
  double of(std::size_t i) const { return group_size_[static_cast<std::size_t>(group_of_[i])]; }

 private:
  std::vector<bool> from_first_;
  std::vector<int> group_of_;
  std::vector<double> group_size_;
  MeasuredRow first_;
};

}  // namespace tisserand::mechanism
