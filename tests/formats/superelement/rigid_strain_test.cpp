// SPDX-License-Identifier: GPL-3.0-or-later
// What rigid motions may strain: slender parts with wrong positions, signs and units are refused, sound ones are read.
#include "formats/superelement/rigid_strain.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "formats/superelement/scaling.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::rigid_strain_test {
namespace {

using test_support::beam_superelement;
using test_support::BeamData;
using test_support::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Square bar of 1 m: the stiffness of bending is (t/L)² of the axial one.
Superelement bar(double thickness) {
  BeamData beam;
  beam.length = 1.0;
  beam.area = thickness * thickness;
  beam.Iy = beam.Iz = std::pow(thickness, 4) / 12;
  beam.J = 0.1406 * std::pow(thickness, 4);
  return beam_superelement(beam);
}

const Eigen::Matrix3d askew = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 0.5).normalized()).toRotationMatrix();

/// The part turned in its frame: every entry mixes axial stiffness and that of bending.
Superelement turned(Superelement e, const Eigen::Matrix3d& R) {
  Eigen::MatrixXd T = Eigen::MatrixXd::Identity(e.size(), e.size());
  for (Eigen::Index k = 0; k < e.size(); k += 3) T.block<3, 3>(k, k) = R;
  for (Eigen::MatrixXd* A : {&e.stiffness, &e.mass}) {
    *A = (T * *A * T.transpose()).eval();
    *A = (0.5 * (*A + A->transpose())).eval();
  }
  e.node_position = (e.node_position * R.transpose()).eval();
  return e;
}

/// Rotations in other units or of other sign: y = factor y'.
Superelement with_rotations_times(Superelement e, double factor) {
  for (Eigen::Index i = 0; i < e.size(); ++i) {
    if (e.dof_component[i] < 3) continue;
    e.stiffness.row(i) *= factor;
    e.stiffness.col(i) *= factor;
    e.mass.row(i) *= factor;
    e.mass.col(i) *= factor;
  }
  return e;
}

double rounded_to(double value, int digits) { return std::stod(fmt::format("{:.{}e}", value, digits - 1)); }

Superelement with_digits(Superelement e, int digits) {
  for (Eigen::Index i = 0; i < e.stiffness.size(); ++i) {
    e.stiffness.data()[i] = rounded_to(e.stiffness.data()[i], digits);
    e.mass.data()[i] = rounded_to(e.mass.data()[i], digits);
  }
  return e;
}

std::string error_of(const Superelement& element) {
  return test_support::error_of([&] { static_cast<void>(check(element, "bar.superelement.h5")); });
}

LoadedSuperelement written_and_read(Superelement element) {
  const TemporaryFolder folder;
  write_superelement(folder.file("bar.superelement.h5"), element);
  return read_superelement(folder.file("bar.superelement.h5"));
}

/// Seventh eigenvalue of (S, M): the first of bending.
double softest_eigenvalue(const Superelement& e) {
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd>(e.stiffness, e.mass).eigenvalues()[6];
}

RigidStrain strain_of(const Superelement& e) {
  const ScaledMatrices s = scale(e);
  const Eigen::MatrixXd S = s.stiffness_row.asDiagonal() * e.stiffness * s.stiffness_row.asDiagonal();
  return rigid_strain(S / s.stiffness_scale, scaled_rigid_motions(e, s.stiffness_row, s.length), {});
}

TEST(RigidStrain, ANodeInTheWrongPlaceIsRefusedHoweverSlenderThePart) {
  for (const double thickness : {1e-1, 1e-2, 1e-3, 1e-4})
    for (const double offset : {0.05, 0.2, 0.5})
      for (const Eigen::Matrix3d& frame : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), askew})
        for (const Eigen::Vector3d& direction : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, 1, 0)}) {
          Superelement e = turned(bar(thickness), frame);
          e.node_position.row(1) += offset * (frame * direction).transpose();
          EXPECT_THAT(error_of(e),
                      AllOf(HasSubstr("bar.superelement.h5: /stiffness: the part resists rigid-body motion: "),
                            HasSubstr("turning about"), HasSubstr("check the positions of the nodes")))
              << thickness << " " << offset;
        }
}

TEST(RigidStrain, WrongSignsAndUnitsAreRefused) {
  for (const double thickness : {1e-1, 1e-3, 1e-4})
    for (const Eigen::Matrix3d& frame : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), askew}) {
      const Superelement sound = turned(bar(thickness), frame);
      EXPECT_THAT(error_of(with_rotations_times(sound, -1.0)), HasSubstr("resists rigid-body motion"));
      EXPECT_THAT(error_of(with_rotations_times(sound, std::numbers::pi / 180)),
                  HasSubstr("resists rigid-body motion"));
      for (const double unit : {1e-3, 1e3}) {
        Superelement e = sound;
        e.node_position *= unit;
        EXPECT_THAT(error_of(e), HasSubstr("resists rigid-body motion")) << thickness << " " << unit;
      }
    }
}

