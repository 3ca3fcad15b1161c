// SPDX-License-Identifier: GPL-3.0-or-later
// Nearest keys, wildcards, base64, and files that appear whole or not at all.
#include "common/text.hpp"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/base64.hpp"
#include "common/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::text_test {
namespace {

using test_support::TemporaryFolder;
using test_support::text_of;

TEST(Text, EditDistanceCountsInsertionsDeletionsSubstitutionsAndSwaps) {
  EXPECT_EQ(edit_distance("", ""), 0u);
  EXPECT_EQ(edit_distance("", "abc"), 3u);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3u);  // the textbook example of Levenshtein distances
  EXPECT_EQ(edit_distance("stpe", "step"), 1u);
  EXPECT_EQ(edit_distance("Step", "step"), 0u);
  EXPECT_EQ(edit_distance("ca", "abc"), 3u);  // optimal string alignment, where Damerau-Levenshtein has 2
}

TEST(Text, NearestSuggestsOnlyWhatIsSimilar) {
  const std::vector<std::string> keys{"integrator", "initial", "bodies", "joints", "step"};
  EXPECT_EQ(nearest("integrater", keys), "integrator");
  EXPECT_EQ(nearest("join", keys), "joints");
  EXPECT_EQ(nearest("setp", keys), "step");
  EXPECT_EQ(nearest("gravity", keys), std::nullopt);
  EXPECT_EQ(nearest("", keys), std::nullopt);
  EXPECT_EQ(nearest("x", {}), std::nullopt);
}

TEST(Text, ListsShowTenNamesAndACount) {
  std::vector<std::string> names;
  for (int i = 0; i < 10; ++i) names.push_back(std::string(1, static_cast<char>('a' + i)));
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"a", "b"}), "a, b");
  EXPECT_EQ(listed(names, " "), "a b c d e f g h i j");
  EXPECT_EQ(listed(names, " ", 300), "a b c d e f g h i j and 290 more");
  names.resize(300, "k");
  EXPECT_EQ(listed(names, " "), "a b c d e f g h i j and 290 more");
}

TEST(Text, NearestNamesHoldTheWordOrResembleIt) {
  const std::vector<std::string> names{"energy/total", "rod/tip/x", "rod/tpi/y", "tip/x"};
  EXPECT_EQ(nearest_names("tip/x", names),
            (std::vector<std::string>{"rod/tip/x", "tip/x", "rod/tpi/y", "energy/total"}));
  EXPECT_EQ(nearest_names("a", std::vector<std::string>(300, "b")).size(), 10u);
}

TEST(Text, JoinPutsTheSeparatorBetween) {
  EXPECT_EQ(join({}, ", "), "");
  EXPECT_EQ(join({"a"}, ", "), "a");
  EXPECT_EQ(join({"a", "", "b"}, ", "), "a, , b");
}

/// Well-formed UTF-8 is that of RFC 3629, section 4.
TEST(Text, PrintableKeepsLettersAndDropsWhatMovesTerminals) {
  EXPECT_EQ(printable_line("Träger 7, \xe4\xb8\xad \xf0\x9f\x99\x82", 100), "Träger 7, \xe4\xb8\xad \xf0\x9f\x99\x82");
  EXPECT_EQ(printable_line("a\x1b[2Jb\x7f", 100), "a\\x1b[2Jb\\x7f");
  EXPECT_EQ(printable_line("a\nb\tc\rd", 100), "a b c d");
  EXPECT_EQ(printable_line("\xc2\x9b\xe2\x80\xae", 100), "\\xc2\\x9b\\xe2\\x80\\xae")
      << "control sequence introducer, right-to-left override";
  EXPECT_EQ(printable_line("\xff\xc3\xc0\xaf\xed\xa0\x80", 100), "\\xff\\xc3\\xc0\\xaf\\xed\\xa0\\x80")
      << "no UTF-8: cut, overlong, surrogate";
  EXPECT_EQ(printable_line("abcdef", 3), "abc...");
  EXPECT_EQ(printable_line("äää", 3), "ä...") << "letters are not cut";
}

TEST(Text, WildcardsMatchAnyRun) {
  EXPECT_TRUE(matches_wildcard("nodes/position/tip/x", "nodes/*/x"));
  EXPECT_TRUE(matches_wildcard("abc", "abc"));
  EXPECT_TRUE(matches_wildcard("abc", "*"));
  EXPECT_TRUE(matches_wildcard("", "**"));
  EXPECT_TRUE(matches_wildcard("aXbXb", "a*b"));
  EXPECT_FALSE(matches_wildcard("abc", "ab"));
  EXPECT_FALSE(matches_wildcard("abc", "*d*"));
  EXPECT_FALSE(matches_wildcard("", "?"));
}

TEST(Text, FileIsReplacedAsAWhole) {
  const TemporaryFolder folder;
  const std::string path = folder.file("a.txt"), text = std::string("one\0two\n", 8);
  write_text_file(path, "old");
  write_text_file(path, text);
  EXPECT_EQ(text_of(path), text);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
            1);
}

TEST(Text, UnpublishedFileLeavesNothing) {
  const TemporaryFolder folder;
  {
    TextFile file(folder.file("a.txt"));
    file.write("half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(Text, UnwritablePlacesAreErrorsWithRemedy) {
  const TemporaryFolder folder;
  write_text_file(folder.file("file"), "x");
  std::filesystem::create_directory(folder.file("folder"));
  const auto error_of = [](const std::string& path) -> std::string {
    try {
      write_text_file(path, "text");
    } catch (const Error& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_THAT(error_of(folder.file("missing/a")),
              ::testing::HasSubstr("No such file or directory; choose a folder that exists"));
  EXPECT_THAT(error_of(folder.file("file/a")), ::testing::HasSubstr("Not a directory; choose a folder that exists"));
  EXPECT_THAT(error_of(folder.file("folder")), ::testing::HasSubstr("Is a directory; give the name of a file"));
  EXPECT_THAT(error_of("/proc/self/a"), ::testing::HasSubstr("/proc/self/a: cannot create the file"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator()),
            2);
}

TEST(Text, PrintableEscapesWhatTerminalsObeyAndWhatIsNoText) {
  EXPECT_EQ(printable("leg\t\xc2\xb2 \xe2\x82\xac\n"),
            "leg\t\xc2\xb2 \xe2\x82\xac\n");  // superscript two, the euro sign
  EXPECT_EQ(printable("\x1b[31mred\r\x7f"), "\\x1b[31mred\\x0d\\x7f");
  EXPECT_EQ(printable("\xff \xc3"), "\\xff \\xc3");
  EXPECT_EQ(printable("\xc2\x9b"), "\\xc2\\x9b");                    // the control character U+009B
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf");                    // a longer form of /
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");           // half of a surrogate pair
  EXPECT_EQ(printable("\xf4\x90\x80\x80"), "\\xf4\\x90\\x80\\x80");  // beyond U+10FFFF
}

TEST(Text, Base64AndBack) {
  // RFC 4648, section 10.
  const std::pair<std::string, std::string> vectors[]{{"", ""},        {"f", "Zg=="},        {"fo", "Zm8="},
                                                      {"foo", "Zm9v"}, {"foob", "Zm9vYg=="}, {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(base64_decoded(text), bytes);
  }
  EXPECT_EQ(base64_decoded("Zm9v\nYmFy"), "foo");
}

}  // namespace
}  // namespace tisserand::text_test
