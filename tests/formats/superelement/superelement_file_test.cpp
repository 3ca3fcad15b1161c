// SPDX-License-Identifier: GPL-3.0-or-later
// Superelement files: bit-equal round trip, foreign and damaged files, units, versions, unknown items, unwritable
// places.
#include <hdf5.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::superelement_file_test {
namespace {

using test_support::craig_bampton_beam;
using test_support::TemporaryFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Gives the root of a file this attribute.
template <class Value>
auto with_attribute(const char* name, Value value) {
  return [name, value](hid_t file) { hdf5::write_attribute({file, ""}, "/", name, value); };
}

std::string error_of(const std::string& path) {
  try {
    static_cast<void>(read_superelement(path));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// Opens the file for changes behind the back of the library.
void change(const std::string& path, const std::function<void(hid_t)>& edit) {
  hdf5::silence();
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  ASSERT_GE(file, 0);
  edit(file);
  ASSERT_GE(H5Fclose(file), 0);
}

void replace_by_doubles(hid_t file, const char* dataset, const hdf5::Shape& shape, double value) {
  H5Ldelete(file, dataset, H5P_DEFAULT);
  std::uint64_t count = 1;
  for (const std::uint64_t extent : shape) count *= extent;
  const std::vector<double> values(count, value);
  hdf5::write_dataset({file, "test"}, dataset, shape, values.data());
}

/// A chunked dataset of any claimed shape without a single byte of data.
void replace_by_claim(hid_t file, const char* dataset, hid_t type, const std::vector<hsize_t>& shape) {
  H5Ldelete(file, dataset, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr);
  const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
  const std::vector<hsize_t> chunk(shape.size(), 7);
  H5Pset_chunk(creation, static_cast<int>(chunk.size()), chunk.data());
  const hid_t handle = H5Dcreate2(file, dataset, type, space, H5P_DEFAULT, creation, H5P_DEFAULT);
  EXPECT_GE(handle, 0);
  H5Dclose(handle);
  H5Pclose(creation);
  H5Sclose(space);
}

TEST(SuperelementFile, RoundTripIsBitEqual) {
  const TemporaryFolder folder;
  for (const int modes : {0, 5}) {
    Superelement e = craig_bampton_beam({}, modes);
    e.units = {{1e-3, "mm"}, {1e3, "t"}, {1.0, "s"}};
    e.method = "craig_bampton, \u00e9tude";
    e.mass(0, 6) = e.mass(6, 0) = std::nextafter(e.mass(0, 6), 0.0);
    write_superelement(folder.file("beam.superelement.h5"), e);
    const LoadedSuperelement loaded = read_superelement(folder.file("beam.superelement.h5"));
    const Superelement& r = loaded.superelement;
    EXPECT_EQ(r.name, e.name);
    EXPECT_EQ(r.method, e.method);
    EXPECT_EQ(r.producer, e.producer);
    EXPECT_EQ(r.units.length.factor, 1e-3);
    EXPECT_EQ(r.units.length.label, "mm");
    EXPECT_EQ(r.units.mass.label, "t");
    EXPECT_EQ(r.content_id, e.content_id);
    EXPECT_EQ(r.node_name, e.node_name);
    EXPECT_EQ(r.node_position, e.node_position);
    EXPECT_EQ(r.dof_node, e.dof_node);
    EXPECT_EQ(r.dof_component, e.dof_component);
    EXPECT_EQ(r.stiffness, e.stiffness);
    EXPECT_EQ(r.mass, e.mass);
    EXPECT_FALSE(loaded.report.filtered);
    EXPECT_THAT(loaded.report.warnings, IsEmpty());
  }
}

TEST(SuperelementFile, EqualContentsGiveEqualBytes) {
  const TemporaryFolder folder;
  const auto bytes = [&](const std::string& name) {
    Superelement e = craig_bampton_beam({}, 3);
    write_superelement(folder.file(name), e);
    std::ifstream in(folder.file(name), std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_EQ(bytes("a.h5"), bytes("b.h5"));
}

TEST(SuperelementFile, ResidualOfRigidMotionsIsFilteredAndSaid) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 2);
  e.stiffness(0, 0) *= 1 + 1.5e-9;
  write_superelement(folder.file("a.h5"), e);
  const LoadedSuperelement loaded = read_superelement(folder.file("a.h5"));
  EXPECT_TRUE(loaded.report.filtered);
  // The only change is 1.5e-9 of the largest entry of S, which rigid motion in x meets with factor 1.
  EXPECT_NEAR(loaded.report.rigid_residual, 1.5e-9, 1e-11);
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_THAT(loaded.report.warnings[0], HasSubstr("removed from /stiffness by projection"));
  EXPECT_LT(check(loaded.superelement, "x").rigid_residual, 1e-14);
  EXPECT_EQ(loaded.superelement.content_id, e.content_id);
}

TEST(SuperelementFile, UnknownItemsOfTheSameMajorVersionAreOneLine) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  Superelement e = craig_bampton_beam({}, 2);
  write_superelement(path, e);
  change(path, [](hid_t file) {
    hdf5::write_attribute({file, "test"}, "/", "version", "1.7");
    hdf5::write_attribute({file, "test"}, "/", "colour", "red");
    const double damping = 0.01;
    hdf5::write_dataset({file, "test"}, "/damping/ratio", {1}, &damping);
    hdf5::write_dataset({file, "test"}, "/dof/extra", {1}, &damping);
  });
  const LoadedSuperelement loaded = read_superelement(path);
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_THAT(loaded.report.warnings[0],
              AllOf(HasSubstr("/damping"), HasSubstr("/dof/extra"), HasSubstr("attribute 'colour'")));
}

TEST(SuperelementFile, OtherStorageOfTheSameValuesIsAccepted) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  Superelement e = craig_bampton_beam({}, 2);
  write_superelement(path, e);
  change(path, [&](hid_t file) {  // variable-length strings, 64-bit big-endian integers, compressed big-endian doubles
    const hid_t text = H5Tcopy(H5T_C_S1);
    H5Tset_size(text, H5T_VARIABLE);
    const hsize_t nodes = 2, n = 14;
    const hid_t node_space = H5Screate_simple(1, &nodes, nullptr), row_space = H5Screate_simple(1, &n, nullptr);
    H5Ldelete(file, "/boundary/name", H5P_DEFAULT);
    const hid_t names = H5Dcreate2(file, "/boundary/name", text, node_space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const char* values[] = {"base", "tip"};
    H5Dwrite(names, text, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
    H5Dclose(names);
    H5Ldelete(file, "/dof/node", H5P_DEFAULT);
    const hid_t node = H5Dcreate2(file, "/dof/node", H5T_STD_I64BE, row_space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(node, H5T_NATIVE_INT, H5S_ALL, H5S_ALL, H5P_DEFAULT, e.dof_node.data());
    H5Dclose(node);
    H5Ldelete(file, "/mass", H5P_DEFAULT);
    const hsize_t square[] = {14, 14}, chunk[] = {7, 7};
    const hid_t square_space = H5Screate_simple(2, square, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_chunk(creation, 2, chunk);
    H5Pset_shuffle(creation);
    if (H5Zfilter_avail(H5Z_FILTER_DEFLATE) > 0) H5Pset_deflate(creation, 9);
    const hid_t mass = H5Dcreate2(file, "/mass", H5T_IEEE_F64BE, square_space, H5P_DEFAULT, creation, H5P_DEFAULT);
    const Eigen::MatrixXd transposed = e.mass.transpose();
    H5Dwrite(mass, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, transposed.data());
    H5Dclose(mass);
    H5Pclose(creation);
    H5Sclose(square_space);
    H5Sclose(node_space);
    H5Sclose(row_space);
    H5Tclose(text);
  });
  const LoadedSuperelement loaded = read_superelement(path);
  EXPECT_EQ(loaded.superelement.content_id, e.content_id);
  EXPECT_EQ(loaded.superelement.mass, e.mass);
}

struct BadFile {
  std::string name;
  std::function<void(hid_t)> edit;
  std::vector<std::string> message;
};

std::ostream& operator<<(std::ostream& out, const BadFile& bad) { return out << bad.name; }

class SpoiledFile : public ::testing::TestWithParam<BadFile> {};

TEST_P(SpoiledFile, IsRejectedWithDatasetAndMeaning) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.h5");
  Superelement e = craig_bampton_beam({}, 2);
  write_superelement(path, e);
  ASSERT_EQ(error_of(path), "no error");
  change(path, GetParam().edit);
  const std::string message = error_of(path);
  EXPECT_THAT(message, HasSubstr(path));
  for (const std::string& part : GetParam().message) EXPECT_THAT(message, HasSubstr(part));
}

std::vector<BadFile> bad_files() {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  return {
      {"Format",
       with_attribute("format", "tisserand-results"),
       {"of the kind 'tisserand-results', expected 'tisserand-superelement'"}},
      {"NoFormat", [](hid_t f) { H5Adelete(f, "format"); }, {"not a superelement file"}},
      {"FormatNumber", with_attribute("format", 3.0), {"attribute 'format'", "expected a string"}},
      {"MajorVersion", with_attribute("version", "2.0"), {"attribute 'version'", "is 2.0"}},
      {"BadVersion", with_attribute("version", "one"), {"attribute 'version'", "'one'"}},
      {"HalfVersion", with_attribute("version", "1."), {"attribute 'version'", "'1.'"}},
      {"NoUnit", [](hid_t f) { H5Adelete(f, "mass_unit"); }, {"attribute 'mass_unit'", "is missing"}},
      {"UnitText", with_attribute("mass_unit", "kg"), {"attribute 'mass_unit'", "expected a number"}},
      {"NoLabel", [](hid_t f) { H5Adelete(f, "mass_unit_label"); }, {"attribute 'mass_unit_label'", "is missing"}},
      {"LongName", with_attribute("name", std::string(300, 'x')), {"attribute 'name'", "300 bytes"}},
      {"ContentId",
       with_attribute("content_id", std::string(64, 'a')),
       {"attribute 'content_id'", "aaaaaaaaaaaa", "changed after it was written"}},
      {"NoStiffness", [](hid_t f) { H5Ldelete(f, "/stiffness", H5P_DEFAULT); }, {"/stiffness: is missing"}},
      {"NoBoundary", [](hid_t f) { H5Ldelete(f, "/boundary", H5P_DEFAULT); }, {"/boundary/name: is missing"}},
      {"GroupForDataset",
       [](hid_t f) {
         H5Ldelete(f, "/mass", H5P_DEFAULT);
         H5Gclose(H5Gcreate2(f, "/mass", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
       },
       {"/mass: is not a dataset"}},
      {"NanStiffness",
       [nan](hid_t f) {
         replace_by_doubles(f, "/stiffness", {14, 14}, nan);
       },
       {"/stiffness", "[0, 0] = nan", "row 0 (node 'base', translation x)"}},
      {"Rank",
       [](hid_t f) { replace_by_doubles(f, "/mass", {196}, 1.0); },
       {"/mass", "has shape 196, expected 14 x 14"}},
      {"ShapeOfMass",
       [](hid_t f) {
         replace_by_doubles(f, "/mass", {14, 13}, 1.0);
       },
       {"/mass", "has shape 14 x 13, expected 14 x 14"}},
      {"ShapeOfPosition",
       [](hid_t f) {
         replace_by_doubles(f, "/boundary/position", {3, 2}, 1.0);
       },
       {"/boundary/position", "has shape 3 x 2, expected 2 x 3"}},
      {"TypeOfNode",
       [](hid_t f) { replace_by_doubles(f, "/dof/node", {14}, 0.0); },
       {"/dof/node", "holds 64-bit floating numbers, expected integers"}},
      {"ScalarNode", [](hid_t f) { replace_by_doubles(f, "/dof/node", {}, 0.0); }, {"/dof/node", "has shape scalar"}},
      {"SinglePrecision",
       [](hid_t f) {
         replace_by_claim(f, "/mass", H5T_IEEE_F32LE, {14, 14});
       },
       {"/mass", "holds 32-bit floating numbers, expected 64-bit"}},
      {"Strings",
       [](hid_t f) { replace_by_doubles(f, "/boundary/name", {2}, 1.0); },
       {"/boundary/name", "expected strings"}},
      {"NeverWritten",
       [](hid_t f) {
         replace_by_claim(f, "/mass", H5T_IEEE_F64LE, {14, 14});
       },
       {"/mass", "not all of its values were written"}},
      {"HugeMatrix",
       [](hid_t f) {
         replace_by_claim(f, "/mass", H5T_IEEE_F64LE, {1u << 30, 1u << 30});
       },
       {"/mass", "has shape 1073741824 x 1073741824, expected 14 x 14"}},
      {"HugeTable",
       [](hid_t f) { replace_by_claim(f, "/dof/node", H5T_STD_I32LE, {hsize_t(1) << 40}); },
       {"/dof/node", "has 1099511627776 entries, expected 1 to 10000"}},
      {"EmptyTable",
       [](hid_t f) {
         hdf5::Shape none{0};
         H5Ldelete(f, "/dof/node", H5P_DEFAULT);
         const std::int32_t value = 0;
         hdf5::write_dataset({f, ""}, "/dof/node", none, &value);
       },
       {"/dof/node", "has 0 entries"}},
      {"WideInteger",
       [](hid_t f) {
         H5Ldelete(f, "/dof/node", H5P_DEFAULT);
         const hsize_t n = 14;
         const hid_t space = H5Screate_simple(1, &n, nullptr);
         const hid_t d = H5Dcreate2(f, "/dof/node", H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
         const std::vector<long> values(14, 1L << 40);
         H5Dwrite(d, H5T_NATIVE_LONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
         H5Dclose(d);
         H5Sclose(space);
       },
       {"/dof/node", "entry 0 is 1099511627776, outside the range of 32-bit"}},
      {"SoftLink",
       [](hid_t f) {
         H5Lmove(f, "/mass", f, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT);
         H5Lcreate_soft("/elsewhere", f, "/mass", H5P_DEFAULT, H5P_DEFAULT);
       },
       {"/mass", "link to another object or file"}},
      {"ExternalLink",
       [](hid_t f) {
         H5Ldelete(f, "/mass", H5P_DEFAULT);
         H5Lcreate_external("/etc/passwd", "/x", f, "/mass", H5P_DEFAULT, H5P_DEFAULT);
       },
       {"/mass", "link to another object or file"}},
      {"ExternalData",
       [](hid_t f) {
         H5Ldelete(f, "/mass", H5P_DEFAULT);
         const hsize_t n[] = {14, 14};
         const hid_t space = H5Screate_simple(2, n, nullptr), creation = H5Pcreate(H5P_DATASET_CREATE);
         H5Pset_external(creation, "/dev/zero", 0, 14 * 14 * 8);
         H5Dclose(H5Dcreate2(f, "/mass", H5T_IEEE_F64LE, space, H5P_DEFAULT, creation, H5P_DEFAULT));
         H5Pclose(creation);
         H5Sclose(space);
       },
       {"/mass", "stored in another file"}},
      {"DanglingSoftLink",
       [](hid_t f) {
         H5Ldelete(f, "/mass", H5P_DEFAULT);
         H5Lcreate_soft("/nowhere", f, "/mass", H5P_DEFAULT, H5P_DEFAULT);
       },
       {"/mass", "link to another object or file"}},
  };
}

INSTANTIATE_TEST_SUITE_P(Damage, SpoiledFile, ::testing::ValuesIn(bad_files()),
                         [](const ::testing::TestParamInfo<BadFile>& test) { return test.param.name; });

TEST(SuperelementFile, MissingContentIdIsAWarning) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 0);
  write_superelement(folder.file("a.h5"), e);
  change(folder.file("a.h5"), [](hid_t file) { H5Adelete(file, "content_id"); });
  const LoadedSuperelement loaded = read_superelement(folder.file("a.h5"));
  EXPECT_EQ(loaded.superelement.content_id, e.content_id);
  ASSERT_EQ(loaded.report.warnings.size(), 1u);
  EXPECT_THAT(loaded.report.warnings[0], HasSubstr("content_id"));
}

TEST(SuperelementFile, OtherFilesAreRejected) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(folder.file("none.h5")), AllOf(HasSubstr("none.h5"), HasSubstr("No such file")));
  EXPECT_THAT(error_of(folder.path().string()), HasSubstr("is not an ordinary file"));
  std::ofstream(folder.file("empty.h5"));
  EXPECT_THAT(error_of(folder.file("empty.h5")), HasSubstr("empty (0 bytes)"));
  std::ofstream(folder.file("text.h5")) << "name: beam\n";
  EXPECT_THAT(error_of(folder.file("text.h5")), HasSubstr("is not an HDF5 file"));
  EXPECT_THAT(error_of("/dev/null"), HasSubstr("is not an ordinary file"));
}

TEST(SuperelementFile, TruncationAndFlippedBytesNeverCrash) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 2);
  write_superelement(folder.file("a.h5"), e);
  std::ifstream in(folder.file("a.h5"), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  for (std::size_t size = 1; size < bytes.size(); size += 293) {
    std::ofstream(folder.file("cut.h5"), std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(size));
    EXPECT_NE(error_of(folder.file("cut.h5")), "no error") << size;
  }
  int harmless = 0, tried = 0;
  for (std::size_t i = 0; i < bytes.size(); i += 61) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 8)));
    std::ofstream(folder.file("flip.h5"), std::ios::binary) << flipped;
    const std::string message = error_of(folder.file("flip.h5"));
    ++tried;
    if (message == "no error") ++harmless;
  }
  // Flips in unused space, labels and library bookkeeping may pass; a flip of any matrix entry may not.
  EXPECT_LT(harmless, tried / 2);
}

