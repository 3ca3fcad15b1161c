// The motion of one body of a results file, in the coordinates and units of its recovery file.
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

/// Some instants of a body. Fields of the recovery file, times y, are those of the part; `mirror` turns them into those
/// of the body. T instants.
struct BodyMotion {
  std::string body;
  std::vector<double> time;  ///< T
  Eigen::MatrixXd y;  ///< n x T: coordinates of the part (of a modal body w), not of the image, units of the file
  Eigen::MatrixXd y_strain;      ///< the same of what stress follows from: y with the second-order strain
  Eigen::RowVectorXd stiffened;  ///< T: 1 of instants at which the body had its stiffening, else 0
  Eigen::MatrixXd second_order;  ///< shapes x T: amplitudes of the shapes of second order; without rows: there are none
  Eigen::MatrixXd load_factor;   ///< columns x T: of the loads of the recovery file; without columns: not known
  Eigen::VectorXd spin_squared;  ///< T: of the frame, with load_factor
  Eigen::Matrix3Xd position;     ///< of the floating frame, units of the scene; empty: not stored
  Eigen::Matrix4Xd rotation;     ///< w x y z
  Eigen::Vector3d origin;   ///< of the undeformed floating frame in the part frame of the image, units of the scene
  Eigen::Vector3d mirror;   ///< signs of the axes, 1 or −1
  UnitConversion to_scene;  ///< factors from the recovery file to the scene
  Units scene_units;

  Eigen::Index instants() const { return y.cols(); }
  double stress_factor() const { return to_scene.force() / (to_scene.length * to_scene.length); }
};

/// The row of a body in /superelements, or in /modal_bodies.
struct BodyRow {
  std::size_t row = 0;
  bool is_modal = false;
  std::string name;
};

/// One body over all instants that are asked for, some of which are in memory at a time.
class MotionReader {
 public:
  /// Reads everything once. Throws Error: no such body, a body without coordinates of its own (rigid), another
  /// superelement or modal body, coordinates that are not stored, not finite or not as many, no instants. The arguments
  /// live as long as this.
  MotionReader(const formats::Recovery& recovery, const formats::ResultsReader& results, const RecoverRequest& request);

  Eigen::Index instants() const { return static_cast<Eigen::Index>(rows_.size()); }
  const std::vector<double>& time() const { return time_; }
  const BodyMotion& still() const { return still_; }  ///< all that does not depend on time
  const BodyRow& body() const { return body_; }
  const formats::ResultsReader& results() const { return results_; }
  const std::vector<std::size_t>& rows() const { return rows_; }    ///< of the results
  const std::vector<std::string>& notes() const { return notes_; }  ///< what the user should know, without a full stop
  /// Modes that the body of the scene does not have and its loads move.
  const std::vector<Eigen::Index>& dropped() const { return dropped_; }

  /// Instants [first, first + count).
  BodyMotion read(Eigen::Index first, Eigen::Index count) const;
  /// How many to read at once: what takes some tens of megabytes, 256 at most.
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
  std::vector<Eigen::Index> zero_, dropped_;  ///< modes that are zero at all instants, and those of them in use
  bool has_strain_ = false, has_loads_ = false;
  Eigen::Index batch_ = 1;
};

}  // namespace tisserand::reducer
