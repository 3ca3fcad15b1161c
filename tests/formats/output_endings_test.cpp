// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the files that belong to a superelement: none of them is taken for the output of another kind.
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/output_path.hpp"
#include "formats/companion/companion.hpp"
#include "formats/recovery/recovery.hpp"
#include "tests/support/temporary_folder.hpp"
#include "tests/support/thrown.hpp"

namespace tisserand::formats::output_endings_test {
namespace {

TEST(OutputEndings, KnowTheFilesBesideASuperelement) {
  const test_support::TemporaryFolder folder;
  const std::string element = folder.file("a.superelement.h5");
  for (const std::string& path : {element, companion_path(element), recovery_path(element)})
    EXPECT_THAT(test_support::error_of([&] { require_output(path, {".results.h5", ".h5"}, {}); }),
                ::testing::HasSubstr("does not end in .results.h5 or .h5"));
  EXPECT_NO_THROW(require_output(folder.file("a.h5"), {".results.h5", ".h5"}, {}));
}

}  // namespace
}  // namespace tisserand::formats::output_endings_test
