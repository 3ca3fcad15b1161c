// SPDX-License-Identifier: GPL-3.0-or-later
// Pseudo-inverse of S̄ in coordinates scaled to one size; products with S̄ and M̄.
#include "mechanism/switching/compliance.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "common/error.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Eigenvalues of the scaled S̄ below this fraction of the largest belong to motions without strain.
constexpr double strainless = 1e-11;

/// Shapes V with Vᵀ S V = 1 and V Vᵀ the pseudo-inverse of S, in coordinates scaled to one size.
MatrixXd strained_shapes(const MatrixXd& S, const VectorXd& units) {
  const MatrixXd scaled = units.asDiagonal() * S * units.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> modes(scaled);
  const VectorXd& values = modes.eigenvalues();  // ascending
  const Eigen::Index count = (values.array() > strainless * values.maxCoeff()).count();
  const VectorXd sizes = values.tail(count).cwiseSqrt().cwiseInverse();
  return units.asDiagonal() * modes.eigenvectors().rightCols(count) * sizes.asDiagonal();
}

/// Returns the body. Throws Error if its internal coordinates have no stiffness.
const SuperelementBody& stiff(const SuperelementBody& body) {
  if (body.modes > 0 && !(body.S_II.minCoeff() > 0.0))
    throw Error(fmt::format("'{}' has a mechanism inside, which `auto` does not support", body.name), "effects",
                "remove `auto`, or reduce two parts and join them in the scene");
  return body;
}

}  // namespace

SuperelementCompliance::SuperelementCompliance(const SuperelementBody& body)
    : body_(stiff(body)),
      strained_(strained_shapes(body.S_BB, coordinate_units(body).head(body.boundary_size))),
      inverse_(strained_ * strained_.transpose()),
      rigid_(rigid_columns(body)) {
  MatrixXd Phi_M(6, rigid_.rows());
  for (int k = 0; k < 6; ++k) Phi_M.row(k) = SuperelementCompliance::mass(rigid_.col(k)).transpose();
  part_ = (Phi_M * rigid_).completeOrthogonalDecomposition().solve(Phi_M);
}

VectorXd SuperelementCompliance::mass(const VectorXd& y) const {
  const Eigen::Index nb = body_.boundary_size, m = body_.modes;
  VectorXd p(nb + m);
  p.head(nb) = body_.M_BB * y.head(nb) + body_.M_BI * y.tail(m);
  p.tail(m) = body_.M_IB * y.head(nb) + y.tail(m);
  return p;
}

VectorXd SuperelementCompliance::stiffness(const VectorXd& y) const {
  const Eigen::Index nb = body_.boundary_size, m = body_.modes;
  VectorXd f(nb + m);
  f.head(nb) = body_.S_BB * y.head(nb);
  f.tail(m) = body_.S_II.cwiseProduct(y.tail(m));
  return f;
}

VectorXd SuperelementCompliance::without_rigid_motion(const VectorXd& y) const { return y - rigid_ * (part_ * y); }

MatrixXd SuperelementCompliance::elastic_shapes() const {
  const Eigen::Index nb = body_.boundary_size, m = body_.modes, count = strained_.cols();
  MatrixXd W = MatrixXd::Zero(nb + m, count + m);
  W.topLeftCorner(nb, count) = strained_;
  W.bottomRightCorner(m, m) = body_.S_II.cwiseSqrt().cwiseInverse().asDiagonal();
  return W - rigid_ * (part_ * W);
}

VectorXd SuperelementCompliance::deformation(const VectorXd& load) const {
  const Eigen::Index nb = body_.boundary_size, m = body_.modes;
  VectorXd y(nb + m);
  y.head(nb) = inverse_ * load.head(nb);
  y.tail(m) = load.tail(m).cwiseQuotient(body_.S_II);
  return without_rigid_motion(y);
}

double SuperelementCompliance::displacement(const VectorXd& y) const {
  double largest = 2.0 * std::sqrt(kinetic_energy(y) / body_.mass);  // √2 √(yᵀ M̄ y / m)
  for (const int j : body_.translation_nodes) {
    const SuperelementNode& seen = body_.node[j];
    largest = std::max(largest, y.segment<3>(seen.translation_row).norm());
    for (const SuperelementNode& from : body_.node) {
      if (!from.has_translation() || !from.has_rotation()) continue;
      const Eigen::Vector3d turn = y.segment<3>(from.rotation_row), arm = seen.X - from.X;
      const Eigen::Vector3d apart =
          y.segment<3>(seen.translation_row) - y.segment<3>(from.translation_row) - turn.cross(arm);
      largest = std::max(largest, apart.norm());
    }
  }
  return largest;
}

double SuperelementCompliance::force(const VectorXd& y) const {
  const Eigen::Index m = body_.modes;
  const VectorXd elastic = body_.S_BB * y.head(body_.boundary_size);
  const VectorXd inner = body_.M_BI * body_.S_II.cwiseProduct(y.tail(m));
  double largest = 0.0;
  for (const int j : body_.translation_nodes) {
    const int row = body_.node[j].translation_row;
    largest = std::max(largest, elastic.segment<3>(row).norm() + inner.segment<3>(row).norm());
  }
  return largest;
}

}  // namespace tisserand::mechanism
