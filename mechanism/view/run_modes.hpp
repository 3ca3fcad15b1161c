// SPDX-License-Identifier: GPL-3.0-or-later
// Modes of a linearised scene as small motions of bodies and their shapes.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "formats/page/deformation.hpp"
#include "formats/page/page_blocks.hpp"
#include "mechanism/view/body_shape.hpp"
#include "mechanism/view/viewed_run.hpp"

namespace tisserand::mechanism {

/// Motion of the nodes in each mode, split into that of the frames of the bodies and their deformation. The sum does
/// not depend on the choice of the frame. Here the frame follows the first node that turns.
class ModesOfBodies {
 public:
  explicit ModesOfBodies(const formats::ResultsReader& reader);

  /// Appends two rows per mode, real and imaginary, to the amplitudes of the shape.
  void take(const ViewedRun& run, int body, BodyShape& shape);
  /// Reads the reduced amplitudes of the modes, which follow those of `instants` rows.
  void reduce(int body, const formats::FewModes& few, Eigen::Index instants);
  /// JSON of all modes; null: the file holds none.
  formats::Json json() const;

 private:
  struct Small {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  };
  /// Small motion of a node. `part`: 0 real, 1 imaginary.
  Small motion_of(int node, Eigen::Index mode, int part) const;
  Small frame_motion(const ViewedRun& run, int body, Eigen::Index mode, int part) const;
  /// Motion of a node relative to the frame, in axes of the frame.
  Small relative_motion(const ViewedRun& run, int body, int node, Eigen::Index mode, int part) const;
  Eigen::VectorXd stations_motion(const ViewedRun& run, int body, const BodyShape& shape, Eigen::Index mode,
                                  int part) const;
  Eigen::VectorXd coordinates_motion(const ViewedRun& run, int body, const BodyShape& shape, Eigen::Index mode,
                                     int part) const;

  Eigen::VectorXd frequency_, damping_;
  std::vector<Eigen::MatrixXd> translation_, rotation_;  ///< per node, modes x 6: x/real, x/imaginary, y/real, ...
  Eigen::MatrixXd y_;                                    ///< modes x 2 Ny; without columns: not stored
  std::vector<formats::Json> bodies_;                    ///< per mode
};

}  // namespace tisserand::mechanism
