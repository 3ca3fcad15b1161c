// SPDX-License-Identifier: GPL-3.0-or-later
// Stiffness and masses of a rod, modes of a lumped model under reference conditions.
#include "tests/support/bodies/lumped_bodies.hpp"

#include <numbers>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace tisserand::test_support {

Eigen::MatrixXd beam_stiffness(const Rod& rod, double l) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(12, 12);
  const auto spring = [&K](int i, int j, double k) {
    K(i, i) += k;
    K(j, j) += k;
    K(i, j) -= k;
    K(j, i) -= k;
  };
  spring(0, 6, rod.E * rod.area / l);
  spring(3, 9, rod.G * 2.0 * rod.I / l);
  const double b = rod.E * rod.I / (l * l * l);
  for (const auto& [w, t, sign] : {std::tuple{1, 5, 1.0}, std::tuple{2, 4, -1.0}}) {
    const int at[] = {w, t, w + 6, t + 6};
    const double s = sign * l;
    Eigen::Matrix4d k;
    k << 12, 6 * s, -12, 6 * s, 6 * s, 4 * l * l, -6 * s, 2 * l * l, -12, -6 * s, 12, -6 * s, 6 * s, 2 * l * l, -6 * s,
        4 * l * l;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) K(at[i], at[j]) += b * k(i, j);
  }
  return K;
}

LumpedModel lumped_rod(const Rod& rod) {
  const int n = rod.elements + 1;
  const double l = rod.length / rod.elements;
  LumpedModel model;
  model.position.setZero(n, 3);
  model.mass.setZero(n);
  model.inertia.assign(static_cast<std::size_t>(n), Eigen::Matrix3d::Zero());
  model.stiffness.setZero(6 * n, 6 * n);
  const Eigen::Matrix3d half = 0.5 * l * rod.density * rod.I * Eigen::Vector3d(2, 1, 1).asDiagonal().toDenseMatrix();
  for (int k = 0; k < n; ++k) {
    model.name.push_back("n" + std::to_string(k));
    model.position(k, 0) = rod.x0 + k * l;
    for (int side = 0; side < 2; ++side) {
      if (k + side < 1 || k + side > rod.elements) continue;
      model.mass[k] += 0.5 * l * rod.density * rod.area;
      model.inertia[k] += half;
    }
  }
  for (int e = 0; e < rod.elements; ++e) model.stiffness.block(6 * e, 6 * e, 12, 12) += beam_stiffness(rod, l);
  return model;
}

void lumped_modes(const LumpedModel& model, const Conditions& conditions, int count, Eigen::VectorXd& omega2,
                  Eigen::MatrixXd& X) {
  const Eigen::Index n = 6 * model.nodes();
  Eigen::MatrixXd M = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index k = 0; k < model.nodes(); ++k) {
    M.block<3, 3>(6 * k, 6 * k) = model.mass[k] * Eigen::Matrix3d::Identity();
    M.block<3, 3>(6 * k + 3, 6 * k + 3) = model.inertia[k];
  }
  std::vector<int> massive, massless;
  for (int i = 0; i < n; ++i) {
    bool held = false;
    for (std::size_t c = 0; c < conditions.node.size(); ++c)
      held = held || i == 6 * conditions.node[c] + conditions.component[c];
    if (!held) (M.row(i).isZero(0.0) ? massless : massive).push_back(i);
  }
  const Eigen::MatrixXd& K = model.stiffness;
  Eigen::MatrixXd Kff = K(massive, massive), condensed(0, static_cast<Eigen::Index>(massive.size()));
  if (!massless.empty()) {
    condensed = -Eigen::MatrixXd(K(massless, massless)).ldlt().solve(Eigen::MatrixXd(K(massless, massive)));
    Kff += K(massive, massless) * condensed;
  }
  const Eigen::MatrixXd Mff = M(massive, massive);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(Kff, Mff);
  const Eigen::Index first = conditions.node.empty() ? 6 : 0;  // rigid motions of the free body
  const Eigen::VectorXd all = eigen.eigenvalues().tail(eigen.eigenvalues().size() - first);
  omega2 = all.head(count);
  if (count < all.size() && all[count] < (1.0 + 1e-6) * omega2[count - 1])
    throw std::invalid_argument(fmt::format(
        "{} modes cut a pair of equal frequencies in a direction of round-off: take one more or less", count));
  X.setZero(n, count);
  for (int j = 0; j < count; ++j) {
    Eigen::VectorXd mode = eigen.eigenvectors().col(first + j);
    for (std::size_t i = 0; i < massive.size(); ++i) X(massive[i], j) = mode[i];
    const Eigen::VectorXd rest = condensed * mode;
    for (std::size_t i = 0; i < massless.size(); ++i) X(massless[i], j) = rest[i];
    Eigen::Index largest = 0;
    X.col(j).cwiseAbs().maxCoeff(&largest);
    if (X(largest, j) < 0.0) X.col(j) *= -1.0;
  }
}

formats::ModalBody modal_body(const LumpedModel& model, const Conditions& conditions, int count) {
  formats::ModalBody body;
  body.name = "lumped";
  body.producer = "tests/support/bodies/lumped_bodies.hpp";
  body.units = Units::si();
  body.frame_position = (model.mass.transpose() * model.position).transpose() / model.mass.sum();
  body.reference = conditions.node.empty() ? formats::ModalReference::mean_axis : formats::ModalReference::nodes;
  body.reference_node = conditions.node;
  body.reference_component = conditions.component;
  body.node_name = model.name;
  body.node_position = model.position.rowwise() - body.frame_position.transpose();
  body.node_mass = model.mass;
  body.node_inertia = model.inertia;
  Eigen::MatrixXd X;
  lumped_modes(model, conditions, count, body.omega2, X);
  body.zeta.setZero(count);
  for (Eigen::Index k = 0; k < model.nodes(); ++k) body.X.emplace_back(X.middleRows<6>(6 * k));
  body.integrals = formats::integrals_of(body);
  return body;
}

Rod paper_rod() {
  const double area = 3.16e-5, E = 2.068e11;
  return {0.0, 0.3048, area, E, E / 2.6, area * area / static_cast<double>(4.0 * std::numbers::pi), 7820.0, 8};
}

Conditions rod_conditions(int elements) { return {{0, 0, 0, 0, elements, elements}, {0, 1, 2, 3, 1, 2}}; }

}  // namespace tisserand::test_support
