// SPDX-License-Identifier: GPL-3.0-or-later
// Loads of lumped masses and of nodes, and their static answers under the reference conditions.
#include "reducer/modal_body/static_answers.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include "reducer/algebra/factor.hpp"
#include "reducer/algebra/symmetric_rows.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Force and moment of a mass on its node under each of the twelve loads (RECOVERY.md, inertia loads), as in the
/// equations of modal bodies: rotary inertia feels angular accelerations, but not products of angular velocities.
Eigen::Matrix<double, 6, formats::inertia_loads> loads_of(const LumpedMass& lumped, const Vector3d& b) {
  Eigen::Matrix<double, 6, formats::inertia_loads> g;
  g.setZero();
  const double m = lumped.mass.mass;
  for (Index k = 0; k < 3; ++k) {
    const Vector3d e = Vector3d::Unit(k);
    g.col(k).head<3>() = m * e;
    g.col(3 + k).head<3>() = m * e.cross(b);
    g.col(3 + k).tail<3>() = lumped.mass.inertia * e;
    g.col(6 + k).head<3>() = m * (b - e * b[k]);
    const Index i = (k + 1) % 3, j = (k + 2) % 3;  // of the product without axis k: yz, xz, xy
    g.col(9 + k).head<3>() = -0.5 * m * (Vector3d::Unit(i) * b[j] + Vector3d::Unit(j) * b[i]);
  }
  for (Index k = 0; k < g.cols(); ++k) g.col(k).tail<3>() += lumped.arm.cross(g.col(k).head<3>());
  return g;
}

/// Loads on coordinates of the mesh: twelve of inertia, then unit forces on the nodes.
MatrixXd unit_loads(const AnsweredBody& body, std::vector<formats::AppliedLoad>& forces) {
  const Coordinates& numbers = body.system.coordinates;
  std::vector<int> place;
  for (const NamedNode& node : body.nodes)
    for (int c = 0; c < (numbers.rotates(node.node) ? 6 : 3); ++c) {
      forces.push_back({"", node.name, c});
      place.push_back(numbers.of(node.node, c));
    }
  const Index all = expand(body.system.T, MatrixXd::Zero(body.system.size(), 1)).rows();
  MatrixXd g = MatrixXd::Zero(all, formats::inertia_loads + static_cast<Index>(forces.size()));
  for (const LumpedMass& lumped : body.masses) {
    const int node = lumped.mass.node;
    const auto own = loads_of(lumped, body.position.col(node) + lumped.arm - body.center);
    for (int c = 0; c < (numbers.rotates(node) ? 6 : 3); ++c)
      g.row(numbers.of(node, c)).head<formats::inertia_loads>() += own.row(c);
  }
  for (std::size_t k = 0; k < place.size(); ++k) g(place[k], formats::inertia_loads + static_cast<Index>(k)) = 1.0;
  return g;
}

/// Displacements K_II⁻¹ g of all coordinates, with the held ones at rest.
MatrixXd answers_on(const System& system, const std::vector<int>& held, const MatrixXd& g) {
  Partition p;
  p.boundary = held;
  for (int i = 0; i < system.size(); ++i)
    if (std::ranges::find(held, i) == held.end()) p.internal.push_back(i);
  const Factor factor(split(system.matrices, p).S_II);
  MatrixXd answers = MatrixXd::Zero(g.rows(), g.cols());
  answers(p.internal, Eigen::all) = factor.solve(rows(g, p.internal));
  return answers;
}

MatrixXd symmetric(const MatrixXd& A) { return 0.5 * (A + A.transpose()); }

}  // namespace

LumpedAnswers lumped_answers(const AnsweredBody& body) {
  const System& system = body.system;
  LumpedAnswers answers;
  const MatrixXd g = gather(system.T, unit_loads(body, answers.forces));
  MatrixXd w;
  if (!body.held.empty()) {
    w = answers_on(system, body.held, g);
  } else {
    const Eigen::LDLT<MatrixXd> rigid(system.R.transpose() * system.MR);
    w = answers_on(system, six_coordinates(system), g - system.MR * rigid.solve(system.R.transpose() * g));
    w -= system.R * rigid.solve(system.MR.transpose() * w);
  }
  const Index n = static_cast<Index>(answers.forces.size());
  answers.share = body.q.transpose() * g;
  for (const int q : body.held) w.row(q).setZero();
  w -= body.q * (body.lambda.cwiseInverse().asDiagonal() * answers.share);
  const MatrixXd of_forces = w.rightCols(n);
  answers.flexibility = symmetric(g.rightCols(n).transpose() * of_forces);
  answers.mass =
      symmetric(of_forces.transpose() * multiply(symmetric_rows(system.matrices, system.matrices.M), of_forces));
  answers.coupling = rigid_momenta_about(system, body.center).transpose() * of_forces;
  answers.x = expand(system.T, w);
  return answers;
}

}  // namespace tisserand::reducer
