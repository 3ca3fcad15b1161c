// Condensation and expansion around the global solve.
#include "mechanism/equations/newton.hpp"

#include <cmath>

#include "common/math/rotation.hpp"
#include "mechanism/equations/carriers.hpp"

namespace tisserand::mechanism {
namespace {

/// exp of a rotation vector as a quaternion.
Eigen::Quaterniond exp_quaternion(const Eigen::Vector3d& turn) {
  const double a2 = turn.squaredNorm();
  const AngleFunctions<double> half(0.25 * a2);
  // cos(a/2) = 1 − (a/2)² c(a/2), sin(a/2)/a = s(a/2)/2
  Eigen::Quaterniond q;
  q.w() = 1.0 - 0.25 * a2 * half.c;
  q.vec() = 0.5 * half.s * turn;
  return q;
}

/// Material increment T(θ) d of a node's rotation for an increment d of the rotation vector θ of the step.
Eigen::Vector3d turn_increment(const Model& model, const Workspace& workspace, int node, const Eigen::Vector3d& d) {
  if (node < 0 || model.nodes[node].rotation < 0) return d;
  const Eigen::Vector3d theta = workspace.displacement.segment<3>(model.nodes[node].rotation);
  const AngleFunctions<double> f(theta.squaredNorm());
  const Eigen::Vector3d across = theta.cross(d);
  return d - f.c * across + f.d * theta.cross(across);
}

/// d_B of superelement i from the boundary coordinates.
void gather(const Model& model, std::size_t i, const Eigen::VectorXd& boundary, Workspace& workspace) {
  const std::vector<int>& coordinates = model.superelement_maps[i].coordinates;
  for (std::size_t k = 0; k < coordinates.size(); ++k) workspace.element_boundary[k] = boundary[coordinates[k]];
}

/// Solves with the factors of the scaled matrix, unknowns in place.
void solve_scaled(const Model& model, Workspace& workspace) {
  workspace.unknowns.array() *= model.equation_scale;
  workspace.solver.solve({workspace.unknowns.data(), static_cast<std::size_t>(workspace.unknowns.size())});
  workspace.unknowns.array() *= model.equation_scale;
}

}  // namespace

FactorReport factor(const Model& model, const State& state, const TangentCoefficients& coefficients, TangentKind kind,
                    const ConstraintRows& rows, Workspace& workspace) {
  evaluate_tangent(model, state, coefficients, kind, rows, workspace);
  Eigen::Map<Eigen::ArrayXd>(workspace.values.data(), model.value_scale.size()) *= model.value_scale;
  const FactorReport report = workspace.solver.numeric(workspace.values);
  workspace.factored = coefficients;
  workspace.has_factors = report.regular;
  return report;
}

void solve_increment(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& rows, Workspace& workspace) {
  const int n = model.sizes.boundary;
  auto boundary = workspace.unknowns.head(n);
  boundary = -workspace.residual;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    const SuperelementScratch& scratch = workspace.superelements[i];
    SuperelementWork& work = work_of(model, i, workspace);
    condense(body_of(model, i), scratch, work);
    const std::vector<int>& coordinates = model.superelement_maps[i].coordinates;
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      boundary[coordinates[k]] += scratch.forces.r_B[at] - work.r_B_condensed[at];
    }
  }
  boundary /= workspace.matrix_scale;
  workspace.unknowns.tail(model.sizes.constraints) = rows.cwiseProduct(workspace.active);
  solve_scaled(model, workspace);
  workspace.increment.head(n) = workspace.unknowns.head(n);
  workspace.unknowns.tail(model.sizes.constraints) *= workspace.matrix_scale;
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    gather(model, i, workspace.increment, workspace);
    expand(body_of(model, i), workspace.superelements[i], workspace.element_boundary.data(),
           workspace.increment.data() + n + model.internal_offset[i], work_of(model, i, workspace));
  }
}

