// SPDX-License-Identifier: GPL-3.0-or-later
// Laws of the reduction: rigid motions, statics, numbering, bounds on frequencies, canonical form.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "common/child.hpp"
#include "common/error.hpp"
#include "reducer/report/certificate_page.hpp"
#include "reducer/solve/solve.hpp"
#include "reducer/system/partition.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/reducer/reduction_laws.hpp"

namespace tisserand::testing::reduction_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using formats::Superelement;
using ::testing::HasSubstr;

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

TEST(Reduction, BoundaryRespondsAndWeighsAsInTheFullModel) {
  const BoundaryLaws laws = boundary_laws();
  EXPECT_LT(laws.rigid_mass, 1e-12);
  EXPECT_LT(laws.rigid_stiffness, 1e-12);
  EXPECT_LT(laws.flexibility, 1e-9);
  EXPECT_LT(laws.effective_mass, 1e-8);
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
    EXPECT_NEAR(r.file.fixed_frequency[k] * 2.0 * std::numbers::pi / omega[k], 1.0, 1e-9);
  }
  ASSERT_TRUE(r.model.first_dropped_frequency);
  EXPECT_NEAR(*r.model.first_dropped_frequency * 2.0 * std::numbers::pi / omega[12], 1.0, 1e-9);
  EXPECT_EQ(r.model.modes_counted, 12);
}

/// benchmarks of component modes: Ritz values are above the full ones, fall with every mode, obey the bound of Elssel
/// and Voss (2006) (λ_CB − λ)/λ ≤ λ/(λ_c − λ), λ_c the first dropped, and meet the full ones with all modes.
TEST(Reduction, FreeFrequenciesComeFromAboveAndMeetTheFullModel) {
  const RitzLaws laws = ritz_laws();
  EXPECT_LT(laws.below_full, 1e-10);
  EXPECT_LT(laws.growth, 1e-10);
  EXPECT_LT(laws.all_modes, 1e-9);
  EXPECT_LT(laws.share_of_bound, 1.0);
  EXPECT_GT(laws.share_of_bound, 1e-3) << "the bound is tried";
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

/// A hinge between the two boundary nodes: nothing inside is loose, but the whole folds freely.
TEST(Reduction, CertificateReportsASeventhFreeMotion) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(2.0, 0.0, 0.0), 2, 0);
  part.points.push_back({"middle", Vector3d(1.0, 0.0, 0.0), ""});
  formats::BeamLine second = part.beams[0];
  part.beams[0].to = "middle";
  second.name = "second";
  second.from = "middle";
  second.releases.start = 0b010000;  // the moment about y
  part.beams.push_back(second);
  const reducer::Reduction r = reduce(part);
  EXPECT_THAT(r.file.free_frequency_note,
              HasSubstr("7 motions have no stiffness, but a rigid body has only six such motions"));
  EXPECT_TRUE(r.file.free_frequency.empty());
}

/// A straight beam whose nodes have lost their inertia about its axis turns about it without moving mass; its other
/// motions and those of the sound beam are told.
TEST(Reduction, CertificateReportsARigidMotionWithoutMass) {
  const reducer::Reduction r = reduce(plain_beam(Vector3d::Zero(), Vector3d(2.0, 0.0, 0.0), 4, 0));
  EXPECT_EQ(r.file.free_frequency_note, "");
  EXPECT_EQ(r.file.free_frequency.size(), 6u);
  Superelement twisting = r.superelement;
  for (Eigen::Index row = 0; row < twisting.size(); ++row) {
    if (twisting.dof_component[static_cast<std::size_t>(row)] != 3) continue;
    twisting.mass.row(row).setZero();
    twisting.mass.col(row).setZero();
  }
  const reducer::FileCertificate c = reducer::certify(twisting, formats::check(twisting, "twisting"));
  EXPECT_EQ(c.free_frequency_note, "the mass or inertia of a rigid motion is zero");
  EXPECT_TRUE(c.free_frequency.empty());
}

/// Phases that take long with large parts say how much of them is done, up to all of it.
TEST(Reduction, LongPhasesReportHowMuchOfThemIsDone) {
  std::map<std::string, std::vector<double>> heard;
  std::string phase;
  reducer::PhaseListener listener([&](const std::string& name) { phase = name; });
  listener.share = [&](double done) { heard[phase].push_back(done); };
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(2.0, 0.0, 0.0), 2000, 6);
  part.recovery = true;
  start_solvers();
  reducer::reduce(part, listener, [&](const reducer::RecoverySource& source) {
    const auto unheard = [](auto, const MatrixXd&) {};
    reducer::recovery_fields(source, reducer::recovery_tables(source), listener.share,
                             {unheard, unheard, unheard, unheard});
  });
  reducer::solve(part, {3, {}}, listener);
  for (const char* name : {"assembly", "boundary modes", "recovery", "second order", "modes", "stresses"}) {
    const std::vector<double>& shares = heard[name];
    ASSERT_FALSE(shares.empty()) << name;
    EXPECT_TRUE(std::ranges::all_of(shares, [](double done) { return done >= 0.0 && done <= 1.0; })) << name;
    EXPECT_GT(shares.back(), 0.8) << name;
  }
}

