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

/// Motion of one body at T instants, in the n coordinates of its part. Fields of the recovery file times y belong to
/// the part. For a mirrored body, `mirror` turns them into those of the body, the image of the part.
struct BodyMotion {
  std::string body;
  std::vector<double> time;  ///< T: time of each instant
  /// n x T: coordinates of the part, not of its image (modal body: w), units of the recovery file.
  Eigen::MatrixXd y;
  Eigen::MatrixXd y_strain;      ///< n x T: coordinates with the second-order strain, from which stress follows
  Eigen::RowVectorXd stiffened;  ///< T: 1 at instants at which the body had geometric stiffening, else 0
  Eigen::MatrixXd second_order;  ///< shapes x T: amplitudes of the shapes of second-order displacement; no rows: none
  Eigen::MatrixXd load_factor;   ///< loads x T: factors of the loads of the recovery file; no columns: unknown
  Eigen::VectorXd spin_squared;  ///< T: Ω² of the floating frame, set with load_factor
  Eigen::Matrix3Xd position;     ///< 3 x T: position of the floating frame, units of the scene; empty: not stored
  Eigen::Matrix4Xd rotation;     ///< 4 x T: rotation of the floating frame, quaternion w x y z
  /// Origin of the undeformed floating frame in the part frame of the image, units of the scene.
  Eigen::Vector3d origin;
  Eigen::Vector3d mirror;   ///< signs of the axes, 1 or −1
  UnitConversion to_scene;  ///< factors from the recovery file to the scene
  Units scene_units;

  Eigen::Index instants() const { return y.cols(); }
  double stress_factor() const { return to_scene.force() / (to_scene.length * to_scene.length); }
};

/// Row of a body in the group /superelements or /modal_bodies of a results file.
struct BodyRow {
  std::size_t row = 0;
  bool is_modal = false;
  std::string name;
};

/// Reader of the motion of one body at all requested instants. Only some of the instants are in memory at a time.
class MotionReader {
 public:
  /// Finds the body and reads all instants once to check them. Throws Error if the body is missing, is rigid, or
  /// belongs to another superelement or modal body than the recovery file. It also throws if there are no instants, or
  /// if the coordinates are not stored, not finite or of another number. The arguments must outlive this object.
  MotionReader(const formats::Recovery& recovery, const formats::ResultsReader& results, const RecoverRequest& request);

  Eigen::Index instants() const { return static_cast<Eigen::Index>(rows_.size()); }
  const std::vector<double>& time() const { return time_; }
  const BodyMotion& still() const { return still_; }  ///< motion without the data that depend on time
  const BodyRow& body() const { return body_; }
  const formats::ResultsReader& results() const { return results_; }
  /// Rows of the requested instants in the results file.
  const std::vector<std::size_t>& rows() const { return rows_; }
  const std::vector<std::string>& notes() const { return notes_; }  ///< notes for the user, without a full stop
  /// Internal coordinates of the part that the body of the scene lacks although its loads move them.
  const std::vector<Eigen::Index>& dropped() const { return dropped_; }

  /// Motion at the instants [first, first + count).
  BodyMotion read(Eigen::Index first, Eigen::Index count) const;
  /// Number of instants to read at once: as many as take some tens of megabytes, at most 256.
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
  /// Internal coordinates that are zero at all instants; those of them that loads move.
  std::vector<Eigen::Index> zero_, dropped_;
  bool has_strain_ = false, has_loads_ = false;
  Eigen::Index batch_ = 1;
};

}  // namespace tisserand::reducer
