// SPDX-License-Identifier: GPL-3.0-or-later
// `reducer import` and `reducer export` as users call them: files, certificate, messages, exit codes.
#include <sys/wait.h>

#include <cstdlib>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "reducer/exchange/request.hpp"
#include "tests/reducer/exchange/exchange_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::reducer::exchange::exchange_program_test {
namespace {

using test_support::text_of;

using ::testing::AllOf;
using testing::error_of;
using testing::Files;
using ::testing::HasSubstr;

struct Outcome {
  int code = -1;
  std::string text;
};

Outcome call(const Files& files, const std::string& arguments) {
  const std::string log = files.file("log");
  const int status = std::system((TISSERAND_BINARY_DIR "/bin/reducer " + arguments + " > " + log + " 2>&1").c_str());
  return {WEXITSTATUS(status), text_of(log)};
}

/// A beam in millimetres, tonnes and seconds on its way out and back in every format that can come back.
class Exchange : public ::testing::Test {
 protected:
  Files files;
  formats::Superelement beam = testing::reduced_beam();
  std::string path = files.file("beam.superelement.h5");

  void SetUp() override { formats::write_superelement(path, beam); }
  formats::Superelement read(const std::string& name) const {
    return formats::read_superelement(files.file(name)).superelement;
  }
  ImportRequest import_request(const std::string& input, const std::string& output) const {
    ImportRequest request;
    request.input = files.file(input);
    request.output = files.file(output);
    request.units = "m,kg,s";
    return request;
  }
};

TEST_F(Exchange, MatrixMarketAndFmxReturnTheSameContent) {
  export_matrices({path, "", "matrixmarket"});
  import_matrices(import_request("beam.S.mtx", "a.h5"));
  EXPECT_EQ(read("a.h5").content_id, beam.content_id);
  EXPECT_EQ(read("a.h5").name, "a");
  EXPECT_TRUE(read("a.h5").units.named());
  export_matrices({path, files.file("other_S.fmx"), "fmx"});
  import_matrices(import_request("other_S.fmx", "b.h5"));
  EXPECT_EQ(read("b.h5").content_id, beam.content_id);
  EXPECT_EQ(text_of(files.file("other_G.fmx")).size(), 46u + 16 * 3 * 8);
}

TEST_F(Exchange, DmigReturnsTheDigitsOfTheFormatAndNames) {
  export_matrices({path, "", "dmig"});
  ImportRequest request = import_request("beam.pch", "a.h5");
  request.names = "1=base,2=tip";
  import_matrices(request);
  const formats::Superelement back = read("a.h5");
  EXPECT_EQ(back.node_name, beam.node_name);
  EXPECT_LT(testing::distance(beam.stiffness, back.stiffness), 1e-9);
  EXPECT_LT(testing::distance(beam.mass, back.mass), 1e-9);
}

TEST_F(Exchange, CertificateSaysWhatWasFound) {
  export_matrices({path, "", "dmig"});
  import_matrices(import_request("beam.pch", "a.superelement.h5"));
  const nlohmann::json j = nlohmann::json::parse(text_of(files.file("a.superelement.certificate.json")));
  EXPECT_EQ(j.at("content_id"), read("a.superelement.h5").content_id);
  EXPECT_EQ(j.at("import").at("format"), "dmig");
  EXPECT_EQ(j.at("import").at("canonical"), true);
  EXPECT_LT(j.at("file").at("rigid_residual"), 1e-12);
  EXPECT_EQ(j.at("file").at("fixed_boundary_frequency").size(), 4u);
}

TEST_F(Exchange, WrongRequestsAreErrors) {
  const std::string known = files.write("x.dat", "DMIG,KAAX,0,6,2\n"), strange = files.write("y.txt", "hello\n");
  const auto error_with = [&](const std::function<void(ImportRequest&)>& change) {
    ImportRequest request = import_request("x.dat", "z.h5");
    change(request);
    return error_of([&] { import_matrices(request); });
  };
  EXPECT_THAT(error_with([](ImportRequest& r) { r.units = "mm,t"; }), HasSubstr("--units"));
  EXPECT_THAT(error_with([](ImportRequest& r) { r.units = "mm,t,fortnight"; }), HasSubstr("fortnight"));
  EXPECT_THAT(error_with([](ImportRequest& r) { r.from = "ansys"; }), HasSubstr("choose one of dmig"));
  EXPECT_THAT(error_with([](ImportRequest& r) { r.names = "1base"; }), HasSubstr("--names"));
  EXPECT_THAT(error_with([](ImportRequest& r) { r.modal = "5-1"; }), HasSubstr("--modal"));
  EXPECT_THAT(error_with([](ImportRequest& r) { r.matrices = "KAAX"; }), HasSubstr("--matrices"));
  EXPECT_THAT(error_with([](ImportRequest& r) { r.output = r.input; }), HasSubstr("replace its own input"));
  EXPECT_THAT(error_with([&](ImportRequest& r) { r.input = strange; }), HasSubstr("--from"));
  EXPECT_THAT(error_with([&](ImportRequest& r) { r.input = files.file("none"); }), HasSubstr("does not exist"));
  EXPECT_FALSE(std::filesystem::exists(files.file("z.h5")));
  EXPECT_THAT(error_of([&] { export_matrices({path, "", "ansys"}); }), HasSubstr("--to"));
  EXPECT_THAT(error_of([&] { export_matrices({path, path, "dmig"}); }), HasSubstr("replace its own input"));
}

TEST_F(Exchange, MissingCompanionsNameTheirOption) {
  export_matrices({path, files.file("c_S.fmx"), "fmx"});
  const auto error = [&] { return error_of([&] { import_matrices(import_request("c_S.fmx", "d.h5")); }); };
  std::filesystem::remove(files.file("c.rows.csv"));
  EXPECT_THAT(error(), AllOf(HasSubstr("the table of its rows is missing"), HasSubstr("c.rows.csv"),
                             HasSubstr("name the file with --rows FILE")));
  std::filesystem::remove(files.file("c_M.fmx"));
  EXPECT_THAT(error(), AllOf(HasSubstr("the mass matrix is missing"), HasSubstr("--mass FILE")));
}

TEST_F(Exchange, CommandLine) {
  const Outcome out = call(files, "export " + path + " --to mbdyn");
  EXPECT_EQ(out.code, 0) << out.text;
  EXPECT_THAT(out.text, AllOf(HasSubstr("beam.fem"), HasSubstr("mean axes")));
  EXPECT_EQ(call(files, "export " + path + " --to matrixmarket").code, 0);
  const Outcome back =
      call(files, "import " + files.file("beam.S.mtx") + " --units mm,t,s -o " + files.file("arm.superelement.h5"));
  EXPECT_EQ(back.code, 0) << back.text;
  EXPECT_THAT(back.text, AllOf(HasSubstr("imported (matrixmarket)"), HasSubstr("in canonical form"),
                               HasSubstr("arm.superelement.certificate.json")));
  EXPECT_EQ(read("arm.superelement.h5").units.mass.label, "t");
  EXPECT_EQ(read("arm.superelement.h5").name, "arm");
  EXPECT_EQ(call(files, "show " + files.file("arm.superelement.h5")).code, 0);
  EXPECT_EQ(call(files, "import " + files.file("beam.S.mtx")).code, 2);  // without units
  EXPECT_EQ(call(files, "export " + path + " --to ansys").code, 1);
}

}  // namespace
}  // namespace tisserand::reducer::exchange::exchange_program_test
