// SPDX-License-Identifier: GPL-3.0-or-later
// Effect of static flexibility on modal bodies whose boundary conditions in the scene differ from those of the modes.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/modal_body/modal_body.hpp"

namespace tisserand::mechanism {

/// Modal body at rest in its own frame and in units of its file: rigid motions, modes, and the residual. The residual
/// is what the modes lack of the static answers to forces at f components of its nodes (MODAL_BODY.md, residual). f and
/// m are the numbers of components and modes.
struct ReferenceModel {
  std::string name;
  int frame = 0;                   ///< index of its frame in Model::nodes
  std::vector<std::string> nodes;  ///< (f): names in the model
  std::vector<int> component;      ///< (f): 0 to 2 translations, 3 to 5 rotations
  std::vector<bool> held;          ///< (f): the boundary conditions of the modes hold it
  Eigen::MatrixXd rigid;           ///< (f x 6): displacement of the components in each rigid motion
  Eigen::MatrixXd modes;           ///< (f x m): displacement of the components in each mode
  Eigen::MatrixXd mass;            ///< ((6 + m) x (6 + m)): mass matrix of rigid motions and modes
  Eigen::VectorXd omega2;          ///< (m): ω² of the modes
  formats::ModalResidual residual;
  UnitConversion units;  ///< conversion to the units of the scene
};

/// Reference model of the body `name` with the first `modes` modes of its file. Other modes of the file are added to
/// its residual. It has no components (f = 0) if the file has no residual. `frame`: index of the frame in Model::nodes.
ReferenceModel reference_model(const formats::ModalBody& file, int modes, const std::string& name, int frame,
                               const UnitConversion& units);

/// Lowest elastic frequency [rad/time of the file] of a modal body with held components: by its modes alone, and with
/// the residual flexibility at these components. Infinite if nothing elastic remains, zero if the search failed.
struct HeldFrequencies {
  double by_modes = 0.0, with_residual = 0.0;
};
/// Computes the lowest elastic frequencies with the rows of `held` (r x f, combinations of components) at zero.
HeldFrequencies held_frequencies(const ReferenceModel& model, const Eigen::MatrixXd& held);

}  // namespace tisserand::mechanism
