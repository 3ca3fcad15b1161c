// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a body: its quasi-static deformation under loads, and measures of a deformation.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Constants of a deforming body, made once. A deformation y has the coordinates of deformation.hpp. S and M are the
/// stiffness and the mass of the body in them.
class Compliance {
 public:
  virtual ~Compliance() = default;

  /// Deformation y with S y = g for loads in balance, without rigid motion: Φᵀ M y = 0. So its centre of mass and its
  /// mean orientation stay.
  virtual Eigen::VectorXd deformation(const Eigen::VectorXd& load) const = 0;
  /// Deformation without rigid motion: y − Φ (Φᵀ M Φ)⁻¹ Φᵀ M y.
  virtual Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const = 0;

  double strain_energy(const Eigen::VectorXd& y) const { return 0.5 * y.dot(stiffness(y)); }
  double kinetic_energy(const Eigen::VectorXd& rate) const { return 0.5 * rate.dot(mass(rate)); }
  /// Product S y.
  virtual Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const = 0;
  /// Product M y.
  virtual Eigen::VectorXd mass(const Eigen::VectorXd& y) const = 0;

  /// Size of the bending: the larger of two values. One is the largest displacement of a node, also relative to any
  /// node where the scene may hold it. The other is √2 times the root mean square over the mass, the amplitude of a
  /// sine, since internal coordinates move no node.
  virtual double displacement(const Eigen::VectorXd& y) const = 0;
  /// Largest nodal force that deforms the body by y.
  virtual double force(const Eigen::VectorXd& y) const = 0;
};

/// Compliance of a superelement: S̄⁺ of the boundary and the projector off its rigid motions. `force`: that of S̄ y,
/// and that of internal coordinates if inertia were their whole load, M̄_BI S̄_II y_I.
class SuperelementCompliance final : public Compliance {
 public:
  explicit SuperelementCompliance(const SuperelementBody& body);

  Eigen::VectorXd deformation(const Eigen::VectorXd& load) const override;
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd mass(const Eigen::VectorXd& y) const override;
  double displacement(const Eigen::VectorXd& y) const override;
  double force(const Eigen::VectorXd& y) const override;

  /// Elastic shapes W (N x elastic coordinates) with WᵀS̄W = 1, without rigid motion; internal coordinates last.
  Eigen::MatrixXd elastic_shapes() const;

 private:
  const SuperelementBody& body_;
  Eigen::MatrixXd strained_;                       ///< nb x elastic: V of S̄_BB, VᵀS̄V = 1
  Eigen::MatrixXd inverse_;                        ///< nb x nb: V Vᵀ, pseudo-inverse of S̄_BB
  Eigen::MatrixXd rigid_;                          ///< Φ, N x 6
  Eigen::Matrix<double, 6, Eigen::Dynamic> part_;  ///< (Φᵀ M̄ Φ)⁻¹ Φᵀ M̄
};

}  // namespace tisserand::mechanism
