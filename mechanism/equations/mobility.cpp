// Ranks of the constraint Jacobian.
#include "mechanism/equations/mobility.hpp"

#include <algorithm>

#include <Eigen/QR>
#include <Eigen/SparseCore>

#include "common/math/rotation.hpp"
#include "mechanism/equations/carriers.hpp"
#include "mechanism/equations/evaluate.hpp"
#include "mechanism/solver/matrix_rank.hpp"

namespace tisserand::mechanism {
namespace {

/// Constraint Jacobians up to this size are decomposed densely.
constexpr int dense_rank_limit = 150;

using Triplets = std::vector<Eigen::Triplet<double>>;

/// Visits the rows of B in the motions [ẋ Ω] of the two nodes of each joint or coupling term:
/// visit(row, coordinate map, markers, values).
template <class Visit>
void for_each_row(const Model& model, const Evaluation& evaluation, Visit visit) {
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    for (int k = 0; k < model.joints[i].size(); ++k)
      visit(model.joints[i].row + k, model.joints.maps[i], model.joints[i], Row12(evaluation.joints[i].B.row(k)));
  for (const Coupling& coupling : model.couplings)
    for (const CouplingTerm& term : coupling.terms) {
      const auto at = static_cast<std::size_t>(term.coordinate);
      visit(coupling.row, model.coordinates.maps[at], model.coordinates[at],
            Row12(term.factor * evaluation.coordinates[at].G));
    }
}

double row_scale(const Model& model, int row) { return model.length_row[row] ? 1.0 : model.length; }

Eigen::SparseMatrix<double> compressed(int rows, int columns, const Triplets& entries) {
  Eigen::SparseMatrix<double> B(rows, columns);
  B.setFromTriplets(entries.begin(), entries.end());
  B.makeCompressed();
  return B;
}

/// Bᵀ with rotation rows divided by the characteristic length and angle columns multiplied with it.
Eigen::SparseMatrix<double> scaled_jacobian(const Model& model, const Evaluation& evaluation) {
  Triplets entries;
  for_each_row(model, evaluation, [&](int row, const ElementMap& map, const auto&, const Row12& values) {
    const Eigen::MatrixXd columns = model_rows(model, map, local_view(values), evaluation);
    for (std::size_t j = 0; j < map.coordinates.size(); ++j) {
      const double value = columns(0, static_cast<Eigen::Index>(j));
      if (map.coordinates[j] < 0 || value == 0.0) continue;
      const double scale = model.equation_scale[map.coordinates[j]] * row_scale(model, row);
      entries.emplace_back(map.coordinates[j], row, value * scale);
    }
  });
  return compressed(model.sizes.boundary, model.sizes.constraints, entries);
}

/// The same for rigid motions [velocity of the first node; angular velocity, world] of the parts: a node at x moves
/// with ẋ = v − (x − x_0)~ ω, Ω = Rᵀ ω.
Eigen::SparseMatrix<double> rigid_jacobian(const Model& model, const Parts& parts, const Evaluation& evaluation) {
  Triplets entries;
  const auto add = [&](int row, const Marker& marker, const Eigen::Matrix<double, 1, 6>& values) {
    if (marker.node < 0) return;
    const int part = parts.of_node[marker.node];
    const NodeMotion& node = motion_of(evaluation, marker.node);
    const Eigen::Vector3d arm = node.x - motion_of(evaluation, parts.first_node[part]).x;
    Eigen::Matrix<double, 1, 6> rigid;
    rigid.head<3>() = values.head<3>();
    rigid.tail<3>() = (values.tail<3>() * node.R.transpose() - values.head<3>() * skew<double>(arm)) / model.length;
    for (int j = 0; j < 6; ++j)
      if (rigid[j] != 0.0) entries.emplace_back(6 * part + j, row, rigid[j] * row_scale(model, row));
  };
  for_each_row(model, evaluation, [&](int row, const ElementMap&, const auto& pair, const Row12& values) {
    add(row, pair.a, values.head<6>());
    add(row, pair.b, values.tail<6>());
  });
  return compressed(6 * parts.count(), model.sizes.constraints, entries);
}

ColumnRank rank_of(const Eigen::SparseMatrix<double>& A) {
  ColumnRank rank;
  if (A.cols() == 0) return rank;
  if (A.cols() <= dense_rank_limit) {
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr;
    qr.setThreshold(rank_tolerance);
    qr.compute(Eigen::MatrixXd(A));
    rank.rank = static_cast<int>(qr.rank());
    for (Eigen::Index k = qr.rank(); k < A.cols(); ++k)
      rank.dependent.push_back(static_cast<int>(qr.colsPermutation().indices()[k]));
  } else {
    const double largest = A.nonZeros() > 0 ? A.coeffs().cwiseAbs().maxCoeff() : 0.0;
    rank = column_rank(A, rank_tolerance * std::max(1.0, largest));
  }
  std::sort(rank.dependent.begin(), rank.dependent.end());
  return rank;
}

}  // namespace

Mobility count_mobility(const Model& model, const State& state, Evaluation& evaluation) {
  evaluate(model, state, evaluation);
  const Parts parts = find_parts(model);
  Mobility mobility;
  mobility.coordinates = model.sizes.velocities();
  for (const Tyre& tyre : model.tyres)
    if (tyre.relaxes()) mobility.coordinates -= 2;  // deflections of treads follow their wheels
  mobility.constraints = model.sizes.constraints;
  mobility.parts = parts.count();
  ColumnRank rank = rank_of(scaled_jacobian(model, evaluation));
  mobility.rank = rank.rank;
  mobility.redundant = std::move(rank.dependent);
  mobility.degrees_of_freedom = mobility.coordinates - mobility.rank;
  const bool all_rigid = 6 * mobility.parts == mobility.coordinates;
  const int rigid_rank = all_rigid ? mobility.rank : rank_of(rigid_jacobian(model, parts, evaluation)).rank;
  mobility.rigid_mobility = 6 * mobility.parts - rigid_rank;
  return mobility;
}

}  // namespace tisserand::mechanism
