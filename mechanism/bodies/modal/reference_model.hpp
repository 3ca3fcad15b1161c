// Modal bodies that the scene holds otherwise than their modes are: what their static flexibility there would change.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/units.hpp"
#include "formats/modal_body/modal_body.hpp"

namespace tisserand::mechanism {

/// A modal body at rest in its own frame and in units of its file: rigid motions, modes, and what the modes leave out
/// of the static answers to forces at some components of its nodes (MODAL_BODY.md, residual), f of them.
struct ReferenceModel {
  std::string name;
  int frame = 0;                   ///< node of the model
  std::vector<std::string> nodes;  ///< f: names in the model
  std::vector<int> component;      ///< f: 0 to 2 translations, 3 to 5 rotations
  std::vector<bool> held;          ///< f: by the reference of the modes
  Eigen::MatrixXd rigid;           ///< f x 6: motion of the components per rigid motion
  Eigen::MatrixXd modes;           ///< f x m: per mode
  Eigen::MatrixXd mass;            ///< (6 + m)²: of rigid motions and modes
  Eigen::VectorXd omega2;          ///< m
  formats::ModalResidual residual;
  UnitConversion units;  ///< to those of the scene
};

/// The model of the body `name` with the first `modes` modes of its file. It has no components (f = 0) if the file does
/// not hold what the modes leave out.
ReferenceModel reference_model(const formats::ModalBody& file, int modes, const std::string& name, int frame,
                               const UnitConversion& units);

/// The lowest elastic frequencies [rad/time of the file] with the rows of `held` (r x f) at zero: of the modes alone,
/// and with their residual flexibility at these rows. Infinite where nothing elastic is left, zero if they were not
/// found.
struct HeldFrequencies {
  double by_modes = 0.0, with_residual = 0.0;
};
HeldFrequencies held_frequencies(const ReferenceModel& model, const Eigen::MatrixXd& held);

}  // namespace tisserand::mechanism
