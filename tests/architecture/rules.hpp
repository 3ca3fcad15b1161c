// SPDX-License-Identifier: GPL-3.0-or-later
// The rules of the tree as functions over its text: who may include whom, lengths, wording, links. Beside the programs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tisserand::architecture {

struct Include {
  std::size_t line = 0;
  std::string target;  ///< what stands between the quotes or angle brackets
};

/// A text file of the tree. `code` is the text of a source file without comments (same number of lines).
struct SourceFile {
  std::string path;  ///< from the root, with /
  std::vector<std::string> lines;
  std::vector<std::string> code;
  std::vector<Include> includes;

  /// Length without the line of the licence.
  std::size_t length() const;
  bool is_header() const { return path.ends_with(".hpp"); }
  bool is_source() const { return path.ends_with(".cpp") || is_header(); }
  bool is_page() const { return path.ends_with(".md"); }
};

struct SourceTree {
  std::filesystem::path root;
  std::vector<SourceFile> files;
};

struct Violation {
  std::string path;
  std::size_t line = 0;  ///< 0: the file as a whole
  std::string what;
};

/// Every text file below `root` except build folders, hidden folders (but .ci) and data (references, *.csv, *.h5, ...).
SourceTree read_tree(const std::filesystem::path& root);

/// common <- formats <- reducer, mechanism; libraries only where they belong; no clock, file or output in numerics;
/// stable sorting by sort_stably.
std::vector<Violation> check_dependencies(const SourceTree& tree);

/// No cycle of headers inside a folder of the first level, and none between its rooms (sources counted): its
/// sub-folders, and each program or story in the folder of a stage itself.
std::vector<Violation> check_cycles(const SourceTree& tree);

/// Every header has #pragma once, and the .cpp beside it includes it first (which proves that it compiles alone).
std::vector<Violation> check_headers(const SourceTree& tree);

/// .cpp up to 500 lines, .hpp up to 300.
std::vector<Violation> check_lengths(const SourceTree& tree);

/// Functions up to 60 lines but for lists of fields and a few by name; few with more than 5 parameters; no name such as
/// work_1.
std::vector<Violation> check_functions(const SourceTree& tree);

/// At most 30 sources (headers counted) in a folder: a room that a person takes in.
std::vector<Violation> check_rooms(const SourceTree& tree);

/// Files that tell a story (simulate, reduce, step, evaluate, build_model) fit on a page: up to 80 lines.
std::vector<Violation> check_stories(const SourceTree& tree);

/// No promises instead of code, no places of one machine, no typographic dashes and quotes, no stray blanks.
std::vector<Violation> check_wording(const SourceTree& tree);

/// Sentences of pages have at most 30 words; tables, code and formulas excepted.
std::vector<Violation> check_sentences(const SourceTree& tree);

/// Docstrings begin with a noun or a verb: none with "Of", "The same" or "As".
std::vector<Violation> check_docstrings(const SourceTree& tree);

/// No two files define a type of the same name in one namespace: the linker would keep one destructor for both.
std::vector<Violation> check_type_names(const SourceTree& tree);

/// Sources, scripts and lists of CMake begin with the line SPDX-License-Identifier (scripts: behind #!).
std::vector<Violation> check_licences(const SourceTree& tree);

/// Links of pages, and files that pages and comments name, exist; source keys such as [Car00] have a row in
/// CONVENTIONS.md.
std::vector<Violation> check_links(const SourceTree& tree);

/// A source has a header of its own name, or is listed with the header that it implements beside others; programs
/// excepted.
std::vector<Violation> check_source_names(const SourceTree& tree);

/// An index is compared with std::ssize(); numbers become int in few places.
std::vector<Violation> check_casts(const SourceTree& tree);

/// The table "Ways through the code" of a map: five rooms at most on each way, none twice.
std::vector<Violation> check_ways(const SourceTree& tree);

/// The formulas of docs/THEORY.md are numbered one after the other; every "THEORY (n)" of a source is one of them;
/// those of motion are named in the tests that evaluate them (tests/mechanism/*/theory_*test.cpp).
std::vector<Violation> check_formulas(const SourceTree& tree);

/// One line per violation; empty for none.
std::string to_text(const std::vector<Violation>& violations);

}  // namespace tisserand::architecture
