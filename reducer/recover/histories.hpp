// SPDX-License-Identifier: GPL-3.0-or-later
// Histories of chosen nodes, elements and groups as CSV, written batch by batch.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/text.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// Axes of the floating frame in the world at an instant, R_0; 1 in the part frame.
Eigen::Matrix3d frame_axes(const BodyMotion& motion, RecoverFrame frame, Eigen::Index instant);

/// Undeformed positions of places of the part (part frame of the image, units of the scene), carried by the floating
/// frame or at rest in the part frame.
Eigen::Matrix3Xd rest_positions(const Eigen::Matrix3Xd& places, const BodyMotion& motion, RecoverFrame frame,
                                Eigen::Index instant);

/// Table over time. It takes blocks of a batch of instants, then writes a line for each instant.
class HistoryTable {
 public:
  virtual ~HistoryTable() = default;
  virtual std::string header() const = 0;
  virtual void begin(Eigen::Index /*instants*/) {}
  virtual void take(const FieldBlock& block) = 0;
  /// Cells ",1,2,3" of an instant of the batch.
  virtual std::string cells(const BodyMotion& motion, Eigen::Index instant) const = 0;
};

/// Tables of the chosen items of the recovery file. A table without items is missing.
struct ChosenHistories {
  std::vector<std::unique_ptr<HistoryTable>> tables;
  std::vector<std::string> endings;  ///< "points", "elements", "groups"
};

/// Tables for a request. Throws Error for nodes, elements or groups that the file lacks, element numbers that several
/// groups have, and lines of the file of points that name nothing. The arguments must outlive the result.
ChosenHistories chosen_histories(const formats::Recovery& recovery, const BodyMotion& still,
                                 const RecoverRequest& request);

/// Files of the tables; each of them is complete or does not exist.
class Histories {
 public:
  /// `stem`: folder and name before _points.csv.
  Histories(ChosenHistories chosen, const BodyMotion& still, const std::string& stem);

  void begin(Eigen::Index instants);
  void take(const FieldBlock& block);
  void end(const BodyMotion& motion);
  /// Gives the files their final names and returns these.
  std::vector<std::string> publish();

 private:
  ChosenHistories chosen_;
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<TextFile>> files_;
};

}  // namespace tisserand::reducer
