// SPDX-License-Identifier: GPL-3.0-or-later
// Moment vectors and modes of the free part: against the textbook's matrices and the exact dynamic stiffness of small
// parts.
#include "reducer/modes/ritz_vectors.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>

#include "reducer/modes/truncation.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/spring_nets.hpp"

namespace tisserand::testing::ritz_vectors_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using formats::ReductionMethod;

/// A part between assembly and projection, dense and sparse.
struct Inside {
  explicit Inside(const formats::Part& part)
      : full(full_model(part)),
        coordinates(reducer::partition(full.mesh, full.system)),
        blocks(reducer::split(full.system.matrices, coordinates)),
        S_II(blocks.S_II),
        boundary(reducer::boundary_modes(S_II, blocks, full.system, coordinates, [](double) {})),
        problem{{full.mesh, full.system, coordinates}, blocks, S_II, "part"} {}

  reducer::InternalModes modes(int count, int moments) const {
    formats::ModeSelection selection;
    selection.count = count;
    selection.moments = moments;
    return reducer::internal_modes(problem, boundary, selection);
  }
  /// Dynamic stiffness that the boundary feels.
  MatrixXd condensed(double lambda) const {
    const MatrixXd D = full.S - lambda * full.M;
    return D(coordinates.boundary, coordinates.boundary) -
           D(coordinates.boundary, coordinates.internal) *
               D(coordinates.internal, coordinates.internal)
                   .partialPivLu()
                   .solve(MatrixXd(D(coordinates.internal, coordinates.boundary)));
  }

  FullModel full;
  reducer::Partition coordinates;
  reducer::Blocks blocks;
  reducer::Factor S_II;
  reducer::BoundaryModes boundary;
  reducer::InternalProblem problem;
};

/// S_B − λ M_B − λ² L (Λ − λ)⁻¹ Lᵀ of the reduced part.
MatrixXd reduced_stiffness(const Inside& part, const reducer::InternalModes& modes, double lambda) {
  return part.boundary.S - lambda * part.boundary.M -
         lambda * lambda * modes.coupling * (modes.lambda.array() - lambda).inverse().matrix().asDiagonal() *
             modes.coupling.transpose();
}

/// Smallest eigenvalue of A over the largest of `size`, in coordinates in which entries have one unit.
double smallest(const MatrixXd& A, const MatrixXd& size) {
  const VectorXd unit = size.diagonal().cwiseAbs().cwiseSqrt().cwiseInverse();
  const MatrixXd scaled = unit.asDiagonal() * A * unit.asDiagonal();
  return Eigen::SelfAdjointEigenSolver<MatrixXd>(0.5 * (scaled + scaled.transpose())).eigenvalues()[0];
}

// λ² R(λ) ≤ Δ(λ) ≤ λ² R(λ)/(1 − λ/λ_d) as matrices, Δ by the condensed matrices themselves, for modes and moment
// vectors of any number. With all moment vectors the upper side is below λ⁴ G₃/(1 − λ/λ_d), G₃ = Xᵀ (S_II⁻¹ M_II)²
// S_II⁻¹ X less kept modes, which the crude choice W c = S_II⁻¹ X proves.
TEST(MomentVectors, ErrorOfTheDynamicStiffnessIsBetweenItsBounds) {
  start_solvers();
  const Inside part(space_frame(0));
  const MatrixXd S_II = part.full.S(part.coordinates.internal, part.coordinates.internal);
  const MatrixXd M_II = part.full.M(part.coordinates.internal, part.coordinates.internal);
  const MatrixXd X = part.full.M(part.coordinates.internal, part.coordinates.boundary) + M_II * part.boundary.Psi;
  for (const int count : {0, 4})
    for (const int moments : {0, 3, 7, 100}) {
      const reducer::InternalModes modes = part.modes(count, moments);
      const double dropped = *modes.first_dropped;
      EXPECT_LE(modes.moments, 18);
      MatrixXd G3 = MatrixXd::Zero(X.cols(), X.cols());
      if (moments == 100) {
        const MatrixXd Phi = modes.Phi.leftCols(count);
        MatrixXd U = S_II.ldlt().solve(X);
        U -= Phi * (Phi.transpose() * M_II * U);
        G3 = U.transpose() * M_II * S_II.ldlt().solve(M_II * U);
      }
      for (const double share : {0.1, 0.3, 0.5, 0.9}) {
        const double lambda = share * dropped;
        const MatrixXd exact = part.condensed(lambda);
        const MatrixXd error = reduced_stiffness(part, modes, lambda) - exact;
        const MatrixXd R = lambda * lambda * modes.left_out.residual(lambda);
        const MatrixXd size = part.boundary.S + lambda * part.boundary.M;
        EXPECT_GT(smallest(error - R, size), -1e-10) << count << " " << moments << " " << share;
        EXPECT_GT(smallest(R / (1.0 - share) - error, size), -1e-10) << count << " " << moments << " " << share;
        if (moments == 100) {
          EXPECT_GT(smallest(std::pow(lambda, 4) * G3 / (1.0 - share) - error, size), -1e-10);
          EXPECT_GT(error.norm(), 0.0);
        }
      }
    }
}