TEST(SuperelementFile, DamagedStringsOfVariableLengthNeverCrash) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 0);
  write_superelement(folder.file("a.h5"), e);
  const std::string mark = "a method of this many letters";
  change(folder.file("a.h5"), [&](hid_t file) {
    const hid_t text = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(text, H5T_VARIABLE);
    H5Adelete(file, "method");
    const hid_t attribute = H5Acreate2(file, "method", text, space, H5P_DEFAULT, H5P_DEFAULT);
    const char* value = mark.c_str();
    H5Awrite(attribute, text, &value);
    H5Aclose(attribute);
    H5Sclose(space);
    H5Tclose(text);
  });
  ASSERT_EQ(error_of(folder.file("a.h5")), "no error");
  std::ifstream in(folder.file("a.h5"), std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  // The global heap: signature GCOL, 16 bytes of header, then per object index, count, reserved and size before its
  // text.
  const std::size_t heap = bytes.find("GCOL"), text = bytes.find(mark);
  ASSERT_NE(heap, std::string::npos);
  ASSERT_EQ(text, heap + 32);
  int damaged = 0;
  for (std::size_t i = heap; i < text; ++i) {
    std::string flipped = bytes;
    flipped[i] = '\x7f';
    std::ofstream(folder.file("flip.h5"), std::ios::binary) << flipped;
    if (error_of(folder.file("flip.h5")) != "no error") ++damaged;
  }
  EXPECT_GT(damaged, 0);
}

