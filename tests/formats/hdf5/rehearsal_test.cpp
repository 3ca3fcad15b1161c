// Reading in a child process first: what kills the child is told, what only fails is left to the caller.
#include <unistd.h>

#include <csignal>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"

namespace tisserand::formats::rehearsal_test {
namespace {

/// As HDF5 ends a process on some damaged files.
void crash() {
  std::signal(SIGSEGV, SIG_DFL);  // sanitizers take it for themselves
  std::raise(SIGSEGV);
}

TEST(Rehearsal, TellsWhichFileKillsTheChild) {
  try {
    hdf5::rehearse("leg.superelement.h5", crash);
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("leg.superelement.h5: is an HDF5 file, but so damaged"), 0u)
        << error.what();
  }
}

TEST(Rehearsal, LeavesErrorsToTheCaller) {
  EXPECT_NO_THROW(hdf5::rehearse("absent", [] { throw Error("cannot be read", "absent", ""); }));
}

TEST(Rehearsal, OfManyFilesReadsAllOfThem) {
  const std::vector<std::string> paths{"absent", "sound", "damaged"};
  const auto read_until = [](const std::string& deadly) {
    return [deadly](const std::string& path) {
      if (path == deadly) crash();
      if (path == "absent") throw Error("cannot be read", path, "");
    };
  };
  EXPECT_TRUE(hdf5::survives(paths, read_until("none")));
  for (const char* deadly : {"absent", "sound", "damaged"})
    EXPECT_FALSE(hdf5::survives(paths, read_until(deadly))) << deadly;
  EXPECT_TRUE(hdf5::survives({}, read_until("none")));
}

TEST(Rehearsal, EndsAChildThatWaitsForEver) {
  try {
    hdf5::rehearse("far.superelement.h5", [] { ::pause(); }, {2, 1});
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).find("far.superelement.h5: could not be read within 1 s"), 0u) << error.what();
  }
}

}  // namespace
}  // namespace tisserand::formats::rehearsal_test