TEST(MomentVectors, AreRitzVectorsBesideTheModes) {
  start_solvers();
  const Inside part(space_frame(0));
  const reducer::InternalModes modes = part.modes(4, 6);
  ASSERT_EQ(modes.lambda.size(), 10);
  EXPECT_EQ(modes.moments, 6);
  EXPECT_GE(modes.lambda[4], *modes.first_dropped * (1.0 - 1e-9));  // Ritz values of what is dropped
  const MatrixXd mass = modes.Phi.transpose() * reducer::multiply(part.blocks.M_II, modes.Phi);
  const MatrixXd stiffness = modes.Phi.transpose() * reducer::multiply(part.blocks.S_II, modes.Phi);
  EXPECT_LT((mass - MatrixXd::Identity(10, 10)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT(relative_difference(stiffness, modes.lambda.asDiagonal()), 1e-9);
  const reducer::InternalModes plain = part.modes(4, 0);
  EXPECT_LT((modes.Phi.leftCols(4) - plain.Phi).cwiseAbs().maxCoeff(), 1e-12 * plain.Phi.cwiseAbs().maxCoeff());
}

formats::Part with_moments(formats::Part part, int moments) {
  part.modes.moments = moments;
  return part;
}

// The same demands as for modes alone: true frequencies in the enclosure up to λ_d, estimate over true error between
// 0.5 and 2 up to λ_d/2 ([the certificate]).
void expect_enclosed(const formats::Part& part) {
  const reducer::Reduction r = reduce(part);
  const double dropped = *r.model.first_dropped_frequency;
  const std::size_t count = std::min(r.model.free_frequency.size(), r.model.truncation_estimate.size());
  ASSERT_GE(count, 3u);
  for (std::size_t k = 0; k < count; ++k) {
    const double full = r.model.free_frequency[k], reduced = r.file.free_frequency[k], error = reduced / full - 1.0;
    EXPECT_GE(full, r.model.truncation_lower[k] * (1.0 - 1e-9)) << "mode " << k;
    EXPECT_LE(full, r.model.truncation_upper[k] * (1.0 + 1e-9)) << "mode " << k;
    if (error < 1e-8 || reduced > std::sqrt(0.5) * dropped) continue;
    EXPECT_GT(r.model.truncation_estimate[k] / error, 0.5) << "mode " << k;
    EXPECT_LT(r.model.truncation_estimate[k] / error, 2.0) << "mode " << k;
  }
}

TEST(MomentVectors, TrueErrorsLieInTheEnclosure) {
  for (const int moments : {1, 3, 6, 12}) {
    expect_enclosed(with_moments(space_frame(4), moments));
    expect_enclosed(with_moments(cardona_beam(40, 4), moments));
  }
}

// At equal size moment vectors do far more for the low frequencies than modes.
TEST(MomentVectors, ImproveLowFrequenciesMoreThanModes) {
  const auto error = [](const formats::Part& part, int moments) {
    const reducer::Reduction r = reduce(with_moments(part, moments));
    return r.file.free_frequency[0] / r.model.free_frequency[0] - 1.0;
  };
  EXPECT_LT(error(space_frame(4), 18), 1e-2 * error(space_frame(22), 0));
  EXPECT_LT(error(cardona_beam(40, 4), 6), 1e-2 * error(cardona_beam(40, 10), 0));
  // Statics are those of Guyan in any case.
  const formats::Superelement guyan = reduce(space_frame(0)).superelement;
  const formats::Superelement rich = reduce(with_moments(space_frame(4), 6)).superelement;
  EXPECT_LT(relative_difference(rich.stiffness.topLeftCorner(18, 18), guyan.stiffness), 1e-12);
  EXPECT_EQ(rich.method, "craig_bampton_moments");
}

// Bending in both planes: one vector of a pair is never left out, so frequencies stay double.
TEST(MomentVectors, StayInGroupsOfEqualOnes) {
  int raised = 0;
  for (int moments = 1; moments <= 8; ++moments) {
    const reducer::Reduction r = reduce(with_moments(cardona_beam(40, 10), moments));
    EXPECT_GE(r.model.moment_vectors, moments);
    raised += r.model.moment_vectors - moments;
    EXPECT_NEAR(r.file.free_frequency[0] / r.file.free_frequency[1], 1.0, 1e-9) << moments;
    EXPECT_NEAR(r.file.free_frequency[2] / r.file.free_frequency[3], 1.0, 1e-9) << moments;
  }
  EXPECT_GT(raised, 0);
}

TEST(MomentVectors, AccuracyTakesThemWhereTheyAreFewer) {
  formats::Part part = space_frame(0);
  const double up_to = reduce(part).model.free_frequency[4] * 1.001;
  for (const double error : {1e-2, 1e-4, 1e-6}) {
    part.modes.accuracy = formats::Accuracy{error, up_to};
    part.modes.moments = 0;
    const Index by_modes = reduce(part).superelement.size();
    part.modes.moments.reset();
    const reducer::Reduction r = reduce(part);
    EXPECT_LE(r.superelement.size(), by_modes);
    EXPECT_GT(*r.model.first_dropped_frequency, up_to);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_LT(r.file.free_frequency[k] / r.model.free_frequency[k] - 1.0, error) << "mode " << k;
  }
  EXPECT_GT(reduce(part).model.moment_vectors, 0);
}

formats::Part by_free_modes(ReductionMethod method, int modes) {
  formats::Part part = space_frame(modes);
  part.modes.method = method;
  return part;
}

/// The matrices of [Rub75], from dense modes: displacements T [q; f] = Φ q + Ĝ f with rigid and kept modes Φ and the
/// columns of the boundary of the residual flexibility Ĝ = Σ_dropped φ φᵀ/λ, f the forces on the boundary.
struct Textbook {
  MatrixXd S, M;
  MatrixXd on_boundary;  ///< T there
  Index kept = 0;        ///< q
};

Textbook textbook(const FullModel& full, const std::vector<int>& boundary, int elastic) {
  constexpr double shift = -1e3;
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> solver(full.M, full.S - shift * full.M);
  const Index n = full.S.rows(), kept = 6 + elastic;
  // M x = μ (S − shift M) x: φ = x/√μ has mass 1, λ = shift + 1/μ; directions without mass have μ = 0.
  const VectorXd mu = solver.eigenvalues().reverse();
  const MatrixXd x = solver.eigenvectors().rowwise().reverse();
  Textbook t;
  t.kept = kept;
  MatrixXd basis(n, kept + static_cast<Index>(boundary.size()));
  for (Index k = 0; k < kept; ++k) basis.col(k) = x.col(k) / std::sqrt(mu[k]);
  const MatrixXd dropped = x.rightCols(n - kept);
  // φ φᵀ/λ = x xᵀ/(1 + shift μ).
  const VectorXd weight = (1.0 + shift * mu.tail(n - kept).array()).inverse();
  basis.rightCols(static_cast<Index>(boundary.size())) =
      dropped * weight.asDiagonal() * dropped(boundary, Eigen::all).transpose();
  t.on_boundary = basis(boundary, Eigen::all);
  t.S = basis.transpose() * full.S * basis;
  t.M = basis.transpose() * full.M * basis;
  return t;
}

/// Largest relative difference of the `count` lowest elastic eigenvalues.
double eigenvalue_difference(const formats::Superelement& a, const Textbook& b, Index count) {
  const VectorXd mine = eigenvalues(a.stiffness, a.mass, -1e3), theirs = eigenvalues(b.S, b.M, -1e3);
  return (mine.segment(6, count).array() / theirs.segment(6, count).array() - 1.0).abs().maxCoeff();
}

TEST(FreeBoundary, RubinIsThatOfTheTextbook) {
  start_solvers();
  for (const int modes : {0, 4, 9}) {
    const Inside part(space_frame(0));
    const reducer::Reduction r = reduce(by_free_modes(ReductionMethod::rubin, modes));
    const Textbook t = textbook(part.full, part.coordinates.boundary, modes);
    ASSERT_EQ(r.superelement.size(), t.S.rows());
    EXPECT_LT(eigenvalue_difference(r.superelement, t, t.S.rows() - 12), 1e-6) << modes;
    for (int k = 0; k < modes; ++k)  // the kept modes are in it
      EXPECT_NEAR(r.file.free_frequency[k], r.model.free_frequency[k], 1e-9 * r.model.free_frequency[k]);
    const formats::Superelement guyan = reduce(space_frame(0)).superelement;
    EXPECT_LT(relative_difference(r.superelement.stiffness.topLeftCorner(18, 18), guyan.stiffness), 1e-12);
    EXPECT_EQ(r.superelement.method, "rubin");
    EXPECT_EQ(r.model.free_modes, modes);
  }
}

// [Mac71]: the mass of q alone.
TEST(FreeBoundary, MacNealLeavesTheResidualMassOut) {
  start_solvers();
  const int modes = 6;
  const Inside part(space_frame(0));
  const reducer::Reduction r = reduce(by_free_modes(ReductionMethod::macneal, modes));
  const Textbook t = textbook(part.full, part.coordinates.boundary, modes);
  for (int k = 0; k < modes; ++k)
    EXPECT_NEAR(r.file.free_frequency[k], r.model.free_frequency[k], 1e-8 * r.model.free_frequency[k]);
  // With the boundary held Φ_B q + Ĝ_BB f = 0: stiffness Λ + Φ_Bᵀ Ĝ_BB⁻¹ Φ_B and mass 1 of q.
  const MatrixXd Phi_B = t.on_boundary.leftCols(t.kept), G_BB = t.on_boundary.rightCols(18);
  const MatrixXd held = t.S.topLeftCorner(t.kept, t.kept) + Phi_B.transpose() * G_BB.ldlt().solve(Phi_B);
  const VectorXd lambda = Eigen::SelfAdjointEigenSolver<MatrixXd>(held).eigenvalues();
  ASSERT_EQ(static_cast<Index>(r.file.fixed_frequency.size()), lambda.size());
  for (Index k = 0; k < lambda.size(); ++k)
    EXPECT_NEAR(std::pow(2.0 * std::numbers::pi * r.file.fixed_frequency[static_cast<std::size_t>(k)], 2) / lambda[k],
                1.0, 1e-5);
  EXPECT_TRUE(r.model.truncation_estimate.empty());
  EXPECT_FALSE(r.companion);
  EXPECT_EQ(r.superelement.method, "macneal");
}

// Without free modes the six vectors of rigid accelerations remain, which are no modes of the held part.
TEST(FreeBoundary, VectorsWithoutFreeModesAreNotCalledModes) {
  const reducer::Reduction r = reduce(by_free_modes(ReductionMethod::rubin, 0));
  EXPECT_EQ(r.model.free_modes, 0);
  EXPECT_EQ(r.file.fixed_frequency.size(), 6u);
  EXPECT_THAT(reducer::certificate_text(r.superelement, r.file, r.model),
              ::testing::HasSubstr("0 of the free part, 6 internal vectors"));
}

// Where nothing behind the kept pairs was found the last of them is a bound, and only all modes leave nothing out.
TEST(MomentVectors, DroppedOnesAreNotBelowWhatIsKept) {
  const VectorXd value = VectorXd::LinSpaced(4, 1.0, 4.0);
  EXPECT_EQ(reducer::least_dropped(value, 3, 9), 4.0);
  EXPECT_EQ(reducer::least_dropped(value, 0, 9), 1.0);
  EXPECT_EQ(reducer::least_dropped(value, 4, 9), 4.0);
  EXPECT_EQ(reducer::least_dropped(value, 4, 4), std::numeric_limits<double>::infinity());
}

TEST(FreeBoundary, CutOffCountsFreeModes) {
  formats::Part part = by_free_modes(ReductionMethod::rubin, 0);
  const std::vector<double> full = reduce(part).model.free_frequency;
  part.modes.cutoff = 0.5 * (full[3] + full[4]);
  EXPECT_EQ(reduce(part).model.free_modes, 4);
}

}  // namespace
}  // namespace tisserand::testing::ritz_vectors_test
