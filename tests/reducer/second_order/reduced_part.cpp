// SPDX-License-Identifier: GPL-3.0-or-later
// The steps of reduce() on a mesh made in code, and the eigenproblem of buckling.
#include "tests/reducer/second_order/reduced_part.hpp"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "reducer/elements/beam/beam.hpp"
#include "reducer/modes/full_model.hpp"
#include "reducer/modes/project.hpp"
#include "reducer/second_order/companion.hpp"
#include "reducer/system/mechanism.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

ReducedPart reduce_with_companion(const reducer::Mesh& mesh, const formats::ModeSelection& modes,
                                  const VectorXd& weights, int shapes) {
  start_solvers();
  formats::Part part;
  part.name = "body";
  part.units = Units::si();
  part.modes = modes;
  reducer::System system = reducer::build_system(mesh, "test");
  const reducer::Partition coordinates = reducer::partition(mesh, system);
  const reducer::Blocks blocks = reducer::take_apart(system, coordinates, modes);
  const reducer::Factor S_II = coordinates.n_I() > 0 ? reducer::Factor(blocks.S_II) : reducer::Factor();
  if (coordinates.n_I() > 0)
    reducer::require_stiffness(reducer::null_space(blocks.S_II, S_II), S_II, {mesh, system, coordinates},
                               reducer::boundary_held(), "test");
  const reducer::BoundaryModes boundary = reducer::boundary_modes(S_II, blocks, system, coordinates, [](double) {});
  const reducer::InternalProblem problem{{mesh, system, coordinates}, blocks, S_II, "test"};
  const reducer::InternalModes internal = reducer::internal_modes(problem, boundary, part.modes);
  ReducedPart body{reducer::project(part, problem, boundary, internal).superelement, {}};
  body.element.content_id = formats::content_id(body.element);
  body.companion =
      reducer::make_companion({problem, boundary, internal, body.element},
                              weights.size() > 0 ? weights : reducer::default_weights(body.element), shapes);
  formats::check(body.companion, body.element, "body");
  return body;
}

ReducedPart reduce_with_companion(const reducer::Mesh& mesh, int modes, const VectorXd& weights, int shapes) {
  formats::ModeSelection selection;
  selection.count = modes;
  return reduce_with_companion(mesh, selection, weights, shapes);
}

int add_node(reducer::Mesh& mesh, const Vector3d& position) {
  mesh.position.conservativeResize(3, mesh.position.cols() + 1);
  mesh.position.rightCols<1>() = position;
  mesh.node_label.push_back("node " + std::to_string(mesh.nodes()));
  return mesh.nodes() - 1;
}

void add_beam(reducer::Mesh& mesh, int first, int second, const Vector3d& orientation) {
  reducer::BeamElement beam;
  beam.first = first;
  beam.second = second;
  beam.R_PE = *reducer::beam_axes(mesh.position.col(second) - mesh.position.col(first), orientation);
  mesh.beams.push_back(beam);
}

int add_rigid_end(reducer::Mesh& mesh, const std::string& name, const std::vector<int>& nodes,
                  const Vector3d& position) {
  reducer::Spider spider;
  spider.name = name;
  spider.nodes = nodes;
  spider.reference = add_node(mesh, position);
  mesh.spiders.push_back(spider);
  mesh.boundary.push_back({name, spider.reference, true, true});
  return spider.reference;
}

MatrixXd stress_stiffness(const formats::Companion& companion, const VectorXd& w) {
  MatrixXd K = MatrixXd::Zero(w.size(), w.size());
  for (Index j = 0; j < w.size(); ++j) K += w[j] * companion.H[static_cast<std::size_t>(j)];
  return K;
}

MatrixXd free_directions(Index size, const std::vector<int>& held) {
  std::vector<int> free;
  for (int row = 0; row < size; ++row)
    if (std::ranges::find(held, row) == held.end()) free.push_back(row);
  const MatrixXd all = MatrixXd::Identity(size, size);
  return all(Eigen::all, free);
}

VectorXd buckling_factors(const MatrixXd& S, const MatrixXd& K_G, const MatrixXd& Z, int count) {
  const MatrixXd S_Z = Z.transpose() * S * Z, K_Z = -Z.transpose() * K_G * Z;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> eigen(K_Z, S_Z, Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().reverse().head(count).cwiseInverse();
}

VectorXd buckling_factors(const ReducedPart& part, const Preload& preload, const MatrixXd& Z, int count) {
  const MatrixXd& A = preload.preloaded;
  const MatrixXd S = A.transpose() * part.element.stiffness * A;
  const VectorXd y = A * S.ldlt().solve(VectorXd(A.transpose() * preload.load));
  MatrixXd K_G = stress_stiffness(part.companion, y);
  if (preload.own.size() > 0) K_G -= preload.own;
  return buckling_factors(part.element.stiffness, K_G, Z, count);
}

}  // namespace tisserand::testing
