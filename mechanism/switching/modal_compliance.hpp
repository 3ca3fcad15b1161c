// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a modal body.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// Rigid part of the mass matrix [GA00] (8), (16) of the undeformed body in axes of its frame. mass: 6 x 6 of the
/// motion of the frame. coupling: 6 x m with w. part: mass⁻¹ coupling, the rigid motion of the mass by w.
struct RigidPart {
  Eigen::Matrix<double, 6, 6> mass;
  Eigen::Matrix<double, 6, Eigen::Dynamic> coupling, part;
};
RigidPart rigid_part(const ModalBody& body);

/// Compliance of a modal body: S = diag(0, ω²), M as in its frame. The model must outlive this object. No node bears
/// the load of a mode, so forces are those of the mass, √(2 m T). By Cauchy and Schwarz this is not below the sum of
/// |ÿ| over the mass. T of ÿ is the largest relative to the mean of the mass or to a turning node with a load, as at a
/// clamp. `force` is that of a vibration of the shape y with ω² = V/T.
class ModalCompliance final : public Compliance {
 public:
  ModalCompliance(const Model& model, std::size_t modal_body);

  Eigen::VectorXd deformation(const Eigen::VectorXd& load) const override;
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd mass(const Eigen::VectorXd& y) const override;
  double displacement(const Eigen::VectorXd& y) const override;
  double force(const Eigen::VectorXd& y) const override;

 private:
  double largest_kinetic(const Eigen::VectorXd& rate) const;

  const ModalBody& body_;
  RigidPart rigid_;
  Eigen::MatrixXd move_;            ///< 3 n x (6 + m): displacements of the nodes
  Eigen::MatrixXd turn_;            ///< 3 n x (6 + m): rotations of the nodes
  std::vector<Eigen::Vector3d> x_;  ///< positions of the nodes
  std::vector<std::size_t> held_;   ///< nodes on which something acts and that turn
};

}  // namespace tisserand::mechanism
