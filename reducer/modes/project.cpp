// SPDX-License-Identifier: GPL-3.0-or-later
// Projection on T = [1 0; Ψ Φ], THEORY (79), and canonical form, THEORY (7).
#include "reducer/modes/project.hpp"

#include <algorithm>

#include "common/program/version.hpp"

namespace tisserand::reducer {
namespace {

double relative_maximum(const Eigen::MatrixXd& part, const Eigen::MatrixXd& whole) {
  return part.size() == 0 || whole.size() == 0 ? 0.0 : part.cwiseAbs().maxCoeff() / whole.cwiseAbs().maxCoeff();
}

/// Name of the method for readers.
std::string method_text(formats::ReductionMethod method, const InternalModes& internal) {
  if (method == formats::ReductionMethod::rubin) return "rubin";
  if (method == formats::ReductionMethod::macneal) return "macneal";
  if (internal.moments > 0) return "craig_bampton_moments";
  return internal.lambda.size() > 0 ? "craig_bampton" : "guyan";
}

/// Superelement with names, positions and rows.
formats::Superelement describe(const formats::Part& part, const InternalProblem& problem, Eigen::Index modes,
                               const std::string& method) {
  formats::Superelement element;
  element.name = part.name;
  element.method = method;
  element.producer = producer("reducer");
  element.units = part.units;
  element.node_position.resize(static_cast<Eigen::Index>(problem.mesh.boundary.size()), 3);
  for (std::size_t b = 0; b < problem.mesh.boundary.size(); ++b) {
    element.node_name.push_back(problem.mesh.boundary[b].name);
    element.node_position.row(b) = problem.mesh.position.col(problem.mesh.boundary[b].node).transpose();
  }
  element.dof_node = problem.partition.boundary_node;
  element.dof_component = problem.partition.boundary_component;
  for (int k = 0; k < modes; ++k) {
    element.dof_node.push_back(-1);
    element.dof_component.push_back(k);
  }
  return element;
}

/// max |S̄ R| over the boundary, rotations scaled by `length`. It is relative to the stiffest entry or, if that is less
/// (one boundary node: S̄_BB = 0), to m ω² of the softest mode.
double rigid_residual(const formats::Superelement& element, double length, const InternalModes& internal) {
  const Eigen::Index n_B = element.size() - internal.lambda.size();
  const Eigen::VectorXd scale = Eigen::VectorXd::NullaryExpr(
      n_B, [&](Eigen::Index i) { return element.dof_component[i] >= 3 ? 1.0 / length : 1.0; });
  const Eigen::Vector3d middle = element.node_position.colwise().mean();
  Eigen::MatrixXd R = formats::rigid_motions(element, middle).topRows(n_B);
  R.rightCols<3>() /= length;
  const Eigen::MatrixXd SR = scale.asDiagonal() * element.stiffness.topLeftCorner(n_B, n_B) * R;
  const Eigen::MatrixXd S = scale.asDiagonal() * element.stiffness.topLeftCorner(n_B, n_B) * scale.asDiagonal();
  const double softest = internal.lambda.size() > internal.loose() ? internal.lambda[internal.loose()]
                                                                   : internal.first_dropped.value_or(0.0);
  const double reference = std::max(S.cwiseAbs().maxCoeff(), softest * formats::rigid_properties(element).mass);
  return reference > 0.0 ? SR.cwiseAbs().maxCoeff() / reference : 0.0;
}

/// Makes S̄ R = 0 by projection, then restores the canonical zeros and eigenvalues.
void make_canonical(const InternalModes& internal, formats::Superelement& element) {
  const Eigen::Index m = internal.lambda.size(), n_B = element.size() - m;
  formats::filter_rigid_motions(element);
  element.stiffness.topRightCorner(n_B, m).setZero();
  element.stiffness.bottomLeftCorner(m, n_B).setZero();
  element.stiffness.bottomRightCorner(m, m) = internal.lambda.asDiagonal();
  element.mass.bottomRightCorner(m, m).setIdentity();
}

}  // namespace

Projection project(const formats::Part& part, const InternalProblem& problem, const BoundaryModes& boundary,
                   const InternalModes& internal) {
  const Blocks& b = problem.blocks;
  const Eigen::MatrixXd &Psi = boundary.Psi, &Phi = internal.Phi;
  const Eigen::Index n_B = problem.partition.n_B(), m = internal.lambda.size();
  Projection result{describe(part, problem, m, method_text(part.modes.method, internal)), {}};
  Eigen::MatrixXd& S = result.superelement.stiffness;
  Eigen::MatrixXd& M = result.superelement.mass;
  S.setZero(n_B + m, n_B + m);
  M.setZero(n_B + m, n_B + m);
  S.topLeftCorner(n_B, n_B) = boundary.S;
  M.topLeftCorner(n_B, n_B) = internal.boundary_mass.size() > 0 ? internal.boundary_mass : boundary.M;
  if (m > 0) {
    M.topRightCorner(n_B, m) = internal.coupling;
    M.bottomLeftCorner(m, n_B) = internal.coupling.transpose();
    const Eigen::MatrixXd force = b.S_IB.transpose() * Phi + Psi.transpose() * multiply(b.S_II, Phi);
    result.defects.stiffness_coupling = relative_maximum(force, internal.lambda);
    const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(m, m);
    if (internal.boundary_mass.size() == 0)
      result.defects.orthonormality = relative_maximum(Phi.transpose() * multiply(b.M_II, Phi) - identity, identity);
  }
  S.diagonal().tail(m) = internal.lambda;
  M.diagonal().tail(m).setOnes();
  result.defects.rigid_residual = rigid_residual(result.superelement, characteristic_length(problem.mesh), internal);
  make_canonical(internal, result.superelement);
  return result;
}

}  // namespace tisserand::reducer