void solve_correction(const Model& model, const Eigen::Ref<const Eigen::VectorXd>& rows, Workspace& workspace) {
  const int n = model.sizes.boundary;
  workspace.unknowns.head(n).setZero();
  workspace.unknowns.tail(model.sizes.constraints) = rows.cwiseProduct(workspace.active);
  solve_scaled(model, workspace);
  workspace.correction.head(n) = workspace.unknowns.head(n);
  for (std::size_t i = 0; i < model.superelements.size(); ++i) {
    // expand() is affine in d_B: −D⁻¹ (r_I + A_IB d_B); the correction is its linear part.
    const SuperelementBody& body = body_of(model, i);
    const SuperelementScratch& scratch = workspace.superelements[i];
    double* internal = workspace.correction.data() + n + model.internal_offset[i];
    gather(model, i, workspace.correction, workspace);
    expand(body, scratch, workspace.element_boundary.data(), internal, work_of(model, i, workspace));
    for (int k = 0; k < body.modes; ++k) internal[k] += scratch.tangent.inverse_D[k] * scratch.forces.r_I[k];
  }
}

std::string weakest_equation(const Model& model, Workspace& workspace) {
  workspace.unknowns.setOnes();
  Eigen::Index at = 0;
  for (int i = 0; i < 2; ++i) {
    solve_scaled(model, workspace);
    const double largest = workspace.unknowns.cwiseAbs().maxCoeff(&at);
    if (!(largest > 0.0) || !std::isfinite(largest)) break;
    workspace.unknowns /= largest;
  }
  return at < model.sizes.boundary ? coordinate_name(model, static_cast<int>(at))
                                   : constraint_name(model, static_cast<int>(at) - model.sizes.boundary);
}

void apply_jacobian(const Model& model, const Workspace& workspace, const Eigen::VectorXd& d,
                    Eigen::Ref<Eigen::VectorXd> rows) {
  Eigen::Matrix<double, 12, 1> local;
  const auto gather_local = [&](const ElementMap& map, const auto& pair) {
    if (!map.carriers.empty()) {
      pushed_increment(model, map, workspace, d, local.data());
      return;
    }
    for (int k = 0; k < 12; ++k) {
      const int coordinate = map.coordinates[k];
      local[k] = coordinate < 0 ? 0.0 : d[coordinate];
    }
    local.segment<3>(3) = turn_increment(model, workspace, pair.a.node, local.segment<3>(3));
    local.segment<3>(9) = turn_increment(model, workspace, pair.b.node, local.segment<3>(9));
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    gather_local(model.joint_maps[i], model.joints[i]);
    const Vector6d product = workspace.joints[i].B.lazyProduct(local);  // rows beyond the joint's size are zero
    for (int k = 0; k < model.joints[i].size(); ++k) rows[model.joints[i].row + k] = product[k];
  }
  for (const Coupling& coupling : model.couplings) {
    double sum = 0.0;
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      gather_local(model.coordinate_maps[at], model.coordinates[at]);
      sum += term.factor * workspace.coordinates[at].G.dot(local);
    }
    rows[coupling.row] = sum;
  }
}

void retract(const Model& model, const State& from, const Eigen::VectorXd& d, State& to) {
  auto x = to.x();
  auto Q = to.Q();
  const auto x0 = from.x();
  const auto Q0 = from.Q();
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    const auto column = static_cast<Eigen::Index>(i);
    if (node.translation >= 0) x.col(column) = x0.col(column) + d.segment<3>(node.translation);
    if (node.rotation >= 0) {
      const Eigen::Quaterniond q0(Q0(0, column), Q0(1, column), Q0(2, column), Q0(3, column));
      Q.col(column) = wxyz(q0 * exp_quaternion(d.segment<3>(node.rotation)));
    }
  }
  to.w() = from.w() + d.segment(model.sizes.first_modal(), model.sizes.modal);
  to.y() = from.y() + d.tail(model.sizes.internal);
}

}  // namespace tisserand::mechanism
