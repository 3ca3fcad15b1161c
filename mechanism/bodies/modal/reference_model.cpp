// SPDX-License-Identifier: GPL-3.0-or-later
// First frequency of a modal body with held components: by its modes, and with residual vectors.
#include "mechanism/bodies/modal/reference_model.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "common/math/rotation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double same_motion = 1e-8;  ///< singular values below this share are zero

/// Null space and rank of a matrix, with round-off singular values as zero.
struct Spaces {
  MatrixXd null;
  Index rank = 0;
};
Spaces spaces_of(MatrixXd rows) {
  Spaces spaces;
  std::vector<Index> kept;
  for (Index k = 0; k < rows.rows(); ++k)
    if (const double size = rows.row(k).norm(); size > 0.0) {
      rows.row(k) /= size;
      kept.push_back(k);
    }
  if (kept.empty()) return {MatrixXd::Identity(rows.cols(), rows.cols()), 0};
  const MatrixXd used = rows(kept, Eigen::all);
  const Eigen::JacobiSVD<MatrixXd> svd(used, Eigen::ComputeFullV);
  const VectorXd& values = svd.singularValues();
  spaces.rank = (values.array() > same_motion * values[0]).count();
  spaces.null = svd.matrixV().rightCols(rows.cols() - spaces.rank);
  return spaces;
}

/// First elastic frequency of M q̈ + K q = 0 with G q = 0, above `rigid` motions. Infinite if nothing elastic moves.
double first_frequency(const MatrixXd& M, const VectorXd& K, const MatrixXd& G, Index rigid) {
  const VectorXd scale = M.diagonal().cwiseSqrt().cwiseInverse();
  const MatrixXd free = spaces_of(G * scale.asDiagonal()).null;
  if (free.cols() <= rigid) return std::numeric_limits<double>::infinity();
  const MatrixXd scaled = scale.asDiagonal() * free;
  const MatrixXd mass = scaled.transpose() * M * scaled, stiffness = scaled.transpose() * K.asDiagonal() * scaled;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(stiffness, mass, Eigen::EigenvaluesOnly);
  if (eigen.info() != Eigen::Success) return 0.0;
  return std::sqrt(std::max(eigen.eigenvalues()[rigid], 0.0));
}

/// Residual vectors of the held rows, mass-orthonormal: columns of coefficients of the f components.
MatrixXd residual_vectors(const formats::ModalResidual& residual, const MatrixXd& held) {
  if (held.rows() == 0) return MatrixXd(held.cols(), 0);
  const MatrixXd gram = held * residual.mass * held.transpose();
  VectorXd scale = gram.diagonal().cwiseMax(0.0).cwiseSqrt();
  const double largest = scale.size() > 0 ? scale.maxCoeff() : 0.0;
  for (double& s : scale) s = s > 1e-12 * largest && s > 0.0 ? 1.0 / s : 0.0;
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scale.asDiagonal() * gram * scale.asDiagonal());
  MatrixXd vectors(held.cols(), 0);
  for (Index k = 0; k < eigen.eigenvalues().size(); ++k) {
    const double value = eigen.eigenvalues()[k];
    if (!(value > same_motion)) continue;
    vectors.conservativeResize(Eigen::NoChange, vectors.cols() + 1);
    vectors.rightCols<1>() = held.transpose() * (scale.asDiagonal() * eigen.eigenvectors().col(k)) / std::sqrt(value);
  }
  return vectors;
}

}  // namespace

