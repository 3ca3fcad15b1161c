// SPDX-License-Identifier: GPL-3.0-or-later
// Motion of one body of a results file, in the coordinates and units of its recovery file.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "common/units.hpp"
#include "formats/recovery/recovery.hpp"
#include "formats/results/results.hpp"
#include "reducer/recover/request.hpp"

namespace tisserand::reducer {

/// Some instants (T) of a body. Fields of the recovery file times y belong to the part; `mirror` turns them into those
/// of the body.
struct BodyMotion {
  std::string body;
  std::vector<double> time;  ///< T
  Eigen::MatrixXd y;         ///< n x T: coordinates of the part (modal body: w), not of its image, units of the file
  Eigen::MatrixXd y_strain;  ///< n x T: y with the second-order strain, from which stress follows
  Eigen::RowVectorXd stiffened;  ///< T: 1 for instants at which the body had its stiffening, else 0
  Eigen::MatrixXd second_order;  ///< shapes x T: amplitudes of the shapes of second order; no rows: none
  Eigen::MatrixXd load_factor;   ///< columns x T: factors of the loads of the recovery file; no columns: unknown
  Eigen::VectorXd spin_squared;  ///< T: Ω² of the frame, set with load_factor
  Eigen::Matrix3Xd position;     ///< of the floating frame, units of the scene; empty: not stored
  Eigen::Matrix4Xd rotation;     ///< w x y z
  Eigen::Vector3d origin;   ///< of the undeformed floating frame in the part frame of the image, units of the scene
  Eigen::Vector3d mirror;   ///< signs of the axes, 1 or −1
  UnitConversion to_scene;  ///< factors from the recovery file to the scene
  Units scene_units;

  Eigen::Index instants() const { return y.cols(); }
  double stress_factor() const { return to_scene.force() / (to_scene.length * to_scene.length); }
};

/// Row of a body in /superelements or in /modal_bodies.
struct BodyRow {
  std::size_t row = 0;
  bool is_modal = false;
  std::string name;
};

/// Motion of one body at all requested instants, some of which are in memory at a time.
class MotionReader {
 public:
  /// Reads everything once. Throws Error for a body that is missing or has no coordinates of its own (rigid), for
  /// another superelement or modal body, and for no instants. Throws it also for coordinates that are not stored, not
  /// finite or of another number. The arguments must outlive this object.
  MotionReader(const formats::Recovery& recovery, const formats::ResultsReader& results, const RecoverRequest& request);

  Eigen::Index instants() const { return static_cast<Eigen::Index>(rows_.size()); }
  const std::vector<double>& time() const { return time_; }
  const BodyMotion& still() const { return still_; }  ///< all data that do not depend on time
  const BodyRow& body() const { return body_; }
  const formats::ResultsReader& results() const { return results_; }
  const std::vector<std::size_t>& rows() const { return rows_; }    ///< rows of the results
  const std::vector<std::string>& notes() const { return notes_; }  ///< for the user, without a full stop
  /// Modes that the body of the scene lacks and its loads move.
  const std::vector<Eigen::Index>& dropped() const { return dropped_; }

  /// Motion at the instants [first, first + count).
  BodyMotion read(Eigen::Index first, Eigen::Index count) const;
  /// Number of instants to read at once: some tens of megabytes, 256 at most.
  Eigen::Index batch() const { return batch_; }

 private:
  BodyMotion stored(Eigen::Index first, Eigen::Index count) const;
  void look_at_all(const RecoverRequest& request);

  const formats::Recovery& recovery_;
  const formats::ResultsReader& results_;
  BodyRow body_;
  BodyMotion still_;
  std::vector<double> time_;
  std::vector<std::size_t> rows_;
  std::vector<std::string> notes_;
  std::vector<Eigen::Index> zero_, dropped_;  ///< modes that are zero at all instants; those that loads move
  bool has_strain_ = false, has_loads_ = false;
  Eigen::Index batch_ = 1;
};

}  // namespace tisserand::reducer
