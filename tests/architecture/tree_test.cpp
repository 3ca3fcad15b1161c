// SPDX-License-Identifier: GPL-3.0-or-later
// The rules of the tree hold for this tree (architecture rules 1-5, README "Where things are").
#include <gtest/gtest.h>

#include "tests/architecture/rules.hpp"

namespace tisserand::architecture::tree_test {
namespace {

const SourceTree& this_tree() {
  static const SourceTree tree = read_tree(TISSERAND_SOURCE_DIR);
  return tree;
}

TEST(Tree, IsReadWhole) {
  std::size_t sources = 0;
  for (const SourceFile& file : this_tree().files) sources += file.is_source() ? 1 : 0;
  EXPECT_GT(sources, 40u);
}

TEST(Tree, DependenciesPointOneWay) { EXPECT_EQ(to_text(check_dependencies(this_tree())), ""); }

TEST(Tree, IncludesMakeNoCircle) { EXPECT_EQ(to_text(check_cycles(this_tree())), ""); }

TEST(Tree, HeadersAreGuardedAndFirst) { EXPECT_EQ(to_text(check_headers(this_tree())), ""); }

TEST(Tree, FilesAreShort) { EXPECT_EQ(to_text(check_lengths(this_tree())), ""); }

TEST(Tree, FunctionsAreShort) { EXPECT_EQ(to_text(check_functions(this_tree())), ""); }

TEST(Tree, SourcesHaveTheNameOfTheirHeader) { EXPECT_EQ(to_text(check_source_names(this_tree())), ""); }

TEST(Tree, CastsAreFew) { EXPECT_EQ(to_text(check_casts(this_tree())), ""); }

TEST(Tree, WaysAreShort) { EXPECT_EQ(to_text(check_ways(this_tree())), ""); }

TEST(Tree, FormulasAreThere) { EXPECT_EQ(to_text(check_formulas(this_tree())), ""); }

TEST(Tree, RoomsAreSmall) { EXPECT_EQ(to_text(check_rooms(this_tree())), ""); }

TEST(Tree, StoriesFitOnAPage) { EXPECT_EQ(to_text(check_stories(this_tree())), ""); }

TEST(Tree, WordsAreKept) { EXPECT_EQ(to_text(check_wording(this_tree())), ""); }

TEST(Tree, SentencesAreShort) { EXPECT_EQ(to_text(check_sentences(this_tree())), ""); }

TEST(Tree, DocstringsBeginWithANoun) { EXPECT_EQ(to_text(check_docstrings(this_tree())), ""); }

TEST(Tree, FilesNameTheirLicence) { EXPECT_EQ(to_text(check_licences(this_tree())), ""); }

TEST(Tree, TypesHaveNamesOfTheirOwn) { EXPECT_EQ(to_text(check_type_names(this_tree())), ""); }

TEST(Tree, LinksLead) { EXPECT_EQ(to_text(check_links(this_tree())), ""); }

}  // namespace
}  // namespace tisserand::architecture::tree_test
