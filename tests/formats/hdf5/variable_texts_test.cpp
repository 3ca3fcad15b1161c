// SPDX-License-Identifier: GPL-3.0-or-later
// Texts of variable length: legal ones are read, crafted ones refused before anything is copied.
#include <cstdlib>
#include <fstream>
#include <random>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/error.hpp"
#include "formats/hdf5/container.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::formats::variable_texts_test {
namespace {

const std::string tests = std::string(TISSERAND_SOURCE_DIR) + "/tests/";
const std::string crafted = tests + "verification/references/trials/hdf5_long_string.superelement.h5";

std::string error_of(const std::string& path) {
  try {
    static_cast<void>(read_superelement(path));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

/// The example of SUPERELEMENT.md as h5py 3.7 writes it: all its texts are of variable length.
TEST(VariableTexts, TheExampleOfThePageIsRead) {
  const Superelement e = read_superelement(tests + "compatibility/tetrahedron.superelement.h5").superelement;
  EXPECT_EQ(e.name, "tetrahedron");
  EXPECT_EQ(e.method, "springs");
  EXPECT_EQ(e.producer, "by hand");
  EXPECT_EQ(e.units.length.label, "m");
  EXPECT_EQ(e.node_name, (std::vector<std::string>{"a", "b", "c", "d"}));
  EXPECT_EQ(e.mass.trace(), 12 * 0.5) << "0.5 kg at every node";
}

/// HDF5 1.10.8 would copy the 4104 bytes into a buffer of the length that the reference gives.
TEST(VariableTexts, ATextLongerThanItsReferenceIsRefused) {
  EXPECT_EQ(error_of(crafted),
            crafted +
                ": /boundary/name: has a string of 4104 bytes, but its reference says 4 bytes; the file is damaged or "
                "malicious: do not use it");
}

/// Some bytes changed each time, most of them in the structures of the file: an error or a superelement, whatever
/// happens to the process that reads. scripts/mutations does this 10 000 times under valgrind.
TEST(VariableTexts, MutationsOfTheCraftedFileDoNoHarm) {
  const test_support::TemporaryFolder folder;
  const std::string bytes = test_support::text_of(crafted), path = folder.file("mutated.h5");
  const char* wish = std::getenv("TISSERAND_MUTATIONS");
  const int copies = wish == nullptr ? 60 : std::atoi(wish);
  int errors = 0;
  // valgrind then translates HDF5's code once, and not in every child.
  const hdf5::OpenFile sound(tests + "compatibility/tetrahedron.superelement.h5");
  EXPECT_FALSE(opening_of(hdf5::Container(sound, hdf5::Completeness::closed)).empty());
  for (int seed = 1; seed <= copies; ++seed) {
    std::mt19937 random(static_cast<unsigned>(seed));
    std::string mutated = bytes;
    for (unsigned k = 1 + random() % 8; k > 0; --k) {
      std::size_t at = random() % mutated.size();
      if (const std::size_t used = mutated.find_first_not_of('\0', at); used != std::string::npos) at = used;
      const std::array<char, 4> values{'\0', '\xff', static_cast<char>(random()),
                                       static_cast<char>(mutated[at] ^ (1 << random() % 8))};
      mutated[at] = values[random() % values.size()];
    }
    std::ofstream(path, std::ios::binary) << mutated;
    if (error_of(path) != "no error") ++errors;
  }
  EXPECT_EQ(errors, copies) << "the text is longer than its reference, or something else is wrong";
}

}  // namespace
}  // namespace tisserand::formats::variable_texts_test