ReferenceModel reference_model(const formats::ModalBody& file, int modes, const std::string& name, int frame,
                               const UnitConversion& units) {
  ReferenceModel model;
  const formats::ModalResidual& residual = file.residual;
  const auto f = static_cast<Index>(residual.node.size());
  model.name = name;
  model.frame = frame;
  model.units = units;
  model.component = residual.component;
  model.omega2 = file.omega2.head(modes);
  model.rigid = MatrixXd::Zero(f, 6);
  model.modes.resize(f, modes);
  for (Index k = 0; k < f; ++k) {
    const auto row = static_cast<std::size_t>(residual.node[static_cast<std::size_t>(k)]);
    const int c = residual.component[static_cast<std::size_t>(k)];
    model.nodes.push_back(name + "/" + file.node_name[row]);
    bool held = false;
    for (std::size_t i = 0; i < file.reference_node.size(); ++i)
      held = held || (file.reference_node[i] == static_cast<int>(row) && file.reference_component[i] == c);
    model.held.push_back(held);
    model.rigid(k, c) = 1.0;
    const Vector3d x = file.node_position.row(static_cast<Index>(row));
    if (c < 3) model.rigid.row(k).tail<3>() = -skew<double>(x).row(c);
    model.modes.row(k) = file.X[row].row(c).head(modes);
  }
  const formats::ModalIntegrals& sums = file.integrals;
  model.mass = MatrixXd::Identity(6 + modes, 6 + modes);
  model.mass.topLeftCorner<3, 3>() *= sums.mass;
  model.mass.block<3, 3>(3, 3) = sums.P0.trace() * Eigen::Matrix3d::Identity() - sums.P0 + sums.J_mu;
  for (Index j = 0; j < modes; ++j) {
    const Eigen::Map<const Eigen::Matrix3d> P(sums.P1.data() + 9 * j);
    Eigen::Matrix<double, 6, 1> momentum;
    momentum << sums.C1.col(j), Vector3d(P(1, 2) - P(2, 1), P(2, 0) - P(0, 2), P(0, 1) - P(1, 0)) + sums.N_mu.col(j);
    model.mass.col(6 + j).head<6>() = momentum;
    model.mass.row(6 + j).head<6>() = momentum.transpose();
  }
  model.residual = residual;
  // Modes of the file that the body does not use belong to the residual.
  const MatrixXd rest = [&] {
    MatrixXd rows(f, file.modes() - modes);
    for (Index k = 0; k < f; ++k)
      rows.row(k) = file.X[static_cast<std::size_t>(residual.node[static_cast<std::size_t>(k)])]
                        .row(residual.component[static_cast<std::size_t>(k)])
                        .tail(file.modes() - modes);
    return rows;
  }();
  for (Index j = 0; j < rest.cols(); ++j) {
    const double omega2 = file.omega2[modes + j];
    const VectorXd answer = rest.col(j) / omega2;
    model.residual.flexibility += rest.col(j) * answer.transpose();
    model.residual.mass += answer * answer.transpose();
    const Eigen::Map<const Eigen::Matrix3d> P(sums.P1.data() + 9 * (modes + j));
    Eigen::Matrix<double, 6, 1> momentum;
    momentum << sums.C1.col(modes + j),
        Vector3d(P(1, 2) - P(2, 1), P(2, 0) - P(0, 2), P(0, 1) - P(1, 0)) + sums.N_mu.col(modes + j);
    model.residual.coupling += momentum * answer.transpose();
  }
  return model;
}

HeldFrequencies held_frequencies(const ReferenceModel& model, const MatrixXd& held) {
  const Index n = model.mass.rows();
  MatrixXd of_model(model.modes.rows(), n);
  of_model << model.rigid, model.modes;
  const MatrixXd G = held * of_model;
  VectorXd K = VectorXd::Zero(n);
  K.tail(n - 6) = model.omega2;
  const VectorXd reach = model.mass.diagonal().head<6>().cwiseSqrt().cwiseInverse();
  const Index rigid = 6 - spaces_of(held * model.rigid * reach.asDiagonal()).rank;
  HeldFrequencies frequencies;
  frequencies.by_modes = first_frequency(model.mass, K, G, rigid);
  const MatrixXd V = residual_vectors(model.residual, held);
  const Index r = V.cols();
  frequencies.with_residual = frequencies.by_modes;
  if (r == 0) return frequencies;  // the reference holds all of it
  MatrixXd M = MatrixXd::Identity(n + r, n + r);
  M.topLeftCorner(n, n) = model.mass;
  M.block(0, n, 6, r) = model.residual.coupling * V;
  M.block(n, 0, r, 6) = M.block(0, n, 6, r).transpose();
  // Diagonalises the elastic energy of the residual vectors.
  const Eigen::SelfAdjointEigenSolver<MatrixXd> turn(V.transpose() * model.residual.flexibility * V);
  MatrixXd all(held.rows(), n + r);
  all << G, held * model.residual.flexibility * V * turn.eigenvectors();
  M.block(0, n, 6, r) = (M.block(0, n, 6, r) * turn.eigenvectors()).eval();
  M.block(n, 0, r, 6) = M.block(0, n, 6, r).transpose();
  VectorXd stiffness(n + r);
  stiffness << K, turn.eigenvalues();
  frequencies.with_residual = first_frequency(M, stiffness, all, rigid);
  return frequencies;
}

}  // namespace tisserand::mechanism