TEST(SuperelementFile, EveryFlippedBitOfTheDataIsNoticed) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 2);
  write_superelement(folder.file("a.h5"), e);
  std::ifstream in(folder.file("a.h5"), std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  const Eigen::MatrixXd columns = e.mass.transpose();
  const std::size_t data = bytes.find(std::string(reinterpret_cast<const char*>(columns.data()), 14 * 14 * 8));
  ASSERT_NE(data, std::string::npos);
  for (std::size_t i = data; i < data + 14 * 14 * 8; i += 23) {
    std::string flipped = bytes;
    flipped[i] = static_cast<char>(flipped[i] ^ 1);
    std::ofstream(folder.file("flip.h5"), std::ios::binary) << flipped;
    EXPECT_NE(error_of(folder.file("flip.h5")), "no error") << i;
  }
}

TEST(SuperelementFile, WriteChecksAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 2);
  e.mass(0, 0) = -1;
  EXPECT_THROW(write_superelement(folder.file("bad.h5"), e), Error);
  Superelement good = craig_bampton_beam({}, 2);
  std::ofstream(folder.file("file")) << "x";
  for (const std::string& place : {folder.file("file/a.h5"), folder.file("missing/a.h5")}) {
    try {
      write_superelement(place, good);
      ADD_FAILURE() << place;
    } catch (const Error& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(place), HasSubstr("folder that exists")));
    }
  }
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
            1);
}

