// SPDX-License-Identifier: GPL-3.0-or-later
// Sums of the elements' errors for the modes of the reduced part on the mesh.
#include "reducer/mesh_error/mesh_error.hpp"

#include <algorithm>
#include <cmath>

#include "common/parallel.hpp"
#include "reducer/elements/mesh_error.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double least_share = 0.25;  ///< least λ/λ_h; below, the estimate only means "useless"

/// [translation; rotation] of every node; zero rotations for nodes without them.
MatrixXd motions(const Mesh& mesh, const System& system, const MatrixXd& q) {
  const MatrixXd x = expand(system.T, q);
  const Coordinates& numbers = system.coordinates;
  MatrixXd motion = MatrixXd::Zero(6 * static_cast<Eigen::Index>(mesh.nodes()), q.cols());
  for (int n = 0; n < mesh.nodes(); ++n) {
    const int count = numbers.rotates(n) ? 6 : 3;
    motion.middleRows(6 * n, count) = x.middleRows(numbers.of(n, 0), count);
  }
  return motion;
}

MatrixXd beam_errors(const Mesh& mesh, const MatrixXd& motion, const VectorXd& lambda) {
  MatrixXd errors(static_cast<Eigen::Index>(mesh.beams.size()), lambda.size());
  const int count = count_of(mesh.beams);
  on_threads(core_count(), [&](int t) {
    const Share share = share_of(count, t, core_count());
    for (int e = share.first; e < share.end; ++e) {
      const BeamElement& beam = mesh.beams[e];
      MatrixXd u(12, lambda.size());
      u << motion.middleRows<6>(6 * beam.first), motion.middleRows<6>(6 * beam.second);
      errors.row(e) = energy_error(mesh, beam, {u, lambda}).transpose();
    }
  });
  return errors;
}

/// Sums by property, and the names of the properties of beams, shells and solids in this order.
struct Properties {
  MatrixXd error;
  std::vector<std::string> name;
};

Properties by_property(const Mesh& mesh, const MatrixXd& errors) {
  Properties result;
  for (const BeamProperty& p : mesh.beam_properties) result.name.push_back(p.name);
  for (const ShellProperty& p : mesh.shell_properties) result.name.push_back(p.name);
  for (const SolidProperty& p : mesh.solid_properties) result.name.push_back(p.name);
  result.error = MatrixXd::Zero(static_cast<Eigen::Index>(result.name.size()), errors.cols());
  const int shells = count_of(mesh.beam_properties);
  const int solids = shells + count_of(mesh.shell_properties);
  Eigen::Index row = 0;
  for (const BeamElement& beam : mesh.beams) result.error.row(beam.property) += errors.row(row++);
  for (const ShellElement& shell : mesh.shells) result.error.row(shells + shell.property) += errors.row(row++);
  for (const SolidElement& solid : mesh.solids) result.error.row(solids + solid.property) += errors.row(row++);
  return result;
}

}  // namespace

MeshErrors mesh_errors(const Mesh& mesh, const System& system, const FreeMotions& modes, int most) {
  const Eigen::Index count = std::min<Eigen::Index>(most, modes.lambda.size());
  MeshErrors result{
      modes.boundary_held, modes.lambda.head(count), VectorXd::Zero(count), Eigen::Matrix3Xd::Zero(3, count), {}, {}};
  if (count == 0) return result;
  const MatrixXd motion = motions(mesh, system, modes.q.leftCols(count));
  const MatrixXd of_beams = beam_errors(mesh, motion, result.lambda);
  const MeshMeasures measures = mesh_measures(mesh, motion, result.lambda);
  MatrixXd errors(of_beams.rows() + measures.error.rows(), count);  // beams, shells, solids
  errors << of_beams, measures.error;
  result.doubts = mesh_doubts(mesh, measures, of_beams.colwise().sum().transpose(), result.lambda);
  const auto beams = static_cast<Eigen::Index>(mesh.beams.size()),
             shells = static_cast<Eigen::Index>(mesh.shells.size());
  result.by_kind.row(0) = errors.topRows(beams).colwise().sum();
  result.by_kind.row(1) = errors.middleRows(beams, shells).colwise().sum();
  result.by_kind.row(2) = errors.bottomRows(errors.rows() - beams - shells).colwise().sum();
  const Properties properties = by_property(mesh, errors);
  for (Eigen::Index k = 0; k < count; ++k) {
    result.by_kind.col(k) /= modes.lambda[k];
    const double left = std::max(1.0 - result.by_kind.col(k).sum(), least_share);
    result.relative[k] = std::sqrt(1.0 / left) - 1.0;
    Eigen::Index worst = 0;
    if (properties.error.rows() > 0) properties.error.col(k).cwiseAbs().maxCoeff(&worst);
    result.place.push_back(properties.name.empty() ? "" : properties.name[worst]);
  }
  return result;
}

}  // namespace tisserand::reducer
