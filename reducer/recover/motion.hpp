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

/// Fields of the recovery file, times y, are those of the part; `mirror` turns them into those of the body. T instants.
struct BodyMotion {
  std::string body;
  std::vector<double> time;  ///< T
  Eigen::MatrixXd y;  ///< n x T: coordinates of the part (of a modal body w), not of the image, units of the file
  Eigen::MatrixXd y_strain;           ///< the same of what stress follows from: y with the second-order strain
  Eigen::MatrixXd load_factor;        ///< 12 x T: of the loads of the recovery file; without columns: not known
  Eigen::VectorXd spin_squared;       ///< T: of the frame, with load_factor
  std::vector<Eigen::Index> dropped;  ///< modes that the body of the scene does not have and its loads move
  std::vector<std::string> notes;     ///< what the user should know, without a full stop
  Eigen::Matrix3Xd position;          ///< of the floating frame, units of the scene; empty: not stored
  Eigen::Matrix4Xd rotation;          ///< w x y z
  Eigen::Vector3d origin;   ///< of the undeformed floating frame in the part frame of the image, units of the scene
  Eigen::Vector3d mirror;   ///< signs of the axes, 1 or −1
  UnitConversion to_scene;  ///< factors from the recovery file to the scene
  Units scene_units;

  Eigen::Index instants() const { return y.cols(); }
  double stress_factor() const { return to_scene.force() / (to_scene.length * to_scene.length); }
};

/// Throws Error: no such body, a body without coordinates of its own (rigid), another superelement or modal body,
/// coordinates that are not stored, not finite or not as many, no instants.
BodyMotion body_motion(const formats::Recovery& recovery, const formats::ResultsReader& results,
                       const RecoverRequest& request);

}  // namespace tisserand::reducer