/// A bar whose turn about z strains it as the error δ of its length: the change is of the order of δ, and no softest
/// frequency need tell (by symmetry those of this bar do not change at all).
TEST(RigidStrain, TheChangeIsOfTheOrderOfTheErrorOfThePosition) {
  for (const double thickness : {1e-1, 1e-3, 1e-5})
    for (const double offset : {1e-6, 1e-3, 0.05, 0.5}) {
      Superelement e = bar(thickness);
      e.node_position(1, 0) += offset;
      const double change = strain_of(e).change;
      EXPECT_GT(change, offset);
      EXPECT_LT(change, 2 * offset);
    }
  Superelement e = bar(1e-3);
  e.node_position(1, 0) += 5e-7;
  EXPECT_EQ(error_of(e), "no error");
  e.node_position(1, 0) += 0.5;
  const double before = softest_eigenvalue(e);
  filter_rigid_motions(e);
  EXPECT_NEAR(softest_eigenvalue(e) / before, 1.0, 1e-9);
}

/// Rounding of entries to d digits is 10^(1-d)/2 of the axial stiffness in every entry of a bar askew, so 1e6 times as
/// much of that of bending: told, removed, and harmless for the first frequency, which keeps its value to that bound.
TEST(RigidStrain, SoundSlenderFilesOfFewDigitsAreReadWithANote) {
  const Superelement sound = turned(bar(1e-3), askew);
  for (const int digits : {9, 10, 11}) {
    const LoadedSuperelement loaded = written_and_read(with_digits(sound, digits));
    EXPECT_TRUE(loaded.report.filtered);
    ASSERT_EQ(loaded.report.warnings.size(), 1u);
    EXPECT_THAT(loaded.report.warnings[0], AllOf(HasSubstr("removed from /stiffness by projection"),
                                                 HasSubstr(fmt::format("({} digits)", digits))));
    EXPECT_LT(loaded.report.rigid_change, 2e6 * std::pow(10.0, -digits));
    EXPECT_NEAR(softest_eigenvalue(loaded.superelement) / softest_eigenvalue(sound), 1.0,
                1e6 * std::pow(10.0, 1 - digits));
  }
  Superelement single = sound;
  for (Eigen::Index i = 0; i < single.stiffness.size(); ++i)
    single.stiffness.data()[i] = static_cast<double>(static_cast<float>(single.stiffness.data()[i]));
  const LoadedSuperelement loaded = written_and_read(single);
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_THAT(loaded.report.warnings[0], HasSubstr("(single precision)"));
}

TEST(RigidStrain, EntriesThatAreGoodTo1e9AreReadWithANote) {
  for (const Eigen::Matrix3d& frame : {Eigen::Matrix3d(Eigen::Matrix3d::Identity()), askew}) {
    Superelement e = turned(bar(1e-3), frame);
    for (Eigen::Index i = 0; i < 12; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) {
        e.stiffness(i, j) *= 1.0 + 1e-9 * std::sin(static_cast<double>(37 * i + 11 * j + 1));
        e.stiffness(j, i) = e.stiffness(i, j);
      }
    const LoadedSuperelement loaded = written_and_read(e);
    EXPECT_TRUE(loaded.report.filtered);
    ASSERT_EQ(loaded.report.warnings.size(), 1u);
    EXPECT_THAT(loaded.report.warnings[0], HasSubstr("removed from /stiffness by projection"));
  }
}

TEST(RigidStrain, EntriesThatDoNotHoldTheSoftestDeformationAreRefused) {
  const Superelement sound = turned(bar(1e-3), askew);
  EXPECT_THAT(
      error_of(with_digits(sound, 6)),
      AllOf(
          HasSubstr(
              "Rounding of the entries (6 digits) may be the cause, but then the entries are too inaccurate for that"),
          HasSubstr("write the matrix with more digits")));
  // The stocky bar holds its bending in six digits.
  EXPECT_EQ(error_of(with_digits(turned(bar(1e-1), askew), 6)), "no error");
  // Five digits are worse, not better; nor do digits excuse a node that is 5 % off.
  EXPECT_THAT(error_of(with_digits(sound, 5)), HasSubstr("the entries are too inaccurate for that deformation"));
  Superelement wrong = turned(bar(1e-2), askew);
  wrong.node_position.row(1) *= 1.05;
  EXPECT_THAT(error_of(with_digits(wrong, 7)), HasSubstr("resists rigid-body motion"));
}

