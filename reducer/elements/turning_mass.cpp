// Sums over the points of an element, and the motion of its nodes taken off.
#include "reducer/elements/turning_mass.hpp"

#include "common/math/rotation.hpp"
#include "formats/companion/companion.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Loads = Eigen::Matrix<double, 3, inertial_loads>;

Matrix3d axis_skew(int k) { return skew<double>(Vector3d(Vector3d::Unit(k))); }

/// Forces on the centre of mass, and moments about it.
struct PointLoads {
  Loads force, moment;
};

PointLoads loads_on(const MassPoint& point, const Vector3d& X) {
  PointLoads loads;
  loads.force << point.mass * Matrix3d::Identity(), -point.mass * skew<double>(X), Eigen::Matrix<double, 3, 6>::Zero();
  loads.moment << Matrix3d::Zero(), point.inertia, Eigen::Matrix<double, 3, 6>::Zero();
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    for (Loads* on : {&loads.force, &loads.moment})
      on->col(6 + pair) = -0.5 * (axis_skew(k) * on->col(3 + j) + axis_skew(j) * on->col(3 + k));
  }
  return loads;
}

/// C and E of masses that move with `U` (three rows for each mass, x of all masses first).
void add_translation(const MatrixXd& U, const Eigen::VectorXd& mass, TurningMass& out) {
  const Index count = mass.size();
  std::array<std::array<MatrixXd, 3>, 3> P;  // Σ m u_a u_b
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      P[a][b].noalias() =
          U.middleRows(a * count, count).transpose() * (mass.asDiagonal() * U.middleRows(b * count, count)).eval();
      if (b > a) P[b][a] = P[a][b].transpose();
    }
  for (int k = 0; k < 3; ++k) {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    out.C[k] = P[j][i] - P[i][j];
    out.E[k] = P[i][i] + P[j][j];
    out.E[formats::axis_pair(i, j)] = -0.5 * (P[i][j] + P[j][i]);
  }
}

/// out += Θᵀ K Θ.
void add_form(const RotaryMass& part, const Matrix3d& K, MatrixXd& out) {
  if (part.weight.size() == 0) {
    out.noalias() += part.rotation.transpose() * (K * part.rotation).eval();
    return;
  }
  for (Index i = 0; i < part.weight.rows(); ++i)
    for (Index j = 0; j < part.weight.cols(); ++j) out.block<3, 3>(6 * i + 3, 6 * j + 3) += part.weight(i, j) * K;
}

void add_rotary(const RotaryMass& part, TurningMass& out) {
  const Matrix3d& J = part.inertia;
  for (int k = 0; k < 3; ++k) {
    add_form(part, J * axis_skew(k), out.C[k]);
    add_form(part, -0.5 * skew<double>(Vector3d(J.col(k))), out.W[k]);
  }
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    const Matrix3d E = -axis_skew(j) * J * axis_skew(k);
    add_form(part, 0.5 * (E + E.transpose()), out.E[pair]);
    // ½ θᵀ K θ = ¼ [(J e_j)·(θ × (θ × e_k)) + (J e_k)·(θ × (θ × e_j))]
    add_form(part, 0.5 * (arm_form(J.col(j), Vector3d::Unit(k)) + arm_form(J.col(k), Vector3d::Unit(j))), out.T[pair]);
  }
}

/// What ω × multiplies, for each load: Z of ω·Z d = Σ load·(ω × ...).
using TurnedLoads = std::array<ElementRows3, inertial_loads>;

void add_turned(const Vector3d& f, const Vector3d& m, const ElementRows3& u, const ElementRows3& rotation, double sign,
                ElementRows3& Z) {
  Z.noalias() -= (sign * skew<double>(f)) * u;
  Z.noalias() -= (0.5 * sign * skew<double>(m)) * rotation;
}

/// The motion of the points with the element, less what their nodes have of it.
void add_turn(const MovingMass& mass, const std::vector<PointLoads>& loads, const Vector3d& reference, TurningMass& out,
              std::array<MatrixXd*, inertial_loads> form) {
  const Index n = mass.coordinates;
  TurnedLoads Z;
  for (ElementRows3& one : Z) one.setZero(3, n);
  for (std::size_t p = 0; p < mass.points.size(); ++p) {
    const MassPoint& point = mass.points[p];
    const ElementRows3 u = point.displacement + 0.5 * skew<double>(Vector3d(point.at - reference)) * mass.turn;
    for (int l = 0; l < inertial_loads; ++l) {
      const Vector3d f = loads[p].force.col(l), m = loads[p].moment.col(l) + point.centre.cross(f);
      add_turned(f, m, u, point.rotation, 1.0, Z[l]);
    }
  }
  for (Index i = 0; i < mass.nodes.cols(); ++i) {
    ElementRows3 u = 0.5 * skew<double>(Vector3d(mass.nodes.col(i) - reference)) * mass.turn;
    ElementRows3 psi = ElementRows3::Zero(3, n);
    u.middleCols<3>(6 * i) += Matrix3d::Identity();
    psi.middleCols<3>(6 * i + 3) = Matrix3d::Identity();
    const ElementRows3 beside = psi - mass.turn;
    const Vector3d r = mass.arms.col(i);
    for (int l = 0; l < inertial_loads; ++l) {
      const Vector3d f = out.load.block<3, 1>(6 * i, l), m = out.load.block<3, 1>(6 * i + 3, l);
      add_turned(f, m, u, psi, -1.0, Z[l]);
      if (!r.isZero(0.0)) form[l]->noalias() += beside.transpose() * (arm_form(f, r) * beside).eval();
    }
  }
  for (int l = 0; l < inertial_loads; ++l) {
    const MatrixXd half = mass.turn.transpose() * Z[l];
    *form[l] += half + half.transpose();
  }
}

}  // namespace

