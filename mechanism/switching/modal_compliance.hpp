// What a modal body yields to loads on it.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// Of a modal body of a model, which must stay where it is: S = diag(0, ω²), and M as its frame holds it. No node bears
/// what loads a mode; so forces are those of the mass, √m √(ÿᵀ M ÿ), by Cauchy and Schwarz not below the sum of |ÿ|
/// over it, and `force` is that of a vibration of the shape y with its own frequency, ω² = V/T of Rayleigh.
class ModalCompliance final : public Compliance {
 public:
  ModalCompliance(const Model& model, std::size_t modal_body);

  Eigen::VectorXd deformation(const Eigen::VectorXd& load) const override;
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd mass(const Eigen::VectorXd& y) const override;
  double displacement(const Eigen::VectorXd& y) const override;
  double force(const Eigen::VectorXd& y) const override;
  double inertia_force(const Eigen::VectorXd& acceleration) const override;

 private:
  const ModalBody& body_;
  Eigen::Matrix<double, 6, 6> rigid_mass_;             ///< of the undeformed body, in axes of its frame
  Eigen::Matrix<double, 6, Eigen::Dynamic> coupling_;  ///< of the motion of the frame and w
  Eigen::Matrix<double, 6, Eigen::Dynamic> part_;      ///< rigid_mass_⁻¹ coupling_
  Eigen::MatrixXd move_;                               ///< 3 n x (6 + m): displacements of the nodes
  Eigen::MatrixXd turn_;                               ///< the same, their rotations
  std::vector<Eigen::Vector3d> x_;                     ///< of the nodes
  std::vector<std::size_t> held_;                      ///< nodes on which something acts and that turn
};

}  // namespace tisserand::mechanism
