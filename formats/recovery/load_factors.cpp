// SPDX-License-Identifier: GPL-3.0-or-later
// Computes the loads that the basis of a superelement misses, from the frames in the results.
#include "formats/recovery/load_factors.hpp"

#include <algorithm>

#include <Eigen/Geometry>

namespace tisserand::formats {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Three columns of a dataset over time, 3 x T; no columns if they are not stored.
Matrix3Xd vectors_of(const ResultsReader& results, const std::string& dataset, const std::vector<std::size_t>& rows,
                     std::size_t row) {
  const MatrixXd all = results.read_dataset(dataset, rows);
  const auto first = static_cast<Index>(3 * row);
  if (all.cols() < first + 3) return Matrix3Xd(3, 0);
  return all.middleCols<3>(first).transpose();
}

/// Names of the body's load cases, or of its nodes if modal. `first`: index of the first one in the whole list.
std::vector<std::string> names_of(const ResultsLayout& layout, const LoadedBody& body, std::size_t& first) {
  const std::vector<int>& offset = body.is_modal ? layout.modal_node_offset : layout.load_case_offset;
  const std::vector<std::string>& names = body.is_modal ? layout.modal_nodes : layout.load_cases;
  if (body.row + 1 >= offset.size()) return {};
  first = static_cast<std::size_t>(offset[body.row]);
  return {names.begin() + offset[body.row], names.begin() + offset[body.row + 1]};
}

/// Factor that converts a force or moment on the mirrored body in the scene to one on the part in units of its file.
/// `component`: AppliedLoad::component.
double force_to_file(const LoadedBody& body, int component) {
  const UnitConversion& to = body.to_scene;
  const double sign = body.mirror[component % 3] * (component < 3 ? 1.0 : body.mirror.prod());
  return sign / (to.force() * (component < 3 ? 1.0 : to.length));
}

/// Sets the factors of applied loads: load cases unchanged, forces on nodes in units of the file.
void set_applied(const std::vector<AppliedLoad>& applied, const ResultsReader& results,
                 const std::vector<std::size_t>& rows, const LoadedBody& body, MatrixXd& factor) {
  factor.bottomRows(static_cast<Index>(applied.size())).setZero();
  std::size_t first = 0;
  const std::vector<std::string> names = names_of(results.layout(), body, first);
  if (names.empty() || applied.empty()) return;
  const MatrixXd all =
      results.read_dataset(body.is_modal ? "modal_bodies/node_force" : "superelements/load_factor", rows);
  for (std::size_t k = 0; k < applied.size(); ++k) {
    const AppliedLoad& load = applied[k];
    const auto at = std::ranges::find(names, body.is_modal ? load.node : load.load_case);
    if (at == names.end()) continue;
    const auto item = static_cast<Index>(first + static_cast<std::size_t>(at - names.begin()));
    const Index column = body.is_modal ? 6 * item + load.component : item;
    const double scale = body.is_modal ? force_to_file(body, load.component) : 1.0;
    if (column < all.cols()) factor.row(inertia_loads + static_cast<Index>(k)) = scale * all.col(column).transpose();
  }
}

}  // namespace

std::vector<std::string> loads_without_answer(const Recovery& recovery, const ResultsLayout& layout,
                                              const LoadedBody& body) {
  std::size_t first = 0;
  std::vector<std::string> names = names_of(layout, body, first);
  if (!recovery.loads) return names;
  std::erase_if(names, [&](const std::string& name) {
    return std::ranges::any_of(recovery.loads->applied, [&](const AppliedLoad& load) {
      return (body.is_modal ? load.node : load.load_case) == name;
    });
  });
  return names;
}

Eigen::Matrix<double, inertia_loads, 1> inertia_factors(const Vector3d& a, const Vector3d& omega,
                                                        const Vector3d& omega_rate, const Vector3d& d) {
  Eigen::Matrix<double, inertia_loads, 1> f;
  f << -(a + omega_rate.cross(d) + omega.cross(omega.cross(d))), -omega_rate, omega.cwiseAbs2(),
      2.0 * omega.y() * omega.z(), 2.0 * omega.x() * omega.z(), 2.0 * omega.x() * omega.y();
  return f;
}

LoadFactors load_factors(const Recovery& recovery, const ResultsReader& results, const std::vector<std::size_t>& rows,
                         const LoadedBody& body) {
  LoadFactors loads;
  if (!recovery.loads) return loads;
  const std::string frame = body.is_modal ? "modal_bodies/frame_" : "superelements/frame_";
  const Matrix3Xd a = vectors_of(results, frame + "acceleration", rows, body.row),
                  w = vectors_of(results, frame + "angular_velocity", rows, body.row),
                  wd = vectors_of(results, frame + "angular_acceleration", rows, body.row);
  const bool stored = a.cols() > 0 && w.cols() > 0 && wd.cols() > 0;
  if (!stored || !a.allFinite() || !w.allFinite() || !wd.allFinite() || !body.origin.allFinite()) return loads;
  const UnitConversion& to = body.to_scene;
  const double turning = body.mirror.prod();
  const Vector3d d = recovery.loads->reference_point - body.mirror.cwiseProduct(body.origin) / to.length;
  loads.factor.resize(recovery.loads->columns(), a.cols());
  set_applied(recovery.loads->applied, results, rows, body, loads.factor);
  if (!loads.factor.bottomRows(static_cast<Index>(recovery.loads->applied.size())).allFinite()) return {};
  for (Index t = 0; t < a.cols(); ++t)
    loads.factor.col(t).head<inertia_loads>() =
        inertia_factors(body.mirror.cwiseProduct(a.col(t)) * (to.time * to.time / to.length),
                        turning * body.mirror.cwiseProduct(w.col(t)) * to.time,
                        turning * body.mirror.cwiseProduct(wd.col(t)) * (to.time * to.time), d);
  loads.spin_squared = w.colwise().squaredNorm().transpose() * (to.time * to.time);
  return loads;
}

std::vector<Index> dropped_modes(const Recovery& recovery, const MatrixXd& y) {
  std::vector<Index> dropped;
  for (Index k = 0; k < y.rows(); ++k)
    if (recovery.dof_node[static_cast<std::size_t>(k)] < 0 && y.row(k).isZero(0.0)) dropped.push_back(k);
  return dropped;
}

}  // namespace tisserand::formats
