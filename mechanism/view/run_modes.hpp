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

/// Modes of a linearised scene, as motions of the frames of bodies and deformations relative to the frames. The sum of
/// both does not depend on the choice of the frame. Here the frame follows the first node of the body that turns.
class ModesOfBodies {
 public:
  explicit ModesOfBodies(const formats::ResultsReader& reader);

  /// Appends the modes to the amplitudes of the shape of a body: two rows per mode, real and imaginary part.
  void take(const ViewedRun& run, int body, BodyShape& shape);
  /// Reads the reduced amplitudes of the modes. They follow the `instants` rows of the run.
  void reduce(int body, const formats::FewModes& few, Eigen::Index instants);
  /// JSON of all modes; null: the file holds none.
  formats::Json json() const;

 private:
  /// Small motion: displacement and rotation.
  struct Small {
    Eigen::Vector3d translation = Eigen::Vector3d::Zero(), rotation = Eigen::Vector3d::Zero();
  };
  /// Small motion of a node in a mode. `part`: 0 real, 1 imaginary.
  Small motion_of(int node, Eigen::Index mode, int part) const;
  /// Small motion of the frame of a body in a mode.
  Small frame_motion(const ViewedRun& run, int body, Eigen::Index mode, int part) const;
  /// Small motion of a node relative to the frame of the body, in axes of the frame.
  Small relative_motion(const ViewedRun& run, int body, int node, Eigen::Index mode, int part) const;
  Eigen::VectorXd stations_motion(const ViewedRun& run, int body, const BodyShape& shape, Eigen::Index mode,
                                  int part) const;
  Eigen::VectorXd coordinates_motion(const ViewedRun& run, int body, const BodyShape& shape, Eigen::Index mode,
                                     int part) const;

  Eigen::VectorXd frequency_, damping_;
  /// Motions of each node (modes x 6): x/real, x/imaginary, y/real, ...
  std::vector<Eigen::MatrixXd> translation_, rotation_;
  /// Amplitudes of the coordinates y of the superelements (modes x 2 Ny), real and imaginary. Without columns: not
  /// stored.
  Eigen::MatrixXd y_;
  std::vector<formats::Json> bodies_;  ///< motions of the bodies, one entry per mode
};

}  // namespace tisserand::mechanism
