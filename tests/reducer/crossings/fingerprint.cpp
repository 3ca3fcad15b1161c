// SPDX-License-Identifier: GPL-3.0-or-later
// Eigenvalues of each reduced matrix against the stiffness of the held part, and mapped vectors.
#include "tests/reducer/crossings/fingerprint.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/SVD>

#include "reducer/report/certificate.hpp"
#include "tests/reducer/solve/solving.hpp"

namespace tisserand::testing::crossings {
namespace {

using Eigen::Index;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

/// Limits of relative differences: round-off; quantities of first order in eigenvectors, or of thin parts.
constexpr double round_off = 1e-7, first_order = 1e-6;

/// Lower limit of the scale of a trait. Companion traits are shares of the stiffness: smaller ones count as zero.
constexpr double smallest = 1e-9;

/// Rows and columns `kept` of a matrix.
MatrixXd kept_of(const MatrixXd& A, const std::vector<int>& kept) { return A(kept, kept); }

/// Forms A of the held part relative to its stiffness: L⁻¹ A L⁻ᵀ with S = L Lᵀ.
class HeldPart {
 public:
  /// Holds the first boundary node, or all boundary nodes if none has rotations.
  explicit HeldPart(const formats::Superelement& e) {
    bool is_bare = true;
    for (int i = 0; i < static_cast<int>(e.size()); ++i) is_bare &= e.dof_node[i] < 0 || e.dof_component[i] < 3;
    for (int i = 0; i < static_cast<int>(e.size()); ++i)
      if (e.dof_node[i] < 0 || (e.dof_node[i] != 0 && !is_bare)) free_.push_back(i);
    factor_.compute(kept_of(e.stiffness, free_));
    EXPECT_EQ(factor_.info(), Eigen::Success);
  }
  bool has_motion() const { return !free_.empty(); }
  VectorXd solve(const VectorXd& force) const {
    VectorXd y = VectorXd::Zero(force.size());
    const VectorXd loaded = force(free_);
    y(free_) = VectorXd(factor_.solve(loaded));
    return y;
  }
  /// Eigenvalues of a symmetric form with their signs: the five largest in size, largest first.
  VectorXd values(const MatrixXd& A) const {
    const MatrixXd B = reduced(A);
    VectorXd values =
        Eigen::SelfAdjointEigenSolver<MatrixXd>(0.5 * (B + B.transpose()), Eigen::EigenvaluesOnly).eigenvalues();
    std::ranges::sort(values, [](double a, double b) { return std::abs(a) > std::abs(b); });
    return values.head(std::min<Index>(values.size(), 5));
  }
  /// The six largest singular values of any form.
  VectorXd sizes(const MatrixXd& A) const {
    const VectorXd values = reduced(A).jacobiSvd().singularValues();
    return values.head(std::min<Index>(values.size(), 6));
  }

