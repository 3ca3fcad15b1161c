// SPDX-License-Identifier: GPL-3.0-or-later
// Measures of elements, their limits, and the warnings for the modes.
#include "reducer/mesh_error/doubts.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Geometry>

#include "common/error.hpp"
#include "common/parallel.hpp"
#include "reducer/elements/mesh_error.hpp"
#include "reducer/mesh/solid_faces.hpp"
#include "reducer/mesh_error/patches.hpp"
#include "reducer/mesh_error/shell_form.hpp"

namespace tisserand::reducer {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Limits of the measures, in units of the estimate; above them the estimate is not reliable.
struct DoubtLimits {
  double traction = 3.0;
  double scatter = 1e3;  ///< no limit
};

DoubtLimits limits_of(const Mesh& mesh, int element) {
  const int shells = count_of(mesh.shells);
  if (element < shells) return {3.0, mesh.shells[element].corners() == 3 ? 0.42 : 0.55};
  switch (mesh.solids[element - shells].shape) {
    case SolidShape::tetrahedron4:
    case SolidShape::tetrahedron10:
    case SolidShape::hexahedron8:
    case SolidShape::prism6:
      return {};
    case SolidShape::hexahedron20:
      return {0.6, 1e3};
    case SolidShape::prism15:
      return {0.6, 0.78};
  }
  return {};
}

/// Nodes at which other elements than solids, or ties, may act.
std::vector<bool> attached_nodes(const Mesh& mesh) {
  std::vector<bool> attached(static_cast<std::size_t>(mesh.nodes()), false);
  for (const Spider& spider : mesh.spiders)
    for (const int n : spider.nodes) attached[n] = true;
  for (const TieEquation& equation : mesh.equations)
    for (const TieTerm& term : equation.terms) attached[term.node] = true;
  for (const ShellElement& shell : mesh.shells)
    for (const int n : nodes_of(shell)) attached[n] = true;
  return attached;
}

/// Free faces of each solid.
std::vector<std::vector<std::vector<int>>> free_faces(const Mesh& mesh) {
  const std::vector<bool> attached = attached_nodes(mesh);
  std::vector<std::vector<std::vector<int>>> faces(mesh.solids.size());
  for (const OuterFace& face : outer_faces_of_solids(mesh)) {
    const auto& nodes = mesh.solids[face.solid].nodes;
    if (std::any_of(face.corners.begin(), face.corners.end(), [&](int k) { return !attached[nodes[k]]; }))
      faces[face.solid].push_back(face.corners);
  }
  return faces;
}

/// Energy of the traction of smooth stresses at a face if it decreases to zero over half the depth of the element:
/// depth/6 · ∫ |σ* n|²/G dA.
VectorXd traction_energy(const Mesh& mesh, const SolidElement& solid, const std::vector<int>& corners,
                         const MatrixXd& smooth) {
  const auto x = [&](int k) { return Vector3d(mesh.position.col(solid.nodes[k])); };
  const Vector3d first = x(corners[0]);
  Vector3d area = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    area += 0.5 * (x(corners[k]) - first).cross(x(corners[k + 1]) - first);
  const Vector3d n = area.normalized();
  double depth = 0.0;
  for (int k = 0; k < corner_count(solid.shape); ++k) depth = std::max(depth, n.dot(first - x(k)));
  const double G = mesh.solid_properties[solid.property].material.C(3, 3);
  Eigen::Matrix<double, 3, 6> to_traction;
  to_traction << n.x(), 0, 0, n.y(), 0, n.z(), 0, n.y(), 0, n.x(), n.z(), 0, 0, 0, n.z(), 0, n.y(), n.x();
  VectorXd sum = VectorXd::Zero(smooth.cols());
  for (const int k : corners) sum += (to_traction * smooth.middleRows<6>(6 * k)).colwise().squaredNorm().transpose();
  return area.norm() * depth / (6.0 * G * static_cast<double>(corners.size())) * sum;
}

}  // namespace

const char* explain(MeshDoubt doubt) {
  constexpr const char* texts[] = {
      "",
      "errors above 50 % mix the modes",
      "smoothed stresses do not vanish at free faces, because there are too few elements across",
      "stresses scatter from element to element, because there are too few elements per wave",
      "errors of opposite sign cancel",
      "a curved surface or edge turns by more than 25 degrees from element to element",
      "there are fewer than three elements between folds",
      "doubly curved shells turn by more than 1.5 degrees from element to element"};
  static_assert(std::size(texts) == static_cast<std::size_t>(MeshDoubt::double_curvature) + 1);
  return texts[static_cast<std::size_t>(doubt)];
}

