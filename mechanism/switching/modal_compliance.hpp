// What a modal body yields to loads on it.
#pragma once

#include <vector>

#include "mechanism/model/model.hpp"
#include "mechanism/switching/compliance.hpp"

namespace tisserand::mechanism {

/// The undeformed body in axes of its frame, of the mass matrix [GA00] (8), (16): 6 x 6 mass of the motion of the
/// frame, its coupling with w, 6 x m, and how w moves the mass as a rigid body, the one over the other.
struct RigidPart {
  Eigen::Matrix<double, 6, 6> mass;
  Eigen::Matrix<double, 6, Eigen::Dynamic> coupling, part;
};
RigidPart rigid_part(const ModalBody& body);

/// Of a modal body of a model, which must stay where it is: S = diag(0, ω²), and M as its frame holds it. No node bears
/// what loads a mode; so forces are those of the mass, √(2 m T), by Cauchy and Schwarz not below the sum of |ÿ| over
/// it, with T of ÿ as seen from where that is the most: from the mean of the mass, or from a node on which something
/// acts and that turns, as from the clamp of a cantilever. `force` is that of a vibration of the shape y with ω² = V/T.
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
  Eigen::MatrixXd turn_;            ///< the same, their rotations
  std::vector<Eigen::Vector3d> x_;  ///< of the nodes
  std::vector<std::size_t> held_;   ///< nodes on which something acts and that turn
};

}  // namespace tisserand::mechanism
