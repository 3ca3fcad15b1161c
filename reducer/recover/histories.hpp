// Histories of chosen nodes, elements and groups as CSV, written while the instants pass.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "common/text.hpp"
#include "reducer/recover/stresses.hpp"

namespace tisserand::reducer {

/// R_0, times the instant: axes of the floating frame in the world; 1 in the part frame.
Eigen::Matrix3d frame_axes(const BodyMotion& motion, RecoverFrame frame, Eigen::Index instant);

/// Where a place of the part (part frame of the image, units of the scene) is without deformation: carried by the
/// floating frame, or at rest in the part frame.
Eigen::Matrix3Xd rest_positions(const Eigen::Matrix3Xd& places, const BodyMotion& motion, RecoverFrame frame,
                                Eigen::Index instant);

/// One table over time: takes blocks of a batch of instants, then writes a line for each of them.
class HistoryTable {
 public:
  virtual ~HistoryTable() = default;
  virtual std::string header() const = 0;
  virtual void begin(Eigen::Index /*instants*/) {}
  virtual void take(const FieldBlock& block) = 0;
  /// ",1,2,3" of an instant of the batch.
  virtual std::string cells(const BodyMotion& motion, Eigen::Index instant) const = 0;
};

/// What is chosen, found in the recovery file. Tables that nothing is chosen for are missing.
struct ChosenHistories {
  std::vector<std::unique_ptr<HistoryTable>> tables;
  std::vector<std::string> endings;  ///< "points", "elements", "groups"
};

/// Throws Error: nodes, elements or groups that the file does not have, numbers that several groups have, a line of the
/// file of points that says none of these. The arguments live as long as the result.
ChosenHistories chosen_histories(const formats::Recovery& recovery, const BodyMotion& still,
                                 const RecoverRequest& request);

/// The files, each of them complete or not there.
class Histories {
 public:
  /// `stem`: folder and name before _points.csv.
  Histories(ChosenHistories chosen, const BodyMotion& still, const std::string& stem);

  void begin(Eigen::Index instants);
  void take(const FieldBlock& block);
  void end(const BodyMotion& motion);
  /// Gives the files their names, which are returned.
  std::vector<std::string> publish();

 private:
  ChosenHistories chosen_;
  std::vector<std::string> paths_;
  std::vector<std::unique_ptr<TextFile>> files_;
};

}  // namespace tisserand::reducer
