// Two translations, one turn, modes.
#include "mechanism/bodies/planar/modal_in_plane.hpp"

#include <cmath>

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::Map;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// e_z × v.
Vector2d across(const Vector2d& v) { return {-v.y(), v.x()}; }

/// R v for a rotation about z.
Vector2d turned(const Eigen::Matrix3d& R, const Vector2d& v) {
  return {R(0, 0) * v.x() + R(0, 1) * v.y(), R(1, 0) * v.x() + R(1, 1) * v.y()};
}

/// Σ_j C.col(j) w_j of its first two rows.
Vector2d sum_of(const Eigen::Matrix3Xd& C, const VectorXd& w) {
  Vector2d sum = Vector2d::Zero();
  for (Index j = 0; j < w.size(); ++j) sum += C.col(j).head<2>() * w[j];
  return sum;
}

/// The four numbers of each 3 x 3 block that stay in the plane.
constexpr int block_in_plane[] = {0, 1, 3, 4};

/// blocks += P2 w, of these numbers.
void add_products(const Eigen::MatrixXd& P2, const VectorXd& w, VectorXd& blocks) {
  for (Index i = 0; i < w.size(); ++i) {
    const double* column = P2.col(i).data();
    for (Index first = 0; first < blocks.size(); first += 9)
      for (const int a : block_in_plane) blocks[first + a] += column[first + a] * w[i];
  }
}

}  // namespace

void update_kinematics_in_plane(const ModalBody& body, const NodeMotion& frame, const ModalCoordinates& modes,
                                const Vector3d& gravity, ModalScratch& s) {
  const Index m = body.modes;
  s.A = frame.R;
  s.om.z() = frame.Omega.z();
  s.omd.z() = frame.Omegad.z();
  const Vector2d felt = (frame.xdd - gravity).head<2>();
  s.ga.head<2>() = Vector2d(s.A(0, 0) * felt.x() + s.A(1, 0) * felt.y(), s.A(0, 1) * felt.x() + s.A(1, 1) * felt.y());
  s.w = Map<const VectorXd>(modes.w, m);
  s.wd = Map<const VectorXd>(modes.wd, m);
  s.wdd = Map<const VectorXd>(modes.wdd, m);
  s.c.head<2>() = body.c0.head<2>() + sum_of(body.C1, s.w);
  s.cd.head<2>() = sum_of(body.C1, s.wd);
  s.S = body.P1;
  add_products(body.P2, s.w, s.S);
  s.Sd.setZero();
  add_products(body.P2, s.wd, s.Sd);
  double inertia = body.P0(0, 0) + body.P0(1, 1) + body.J_mu(2, 2);
  for (const int k : {0, 1})
    for (const int l : {0, 1}) s.D(k, l) = 0.0;
  for (Index j = 0; j < m; ++j) {
    const double *S = s.S.data() + 9 * j, *P1 = body.P1.data() + 9 * j;
    inertia += s.w[j] * (S[0] + P1[0] + S[4] + P1[4]);
    for (const int k : {0, 1})
      for (const int l : {0, 1}) s.D(k, l) += s.wd[j] * S[k + 3 * l];
    s.N(2, j) = S[3] - S[1] + body.N_mu(2, j);
  }
  s.J(2, 2) = inertia;
}

void residual_in_plane(const ModalBody& body, ModalScratch& s) {
  const double om = s.om.z(), omd = s.omd.z();
  const Vector2d c = s.c.head<2>(), cd = s.cd.head<2>(), ga = s.ga.head<2>();
  const Vector2d inner =
      body.mass * ga + omd * across(c) + sum_of(body.C1, s.wdd) - om * om * c + 2.0 * om * across(cd);
  s.r.head<2>() = turned(s.A, inner);
  s.r[5] = c.x() * ga.y() - c.y() * ga.x() + s.J(2, 2) * omd + 2.0 * om * (s.D(0, 0) + s.D(1, 1));
  for (Index j = 0; j < body.modes; ++j) {
    const double *S = s.S.data() + 9 * j, *Sd = s.Sd.data() + 9 * j;
    s.r[5] += s.N(2, j) * s.wdd[j];
    s.r[6 + j] = body.C1(0, j) * ga.x() + body.C1(1, j) * ga.y() + s.N(2, j) * omd + s.wdd[j] -
                 om * om * (S[0] + S[4]) + 2.0 * om * (Sd[3] - Sd[1]) + body.stiffness[j] * s.w[j] +
                 body.damping[j] * s.wd[j];
  }
}

void update_node_in_plane(const ModalNode& node, const ModalScratch& body, const NodeMotion& frame, NodeMotion& motion,
                          ModalNodeTerms& t) {
  const double om = frame.Omega.z(), omd = frame.Omegad.z();
  double theta = 0.0, rate = 0.0, second = 0.0;
  Vector2d moved = Vector2d::Zero(), pushed = Vector2d::Zero();
  t.b.head<2>() = node.x.head<2>();
  t.A = frame.R;
  for (Index j = 0; j < node.Xd.cols(); ++j) {
    const Vector2d X = node.Xd.col(j).head<2>();
    t.b.head<2>() += X * body.w[j];
    moved += X * body.wd[j];
    pushed += X * body.wdd[j];
    theta += node.Xt(2, j) * body.w[j];
    rate += node.Xt(2, j) * body.wd[j];
    second += node.Xt(2, j) * body.wdd[j];
    t.T.col(6 + j).head<2>() = turned(t.A, X);
    t.T(5, 6 + j) = node.Xt(2, j);
  }
  const Vector2d b = t.b.head<2>();
  t.theta.z() = theta;
  t.rate.z() = rate;
  t.om.z() = om;
  const double c = std::cos(theta), s = std::sin(theta);
  t.E(0, 0) = t.E(1, 1) = c;
  t.E(0, 1) = -s;
  t.E(1, 0) = s;
  t.T.col(5).head<2>() = turned(t.A, across(b));
  t.T(5, 5) = 1.0;
  t.bias.head<2>() = turned(t.A, 2.0 * om * across(moved) - om * om * b);

  motion.x = frame.x;
  motion.x.head<2>() += turned(t.A, b);
  motion.R(0, 0) = motion.R(1, 1) = t.A(0, 0) * c - t.A(1, 0) * s;
  motion.R(0, 1) = -(motion.R(1, 0) = t.A(1, 0) * c + t.A(0, 0) * s);
  motion.xd.head<2>() = frame.xd.head<2>() + turned(t.A, om * across(b) + moved);
  motion.Omega.z() = om + rate;
  motion.xdd.head<2>() = frame.xdd.head<2>() + t.bias.head<2>() + turned(t.A, omd * across(b) + pushed);
  motion.Omegad.z() = omd + second;
}

}  // namespace tisserand::mechanism
