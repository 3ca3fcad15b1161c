// SPDX-License-Identifier: GPL-3.0-or-later
// Rigid properties and free frequencies of the unreduced part.
#include "reducer/modes/full_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "reducer/modes/internal_modes.hpp"

namespace tisserand::reducer {
namespace {

Eigen::Matrix<double, 6, 6> rigid_mass_about(const System& system, const Eigen::Vector3d& point) {
  return rigid_motions_about(system, point).transpose() * rigid_momenta_about(system, point);
}

}  // namespace

Blocks take_apart(System& system, const Partition& p, const formats::ModeSelection& asked) {
  const bool needed =
      asked.method != formats::ReductionMethod::craig_bampton || asked.mechanism == formats::Mechanisms::allow;
  if (!needed && system.size() > most_compared_coordinates) return split(std::move(system.matrices), p);
  return split(system.matrices, p);
}

formats::RigidProperties full_rigid_properties(const System& system) {
  const Eigen::Vector3d& mean = system.middle;
  const Eigen::Matrix<double, 6, 6> about_mean = rigid_mass_about(system, mean);
  formats::RigidProperties rigid;
  rigid.mass = about_mean.topLeftCorner<3, 3>().trace() / 3.0;
  if (!(rigid.mass > 0.0)) return rigid;
  const Eigen::Matrix3d C = about_mean.topRightCorner<3, 3>() / rigid.mass;  // −skew(center − mean)
  rigid.center_of_mass = mean + 0.5 * Eigen::Vector3d(C(1, 2) - C(2, 1), C(2, 0) - C(0, 2), C(0, 1) - C(1, 0));
  rigid.inertia = rigid_mass_about(system, rigid.center_of_mass).bottomRightCorner<3, 3>();
  return rigid;
}

std::optional<FreeModes> full_free_modes(const System& system, const FreeSearch& sought,
                                         const formats::ModeSelection& asked, Count verify,
                                         const std::function<void(double)>& share) {
  const Eigen::Matrix<double, 6, 6> rigid = rigid_mass_about(system, system.middle);
  Eigen::Matrix<double, 6, 1> unit = rigid.diagonal().cwiseMax(0.0).cwiseSqrt().cwiseInverse();
  if (!unit.allFinite()) return std::nullopt;
  const Eigen::MatrixXd scaled = unit.asDiagonal() * rigid * unit.asDiagonal();
  if (Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(scaled).eigenvalues()[0] < 1e-12) return std::nullopt;

  const SystemMatrices matrices = to_petsc(system.matrices);
  const int rigid_motions = sought.rigid_motions, most = rigid_motions + sought.count;
  const bool is_dense = choose_solver(system.size(), most, asked) == EigenSolver::lapack;
  const int available =
      !is_dense && most + sought_beyond <= sought.finite ? count_of(system) : finite_mode_count(matrices.mass);
  const int wanted = std::min(available, most);
  if (wanted <= rigid_motions) return FreeModes{};
  // The shift is as far below the rigid motions as the first mode is above: a solution has the error ε λ_max/(λ −
  // shift), which was 7e-8 for bricks with a tenth of this shift.
  const double shift = -sought.scale;
  const Factor factor(combine(matrices.stiffness, -shift, matrices.mass));
  const Spectrum spectrum = lowest_pairs({matrices.stiffness, matrices.mass, factor, shift, share}, wanted, available,
                                         choose_solver(system.size(), wanted, asked), verify);
  const int kept = spectrum.kept - rigid_motions;
  FreeModes modes{
      {spectrum.pairs.value.segment(rigid_motions, kept), spectrum.pairs.vector.middleCols(rigid_motions, kept)},
      {},
      report_of(spectrum)};
  if (spectrum.counted) modes.counted = *spectrum.counted - rigid_motions;
  return modes;
}

ModeComparison compare_free_modes(const System& system, const FreeSearch& sought, const formats::ModeSelection& asked,
                                  const Eigen::MatrixXd& u) {
  ModeComparison result;
  try {
    const std::optional<FreeModes> pairs = full_free_modes(system, sought, asked);
    if (!pairs) return result;
    const Eigen::Index kept = std::min<Eigen::Index>(sought.count, pairs->value.size());
    for (Eigen::Index k = 0; k < kept; ++k)
      result.frequency.push_back(std::sqrt(std::max(0.0, pairs->value[k])) / (2.0 * std::numbers::pi));
    const Eigen::MatrixXd Mu = multiply(symmetric_rows(system.matrices, system.matrices.M), u);
    result.assurance = (pairs->vector.leftCols(kept).transpose() * Mu).cwiseAbs2();
    return result;
  } catch (const Error&) {
    return {};  // only a comparison: frequencies of nearly massless parts cannot be resolved
  }
}

}  // namespace tisserand::reducer