Matrix3d arm_form(const Vector3d& f, const Vector3d& c) {
  return 0.5 * (f * c.transpose() + c * f.transpose()) - f.dot(c) * Matrix3d::Identity();
}

MatrixXd crossed(int k, const MatrixXd& rows) {
  MatrixXd result(rows.rows(), rows.cols());
  const int i = (k + 1) % 3, j = (k + 2) % 3;
  for (Index first = 0; first + 2 < rows.rows(); first += 3) {
    result.row(first + k).setZero();
    result.row(first + i) = -rows.row(first + j);
    result.row(first + j) = rows.row(first + i);
  }
  return result;
}

void turning_mass(const MovingMass& mass, const Vector3d& reference, TurningMass& out) {
  const Index n = mass.coordinates, count = static_cast<Index>(mass.points.size());
  std::array<MatrixXd*, inertial_loads> form;
  for (int a = 0; a < 6; ++a) {
    form[a] = &out.N[a];
    form[6 + a] = &out.T[a];
  }
  for (MatrixXd* one : form) one->setZero(n, n);
  for (MatrixXd& W : out.W) W.setZero(n, n);
  out.load.setZero(n, inertial_loads);
  MatrixXd U(3 * count, n);
  Eigen::VectorXd masses(count);
  std::vector<PointLoads> loads;
  for (Index p = 0; p < count; ++p) {
    const MassPoint& point = mass.points[static_cast<std::size_t>(p)];
    const ElementRows3 centre = point.displacement - skew<double>(point.centre) * point.rotation;
    for (int a = 0; a < 3; ++a) U.row(a * count + p) = centre.row(a);
    masses[p] = point.mass;
    loads.push_back(loads_on(point, point.at + point.centre - reference));
    out.load.noalias() += centre.transpose() * loads.back().force;
    out.load.noalias() += point.rotation.transpose() * loads.back().moment;
    if (point.centre.isZero(0.0)) continue;
    for (int l = 0; l < inertial_loads; ++l)
      form[l]->noalias() +=
          point.rotation.transpose() * (arm_form(loads.back().force.col(l), point.centre) * point.rotation).eval();
  }
  add_translation(U, masses, out);
  if (mass.turn.cols() > 0) add_turn(mass, loads, reference, out, form);
  for (const RotaryMass& part : mass.rotary) add_rotary(part, out);
}

void turning_mass(const MatrixXd& M, const MatrixXd& D, TurningMass& out) {
  const Index n = M.rows();
  std::array<MatrixXd, 3> MX;  // M [e_k ×]
  for (int k = 0; k < 3; ++k) {
    MX[k] = -crossed(k, M).transpose();
    out.C[k] = MX[k];
  }
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    const MatrixXd E = -crossed(j, MX[k]);
    out.E[pair] = 0.5 * (E + E.transpose());
  }
  out.load.resize(n, inertial_loads);
  out.load.leftCols<6>().noalias() = M * D;
  for (int pair = 0; pair < 6; ++pair) {
    const auto [j, k] = formats::axis_pairs[pair];
    out.load.col(6 + pair) = -0.5 * (crossed(k, out.load.col(3 + j)) + crossed(j, out.load.col(3 + k)));
  }
}

MovingMass moving_mass(const Mesh& mesh, const NodalMass& mass) {
  MovingMass moving;
  moving.coordinates = 6;
  MassPoint point;
  point.displacement.setZero(3, 6);
  point.displacement.leftCols<3>().setIdentity();
  point.rotation.setZero(3, 6);
  point.rotation.rightCols<3>().setIdentity();
  point.at = mesh.position.col(mass.node);
  point.mass = mass.mass;
  point.centre = mass.offset;
  point.inertia = 0.5 * (mass.inertia + mass.inertia.transpose());
  moving.rotary = {{point.inertia, point.rotation, {}}};
  moving.points = {point};
  return moving;
}

}  // namespace tisserand::reducer