TEST(Reduction, MomentVectorsAreMarkedAsNoModes) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(1.7, 0.0, 0.0), 16, 4);
  const auto text_of = [&] {
    const reducer::Reduction r = reduce(part);
    EXPECT_EQ(r.model.moment_vectors, part.modes.moments.value_or(0));
    return reducer::certificate_text(r.superelement, r.file, r.model);
  };
  EXPECT_THAT(text_of(), ::testing::Not(HasSubstr("not a mode of the part")));
  part.modes.moments = 3;
  const std::string text = text_of();
  EXPECT_THAT(text, ::testing::AllOf(HasSubstr("moment vectors     3\n"),
                                     HasSubstr("   * value of a moment vector, which is not a mode of the part\n")));
  EXPECT_EQ(std::count(text.begin(), text.end(), '*'), 3 + 1);
}

/// A bar held at both ends moves along itself in sin(nπx/L): effective mass 8/(nπ)² of the whole for odd n, 0 for even
/// (the integral of the mode). Linear elements lose (π/64)²/12 = 2e-4 of it.
TEST(Reduction, EffectiveMassOfABar) {
  const reducer::Reduction r = reduce(plain_beam(Vector3d::Zero(), Vector3d(1.7, 0.0, 0.0), 64, 60));
  const double whole = r.file.effective_mass_whole[0];
  EXPECT_NEAR(whole, r.file.rigid.mass, 1e-9 * whole);
  ASSERT_EQ(static_cast<int>(r.file.participation.size()), r.model.modes_kept);
  double most = 0.0;
  std::array<double, 6> sum{};
  for (const auto& row : r.file.participation) {
    most = std::max(most, row[0] * row[0] / whole);
    for (std::size_t k = 0; k < 6; ++k) sum[k] += row[k] * row[k];
  }
  EXPECT_NEAR(most, 8.0 / (std::numbers::pi * std::numbers::pi), 1e-3);
  for (std::size_t k = 0; k < 6; ++k)
    EXPECT_NEAR(sum[k] + r.file.effective_mass_left[k], r.file.effective_mass_whole[k],
                1e-9 * r.file.effective_mass_whole[k]);
}

/// With all modes the reduced part is the full one; with few, the lowest modes agree still and others do not.
TEST(Reduction, ModesAgreeWithThoseOfTheFullModel) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(1.7, 0.0, 0.0), 8, 42);
  const reducer::Reduction all = reduce(part);
  ASSERT_EQ(all.model.assurance.size(), 12u);
  for (std::size_t k = 0; k < 12; ++k) EXPECT_NEAR(all.model.assurance[k][k], 1.0, 1e-6) << k;
  part.modes.count = 4;
  const reducer::Reduction few = reduce(part);
  EXPECT_NEAR(few.model.assurance[0][0], 1.0, 1e-2);
  const std::vector<double>& highest = few.model.assurance[11];  // with each mode that the reduced part has
  ASSERT_LT(highest.size(), 12u);
  EXPECT_LT(*std::ranges::max_element(highest), 0.99);
}

/// One file that needs nothing else; names from files are text.
TEST(Reduction, CertificateAsAPage) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d(1.7, 0.0, 0.0), 16, 12);
  part.name = "<b>&";
  const reducer::Reduction r = reduce(part);
  const std::string page = reducer::certificate_page(r.superelement, r.file, r.model);
  for (const char* heading :
       {"Frequencies", "Errors of the free frequencies", "Effective mass", "Modal assurance criterion (MAC)"})
    EXPECT_THAT(page, HasSubstr(std::string("<h2>") + heading));
  EXPECT_THAT(page, ::testing::AllOf(HasSubstr("<h1>&lt;b&gt;&amp;</h1>"), ::testing::EndsWith("</html>\n"),
                                     ::testing::Not(HasSubstr("<b>"))));
  EXPECT_THAT(page, HasSubstr("centre of mass (0.85, 0, 0)"));  // round-off across the beam is 0
  std::size_t pictures = 0;
  for (std::size_t at = page.find("<svg"); at != std::string::npos; at = page.find("<svg", at + 1)) ++pictures;
  EXPECT_EQ(pictures, is_program("gnuplot") ? 9u : 0u);  // frequencies, errors, six directions, assurance
}

}  // namespace
}  // namespace tisserand::testing::reduction_test
