// Groups by joints; kinetic energies of neighbouring velocities.
#include "mechanism/switching/momentum.hpp"

#include <algorithm>
#include <numeric>

#include <Eigen/Geometry>
#include <Eigen/QR>
#include <Eigen/SVD>

#include "mechanism/equations/evaluate.hpp"
#include "mechanism/equations/increments.hpp"
#include "mechanism/model/connected_bodies.hpp"

namespace tisserand::mechanism {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Of rows of B times rigid velocities of size one: a direction that is held has one of order one.
constexpr double held = 1e-7;

/// Velocities of the group as one rigid body: columns of translation, of rotation about a point over the
/// characteristic length.
MatrixXd rigid_velocities(const Model& model, const State& state, const BodyGroup& group, const Vector3d& about) {
  const Parts parts = find_parts(model);
  MatrixXd Z = MatrixXd::Zero(model.sizes.velocities(), 6);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    if (!group.contains(parts.name[parts.of_node[i]])) continue;
    const Node& node = model.nodes[i];
    const auto column = static_cast<Eigen::Index>(i);
    const Eigen::Vector4d q = state.Q().col(column);
    const Eigen::Matrix3d R = Eigen::Quaterniond(q[0], q[1], q[2], q[3]).toRotationMatrix();
    const Vector3d arm = state.x().col(column) - about;
    for (int k = 0; k < 3; ++k) {
      const Vector3d axis = Vector3d::Unit(k);
      if (node.translation >= 0) {
        Z.block<3, 1>(node.translation, k) = axis;
        Z.block<3, 1>(node.translation, 3 + k) = axis.cross(arm) / model.length;
      }
      if (node.rotation >= 0) Z.block<3, 1>(node.rotation, 3 + k) = R.transpose() * axis / model.length;
    }
  }
  return Z;
}

double kinetic(const Model& model, const State& state, const VectorXd& v, Evaluation& evaluation) {
  State moved = state;
  moved.v() = v;
  evaluate(model, moved, evaluation);
  return evaluate_energy(model, evaluation).kinetic;
}

/// Momentum along each column of Z.
Momentum along(const Model& model, const State& state, const MatrixXd& Z, Evaluation& evaluation) {
  double size = 0.0;
  for (const Node& node : model.nodes)
    if (node.translation >= 0) size = std::max(size, state.v().segment<3>(node.translation).norm());
  if (size == 0.0) size = 1.0;
  Momentum P;
  for (int k = 0; k < 6; ++k)
    P[k] = (kinetic(model, state, state.v() + size * Z.col(k), evaluation) -
            kinetic(model, state, state.v() - size * Z.col(k), evaluation)) /
           (2.0 * size);
  return P;
}

/// Momentum along each column of velocities of each column.
MatrixXd inertia_of(const Model& model, const State& state, const MatrixXd& Z, Evaluation& evaluation) {
  const Eigen::Index n = Z.cols();
  MatrixXd G(n, n);
  for (Eigen::Index k = 0; k < n; ++k) G(k, k) = 2.0 * kinetic(model, state, Z.col(k), evaluation);
  for (Eigen::Index k = 0; k < n; ++k)
    for (Eigen::Index l = 0; l < k; ++l)
      G(k, l) = G(l, k) = kinetic(model, state, Z.col(k) + Z.col(l), evaluation) - 0.5 * (G(k, k) + G(l, l));
  return G;
}

/// 6 x n, orthonormal: combinations of the columns of Z that no constraint row of the last evaluate() holds.
MatrixXd free_directions(const Model& model, const MatrixXd& Z, const Evaluation& evaluation) {
  if (model.sizes.constraints == 0) return MatrixXd::Identity(6, 6);
  MatrixXd rows(model.sizes.constraints, 6);
  VectorXd column(model.sizes.constraints);
  for (int k = 0; k < 6; ++k) {
    apply_jacobian(model, evaluation, Z.col(k), column);
    rows.col(k) = column;
  }
  for (int row = 0; row < model.sizes.constraints; ++row)
    if (!model.length_row[row]) rows.row(row) *= model.length;
  const Eigen::JacobiSVD<MatrixXd> svd(rows, Eigen::ComputeFullV);
  const auto& values = svd.singularValues();
  const auto rank = std::count_if(values.begin(), values.end(), [](double value) { return value > held; });
  return svd.matrixV().rightCols(6 - rank);
}

/// Sets of parts, each by its smallest one.
class PartSets {
 public:
  explicit PartSets(int count) : of_(count) { std::iota(of_.begin(), of_.end(), 0); }
  void unite(int a, int b) {
    const int kept = of_[a], gone = of_[b];
    std::ranges::replace(of_, gone, kept);
  }
  int of(int part) const { return of_[part]; }

 private:
  std::vector<int> of_;
};

}  // namespace

std::vector<BodyGroup> jointed_groups(const Model& model, const BodyGroup& bodies) {
  const Parts parts = find_parts(model);
  PartSets sets(parts.count());
  const auto unite = [&](const Marker& a, const Marker& b) {
    if (a.node >= 0 && b.node >= 0) sets.unite(parts.of_node[a.node], parts.of_node[b.node]);
  };
  for (const Joint& joint : model.joints) unite(joint.a, joint.b);
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const Coordinate& coordinate = model.coordinates[term.coordinate];
      unite(coordinate.a, coordinate.b);
      unite(model.coordinates[coupling.terms.front().coordinate].b, coordinate.b);
    }
  std::vector<BodyGroup> groups(parts.count());
  for (int part = 0; part < parts.count(); ++part) groups[sets.of(part)].insert(parts.name[part]);
  std::erase_if(groups, [&bodies](const BodyGroup& group) {
    return std::ranges::none_of(bodies, [&group](const std::string& body) { return group.contains(body); });
  });
  return groups;
}

Momentum momentum_of(const Model& model, const State& state, const BodyGroup& group, const Vector3d& about,
                     Evaluation& evaluation) {
  Momentum P = along(model, state, rigid_velocities(model, state, group, about), evaluation);
  P.tail<3>() *= model.length;
  return P;
}

void restore_momentum(const Model& model, const BodyGroup& group, const Momentum& wanted, const Vector3d& about,
                      State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  const MatrixXd Z = rigid_velocities(model, state, group, about);
  const MatrixXd free = free_directions(model, Z, evaluation);
  if (free.cols() == 0) return;
  const MatrixXd G = inertia_of(model, state, Z * free, evaluation);
  Momentum target = wanted;
  target.tail<3>() /= model.length;
  for (int pass = 0; pass < 2; ++pass) {  // the second takes what rounding of the first has left
    const VectorXd open = free.transpose() * (target - along(model, state, Z, evaluation));
    state.v() += Z * (free * G.completeOrthogonalDecomposition().solve(open));
  }
}

}  // namespace tisserand::mechanism
