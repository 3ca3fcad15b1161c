// Laws of the reduction: rigid motions, statics, numbering, bounds on frequencies, canonical form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/error.hpp"
#include "reducer/partition.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Superelement;
using ::testing::HasSubstr;

/// A shift of the size of the first elastic eigenvalues of the frame.
constexpr double shift = -1e4;

TEST(Reduction, RigidBodyIsThatOfTheMesh) {
  for (const int modes : {0, 6}) {
    const reducer::Reduction r = reduce(space_frame(modes));
    const FullModel full = full_model(space_frame(modes));
    const MatrixXd R = reducer::rigid_motions_about(full.system, Vector3d::Zero());
    const Superelement& e = r.superelement;
    const MatrixXd R_reduced = formats::rigid_motions(e, Vector3d::Zero());
    // Exact with any number of modes: T R_B = R. Round-off of some hundred terms.
    EXPECT_LT(relative_difference(R_reduced.transpose() * e.mass * R_reduced, R.transpose() * full.M * R), 1e-12);
    EXPECT_LT((e.stiffness * R_reduced).cwiseAbs().maxCoeff(), 1e-12 * e.stiffness.topLeftCorner(18, 18).maxCoeff());
    EXPECT_LT(r.file.rigid_residual, 1e-12);
    EXPECT_NEAR(r.file.rigid.mass / r.model.rigid.mass, 1.0, 1e-12);
    EXPECT_LT((r.file.rigid.center_of_mass - r.model.rigid.center_of_mass).norm(), 1e-12);
    EXPECT_LT(relative_difference(r.file.rigid.inertia, r.model.rigid.inertia), 1e-11);
  }
}

TEST(Reduction, StaticResponseOfTheBoundaryIsThatOfTheFullModel) {
  const FullModel full = full_model(space_frame(0));
  const reducer::Partition p = reducer::partition(full.mesh, full.system);
  const Superelement e = reduce(space_frame(0)).superelement;
  // Boundary node A held, unit loads on B and C.
  std::vector<int> free;
  const std::vector<int> held(p.boundary.begin(), p.boundary.begin() + 6);
  for (int i = 0; i < full.system.size(); ++i)
    if (std::find(held.begin(), held.end(), i) == held.end()) free.push_back(i);
  const MatrixXd flexibility = MatrixXd(full.S(free, free)).ldlt().solve(MatrixXd::Identity(free.size(), free.size()));
  std::vector<int> loaded;
  for (std::size_t b = 6; b < 18; ++b)
    loaded.push_back(static_cast<int>(std::find(free.begin(), free.end(), p.boundary[b]) - free.begin()));
  const MatrixXd reduced = MatrixXd(e.stiffness.block(6, 6, 12, 12)).inverse();
  EXPECT_LT(relative_difference(reduced, flexibility(loaded, loaded)), 1e-9);
}

TEST(Reduction, FormIsCanonicalExactly) {
  const Superelement e = reduce(space_frame(9)).superelement;
  ASSERT_EQ(e.size(), 27);
  EXPECT_EQ(e.stiffness.topRightCorner(18, 9).cwiseAbs().maxCoeff(), 0.0);
  EXPECT_EQ(e.mass.bottomRightCorner(9, 9), MatrixXd::Identity(9, 9));
  EXPECT_EQ(e.stiffness, e.stiffness.transpose());
  EXPECT_EQ(e.mass, e.mass.transpose());
  const MatrixXd S_II = e.stiffness.bottomRightCorner(9, 9);
  EXPECT_EQ(S_II, MatrixXd(S_II.diagonal().asDiagonal()));
  for (int k = 1; k < 9; ++k) EXPECT_LE(S_II(k - 1, k - 1), S_II(k, k));
  EXPECT_EQ(e.node_name, (std::vector<std::string>{"A", "B", "C"}));
  EXPECT_EQ(e.method, "craig_bampton");
  EXPECT_EQ(reduce(space_frame(0)).superelement.method, "guyan");
}

TEST(Reduction, InternalModesAreThoseOfTheHeldPart) {
  const FullModel full = full_model(space_frame(0));
  const VectorXd omega = angular_frequencies(full.S, full.M, reducer::partition(full.mesh, full.system).internal);
  const reducer::Reduction r = reduce(space_frame(12));
  for (int k = 0; k < 12; ++k) {
    EXPECT_NEAR(std::sqrt(r.superelement.stiffness(18 + k, 18 + k)) / omega[k], 1.0, 1e-9);
    EXPECT_NEAR(r.file.fixed_frequency[static_cast<std::size_t>(k)] * 2.0 * EIGEN_PI / omega[k], 1.0, 1e-9);
  }
  ASSERT_TRUE(r.model.first_dropped_frequency);
  EXPECT_NEAR(*r.model.first_dropped_frequency * 2.0 * EIGEN_PI / omega[12], 1.0, 1e-9);
  EXPECT_EQ(r.model.modes_counted, 12);
}

