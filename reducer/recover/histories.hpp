// SPDX-License-Identifier: GPL-3.0-or-later
// Histories of chosen nodes, elements and groups as CSV, written batch by batch.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/text.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// Axes R_0 of the floating frame in the world at an instant. They are the unit matrix if `frame` is the part frame.
Eigen::Matrix3d frame_axes(const BodyMotion& motion, RecoverFrame frame, Eigen::Index instant);

/// Undeformed positions of `places` at an instant. In the world frame the floating frame carries them; in the part
/// frame they are at rest. `places`: positions in the part frame (mirrored, if the body is), in units of the scene (3
/// x places).
Eigen::Matrix3Xd rest_positions(const Eigen::Matrix3Xd& places, const BodyMotion& motion, RecoverFrame frame,
                                Eigen::Index instant);

/// Table over time with one line per instant. It takes the field blocks of a batch of instants, then gives its lines.
class HistoryTable {
 public:
  virtual ~HistoryTable() = default;
  virtual std::string header() const = 0;
  virtual void begin(Eigen::Index /*instants*/) {}
  virtual void take(const FieldBlock& block) = 0;
  /// Cells ",1,2,3" of the line of an instant of the batch.
  virtual std::string cells(const BodyMotion& motion, Eigen::Index instant) const = 0;
};

/// Tables of the chosen nodes, elements and groups of a recovery file. A table without items is omitted.
struct ChosenHistories {
  std::vector<std::unique_ptr<HistoryTable>> tables;
  std::vector<std::string> endings;  ///< end of the file name of each table: "points", "elements" or "groups"
};

/// Makes the tables for the nodes, elements and groups of `request`. Throws Error for those that the recovery file
/// lacks, for an element number that several groups have, and for a line of the file of points that names nothing.
/// `still`: data of the motion that do not depend on time. The arguments must outlive the result.
ChosenHistories chosen_histories(const formats::Recovery& recovery, const BodyMotion& still,
                                 const RecoverRequest& request);

/// CSV files of the tables. Each file is complete or does not exist.
class Histories {
 public:
  /// Begins the files. `stem`: folder and file name up to the "_" before "points.csv".
  Histories(ChosenHistories chosen, const BodyMotion& still, const std::string& stem);

  void begin(Eigen::Index instants);
  void take(const FieldBlock& block);
  void end(const BodyMotion& motion);
  /// Gives the files their final names, and returns the names.
  std::vector<std::string> publish();

 private:
  ChosenHistories chosen_;
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<TextFile>> files_;
};

}  // namespace tisserand::reducer