 private:
  MatrixXd reduced(const MatrixXd& A) const {
    MatrixXd B = kept_of(A, free_);
    factor_.matrixL().solveInPlace(B);
    B.transposeInPlace();
    factor_.matrixL().solveInPlace(B);
    return B.transpose();
  }
  std::vector<int> free_;
  Eigen::LLT<MatrixXd> factor_;
};

/// Flexibility of the boundary with the first node held: displacement of each node under unit forces on it, in the axes
/// of the first description.
VectorXd flexibility(const formats::Superelement& e, const Description& d) {
  const HeldPart held(e);
  std::vector<double> all;
  for (int i = 0; i < static_cast<int>(e.size()); ++i) {
    if (e.dof_node[i] <= 0 || e.dof_component[i] != 0) continue;
    Matrix3d block;
    for (int k = 0; k < 3; ++k) {
      VectorXd force = VectorXd::Zero(e.size());
      force[i + k] = 1.0;
      block.col(k) = held.solve(force).segment<3>(i);
    }
    const Matrix3d F = d.Q.transpose() * block * d.Q * d.force() / d.length;
    all.insert(all.end(), F.reshaped().begin(), F.reshaped().end());
  }
  return Eigen::Map<VectorXd>(all.data(), static_cast<Index>(all.size()));
}

/// The lowest squared angular frequencies of the free part above zero, up to six. `least`: lowest of the held part.
VectorXd free_frequencies(const formats::Superelement& e, double least) {
  const double shift = 1e-3 * least;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(e.mass, e.stiffness + shift * e.mass);
  std::vector<double> lambda;
  for (const double mu : solver.eigenvalues().reverse()) {
    const double value = 1.0 / mu - shift;
    if (value > shift && lambda.size() < 6) lambda.push_back(value);
  }
  return Eigen::Map<VectorXd>(lambda.data(), static_cast<Index>(lambda.size()));
}

void add_reduced(const reducer::Reduction& reduction, const Description& d, std::vector<Trait>& traits) {
  const formats::Superelement& e = reduction.superelement;
  const formats::RigidProperties rigid = formats::rigid_properties(e);
  traits.push_back({"mass", VectorXd::Constant(1, rigid.mass / d.mass), round_off});
  traits.push_back(
      {"centre", d.Q.transpose() * rigid.center_of_mass / d.length - d.Q.transpose() * d.shift, round_off});
  const Matrix3d J = d.Q.transpose() * rigid.inertia * d.Q / (d.mass * d.length * d.length);
  traits.push_back({"inertia", J.reshaped(), first_order});
  traits.push_back({"flexibility", flexibility(e, d), round_off});
  const HeldPart held(e);
  if (!held.has_motion()) return;
  const VectorXd lambda = held.values(e.mass).cwiseInverse();
  traits.push_back({"held frequencies", lambda, round_off});
  traits.push_back({"free frequencies", free_frequencies(e, lambda[0]), first_order});
}

void add_companion(const formats::Companion& c, const formats::Superelement& e, const Description& d,
                   std::vector<Trait>& traits) {
  const HeldPart held(e);
  if (!held.has_motion() || !c.has_second_order()) return;
  const Vector3d a = d.length * (d.Q * Vector3d(40.0, -90.0, 30.0)), turn = Vector3d(5.0, 3.0, -8.0);
  const Vector3d Omega = d.handedness() * (d.Q * turn);
  const VectorXd y = held.solve(c.S1.transpose() * a);
  MatrixXd stress = MatrixXd::Zero(e.size(), e.size()), spin = stress, gyro = stress, relative = stress, pull = stress,
           twist = stress;
  for (Index j = 0; j < e.size(); ++j) stress += y[j] * c.H[j];
  for (int j = 0; j < 3; ++j)
    for (int k = 0; k < 3; ++k)
      spin += Omega[j] * Omega[k] * (c.E[formats::axis_pair(j, k)] + c.T[formats::axis_pair(j, k)]);
  for (int k = 0; k < 3; ++k) {
    gyro += Omega[k] * c.C[k];
    if (c.has_relative_turns()) relative += Omega[k] * c.W[k];
    pull += a[k] * c.N[k];
    twist += Omega[k] * c.N[k + 3];
  }
  traits.push_back({"stress stiffness", held.values(stress), first_order});
  traits.push_back({"inertia of a turning frame", held.values(spin), first_order});
  traits.push_back({"gyroscopic", held.sizes(gyro + relative), first_order});
  traits.push_back({"momentum, second order", held.values(pull), first_order});
  traits.push_back({"moment of momentum, second order", held.values(twist), first_order});
}

/// The twelve largest element stresses, sorted, because the numbers of elements differ between descriptions.
VectorXd stresses(const reducer::Solution& s, const Description& d) {
  std::vector<double> all;
  for (const Eigen::MatrixXf* field : {&s.fields.beam_stress, &s.fields.shell_von_mises, &s.fields.solid_von_mises})
    for (const float value : field->reshaped()) all.push_back(static_cast<double>(value) / d.stress());
  std::ranges::sort(all, std::greater());
  return Eigen::Map<VectorXd>(all.data(), static_cast<Index>(std::min<std::size_t>(all.size(), 12)));
}

void add_solution(const reducer::Solution& s, const Description& d, std::vector<Trait>& traits) {
  const Eigen::Matrix<double, 6, 1> motion = motion_of(s, "load", 0);
  traits.push_back({"displacement", d.Q.transpose() * motion.head<3>() / d.length, round_off});
  traits.push_back({"strain energy", s.statics.energy / (d.mass * d.length * d.length), round_off});
  traits.push_back({"stress", stresses(s, d), first_order});
  if (s.modes) traits.push_back({"modes on supports", s.modes->lambda, round_off});
  if (!s.buckling.empty()) traits.push_back({"load factors", s.buckling.front().factor, first_order});
}

}  // namespace

std::vector<Trait> fingerprint(const reducer::Reduction& reduction, const reducer::Solution& solution,
                               const Description& d, bool has_own_second_order) {
  std::vector<Trait> traits;
  add_reduced(reduction, d, traits);
  if (reduction.companion && has_own_second_order)
    add_companion(*reduction.companion, reduction.superelement, d, traits);
  add_solution(solution, d, traits);
  return traits;
}

Difference worst_difference(const std::vector<Trait>& a, const std::vector<Trait>& b) {
  Difference worst;
  if (a.size() != b.size()) return {"number of traits", std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i].values.size() != b[i].values.size()) return {a[i].name, std::numeric_limits<double>::infinity()};
    if (a[i].values.size() == 0) continue;
    const double scale = std::max(a[i].values.cwiseAbs().maxCoeff(), smallest);
    const double share = (a[i].values - b[i].values).cwiseAbs().maxCoeff() / (a[i].limit * scale);
    if (!(share <= worst.share))
      worst = {
          fmt::format("{}: {:.9g} and {:.9g}", a[i].name, fmt::join(a[i].values, " "), fmt::join(b[i].values, " ")),
          share};
  }
  return worst;
}

}  // namespace tisserand::testing::crossings
