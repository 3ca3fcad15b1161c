// SPDX-License-Identifier: GPL-3.0-or-later
// Compliance of a body: its quasi-static deformation under loads, and measures of a deformation.
#pragma once

#include <Eigen/Core>

#include "mechanism/bodies/superelement/constants/body.hpp"

namespace tisserand::mechanism {

/// Compliance of a deforming body: deformations under loads, and measures of a deformation. It holds constants that are
/// made once. A deformation y has the coordinates of deformation.hpp. S and M are the stiffness and the mass matrix of
/// the body in these coordinates, and Φ are its rigid motions.
class Compliance {
 public:
  virtual ~Compliance() = default;

  /// Deformation y with S y = g under the load `load` = g, which is in balance. It contains no rigid motion: Φᵀ M y =
  /// 0. So the centre of mass and the mean orientation of the body stay.
  virtual Eigen::VectorXd deformation(const Eigen::VectorXd& load) const = 0;
  /// Deformation y without its rigid motion: y − Φ (Φᵀ M Φ)⁻¹ Φᵀ M y.
  virtual Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const = 0;

  double strain_energy(const Eigen::VectorXd& y) const { return 0.5 * y.dot(stiffness(y)); }
  double kinetic_energy(const Eigen::VectorXd& rate) const { return 0.5 * rate.dot(mass(rate)); }
  /// Product S y of the stiffness matrix and y.
  virtual Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const = 0;
  /// Product M y of the mass matrix and y.
  virtual Eigen::VectorXd mass(const Eigen::VectorXd& y) const = 0;

  /// Size of the bending by y: the larger of two values. One is the largest displacement of a node, also relative to
  /// any node where the scene may hold the body. The other is √2 times the root mean square over the mass, the
  /// amplitude of a sine. It is needed since internal coordinates move no node.
  virtual double displacement(const Eigen::VectorXd& y) const = 0;
  /// Largest nodal force that deforms the body by y.
  virtual double force(const Eigen::VectorXd& y) const = 0;
};

/// Compliance of a superelement: pseudo-inverse of the stiffness S̄_BB of the boundary, and projector off the rigid
/// motions. `force` is the largest nodal sum of two forces. One is S̄_BB y_B. The other is that of internal coordinates
/// if inertia were their whole load, M̄_BI S̄_II y_I. The matrices are those of THEORY (7).
class SuperelementCompliance final : public Compliance {
 public:
  explicit SuperelementCompliance(const SuperelementBody& body);

  Eigen::VectorXd deformation(const Eigen::VectorXd& load) const override;
  Eigen::VectorXd without_rigid_motion(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd stiffness(const Eigen::VectorXd& y) const override;
  Eigen::VectorXd mass(const Eigen::VectorXd& y) const override;
  double displacement(const Eigen::VectorXd& y) const override;
  double force(const Eigen::VectorXd& y) const override;

  /// Elastic shapes W (N x elastic coordinates), the columns of which have no rigid motion. They are orthonormal in the
  /// stiffness S̄, THEORY (7): WᵀS̄W = 1. The first columns deform the boundary, the last ones are the internal
  /// coordinates.
  Eigen::MatrixXd elastic_shapes() const;

 private:
  const SuperelementBody& body_;
  Eigen::MatrixXd strained_;  ///< elastic shapes V of the boundary (nb x elastic) with VᵀS̄_BB V = 1
  Eigen::MatrixXd inverse_;   ///< pseudo-inverse V Vᵀ of S̄_BB (nb x nb)
  Eigen::MatrixXd rigid_;     ///< rigid motions Φ (N x 6), THEORY (8)
  Eigen::Matrix<double, 6, Eigen::Dynamic> part_;  ///< projector (Φᵀ M̄ Φ)⁻¹ Φᵀ M̄ on the rigid motions (6 x N)
};

}  // namespace tisserand::mechanism
