// Two translations, one turn, modes.
#include "mechanism/bodies/modal/in_plane.hpp"

#include "mechanism/frames/turn.hpp"

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

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// sums += P2 w.
void add_products(const Eigen::MatrixXd& P2, const VectorXd& w, VectorXd& sums) {
  for (Index i = 0; i < w.size(); ++i) {
    const double* column = P2.col(i).data();
    for (Index a = 0; a < sums.size(); ++a) sums[a] += column[a] * w[i];
  }
}

/// Rows and columns of translations, turn and modes of the tangent, [r · · · · ω ẇ].
constexpr Index turning = 5, first_mode = 6;

void add_mass_in_plane(const ModalBody& body, double factor, ModalScratch& s) {
  auto& K = s.tangent;
  const auto couple = [&](Index column, const Vector2d& force) {
    K.col(column).head<2>() += force;
    K.row(column).head<2>() += force.transpose();
  };
  K(0, 0) += factor * body.mass;
  K(1, 1) += factor * body.mass;
  K(turning, turning) += factor * s.J(2, 2);
  couple(turning, factor * turned(s.A, across(s.c.head<2>())));
  for (Index j = 0; j < body.modes; ++j) {
    K(first_mode + j, first_mode + j) += factor;
    K(turning, first_mode + j) += factor * s.N(2, j);
    K(first_mode + j, turning) += factor * s.N(2, j);
    couple(first_mode + j, factor * turned(s.A, body.C1.col(j).head<2>()));
  }
}

void add_damping_in_plane(const ModalBody& body, double factor, ModalScratch& s) {
  auto& K = s.tangent;
  const Index m = body.modes;
  const double om = s.om.z();
  K.col(turning).head<2>() += 2.0 * factor * turned(s.A, across(s.cd.head<2>()) - om * s.c.head<2>());
  K(turning, turning) += 2.0 * factor * s.wd.dot(s.S.head(m));
  for (Index j = 0; j < m; ++j) {
    K.col(first_mode + j).head<2>() += 2.0 * factor * om * turned(s.A, across(body.C1.col(j).head<2>()));
    K(turning, first_mode + j) += 2.0 * factor * om * s.S[j];
    K(first_mode + j, turning) += 2.0 * factor * (s.Sd[m + j] - om * s.S[j]);
  }
  K.bottomRightCorner(m, m) += 2.0 * factor * om * body.P2.bottomRows(m);
  K.diagonal().tail(m) += factor * body.damping;
}

void add_stiffness_in_plane(const ModalBody& body, double factor, ModalScratch& s) {
  auto& K = s.tangent;
  const Index m = body.modes;
  const double om = s.om.z(), omd = s.omd.z();
  const Vector2d c = s.c.head<2>(), cd = s.cd.head<2>(), ga = s.ga.head<2>();
  const Vector2d pulled = omd * across(c) + sum_of(body.C1, s.wdd) - om * om * c + 2.0 * om * across(cd);
  K.col(turning).head<2>() += factor * turned(s.A, across(pulled));
  K(turning, turning) -= factor * c.dot(ga);
  for (Index i = 0; i < m; ++i) {
    const Vector2d Ci = body.C1.col(i).head<2>();
    const double pull = cross(Ci, ga);
    K.col(first_mode + i).head<2>() += factor * turned(s.A, omd * across(Ci) - om * om * Ci);
    K(turning, first_mode + i) += factor * (pull + 2.0 * s.S[i] * omd - s.Sdd[m + i] + 2.0 * s.Sd[i] * om);
    K(first_mode + i, turning) += factor * pull;
  }
  K.bottomRightCorner(m, m) += factor * (omd * body.P2.bottomRows(m) - om * om * body.P2.topRows(m));
  K.diagonal().tail(m) += factor * body.stiffness;
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
  for (Index j = 0; j < m; ++j) {
    inertia += s.w[j] * (s.S[j] + body.P1[j]);
    s.N(2, j) = s.S[m + j] + body.N_mu(2, j);
  }
  s.J(2, 2) = inertia;
}

void residual_in_plane(const ModalBody& body, ModalScratch& s) {
  const Index m = body.modes;
  const double om = s.om.z(), omd = s.omd.z();
  const Vector2d c = s.c.head<2>(), cd = s.cd.head<2>(), ga = s.ga.head<2>();
  const Vector2d inner =
      body.mass * ga + omd * across(c) + sum_of(body.C1, s.wdd) - om * om * c + 2.0 * om * across(cd);
  s.r.head<2>() = turned(s.A, inner);
  s.r[turning] = cross(c, ga) + s.J(2, 2) * omd;
  for (Index j = 0; j < m; ++j) {
    s.r[turning] += s.N(2, j) * s.wdd[j] + 2.0 * om * s.wd[j] * s.S[j];
    s.r[first_mode + j] = body.C1(0, j) * ga.x() + body.C1(1, j) * ga.y() + s.N(2, j) * omd + s.wdd[j] -
                          om * om * s.S[j] + 2.0 * om * s.Sd[m + j] + body.stiffness[j] * s.w[j] +
                          body.damping[j] * s.wd[j];
  }
}

void tangent_in_plane(const ModalBody& body, const TangentCoefficients& coefficients, ModalScratch& s) {
  s.tangent.setZero();
  s.Sdd.setZero();
  add_products(body.P2, s.wdd, s.Sdd);
  if (coefficients.mass != 0.0) add_mass_in_plane(body, coefficients.mass, s);
  if (coefficients.damping != 0.0) add_damping_in_plane(body, coefficients.damping, s);
  if (coefficients.stiffness != 0.0) add_stiffness_in_plane(body, coefficients.stiffness, s);
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
  const auto [c, s] = Turn(theta);
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
