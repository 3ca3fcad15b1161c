// What a superelement yields to loads on it: its quasi-static deformation, and the size of one.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/body.hpp"

namespace tisserand::mechanism {

/// Constants of a body, made once: S̄⁺ of its boundary and the projector off its rigid motions.
class Compliance {
 public:
  explicit Compliance(const SuperelementBody& body);

  /// y with S̄ y = g for loads that are in balance (boundary, then internal ones; axes of the frame), without rigid
  /// motion: Φᵀ M̄ y = 0, so that its centre of mass and its mean orientation stay.
  Eigen::VectorXd deformation(const Eigen::VectorXd& load) const;
  /// y − Φ (Φᵀ M̄ Φ)⁻¹ Φᵀ M̄ y.
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const;

  /// N x elastic coordinates: W with WᵀS̄W = 1, without rigid motion; internal coordinates last.
  Eigen::MatrixXd elastic_shapes() const;

  double strain_energy(const Eigen::VectorXd& y) const { return 0.5 * y.dot(stiffness(y)); }
  double kinetic_energy(const Eigen::VectorXd& rate) const { return 0.5 * rate.dot(mass(rate)); }
  /// S̄ y.
  Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const;

  /// How far the body is bent: the largest displacement of a node, also as seen from any other node, where the scene
  /// may hold it, or √2 times the root mean square over its mass, which is the amplitude of a sine: internal
  /// coordinates move no node.
  double displacement(const Eigen::VectorXd& y) const;
  /// The largest force on a node of those that deform it by y: of S̄ y, and of internal coordinates if their whole load
  /// came from inertia, M̄_BI S̄_II y_I.
  double force(const Eigen::VectorXd& y) const;
  /// The largest force on a node of the inertia of a deformation with these accelerations, M̄ ÿ without rigid motion.
  double inertia_force(const Eigen::VectorXd& acceleration) const;

 private:
  Eigen::VectorXd mass(const Eigen::VectorXd& y) const;

  const SuperelementBody& body_;
  Eigen::MatrixXd strained_;                       ///< nb x elastic: V of S̄_BB, VᵀS̄V = 1
  Eigen::MatrixXd inverse_;                        ///< nb x nb: V Vᵀ, pseudo-inverse of S̄_BB
  Eigen::MatrixXd rigid_;                          ///< Φ, N x 6
  Eigen::Matrix<double, 6, Eigen::Dynamic> part_;  ///< (Φᵀ M̄ Φ)⁻¹ Φᵀ M̄
};

}  // namespace tisserand::mechanism
