// Whole tangents of a superelement body: the step tangent in dense form, and the exact one by dual numbers.
#include <Eigen/Core>
#include <Eigen/LU>

#include "common/math/dual.hpp"
#include "mechanism/bodies/superelement/center_tangent.hpp"
#include "mechanism/bodies/superelement/coupling.hpp"
#include "mechanism/bodies/superelement/evaluate.hpp"
#include "mechanism/bodies/superelement/second_order_tangent.hpp"

namespace tisserand::mechanism {

namespace {

using Node = NodeMotionOf<Dual>;

Vec3<Dual> with_derivative(const Eigen::Vector3d& value, const Eigen::Vector3d& derivative) {
  Vec3<Dual> out;
  for (int i = 0; i < 3; ++i) out[i] = Dual(value[i], derivative[i]);
  return out;
}

Mat3<Dual> with_derivative(const Eigen::Matrix3d& value, const Eigen::Matrix3d& derivative) {
  Mat3<Dual> out;
  for (int i = 0; i < 9; ++i) out(i) = Dual(value(i), derivative(i));
  return out;
}

/// Node motion at v̇ + ε c_m d, v + ε c_c d, q + ε c_k d with the direction d of one node (translation, material
/// rotation).
Node perturbed(const NodeMotion& node, const Eigen::Vector3d& x, const Eigen::Vector3d& theta,
               const TangentCoefficients& c) {
  Node out;
  out.x = with_derivative(node.x, c.stiffness * x);
  out.R = with_derivative(node.R, node.R * skew<double>(c.stiffness * theta));
  out.xd = with_derivative(node.xd, c.damping * x);
  out.Omega = with_derivative(node.Omega, c.damping * theta);
  out.xdd = with_derivative(node.xdd, c.mass * x);
  out.Omegad = with_derivative(node.Omegad, c.mass * theta);
  return out;
}

/// Column by column: the derivative of (r_B, r_I) in each direction. R₀ at entry: the converged one for iterated
/// frames, the same reference as update_kinematics() had for the incremental one.
void exact_columns(const SuperelementBody& body, const SuperelementScratch& scratch, const NodeView<NodeMotion>& nodes,
                   const Eigen::Vector3d& gravity, const TangentCoefficients& c, Eigen::MatrixXd& A) {
  const int nb = body.boundary_size, n = nb + body.modes;
  A.resize(n, n);
  LocalMotion<Dual> motion = make_local_motion<Dual>(body);
  SuperelementForces<Dual> forces = make_forces<Dual>(body);
  forces.loads.factors = scratch.forces.loads.factors;
  std::vector<Node> moved(body.node.size());
  std::vector<int> index(body.node.size());
  const Eigen::Matrix3d& R0 = body.frame == FrameAlgorithm::incremental ? scratch.R0_reference : scratch.motion.R0;
  for (int column = 0; column < n; ++column) {
    const Eigen::VectorXd direction = Eigen::VectorXd::Unit(n, column);
    for (std::size_t i = 0; i < body.node.size(); ++i) {
      const SuperelementNode& node = body.node[i];
      Eigen::Vector3d x = Eigen::Vector3d::Zero(), theta = x;
      if (node.has_translation())
        x.head(body.translations()) = direction.segment(node.translation_row, body.translations());
      if (node.has_rotation()) theta.tail(body.rotations()) = direction.segment(node.rotation_row, body.rotations());
      moved[i] = perturbed(nodes[i], x, theta, c);
      index[i] = static_cast<int>(i);
    }
    for (int k = 0; k < body.modes; ++k) {
      const double d = direction[nb + k];
      motion.y_I[k] = Dual(scratch.motion.y_I[k], c.stiffness * d);
      motion.rate_I[k] = Dual(scratch.motion.rate_I[k], c.damping * d);
      motion.acceleration_I[k] = Dual(scratch.motion.acceleration_I[k], c.mass * d);
    }
    motion.R0 = R0.cast<Dual>();
    local_motion<Dual>(body, NodeView<Node>{moved.data(), index.data()}, motion);
    superelement_forces(body, motion, gravity, forces);
    for (int i = 0; i < nb; ++i) A(i, column) = forces.r_B[i].derivative;
    for (int k = 0; k < body.modes; ++k) A(nb + k, column) = forces.r_I[k].derivative;
  }
}

/// The matrices of the formulation in full, (nb + m) rows: P, Υ square; V, V₁ three columns; U three rows.
struct DenseForm {
  Eigen::MatrixXd S, M, D, P, Upsilon, V, V1, U, O0, OB, momentum;
};

/// Sets the blocks that belong to one node alone; Υ couples all of them and is set by dense_form().
void set_node_blocks(const SuperelementBody& body, const SuperelementScratch& scratch, std::size_t i, DenseForm& d) {
  const SuperelementNode& node = body.node[i];
  const LocalMotion<double>& motion = scratch.motion;
  const LocalNode<double>& local = motion.node[i];
  const bool option_A = body.inertia == formats::InertiaOption::A;
  if (node.has_translation()) {
    const int row = node.translation_row;
    d.P.block<3, 3>(row, row) = motion.R0.transpose();
    d.V.middleRows<3>(row) = skew<double>(local.xd);
    d.V1.middleRows<3>(row) = -skew<double>(scratch.forces.p_B.segment<3>(row));
    d.O0.block<3, 3>(row, row) = skew<double>(motion.Omega0);
    if (body.frame == FrameAlgorithm::polar) d.U.middleCols<3>(row) = local.U_x;
  }
  if (!node.has_rotation()) return;
  const int row = node.rotation_row;
  const Eigen::Matrix3d p = skew<double>(scratch.forces.p_B.segment<3>(row));
  d.U.middleCols<3>(row) = local.U;
  d.OB.block<3, 3>(row, row) = skew<double>(local.Omega);
  d.momentum.block<3, 3>(row, row) = p;
  if (option_A) {
    d.P.block<3, 3>(row, row) = local.E;
    d.V.middleRows<3>(row) = skew<double>(local.Omega);
    d.V1.middleRows<3>(row) = -p;
    d.O0.block<3, 3>(row, row) = skew<double>(motion.Omega0);
  }
}

DenseForm dense_form(const SuperelementBody& body, const SuperelementScratch& scratch) {
  const int nb = body.boundary_size, m = body.modes, n = nb + m;
  const auto zero = [](int rows, int cols) { return Eigen::MatrixXd(Eigen::MatrixXd::Zero(rows, cols)); };
  DenseForm d{zero(n, n),
              zero(n, n),
              zero(n, n),
              Eigen::MatrixXd::Identity(n, n),
              Eigen::MatrixXd::Identity(n, n),
              zero(n, 3),
              zero(n, 3),
              zero(3, n),
              zero(n, n),
              zero(n, n),
              zero(n, n)};
  d.S.topLeftCorner(nb, nb) = body.S_BB;
  d.S.bottomRightCorner(m, m) = body.S_II.asDiagonal();
  d.M << body.M_BB, body.M_BI, body.M_IB, Eigen::MatrixXd::Identity(m, m);
  if (body.damping.is_full()) d.D << body.damping.BB, body.damping.BI, body.damping.IB, body.damping.II;
  d.D.topLeftCorner(nb, nb) += body.damping.stiffness * body.S_BB;
  d.D.bottomRightCorner(m, m).diagonal() += body.damping.internal;
  for (std::size_t i = 0; i < body.node.size(); ++i) set_node_blocks(body, scratch, i, d);
  SuperelementTangent frozen = scratch.tangent;
  frozen.R0 = scratch.motion.R0;
  frozen.node = scratch.motion.node;
  Eigen::VectorXd column(nb);
  for (int j = 0; j < nb; ++j) {
    const Eigen::VectorXd unit = Eigen::VectorXd::Unit(nb, j);
    apply_upsilon(body, frozen, unit.data(), column);
    d.Upsilon.col(j).head(nb) = column;
  }
  return d;
}

}  // namespace

void uncondensed_tangent(const SuperelementBody& body, const SuperelementScratch& scratch,
                         const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                         const TangentCoefficients& c, TangentKind kind, Eigen::MatrixXd& A) {
  if (kind == TangentKind::exact) {
    exact_columns(body, scratch, nodes, gravity, c, A);
    return;
  }
  if (body.second_order.inertia) {
    A = whole_full_inertia_tangent(body, c, scratch);
    return;
  }
  if (body.planar) {
    A = planar_whole_tangent(body, c, scratch);
    return;
  }
  const DenseForm d = dense_form(body, scratch);
  const Eigen::MatrixXd PT = d.P.transpose(), UT = d.U.transpose();
  const Eigen::MatrixXd C1 = PT * (d.O0 * d.M + d.M * d.O0.transpose()) * d.P;
  const Eigen::MatrixXd C2 = PT * (d.M * d.V + d.V1) * d.U - UT * (d.V1.transpose() + d.V.transpose() * d.M) * d.P;
  const double sign = body.inertia == formats::InertiaOption::A ? -1.0 : 1.0;
  const Eigen::MatrixXd C3 = sign * PT * (d.OB * d.M - d.momentum) * d.P;
  const Eigen::MatrixXd UpsilonT = d.Upsilon.transpose();
  A = c.mass * PT * d.M * d.P + c.damping * (C1 + C2 + C3 + UpsilonT * d.D * d.Upsilon) +
      c.stiffness * UpsilonT * d.S * d.Upsilon;
  if (body.second_order.stiffening) A += whole_stiffening_tangent(body, c, scratch);
  if (body.inertia != formats::InertiaOption::M) return;
  SuperelementTangent frozen = scratch.tangent;
  frozen.coefficients = c;
  frozen.R0 = scratch.motion.R0;
  frozen.Omega0 = scratch.motion.Omega0;
  frozen.node = scratch.motion.node;
  A += center_of_mass_tangent(body, scratch.motion, frozen);
}

void exact_tangent(const SuperelementBody& body, const NodeView<NodeMotion>& nodes, const Eigen::Vector3d& gravity,
                   const TangentCoefficients& coefficients, SuperelementScratch& scratch, SuperelementWork& work) {
  const Eigen::Index nb = body.boundary_size, m = body.modes;
  SuperelementTangent& frozen = scratch.tangent;
  Eigen::MatrixXd A;
  exact_columns(body, scratch, nodes, gravity, coefficients, A);
  frozen.dense_coupling = true;
  frozen.A_BI = A.topRightCorner(nb, m);
  frozen.A_IB = A.bottomLeftCorner(m, nb);
  if (body.second_order.any()) {
    if (m > 0) frozen.factor.factor(A.bottomRightCorner(m, m));
    work.A_BB = A.topLeftCorner(nb, nb);
    if (m > 0) eliminate_internal(body, frozen, work);
    return;
  }
  if (body.damping.is_full()) {
    frozen.inverse_II = A.bottomRightCorner(m, m).inverse();
    work.A_BB = A.topLeftCorner(nb, nb) - frozen.A_BI * frozen.inverse_II * frozen.A_IB;
    return;
  }
  frozen.inverse_D = A.bottomRightCorner(m, m).diagonal().cwiseInverse();
  work.A_BB = A.topLeftCorner(nb, nb) - frozen.A_BI * frozen.inverse_D.asDiagonal() * frozen.A_IB;
}

}  // namespace tisserand::mechanism
