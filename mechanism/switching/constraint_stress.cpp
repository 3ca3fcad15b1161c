// SPDX-License-Identifier: GPL-3.0-or-later
// Constraint Jacobian on motions of rigid bodies, and reactions that do no work on them.
#include "mechanism/switching/constraint_stress.hpp"

#include <cmath>
#include <random>

#include <Eigen/SparseCore>

#include "common/math/rotation.hpp"
#include "mechanism/equations/constraint_rows.hpp"
#include "mechanism/model/connected_bodies.hpp"
#include "mechanism/solver/matrix_rank.hpp"
#include "mechanism/switching/deformation.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

/// Rows that depend on the others up to this fraction count as dependent, since positions and axes in a file may have
/// six digits. A loop free of stress only by such a difference has reactions of 1e6 times its loads.
constexpr double dependent = 1e-6;
/// Size of reactions that deform a body, relative to their random sizes of one each. It is far above the imbalance that
/// `dependent` leaves, and far below what two joints of a loop exert.
constexpr double deforming = 1e-4;

/// Bᵀ: boundary coordinates x constraint rows; rows of angles times the characteristic length.
Matrix transposed_jacobian(const Model& model, const Evaluation& now) {
  Entries entries;
  for_each_row(model, now, [&](int row, const ElementMap& map, const auto&, const Row12& values) {
    const double scale = model.length_row[row] ? 1.0 : model.length;
    for_each_entry(model, map, values, now, [&](int j, double value) { entries.emplace_back(j, row, scale * value); });
  });
  Matrix B(model.sizes.boundary, model.sizes.constraints);
  B.setFromTriplets(entries.begin(), entries.end());
  return B;
}

/// Matrix T: six motions of each part about its first node that owns coordinates, rotations times the characteristic
/// length. Modes are at rest.
Matrix rigid_motions(const Model& model, const Parts& parts, const Evaluation& now) {
  Entries entries;
  const auto add = [&](int row, int column, const Matrix3d& block) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (block(i, j) != 0.0) entries.emplace_back(row + i, column + j, block(i, j));
  };
  std::vector<int> first(static_cast<std::size_t>(parts.count()), -1);
  for (int i = 0; i < std::ssize(model.nodes); ++i) {
    const Node& node = model.nodes[i];
    if (node.translation < 0 && node.rotation < 0) continue;
    const int part = parts.of_node[i], column = 6 * part;
    if (first[part] < 0) first[part] = i;
    const Vector3d arm = now.motion[i].x - now.motion[first[part]].x;
    if (node.translation >= 0) {
      add(node.translation, column, Matrix3d::Identity());
      add(node.translation, column + 3, -skew<double>(arm) / model.length);
    }
    if (node.rotation >= 0) add(node.rotation, column + 3, now.motion[i].R.transpose() / model.length);
  }
  Matrix T(model.sizes.boundary, 6 * parts.count());
  T.setFromTriplets(entries.begin(), entries.end());
  return T;
}

/// Squared loads of each part on the nodes that own coordinates: forces, moments over the characteristic length, and
/// loads of modes over the root of the mass.
std::vector<double> on_parts(const Model& model, const Parts& parts, const VectorXd& load) {
  std::vector<double> square(static_cast<std::size_t>(parts.count()), 0.0);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    if (node.translation >= 0) square[parts.of_node[i]] += load.segment<3>(node.translation).squaredNorm();
    if (node.rotation >= 0) square[parts.of_node[i]] += load.segment<3>(node.rotation).squaredNorm();
  }
  return square;
}

}  // namespace

std::vector<bool> stressed_by_constraints(const Model& model, const Evaluation& now) {
  std::vector<bool> stressed(deforming_bodies(model), false);
  if (model.sizes.constraints == 0) return stressed;
  const Matrix B = transposed_jacobian(model, now);
  const Parts parts = find_parts(model);
  const Matrix A = rigid_motions(model, parts, now).transpose() * B;
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  const VectorXd probe = VectorXd::NullaryExpr(model.sizes.constraints, [&](Eigen::Index) { return normal(random); });
  const VectorXd load = (B * (probe - without_null_space(A, probe, dependent)))
                            .cwiseProduct(model.equation_scale.head(B.rows()).matrix());
  const std::vector<double> square = on_parts(model, parts, load);
  for (std::size_t i = 0; i < stressed.size(); ++i) {
    if (const int modal = modal_body_of(model, i); modal >= 0) {
      const ModalBody& body = model.modal_bodies[modal];
      stressed[i] = load.segment(model.sizes.first_modal() + body.offset, body.modes).norm() > deforming;
    } else {
      stressed[i] = std::sqrt(square[parts.of_node[model.superelements[i].nodes.front()]]) > deforming;
    }
  }
  return stressed;
}

}  // namespace tisserand::mechanism
