// SPDX-License-Identifier: GPL-3.0-or-later
// S and M in independent coordinates, from the mesh.
#include "reducer/system/system.hpp"

#include <utility>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/math/rotation.hpp"
#include "common/parallel.hpp"
#include "reducer/system/assembly.hpp"
#include "reducer/system/inactive.hpp"
#include "reducer/ties/condense.hpp"

namespace tisserand::reducer {
namespace {

Eigen::VectorXd mass_diagonal(const SymmetricPair& pair) {
  return Eigen::VectorXd::NullaryExpr(pair.size(), [&](Eigen::Index i) { return pair.M[pair.begin[i]]; });
}

/// Throws Error unless all numbers are finite: sound elements can still overflow through their materials.
void check_finite(const SymmetricPair& pair, const Mesh& mesh, const Coordinates& coordinates,
                  const std::string& where) {
  for (int i = 0; i < pair.size(); ++i)
    for (int k = pair.begin[i]; k < pair.begin[i + 1]; ++k)
      if (!std::isfinite(pair.S[k]) || !std::isfinite(pair.M[k]))
        throw Error(
            fmt::format("the stiffness or mass at {} is not a finite number", mesh.node_label[coordinates.node[i]]),
            where, "check units and values of materials, sections and masses there");
}

/// Coordinates of the mesh that ties leave independent, and those that remain although they have no stiffness and mass.
struct Kept {
  std::vector<int> independent, present;
};

System assembled(const Mesh& mesh, const Kept& kept, const std::string& where,
                 const std::function<void(double)>& share) {
  System system;
  const int threads = core_count();
  system.coordinates = number_coordinates(mesh);
  system.middle = mesh.position.rowwise().mean();
  system.length = characteristic_length(mesh);

  const TieSystem ties = collect_ties(mesh, system.coordinates, where);
  const auto name = [&](int x) { return coordinate_text(mesh, system.coordinates, ties, x); };
  Elimination elimination = eliminate(ties, kept.independent, name, where);
  for (int x = ties.mesh_coordinates; x < ties.coordinates; ++x) system.name.push_back(name(x));
  system.eliminated = count_of(elimination.T.dependent);
  system.redundant = elimination.redundant;
  system.T = std::move(elimination.T);
  system.R.resize(system.size(), 6);
  for (int q = 0; q < system.size(); ++q) system.R.row(q) = ties.rigid[system.T.source[q]].transpose();

  SymmetricPair full = assemble(mesh, system.coordinates, threads, share);
  check_finite(full, mesh, system.coordinates, where);
  system.mesh_mass = mass_diagonal(full);
  system.matrices = condense(std::move(full), system.T, threads);
  remove_inactive(mesh, kept.present, where, threads, system);
  system.MR = multiply(symmetric_rows(system.matrices, system.matrices.M), system.R);
  return system;
}

/// R, or M R, moved to another point.
Eigen::MatrixXd about(const System& system, const Eigen::Vector3d& point, Eigen::MatrixXd R) {
  R.rightCols<3>() *= system.length;
  R.rightCols<3>() += R.leftCols<3>() * skew<double>(Eigen::Vector3d(point - system.middle));
  return R;
}

}  // namespace

System build_system(const Mesh& mesh, const std::string& where, const std::function<void(double)>& share) {
  const Coordinates coordinates = number_coordinates(mesh);
  check_retained(mesh, coordinates, where);
  const std::vector<int> boundary = boundary_coordinates(mesh, coordinates);
  return assembled(mesh, {boundary, boundary}, where, share);
}

System build_system(const Mesh& mesh, const std::vector<int>& held, const std::string& where,
                    const std::function<void(double)>& share) {
  return assembled(mesh, {held, {}}, where, share);
}

std::string coordinate_name(const Mesh& mesh, const System& system, int x) {
  const auto k = static_cast<std::size_t>(x);
  if (x >= system.coordinates.count()) return system.name[k - system.coordinates.node.size()];
  return fmt::format("{} ({})", mesh.node_label[system.coordinates.node[k]],
                     component_text(system.coordinates.component[k]));
}

std::vector<int> boundary_coordinates(const Mesh& mesh, const Coordinates& coordinates) {
  std::vector<int> result;
  for (const MeshBoundary& b : mesh.boundary)
    for (int c = 0; c < 6; ++c)
      if (c < 3 ? b.translations : b.rotations) result.push_back(coordinates.of(b.node, c));
  return result;
}

Eigen::MatrixXd rigid_motions_about(const System& system, const Eigen::Vector3d& point) {
  return about(system, point, system.R);
}

Eigen::MatrixXd rigid_momenta_about(const System& system, const Eigen::Vector3d& point) {
  return about(system, point, system.MR);
}

}  // namespace tisserand::reducer