/// benchmarks of component modes: Ritz values are above the full ones, fall with every mode, obey the bound of Elssel
/// and Voss (2006) (λ_CB − λ)/λ ≤ λ/(λ_c − λ), λ_c the first dropped, and meet the full ones with all modes.
TEST(Reduction, FreeFrequenciesComeFromAboveAndMeetTheFullModel) {
  const FullModel full = full_model(space_frame(0));
  const int all = static_cast<int>(reducer::partition(full.mesh, full.system).n_I());
  const VectorXd exact = eigenvalues(full.S, full.M, shift);
  VectorXd last = VectorXd::Constant(18, INFINITY);
  for (const int modes : {0, 1, 4, 10, 20, 40, all}) {
    const reducer::Reduction r = reduce(space_frame(modes));
    const VectorXd lambda = eigenvalues(r.superelement.stiffness, r.superelement.mass, shift);
    const double dropped = std::pow(2.0 * EIGEN_PI * r.model.first_dropped_frequency.value_or(1e30), 2);
    for (int k = 6; k < 18; ++k) {
      EXPECT_GE(lambda[k], exact[k] * (1.0 - 1e-10)) << modes << " modes, frequency " << k;
      EXPECT_LE(lambda[k], last[k] * (1.0 + 1e-10)) << modes << " modes, frequency " << k;
      if (exact[k] < dropped) {
        EXPECT_LE(lambda[k] / exact[k] - 1.0, exact[k] / (dropped - exact[k]) + 1e-9)
            << modes << " modes, frequency " << k;
      }
    }
    last = lambda.head(18);
    if (modes == all) {
      EXPECT_LT((lambda.segment(6, 12).cwiseQuotient(exact.segment(6, 12)).array() - 1.0).abs().maxCoeff(), 1e-9);
    }
  }
}

/// With all modes kept, Σ_k M̄_Bkᵀ M̄_kB is the mass that the modes carry: Xᵀ M_II⁻¹ X with X = M_IB + M_II Ψ.
TEST(Reduction, EffectiveMassesOfAllModesAddUp) {
  const FullModel full = full_model(space_frame(0));
  const reducer::Partition p = reducer::partition(full.mesh, full.system);
  const MatrixXd S_II = full.S(p.internal, p.internal), M_II = full.M(p.internal, p.internal);
  const MatrixXd S_IB = full.S(p.internal, p.boundary), M_IB = full.M(p.internal, p.boundary);
  const MatrixXd X = M_IB - M_II * S_II.ldlt().solve(S_IB);
  const MatrixXd expected = X.transpose() * M_II.ldlt().solve(X);
  const int all = static_cast<int>(p.n_I());
  const MatrixXd M_IB_reduced = reduce(space_frame(all)).superelement.mass.bottomLeftCorner(all, 18);
  EXPECT_LT(relative_difference(M_IB_reduced.transpose() * M_IB_reduced, expected), 1e-8);
}

TEST(Reduction, DoesNotDependOnTheNumberingOfNodes) {
  const formats::Part part = space_frame(10);
  formats::Part permuted = part;
  std::reverse(permuted.points.begin(), permuted.points.end());
  std::rotate(permuted.beams.begin(), permuted.beams.begin() + 2, permuted.beams.end());
  const Superelement a = reduce(part).superelement, b = reduce(permuted).superelement;
  // Round-off of the condensation, amplified by cond(S_II) of about 1e6.
  EXPECT_LT(relative_difference(b.stiffness, a.stiffness), 1e-9);
  EXPECT_LT(relative_difference(b.mass, a.mass), 1e-9) << "signs and order of the modes included";
}

TEST(Reduction, BoundaryNodesMayRetainTranslationsOnly) {
  formats::Part part = space_frame(0);
  for (formats::BoundaryNode& b : part.boundary) b.rotations = false;
  const Superelement e = reduce(part).superelement;
  ASSERT_EQ(e.size(), 9);
  const Superelement all = reduce(space_frame(0)).superelement;
  std::vector<int> kept, gone;
  for (int i = 0; i < 18; ++i) (i % 6 < 3 ? kept : gone).push_back(i);
  const MatrixXd S = all.stiffness;
  const MatrixXd expected =
      S(kept, kept) - S(kept, gone) * MatrixXd(S(gone, gone)).ldlt().solve(MatrixXd(S(gone, kept)));
  EXPECT_LT(relative_difference(e.stiffness, expected), 1e-9);
}

TEST(Reduction, OneBoundaryNodeIsEnough) {
  formats::Part part = space_frame(5);
  part.boundary.resize(1);
  const Superelement e = reduce(part).superelement;
  ASSERT_EQ(e.size(), 11);
  EXPECT_LT(e.stiffness.topLeftCorner(6, 6).cwiseAbs().maxCoeff(), 1e-9 * e.stiffness(6, 6) * e.mass(0, 0));
}

TEST(Reduction, OneElementHasNoInternalCoordinates) {
  const Superelement e = reduce(cardona_beam(1, 0)).superelement;
  const FullModel full = full_model(cardona_beam(1, 0));
  EXPECT_LT(relative_difference(e.stiffness, full.S), 1e-14);
  EXPECT_LT(relative_difference(e.mass, full.M), 1e-14);
  try {
    reduce(cardona_beam(1, 2));
    FAIL() << "two modes of nothing";
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("2 internal modes asked for, but only 0 exist"));
  }
}

TEST(Reduction, PartOfTheExampleIsConverged) {
  // The eight kept modes on 48 elements against 192: closer than 1e-4, as the example's part promises.
  const VectorXd coarse = reduce(cardona_beam(48, 8)).superelement.stiffness.diagonal().tail(8).cwiseSqrt();
  const VectorXd fine = reduce(cardona_beam(192, 8)).superelement.stiffness.diagonal().tail(8).cwiseSqrt();
  for (int k = 0; k < 8; ++k) EXPECT_NEAR(coarse[k] / fine[k], 1.0, 1e-4) << "mode " << k;
}

}  // namespace
}  // namespace tisserand::testing
