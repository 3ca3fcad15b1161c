// SPDX-License-Identifier: GPL-3.0-or-later
// Equations of rigid spiders and of the mesh; averaging.cpp has those of averaging spiders.
#include "reducer/ties/equations.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/text.hpp"
#include "reducer/ties/averaging.hpp"

namespace tisserand::reducer {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

TieSystem start(const Mesh& mesh, const Coordinates& coordinates) {
  TieSystem ties;
  ties.mesh_coordinates = ties.coordinates = coordinates.count();
  const double length = characteristic_length(mesh);
  Eigen::MatrixXd R = rigid_motions(mesh, coordinates, mesh.position.rowwise().mean());
  R.rightCols<3>() /= length;
  for (int i = 0; i < coordinates.count(); ++i) {
    ties.rigid.push_back(R.row(i).transpose());
    ties.scale.push_back(coordinates.component[i] < 3 ? 1.0 : length);
  }
  return ties;
}

void add_term(int coordinate, double coefficient, LinearEquation& equation) {
  if (coefficient != 0.0) equation.terms.push_back({coordinate, coefficient});
}

/// Equation of component c of a node at r from the reference: e·u − e·u_ref − (r × e)·θ_ref = 0, or e·θ − e·θ_ref = 0.
LinearEquation follow(const Coordinates& coordinates, const Spider& spider, int node, const Eigen::Vector3d& r, int c) {
  const Eigen::Vector3d e = spider.axes.col(c % 3);
  const int base = c < 3 ? 0 : 3;
  LinearEquation equation;
  for (int k = 0; k < 3; ++k) {
    add_term(coordinates.of(node, base + k), e[k], equation);
    add_term(coordinates.of(spider.reference, base + k), -e[k], equation);
    if (std::abs(e[k]) == 1.0) equation.preferred = coordinates.of(node, base + k);
  }
  const Eigen::Vector3d arm = r.cross(e);
  for (int k = 0; k < 3 && c < 3; ++k) add_term(coordinates.of(spider.reference, 3 + k), -arm[k], equation);
  return equation;
}

void append_rigid(const Mesh& mesh, const Coordinates& coordinates, const Spider& spider, TieSystem& ties) {
  for (const int n : spider.nodes) {
    if (n == spider.reference) continue;
    const Eigen::Vector3d r = mesh.position.col(n) - mesh.position.col(spider.reference);
    for (int c = 0; c < (coordinates.rotates(n) ? 6 : 3); ++c)
      if (((spider.node_components >> c) & 1) != 0) ties.add(follow(coordinates, spider, n, r, c));
  }
}

LinearEquation own_equation(const Coordinates& coordinates, const TieEquation& tie) {
  LinearEquation equation;
  for (const TieTerm& term : tie.terms) add_term(coordinates.of(term.node, term.component), term.coefficient, equation);
  if (!equation.terms.empty()) equation.preferred = equation.terms.front().coordinate;
  return equation;
}

/// Throws Error if a rigid motion of the part violates the equation. Coefficients of decks have about seven digits.
void check_rigid(const Mesh& mesh, const Coordinates& coordinates, const TieSystem& ties,
                 const LinearEquation& equation, const std::string& where) {
  Vector6 sum = Vector6::Zero();
  double size = 0.0;
  for (const Term& term : equation.terms) {
    sum += term.coefficient * ties.rigid[term.coordinate];
    size += std::abs(term.coefficient) / ties.scale[term.coordinate];
  }
  if (sum.cwiseAbs().maxCoeff() <= 1e-6 * size) return;
  std::vector<std::string> words, motions;
  for (const Term& term : equation.terms) words.push_back(coordinate_text(mesh, coordinates, ties, term.coordinate));
  for (int k = 0; k < 6; ++k)
    if (std::abs(sum[k]) > 1e-6 * size) motions.push_back(component_text(k));
  throw Error(
      fmt::format("{} between {} prevents rigid-body motion of the part: {}", ties.name[equation.tie], listed(words),
                  join(motions, ", ")),
      where,
      "use a spider, which takes account of the distance between the nodes; if it is a support, define it in the "
      "scene");
}

}  // namespace

TieSystem collect_ties(const Mesh& mesh, const Coordinates& coordinates, const std::string& where) {
  TieSystem ties = start(mesh, coordinates);
  for (const Spider& spider : mesh.spiders) {
    ties.name.push_back(fmt::format("spider '{}'", spider.name));
    if (spider.nodes.empty())
      throw Error(ties.name.back() + " connects no nodes", where, "name a set of nodes that is not empty");
    if (spider.kind == SpiderKind::rigid)
      append_rigid(mesh, coordinates, spider, ties);
    else
      append_averaging(mesh, coordinates, spider, where, ties);
  }
  for (const TieEquation& equation : mesh.equations) {
    ties.name.push_back(fmt::format("equation '{}'", equation.name));
    ties.add(own_equation(coordinates, equation));
    check_rigid(mesh, coordinates, ties, ties.equations.back(), where);
  }
  return ties;
}

std::string coordinate_text(const Mesh& mesh, const Coordinates& coordinates, const TieSystem& ties, int coordinate) {
  const auto k = static_cast<std::size_t>(coordinate);
  if (coordinate >= ties.mesh_coordinates) {
    const int tie = ties.auxiliary_tie[k - static_cast<std::size_t>(ties.mesh_coordinates)];
    return "a group of nodes of " + ties.name[tie];
  }
  return fmt::format("{} ({})", mesh.node_label[coordinates.node[k]], component_text(coordinates.component[k]));
}

}  // namespace tisserand::reducer
