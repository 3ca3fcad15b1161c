// SPDX-License-Identifier: GPL-3.0-or-later
// Frequencies, condition numbers and massless directions from S̄ and M̄ only.
#include "reducer/report/certificate.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/text.hpp"
#include "reducer/mesh/coordinates.hpp"
#include "reducer/modes/spectrum.hpp"
#include "reducer/modes/truncation.hpp"

namespace tisserand::reducer {
namespace {

constexpr double massless_limit = 1e-12;    ///< share of the largest eigenvalue of the scaled M̄
constexpr double unresisted_limit = 1e-13;  ///< likewise for S̄
constexpr int most_frequencies = 20;

/// Scale of the rows, by which rotations are divided by the characteristic length: entries of one unit.
Eigen::VectorXd row_scale(const formats::Superelement& element, double length) {
  return Eigen::VectorXd::NullaryExpr(element.size(), [&](Eigen::Index i) {
    return element.dof_node[i] >= 0 && element.dof_component[i] >= 3 ? 1.0 / length : 1.0;
  });
}

std::vector<int> internal_rows(const formats::Superelement& element) {
  std::vector<int> rows;
  for (int i = 0; i < element.size(); ++i)
    if (element.dof_node[i] < 0) rows.push_back(i);
  return rows;
}

std::string coordinate_text(const formats::Superelement& element, Eigen::Index row) {
  const int component = element.dof_component[row];
  if (element.dof_node[row] < 0) return fmt::format("internal coordinate {}", component);
  return fmt::format("{} {}", element.node_name[element.dof_node[row]], component_text(component));
}

std::vector<double> fixed_frequencies(const formats::Superelement& element) {
  const std::vector<int> rows = internal_rows(element);
  if (rows.empty()) return {};
  const Eigen::MatrixXd S = element.stiffness(rows, rows), M = element.mass(rows, rows);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(S, M, Eigen::EigenvaluesOnly);
  std::vector<double> result;
  for (const double lambda : solver.eigenvalues()) result.push_back(frequency(lambda));
  return result;
}

/// Number of internal coordinates without stiffness: mechanisms that a part has on purpose.
int mechanisms_of(const formats::Superelement& element) {
  int count = 0;
  for (const int row : internal_rows(element)) count += element.stiffness.row(row).isZero(0.0) ? 1 : 0;
  return count;
}

/// Elastic frequencies among the lowest, after `rigid` without stiffness.
std::vector<double> free_frequencies(const formats::Superelement& element, int massless, int rigid) {
  const int count = std::min(count_of(element) - massless, rigid + most_frequencies);
  if (count <= rigid) return {};
  const Eigen::VectorXd lambda = free_eigenvalues(element.stiffness, element.mass, count, rigid);
  std::vector<double> result;
  constexpr double resolved = 1e13;  // larger multiples of the first are round-off
  for (Eigen::Index k = rigid; k < lambda.size() && lambda[k] > 0.0 && lambda[k] < resolved * lambda[rigid]; ++k)
    result.push_back(frequency(lambda[k]));
  return result;
}

/// Whether the rigid part has no mass or inertia in some direction.
bool rigid_motion_without_mass(const formats::Superelement& element, const formats::SuperelementReport& report) {
  Eigen::MatrixXd R = formats::rigid_motions(element, report.rigid.center_of_mass);
  R.rightCols<3>() /= report.characteristic_length;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> M(R.transpose() * element.mass * R, Eigen::EigenvaluesOnly);
  return M.eigenvalues()[0] < massless_limit * M.eigenvalues()[5];
}

/// Sets the effective masses if internal coordinates are modes: M_II = 1 and S_BI = 0.
void find_effective_masses(const formats::Superelement& element, FileCertificate& c) {
  const std::vector<int> rows = internal_rows(element);
  const auto m = static_cast<Eigen::Index>(rows.size());
  if (m == 0 || !element.mass(rows, rows).isIdentity(1e-9)) return;
  Eigen::MatrixXd S = element.stiffness(rows, Eigen::all);
  const double whole_norm = S.norm();
  for (Eigen::Index k = 0; k < m; ++k) S(k, rows[k]) = 0.0;
  if (S.norm() > 1e-9 * whole_norm) return;
  const Eigen::MatrixXd MR = element.mass * formats::rigid_motions(element, c.rigid.center_of_mass);
  const Eigen::MatrixXd Gamma = MR(rows, Eigen::all);
  const Eigen::MatrixXd R = formats::rigid_motions(element, c.rigid.center_of_mass);
  const Eigen::RowVectorXd whole = R.cwiseProduct(MR).colwise().sum(), carried = Gamma.cwiseAbs2().colwise().sum();
  for (const auto& row : Gamma.rowwise()) std::copy(row.begin(), row.end(), c.participation.emplace_back().begin());
  for (int k = 0; k < 6; ++k) {
    c.effective_mass_whole[k] = whole[k];
    c.effective_mass_left[k] = std::max(whole[k] - carried[k], 0.0);
  }
}

}  // namespace

double frequency(double lambda) { return std::sqrt(std::max(lambda, 0.0)) / (2.0 * std::numbers::pi); }

FileCertificate certify(const formats::Superelement& element, const formats::SuperelementReport& report) {
  FileCertificate c;
  c.rigid = report.rigid;
  c.rigid_residual = report.rigid_residual;
  c.characteristic_length = report.characteristic_length;
  c.warnings = report.warnings;
  c.fixed_frequency = fixed_frequencies(element);
  find_effective_masses(element, c);

  const Eigen::VectorXd scale = row_scale(element, report.characteristic_length);
  using Solver = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>;
  const Solver S(scale.asDiagonal() * element.stiffness * scale.asDiagonal(), Eigen::EigenvaluesOnly);
  const int rigid = 6 + mechanisms_of(element);
  if (element.size() > rigid) c.stiffness_condition = S.eigenvalues().maxCoeff() / S.eigenvalues()[rigid];
  const Solver M(scale.asDiagonal() * element.mass * scale.asDiagonal());
  const Eigen::VectorXd value = M.eigenvalues();
  const int massless = static_cast<int>((value.array() < massless_limit * value.maxCoeff()).count());
  c.mass_condition = value.maxCoeff() / value[massless];
  for (int k = 0; k < massless; ++k) {
    const Eigen::VectorXd direction = M.eigenvectors().col(k).cwiseAbs();
    std::vector<std::string> words;
    for (Eigen::Index i = 0; i < direction.size(); ++i)
      if (direction[i] > 0.5 * direction.maxCoeff()) words.push_back(coordinate_text(element, i));
    c.massless.push_back(listed(words, " with "));
  }
  const auto free = (S.eigenvalues().array() < unresisted_limit * S.eigenvalues().maxCoeff()).count();
  if (free > rigid) {
    c.free_frequency_note = fmt::format(
        "{} motions have no stiffness, but a rigid body has only six such motions: a piece of the part is loose", free);
    return c;
  }
  if (rigid_motion_without_mass(element, report)) {
    c.free_frequency_note = "the mass or inertia of a rigid motion is zero";
    return c;
  }
  try {
    c.free_frequency = free_frequencies(element, massless, rigid);
  } catch (const Error& error) {
    c.free_frequency_note = error.message();
  }
  return c;
}

std::string certificate_path(const std::string& superelement_path) {
  return without_ending(superelement_path, {".h5"}) + ".certificate.json";
}

}  // namespace tisserand::reducer
