// What the ledger compares of two motions: places, deflections and reactions, or channels of the user.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/results/results.hpp"
#include "formats/scene/scene.hpp"

namespace tisserand::mechanism {

/// What is compared by name: a vector of a place, the deflection of a node against the first node of its body (in axes
/// of that node), the direction of an axis of a body, the reaction of a joint, or one number of a channel.
enum class MeasureKind { position, deflection, direction, force, channel };
struct Measured {
  MeasureKind kind = MeasureKind::position;
  std::string name;   ///< "nodes/position/rod/mid", "deflection of rod/mid"
  std::string group;  ///< the largest of a group is what changes are compared with
};

/// The values of one row: each measured thing has three (a channel one, and zeros).
using MeasuredRow = Eigen::Matrix3Xd;

/// Finds what is measured in the rows of a layout; another layout of the same scene may have less.
class Measures {
 public:
  enum class Missing { is_error, is_left_out };
  /// Without `channels`: positions of all places, axes of all bodies with a node of their name, deflections of all
  /// bodies that deform, forces of all joints. Throws Error for a channel that is missing where that is one.
  Measures(const formats::Scene& scene, const formats::ResultsLayout& layout, const std::vector<std::string>& channels,
           Missing missing);

  const std::vector<Measured>& list() const { return list_; }
  /// Not-a-number where the row has none.
  MeasuredRow values(const formats::ResultsRow& row) const;
  /// Where each of them stands in the list of another layout; −1: not there.
  std::vector<int> places_in(const Measures& other) const;

 private:
  /// Columns of a place in rows: of `node`, or of a joint, or of a channel.
  struct Source {
    int index = 0;
    int base = -1;  ///< of deflections: place of the first node of the body; of directions: the axis
    const double* (*values)(const formats::ResultsRow&) = nullptr;
  };

  void add_defaults(const formats::Scene& scene, const formats::ResultsLayout& layout, Missing missing);
  void add_channel(const std::string& given, const formats::ResultsLayout& layout, const std::string& where,
                   Missing missing);

  std::vector<Measured> list_;
  std::vector<Source> sources_;
};

/// Largest distance from the first row (positions, deflections) or value (forces, channels) of each group.
class MeasureSizes {
 public:
  explicit MeasureSizes(const std::vector<Measured>& list);
  void observe(const MeasuredRow& row);
  /// Of thing i: that of the largest of its group.
  double of(std::size_t i) const { return group_size_[static_cast<std::size_t>(group_of_[i])]; }

 private:
  std::vector<bool> from_first_;
  std::vector<int> group_of_;
  std::vector<double> group_size_;
  MeasuredRow first_;
};

}  // namespace tisserand::mechanism
