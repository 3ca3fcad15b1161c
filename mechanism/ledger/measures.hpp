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

/// Kind of a measure: position of a place, deflection of a node, direction of an axis of a body, reaction force of a
/// joint, value of a channel. A deflection is the position of a node relative to the first node of its body, in axes of
/// this first node.
enum class MeasureKind { position, deflection, direction, force, channel };
/// Quantity that a ledger compares.
struct Measured {
  MeasureKind kind = MeasureKind::position;
  std::string name;  ///< name such as "nodes/position/rod/mid", "deflection of rod/mid"
  /// Name of a group of measures. Changes are relative to the largest size in the group.
  std::string group;
};

/// Values of all measures in one row (3 x measures). A channel has one value and two zeros.
using MeasuredRow = Eigen::Matrix3Xd;

/// List of the measures of a scene, and their values in the rows of a layout. Another layout of the same scene may lack
/// some measures.
class Measures {
 public:
  enum class Missing { is_error, is_left_out };
  /// Makes the list from the channels that `channels` selects. If `channels` is empty, the list has the positions of
  /// all nodes in the layout, the deflections of deformable bodies and the forces of all joints. It also has the x and
  /// y axes of each body whose name is also the name of a node, as for rigid bodies. Throws Error for a missing channel
  /// if `missing` is is_error.
  Measures(const formats::Scene& scene, const formats::ResultsLayout& layout, const std::vector<std::string>& channels,
           Missing missing);

  const std::vector<Measured>& list() const { return list_; }
  /// Values of all measures in a row. They are not-a-number where the row has no value.
  MeasuredRow values(const formats::ResultsRow& row) const;
  /// Indices of the measures in the list of `other`; −1 where a measure is missing there.
  std::vector<int> places_in(const Measures& other) const;

 private:
  /// Source of a measure in a row: column of a node, of a joint or of a channel.
  struct Source {
    int index = 0;
    int base = -1;  ///< for deflections: column of the first node of the body; for directions: number of the axis
    const double* (*values)(const formats::ResultsRow&) = nullptr;
  };

  void add_defaults(const formats::Scene& scene, const formats::ResultsLayout& layout, Missing missing);
  void add_channel(const std::string& given, const formats::ResultsLayout& layout, const std::string& where,
                   Missing missing);

  std::vector<Measured> list_;
  std::vector<Source> sources_;
};

/// Size of each group of measures over the observed rows. For forces and channels it is the largest value, for other
/// measures the largest distance from the first row.
class MeasureSizes {
 public:
  explicit MeasureSizes(const std::vector<Measured>& list);
  /// Updates the sizes by a row.
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
