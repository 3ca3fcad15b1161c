// SPDX-License-Identifier: GPL-3.0-or-later
// The first line of a certificate: good enough or not, up to which frequency, and why.
#include "reducer/report/verdict.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "common/units.hpp"

namespace tisserand::reducer::verdict_test {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

FileCertificate file_of(std::vector<double> free) {
  FileCertificate file;
  file.free_frequency = std::move(free);
  return file;
}

/// Errors by the mesh and by dropped modes of the frequencies 10, 20, 40 and 80.
ModelCertificate model_of(std::vector<double> mesh, std::vector<double> dropped) {
  ModelCertificate model;
  model.modes_kept = 4;
  model.modes_available = 100;
  model.mesh_error.error = std::move(mesh);
  model.mesh_error.frequency = {10, 20, 40, 80};
  model.truncation_estimate = std::move(dropped);
  model.truncation_lower = {9, 18, 36, 72};
  return model;
}

const FileCertificate file = file_of({10, 20, 40, 80});

std::string reported(const ModelCertificate& model) { return verdict(file, model, Units::si()); }

TEST(Verdict, IsGoodUpToTheFirstErrorBeyondTheLimit) {
  EXPECT_EQ(
      reported(model_of({0.001, -0.002, 0.01, 0.04}, {0.0, 0.001, 0.01, 0.02})),
      "good enough for vibrations up to 40 Hz: frequencies of the free part have errors of at most about 2 % (mesh 1 "
      "%, dropped modes 1 %); above, the frequency 80 Hz has an error of about 6 % (mesh 4 %, dropped modes 2 %)");
  EXPECT_EQ(reported(model_of({0.001, 0.001}, {0.0, 0.0})),
            "good enough for vibrations up to 20 Hz: frequencies of the free part have errors of at most about 0.1 % "
            "(mesh 0.1 %, dropped modes 0 %)");
  EXPECT_THAT(reported(model_of({0.2, 0.001}, {0.0, 0.0})),
              StartsWith("not good enough: the frequency 10 Hz has an error of about 20 %"));
}

TEST(Verdict, DoesNotTakeTheUnknownForGood) {
  EXPECT_EQ(reported(model_of({unknown, 0.001}, {0.0, 0.0})),
            "not known: the error of the mesh is unknown for the frequency 10 Hz");
  EXPECT_THAT(
      reported(model_of({0.01, unknown}, {0.0, 0.0})),
      AllOf(StartsWith("good enough for vibrations up to 10 Hz"), EndsWith("is unknown for the frequency 20 Hz")));
  // No estimate: the bound of the frequency of the full part, 9 of 10, leaves 11 %.
  EXPECT_THAT(reported(model_of({0.0}, {unknown})),
              StartsWith("not good enough: the frequency 10 Hz has an error of about 11 %"));
  EXPECT_THAT(reported(model_of({0.0}, {})),
              HasSubstr("the error by dropped modes is unknown for the frequency 10 Hz"));
  EXPECT_THAT(reported(model_of({}, {})), StartsWith("not known: no frequency was compared"));
  EXPECT_THAT(verdict(file, std::nullopt, Units::si()), StartsWith("not known: no data of the full part are stored"));
  FileCertificate loose;
  loose.free_frequency_note = "a piece of the part is loose";
  EXPECT_EQ(verdict(loose, model_of({0.0}, {0.0}), Units::si()),
            "not known for vibrations: a piece of the part is loose");
}

TEST(Verdict, TakesTheFullModelWhereItWasSolved) {
  ModelCertificate model = model_of({0.0, 0.0}, {0.0, 0.0});
  model.free_frequency = {10, 18};
  EXPECT_THAT(reported(model), AllOf(StartsWith("good enough for vibrations up to 10 Hz"),
                                     HasSubstr("the frequency 20 Hz has an error of about 11 %")));
  ModelCertificate all = model_of({0.0, 0.0}, {});
  all.modes_kept = all.modes_available;  // nothing is dropped
  EXPECT_THAT(reported(all), StartsWith("good enough for vibrations up to 20 Hz"));
}

TEST(Verdict, IsOfWhatThePartAsksFor) {
  ModelCertificate model = model_of({0.001, 0.002, 0.02}, {0.0, 0.0, 0.0});
  model.accuracy = formats::Accuracy{0.01, 30.0};
  EXPECT_EQ(reported(model),
            "good enough: frequencies have errors of at most about 0.2 % (mesh 0.2 %, dropped modes 0 %); requested: 1 "
            "% up to 30 Hz");
  model.accuracy->up_to = 40.0;
  EXPECT_THAT(reported(model), StartsWith("not good enough: the frequency 40 Hz has an error of about 2 %"));
  model.accuracy->up_to = 5.0;
  EXPECT_THAT(reported(model), StartsWith("good enough: no frequency of the free part lies below 5 Hz"));
  model.accuracy = formats::Accuracy{0.05, 100.0};
  EXPECT_THAT(reported(model),
              StartsWith("good enough up to 40 Hz, the highest frequency with an estimated error of the mesh"));
  model.warnings = {"a", "b"};
  EXPECT_THAT(reported(model), EndsWith("; 2 warnings below"));
}

TEST(Verdict, IsOfTheHeldPartWhereItsMeshWasJudgedSo) {
  ModelCertificate model = model_of({0.01, 0.2, 0.0, 0.0}, {});
  model.mesh_error.boundary_held = true;
  EXPECT_THAT(
      reported(model),
      StartsWith(
          "good enough for vibrations up to 10 Hz: frequencies of the held part have errors of at most about 1 %"));
}

TEST(Verdict, NamesTheUnitOfFrequencies) {
  EXPECT_EQ(frequency_unit(Units::si()), "Hz");
  EXPECT_EQ(frequency_unit(Units::consistent()), "1/time");
  EXPECT_EQ(frequency_unit({length_unit("mm"), mass_unit("t"), time_unit("ms")}), "1/ms");
}

}  // namespace
}  // namespace tisserand::reducer::verdict_test