/// Text of the Error that `action` throws in a child whose files may not exceed `bytes`; stands for a full disk
/// anywhere.
std::string error_with_file_limit(rlim_t bytes, const std::function<void()>& action) {
  int channel[2];
  if (::pipe(channel) != 0) return "no pipe";
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{bytes, bytes};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    std::string text = "no error";
    try {
      action();
    } catch (const Error& error) {
      text = error.what();
    }
    if (::write(channel[1], text.data(), text.size()) < 0) ::_exit(1);
    ::_exit(0);
  }
  ::close(channel[1]);
  std::string text(4096, '\0');
  const ssize_t size = ::read(channel[0], text.data(), text.size());
  ::close(channel[0]);
  int status = 0;
  ::waitpid(child, &status, 0);
  text.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return status == 0 ? text : fmt::format("child ended with status {}: {}", status, text);
}

TEST(SuperelementFile, FileThatCannotGrowIsAnErrorAndLeavesNothingBehind) {
  const TemporaryFolder folder;
  Superelement e = craig_bampton_beam({}, 2);
  const std::string text = error_with_file_limit(2000, [&] { write_superelement(folder.file("a.h5"), e); });
  EXPECT_THAT(text, AllOf(HasSubstr("a.h5: cannot write"), HasSubstr("File too large")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

}  // namespace
}  // namespace tisserand::formats::superelement_file_test