TEST(RigidStrain, DirectionsWithoutMassOrStiffnessAreNoSoftestDeformation) {
  Superelement massless = bar(1e-3);
  for (const int row : {4, 5, 10, 11}) {
    massless.mass.row(row).setZero();
    massless.mass.col(row).setZero();
  }
  EXPECT_EQ(error_of(massless), "no error");
  massless.node_position(1, 0) *= 1.05;
  EXPECT_THAT(error_of(massless), HasSubstr("resists rigid-body motion"));

  // A third node that turns freely: three directions of S without stiffness beyond the rigid motions.
  Superelement hinged = turned(bar(1e-3), askew);
  hinged.node_name.push_back("gyro");
  hinged.node_position.conservativeResize(3, 3);
  hinged.node_position.row(2).setZero();
  for (Eigen::MatrixXd* A : {&hinged.stiffness, &hinged.mass}) {
    A->conservativeResizeLike(Eigen::MatrixXd::Zero(15, 15));
    A->bottomRightCorner<3, 3>().setIdentity();
  }
  hinged.stiffness.bottomRightCorner<3, 3>().setZero();
  for (int k = 3; k < 6; ++k) {
    hinged.dof_node.push_back(2);
    hinged.dof_component.push_back(k);
  }
  EXPECT_THAT(written_and_read(hinged).report.warnings, IsEmpty());
  EXPECT_EQ(written_and_read(with_digits(hinged, 10)).report.warnings.size(), 1u);
  hinged.node_position.row(1) *= 1.05;
  EXPECT_THAT(error_of(hinged), HasSubstr("resists rigid-body motion"));
}

/// Above 400 coordinates the softest deformations come from inverse iteration: internal coordinates of their own
/// stiffness, which take no part in rigid motions, change nothing of what 12 coordinates give.
TEST(RigidStrain, LargeMatricesGiveWhatSmallOnesDo) {
  Superelement e = turned(bar(1e-3), askew);
  e.node_position.row(1) *= 1.05;
  const ScaledMatrices s = scale(e);
  const Eigen::MatrixXd S =
      s.stiffness_row.asDiagonal() * e.stiffness * s.stiffness_row.asDiagonal() / s.stiffness_scale;
  const Eigen::MatrixXd R = scaled_rigid_motions(e, s.stiffness_row, s.length);
  Eigen::MatrixXd large_S = Eigen::MatrixXd::Identity(500, 500), large_R = Eigen::MatrixXd::Zero(500, 6);
  large_S.topLeftCorner(12, 12) = S;
  large_R.topRows(12) = R;
  const RigidStrain small = rigid_strain(S, R, {}), large = rigid_strain(large_S, large_R, {});
  EXPECT_NEAR(large.change / small.change, 1.0, 1e-6);
  EXPECT_EQ(large.motion, small.motion);
  EXPECT_EQ(large.row, small.row);
  EXPECT_EQ(large.cause, RigidStrainCause::unexplained);
}

TEST(RigidStrain, DigitsOfEntries) {
  const auto matrix = [](int digits) {
    return Eigen::MatrixXd::NullaryExpr(9, 9, [digits](Eigen::Index i, Eigen::Index j) {
      return rounded_to(1e5 * std::sin(1.0 + 3.7 * static_cast<double>(9 * i + j)), digits);
    });
  };
  EXPECT_EQ(entry_errors(matrix(17)).reason, "");
  EXPECT_EQ(entry_errors(matrix(4)).reason, "") << "chosen numbers";
  for (const int digits : {5, 8, 10, 13}) {
    const Eigen::MatrixXd A = matrix(digits);
    const EntryErrors errors = entry_errors(A);
    EXPECT_EQ(errors.reason, fmt::format("{} digits", digits));
    EXPECT_NEAR(errors.bound(2, 3) / std::abs(A(2, 3)), 0.5 * std::pow(10.0, 1 - digits), 1e-20);
  }
  Eigen::MatrixXd single = matrix(17).cast<float>().cast<double>();
  EXPECT_EQ(entry_errors(single).reason, "single precision");
  for (Eigen::Index i = 0; i < single.size(); ++i) single.data()[i] = rounded_to(single.data()[i], 9);
  EXPECT_EQ(entry_errors(single).reason, "single precision") << "as text of nine digits";
}

}  // namespace
}  // namespace tisserand::formats::rigid_strain_test
