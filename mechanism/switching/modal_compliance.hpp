// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a modal body.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// Rigid part of the mass matrix of a modal body, [GA00] (8), (16), undeformed and in axes of its frame. `mass` (6 x 6)
/// belongs to the motion of the frame. `coupling` (6 x m) couples this motion with the m modal coordinates w. `part` =
/// mass⁻¹ coupling (6 x m) is the rigid motion of the mass by w.
struct RigidPart {
  Eigen::Matrix<double, 6, 6> mass;
  Eigen::Matrix<double, 6, Eigen::Dynamic> coupling, part;
};
/// Computes the rigid part of the mass matrix of `body`.
RigidPart rigid_part(const ModalBody& body);

/// Compliance of a modal body, with the stiffness S = diag(0, ω²) and the mass matrix M of its frame and modes. No node
/// bears the load of a mode. So forces are those of the mass, √(2 m T) for the kinetic energy T of ÿ and the mass m. By
/// Cauchy and Schwarz this is not below the sum of |ÿ| over the mass. T is the largest of several: relative to the mean
/// of the mass, and relative to each turning node with a load, as at a clamp. `force` is that of a vibration of the
/// shape y with the squared frequency V/T.
class ModalCompliance final : public Compliance {
 public:
  /// Makes the constants of the modal body with the index `modal_body` in Model::modal_bodies. Requires that `model`
  /// outlives this object.
  ModalCompliance(const Model& model, std::size_t modal_body);

  Eigen::VectorXd deformation(const Eigen::VectorXd& load) const override;
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd mass(const Eigen::VectorXd& y) const override;
  double displacement(const Eigen::VectorXd& y) const override;
  double force(const Eigen::VectorXd& y) const override;

 private:
  /// Largest kinetic energy of `rate`, relative to the mean of the mass or to one of the nodes `held_`.
  double largest_kinetic(const Eigen::VectorXd& rate) const;

  const ModalBody& body_;
  RigidPart rigid_;
  Eigen::MatrixXd move_;            ///< displacements of the n nodes by y (3 n x (6 + m))
  Eigen::MatrixXd turn_;            ///< rotations of the n nodes by y (3 n x (6 + m))
  std::vector<Eigen::Vector3d> x_;  ///< positions of the nodes
  std::vector<std::size_t> held_;   ///< indices of turning nodes on which something acts
};

}  // namespace tisserand::mechanism
