// From arrays on the coordinates of a body to the constants of its second-order terms.
#include "mechanism/bodies/superelement/second_order.hpp"

#include <cmath>

#include <Eigen/Eigenvalues>

#include "common/math/rotation.hpp"
#include "mechanism/bodies/superelement/body.hpp"

namespace tisserand::mechanism {

namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd whole_mass(const SuperelementBody& body) {
  const int nb = body.boundary_size, m = body.modes;
  MatrixXd M = MatrixXd::Identity(nb + m, nb + m);
  M.topLeftCorner(nb, nb) = body.M_BB;
  M.topRightCorner(nb, m) = body.M_BI;
  M.bottomLeftCorner(m, nb) = body.M_IB;
  return M;
}

/// J₀⁻¹, zero for the axis of a line of masses without rotary inertia; rotations measured by `length`.
Eigen::Matrix<double, 6, 6> invert_inertia(const Eigen::Matrix<double, 6, 6>& J0, double length) {
  constexpr double no_inertia = 1e-12;
  Eigen::Matrix<double, 6, 1> unit;
  unit << 1.0, 1.0, 1.0, 1.0 / length, 1.0 / length, 1.0 / length;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(unit.asDiagonal() * J0 * unit.asDiagonal());
  Eigen::Matrix<double, 6, 1> inverse = solver.eigenvalues();
  for (int i = 0; i < 6; ++i) inverse[i] = inverse[i] > no_inertia * solver.eigenvalues()[5] ? 1.0 / inverse[i] : 0.0;
  return unit.asDiagonal() * solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose() *
         unit.asDiagonal();
}

/// C and E after the Galilean step ([SO] 2.2): C_k += (M̄ R_T/m) d_k, and what keeps [M̄ C; Cᵀ E] a Gram matrix.
struct Turning {
  std::array<MatrixXd, 3> C;
  std::vector<MatrixXd> E;
};

Turning exact_under_translation(const FullInertia& inertia, double mass, const SecondOrderArrays& arrays) {
  const MatrixXd RT = inertia.R.leftCols<3>(), S1 = inertia.MR.leftCols<3>().transpose();
  std::array<MatrixXd, 3> A, d;
  Turning turning{arrays.C, {arrays.E.begin(), arrays.E.end()}};
  for (int k = 0; k < 3; ++k) {
    A[k] = RT.transpose() * arrays.C[k];
    d[k] = skew<double>(Eigen::Vector3d::Unit(k)) * S1 - A[k];
    turning.C[k] += inertia.MR.leftCols<3>() * d[k] / mass;
  }
  constexpr int pair[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}};
  for (int a = 0; a < 6; ++a) {
    const auto [j, k] = pair[a];
    const MatrixXd step = (A[j].transpose() * d[k] + A[k].transpose() * d[j] + d[j].transpose() * d[k]) / mass;
    turning.E[a] += 0.5 * (step + step.transpose());
  }
  return turning;
}

}  // namespace

Stiffening make_stiffening(const SuperelementBody& body, const std::vector<MatrixXd>& H) {
  constexpr double no_strain = 1e-9;
  const int nb = body.boundary_size, m = body.modes;
  const VectorXd unit = coordinate_units(body);
  const MatrixXd scaled = unit.head(nb).asDiagonal() * body.S_BB * unit.head(nb).asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> solver(scaled);
  const VectorXd& lambda = solver.eigenvalues();
  const Eigen::Index strained = (lambda.array() > no_strain * lambda[nb - 1]).count(), rows = strained + m;
  Stiffening out;
  out.L = MatrixXd::Zero(rows, nb + m);
  MatrixXd inverse = MatrixXd::Zero(nb + m, rows);
  for (Eigen::Index a = 0; a < strained; ++a) {
    const VectorXd v = solver.eigenvectors().col(nb - strained + a);
    const double root = std::sqrt(lambda[nb - strained + a]);
    out.L.row(a).head(nb) = root * v.cwiseQuotient(unit.head(nb));
    inverse.col(a).head(nb) = v.cwiseProduct(unit.head(nb)) / root;
  }
  for (int i = 0; i < m; ++i) {
    out.L(strained + i, nb + i) = std::sqrt(body.S_II[i]);
    inverse(nb + i, strained + i) = 1.0 / std::sqrt(body.S_II[i]);
  }
  std::vector<MatrixXd> Gamma(static_cast<std::size_t>(rows), MatrixXd::Zero(nb + m, nb + m));
  for (Eigen::Index a = 0; a < rows; ++a)
    for (int j = 0; j < nb + m; ++j)
      if (inverse(j, a) != 0.0) Gamma[a] += inverse(j, a) * H[j];
  out.Gamma = quadratic_forms(Gamma, unit);
  return out;
}

FullInertia make_full_inertia(const SuperelementBody& body, const SecondOrderArrays& arrays,
                              Foreshortening foreshortening) {
  FullInertia inertia;
  inertia.M = whole_mass(body);
  inertia.R = rigid_columns(body);
  inertia.MR = inertia.M * inertia.R;
  double length = 0.0;
  for (const SuperelementNode& node : body.node) length = std::max(length, node.X.norm());
  inertia.J0_inverse = invert_inertia(inertia.R.transpose() * inertia.MR, length > 0.0 ? length : 1.0);
  const Turning turning = exact_under_translation(inertia, body.mass, arrays);
  const Eigen::Index n = inertia.M.rows();
  inertia.C.resize(3 * n, n);
  for (int k = 0; k < 3; ++k) inertia.C.middleRows(k * n, n) = turning.C[k];
  const VectorXd unit = coordinate_units(body);
  inertia.E = quadratic_forms(turning.E, unit);
  switch (foreshortening) {
    case Foreshortening::off:
      break;
    case Foreshortening::on: {
      std::vector<MatrixXd> NT(arrays.N.begin(), arrays.N.end());
      NT.insert(NT.end(), arrays.T.begin(), arrays.T.end());
      inertia.NT = quadratic_forms(NT, unit);
      break;
    }
  }
  return inertia;
}

}  // namespace tisserand::mechanism