MeshMeasures mesh_measures(const Mesh& mesh, const MatrixXd& motion, const VectorXd& lambda) {
  const int shells = count_of(mesh.shells), count = shells + count_of(mesh.solids);
  const int modes = count_of(lambda);
  const SmoothStress smooth(mesh, motion);
  const auto faces = free_faces(mesh);
  const MatrixXd none = MatrixXd::Zero(count, modes);
  MeshMeasures all{none, none, none, none, none};
  on_threads(core_count(), [&](int t) {
    const Share share = share_of(count, t, core_count());
    for (int e = share.first; e < share.end; ++e) {
      const auto energy = [&](const auto& element, const MatrixXd& stress) -> Eigen::RowVectorXd {
        return stress_energy(mesh, element, stress, modes).transpose();
      };
      if (e < shells) {
        const ShellElement& shell = mesh.shells[e];
        all.error.row(e) =
            energy_error(mesh, shell, {motion_of(shell, motion), lambda}, smooth.of_shell(e), smooth.around(e))
                .transpose();
        all.strain.row(e) = energy(shell, smooth.samples(e));
        all.scatter.row(e) = energy(shell, smooth.scatter(e));
        continue;
      }
      const SolidElement& solid = mesh.solids[e - shells];
      const MatrixXd u = motion_of(solid, motion), stress = smooth.of_solid(e - shells);
      all.error.row(e) = energy_error(mesh, solid, {u, lambda}, stress).transpose();
      all.strain.row(e) = energy(solid, smooth.samples(e));
      all.scatter.row(e) = energy(solid, smooth.scatter(e));
      for (const std::vector<int>& face : faces[e - shells])
        all.traction.row(e) += traction_energy(mesh, solid, face, stress).transpose();
      if (!is_second_order(solid.shape)) all.imbalance.row(e) = imbalance(mesh, solid, {u, lambda}, stress).transpose();
    }
  });
  return all;
}

MeshDoubts mesh_doubts(const Mesh& mesh, const MeshMeasures& measures, const VectorXd& beams, const VectorXd& lambda) {
  constexpr double least = 1.5e-3, largest = 0.5, out_of_balance = 0.2, cancelled = 2.5;
  constexpr double turned_size = 0.1;                   ///< a cylinder of 8 to 12 shells has errors of 6 to 20 %
  constexpr double few_turned = 0.1, few_folded = 0.2;  // shares of the strain energy
  const Index modes = lambda.size();
  const int shells = count_of(mesh.shells), count = static_cast<int>(measures.error.rows());
  const std::vector<ShellForm> forms = shell_forms(mesh);
  Eigen::MatrixXd at_node = MatrixXd::Zero(mesh.nodes(), modes);
  VectorXd traction = VectorXd::Zero(modes), scatter = traction, turned = traction, folded = traction,
           curved = traction;
  for (int e = 0; e < count; ++e) {
    const DoubtLimits limits = limits_of(mesh, e);
    traction += measures.traction.row(e).transpose() / limits.traction;
    scatter += measures.scatter.row(e).transpose() / limits.scatter;
    if (e >= shells) continue;
    const int corners = corners_of(mesh, e);
    for (int k = 0; k < corners; ++k) at_node.row(corner_node(mesh, e, k)) += measures.error.row(e) / corners;
    const VectorXd strain = measures.strain.row(e).transpose();
    if (forms[e].turned) turned += strain;
    if (forms[e].few_across) folded += strain;
    if (forms[e].double_curvature) curved += strain;
  }
  const VectorXd strain = measures.strain.colwise().sum().transpose();
  const VectorXd error = measures.error.colwise().sum().transpose() + beams;
  const VectorXd gross = at_node.cwiseAbs().colwise().sum().transpose();
  const VectorXd balance = (measures.traction + measures.imbalance).colwise().sum().transpose();
  MeshDoubts result{std::vector<MeshDoubt>(static_cast<std::size_t>(modes), MeshDoubt::none), VectorXd::Zero(modes)};
  bool mixed = false;
  for (Index k = 0; k < modes; ++k) {
    const double half = 0.5 / lambda[k], estimate = std::abs(half * error[k]);
    const double size = std::max({estimate, half * traction[k], half * scatter[k], half * gross[k] / cancelled});
    result.size[k] = size;
    mixed = mixed || half * error[k] > 0.5 * (1.0 - 1.0 / ((1.0 + largest) * (1.0 + largest)));
    const auto doubt = [&] {
      if (turned[k] > few_turned * strain[k]) return MeshDoubt::turned;
      if (size < least) return MeshDoubt::none;
      if (half * balance[k] > out_of_balance || half * traction[k] > estimate) return MeshDoubt::free_faces;
      if (folded[k] > few_folded * strain[k]) return MeshDoubt::few_across;
      if (curved[k] > few_folded * strain[k]) return MeshDoubt::double_curvature;
      if (half * gross[k] > cancelled * estimate) return MeshDoubt::cancelling;
      if (half * scatter[k] > estimate) return MeshDoubt::scatter;
      return MeshDoubt::none;
    };
    const MeshDoubt found = doubt();
    result.doubt[k] = found;
    if (found == MeshDoubt::turned) result.size[k] = std::max(size, turned_size);
    if (found == MeshDoubt::few_across) result.size[k] = 3.0 * size;
  }
  if (mixed) std::fill(result.doubt.begin(), result.doubt.end(), MeshDoubt::too_large);
  return result;
}

}  // namespace tisserand::reducer
