// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the tree as text and looks for violations of its rules.
#include "tests/architecture/rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string_view>

namespace tisserand::architecture {
namespace {

namespace fs = std::filesystem;

std::string first_folder(const std::string& path) {
  const auto slash = path.find('/');
  return slash == std::string::npos ? "" : path.substr(0, slash);
}

/// Folder of a test's subject: "tests/reducer/..." -> "reducer", else the first folder.
std::string subject(const std::string& path) {
  return path.starts_with("tests/") ? first_folder(path.substr(6)) : first_folder(path);
}

bool is_text(const fs::path& file) {
  static const std::set<std::string> endings = {".cpp",  ".hpp",   ".md", ".txt", ".yaml", ".yml",
                                                ".json", ".cmake", ".py", ".sh",  ".in",   ""};
  const std::string name = file.filename().string();
  return name != "LICENSE" && (endings.contains(file.extension().string()) || name.starts_with(".clang"));
}

/// Removes // and /* */ comments, keeps strings and the number of lines.
std::vector<std::string> without_comments(const std::vector<std::string>& lines) {
  std::vector<std::string> code;
  bool in_block = false;
  for (const std::string& line : lines) {
    std::string kept;
    char quote = 0;
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::string_view two = std::string_view(line).substr(i, 2);
      if (in_block) {
        if (two == "*/") in_block = false, ++i;
        continue;
      }
      if (quote == 0 && two == "//") break;
      if (quote == 0 && two == "/*") {
        in_block = true, ++i;
        continue;
      }
      kept += line[i];
      if (quote != 0 && line[i] == '\\' && i + 1 < line.size())
        kept += line[++i];
      else if (quote != 0)
        quote = line[i] == quote ? 0 : quote;
      else if (line[i] == '"' ||
               (line[i] == '\'' && (i == 0 || !std::isalnum(static_cast<unsigned char>(line[i - 1])))))
        quote = line[i];  // a ' after a digit separates digits
    }
    code.push_back(kept);
  }
  return code;
}

std::vector<Include> includes_of(const std::vector<std::string>& code) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*[<"]([^>"]+)[>"])re");
  std::vector<Include> includes;
  std::smatch match;
  for (std::size_t i = 0; i < code.size(); ++i)
    if (code[i].find('#') != std::string::npos && std::regex_search(code[i], match, pattern))
      includes.push_back({i + 1, match[1]});
  return includes;
}

SourceFile read_file(const fs::path& root, const fs::path& file) {
  SourceFile source;
  source.path = fs::relative(file, root).generic_string();
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) source.lines.push_back(line);
  if (source.is_source()) {
    source.code = without_comments(source.lines);
    source.includes = includes_of(source.code);
  }
  return source;
}

/// Headers of a library, where they may be included, and in how many files outside the tests.
struct LibraryRule {
  const char* headers;  ///< regular expression
  const char* places;   ///< regular expression of the including path
  std::size_t most_files;
  const char* rule;
};

constexpr std::size_t kAny = 1000000;
const std::array kLibraryRules = {
    LibraryRule{"^(petsc|slepc).*", "^((tests/)?reducer/.*|tests/benchmarks/eigensolvers\\.cpp)", kAny,
                "PETSc and SLEPc stay in reducer"},
    LibraryRule{"^gmshc?\\.h.*", "^reducer/gmsh/.*", kAny, "gmsh stays in reducer/gmsh"},
    LibraryRule{"^linux/landlock\\.h", "^reducer/gmsh/.*", 1, "the door is one file of reducer/gmsh"},
    LibraryRule{"^(linux/)?seccomp\\.h", "^(common/confined/call_filter\\.cpp|tests/.*)", kAny,
                "system calls are filtered by common/confined/call_filter"},
    LibraryRule{"^(suitesparse/)?(klu|umfpack|SuiteSparse.*|cholmod|amd|colamd)\\.h.*",
                "^(mechanism/solver/.*|reducer/algebra/cholesky\\.cpp)", 5,
                "SuiteSparse stays in four files of mechanism/solver and one of reducer/algebra"},
    LibraryRule{"^(cvode|nvector|sundials|sunlinsol|sunmatrix)/.*", "^mechanism/.*", 1,
                "SUNDIALS stays in one file of mechanism"},
    LibraryRule{"^CLI/.*", "^(reducer|mechanism)/(main\\.cpp|history_commands\\.[ch]pp)", kAny,
                "only main.cpp sees the command-line parser, and history_commands"},
    LibraryRule{"^(hdf5|H5).*\\.h.*", "^(tests/)?formats/.*", kAny, "HDF5 stays in formats"},
    LibraryRule{"^yaml-cpp/.*", "^(tests/)?formats/.*", kAny, "yaml-cpp stays in formats"},
    LibraryRule{"^nlohmann/.*", "^(tests/.*|(formats|reducer|mechanism)/.*)", kAny, "common reads and writes no JSON"},
    LibraryRule{"^zlib\\.h", "^(tests/support/view|formats/page)/.*", 3, "zlib stays in formats/page"},
    LibraryRule{"^openssl/.*", "^common/.*", 1, "OpenSSL stays in one file of common"},
    LibraryRule{"^muParser.*", "^(formats|mechanism)/.*", 2,
                "muParser stays in one file of formats and one of mechanism"},
};

void check_library(const SourceTree& tree, const LibraryRule& rule, std::vector<Violation>& violations) {
  const std::regex headers(rule.headers), places(rule.places);
  std::set<std::string> files;
  for (const SourceFile& file : tree.files)
    for (const Include& include : file.includes) {
      if (!std::regex_match(include.target, headers)) continue;
      const bool is_in_place = std::regex_match(file.path, places);
      if (is_in_place && !file.path.starts_with("tests/")) files.insert(file.path);
      if (!is_in_place || files.size() > rule.most_files)
        violations.push_back({file.path, include.line, "includes <" + include.target + ">: " + rule.rule});
    }
}

/// Folders of the project that a folder may include.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"common", {"common"}},
    {"formats", {"common", "formats"}},
    {"meshes", {"common", "formats", "meshes"}},
    {"reducer", {"common", "formats", "reducer"}},
    {"mechanism", {"common", "formats", "mechanism"}},
};

void check_folders(const SourceFile& file, std::vector<Violation>& violations) {
  const bool is_test = file.path.starts_with("tests/");
  const auto allowed = kMayInclude.find(subject(file.path));
  if (allowed == kMayInclude.end()) return;
  for (const Include& include : file.includes) {
    const std::string folder = first_folder(include.target);
    if (!kMayInclude.contains(folder) || allowed->second.contains(folder)) continue;
    if (is_test && folder == "meshes") continue;
    violations.push_back({file.path, include.line, subject(file.path) + " may not include " + include.target});
  }
}

/// The two stages do not name each other, except in tests that run both programs and in the one file by which a study
/// starts the other program.
void check_names(const SourceFile& file, std::vector<Violation>& violations) {
  static const std::regex in_reducer(R"(\bmechanism::|namespace\s+mechanism|tisserand_mechanism)");
  static const std::regex in_mechanism(R"(\breducer\b|tisserand_reducer)");
  const std::string folder = first_folder(file.path);
  if (folder != "reducer" && folder != "mechanism") return;
  if (file.path == "mechanism/study/parts.cpp") return;
  const std::vector<std::string>& lines = file.is_source() ? file.code : file.lines;
  for (std::size_t i = 0; i < lines.size(); ++i)
    if (std::regex_search(lines[i], folder == "reducer" ? in_reducer : in_mechanism))
      violations.push_back({file.path, i + 1, "the two stages do not name each other"});
}

/// Numerics return reports: no files, no output, no environment, no clock.
void check_numerics(const SourceFile& file, std::vector<Violation>& violations) {
  static const std::array folders = {"mechanism/bodies/", "mechanism/joints/", "mechanism/forces/", "mechanism/solver/",
                                     "reducer/elements/"};
  static const std::set<std::string> headers = {"iostream", "fstream", "chrono", "filesystem",
                                                "cstdio",   "stdio.h", "ctime"};
  static const std::regex words(R"(\b(getenv|printf|puts|fopen|cout|cerr|clock_gettime)\b)");
  if (std::none_of(folders.begin(), folders.end(), [&](const char* f) { return file.path.starts_with(f); })) return;
  for (const Include& include : file.includes)
    if (headers.contains(include.target))
      violations.push_back({file.path, include.line, "numerics do not include <" + include.target + ">"});
  for (std::size_t i = 0; i < file.code.size(); ++i) {
    std::smatch match;
    if (std::regex_search(file.code[i], match, words))
      violations.push_back({file.path, i + 1, "numerics do not use " + match.str()});
  }
}

/// Algorithms of the library that move elements through a buffer aligned to 16 bytes have one home.
void check_sorting(const SourceFile& file, std::vector<Violation>& violations) {
  static const std::regex words(R"(\b(stable_sort|stable_partition|inplace_merge|get_temporary_buffer)\s*\()");
  if (file.path == "common/stable_sort.hpp") return;
  for (std::size_t i = 0; i < file.code.size(); ++i) {
    std::smatch match;
    if (std::regex_search(file.code[i], match, words))
      violations.push_back({file.path, i + 1, match.str(1) + " needs elements of small alignment: use sort_stably"});
  }
}

using Graph = std::map<std::string, std::set<std::string>>;

/// Depth-first search; every edge that closes a cycle is one violation that names the whole cycle.
std::vector<Violation> cycles_of(const Graph& graph, const std::string& what) {
  std::vector<Violation> violations;
  std::map<std::string, int> state;  // 1 on the path, 2 done
  std::vector<std::string> path;
  const std::function<void(const std::string&)> visit = [&](const std::string& node) {
    state[node] = 1;
    path.push_back(node);
    const auto edges = graph.find(node);
    if (edges != graph.end())
      for (const std::string& next : edges->second) {
        if (state[next] == 1) {
          std::string text = what;
          for (auto it = std::find(path.begin(), path.end(), next); it != path.end(); ++it) text += *it + " -> ";
          violations.push_back({next, 0, text + next});
        } else if (state[next] == 0) {
          visit(next);
        }
      }
    path.pop_back();
    state[node] = 2;
  };
  for (const auto& [node, edges] : graph)
    if (state[node] == 0) visit(node);
  return violations;
}

std::string without_ending(const std::string& path) { return path.substr(0, path.rfind('.')); }

/// The folder of a source. Sources in the folder of a stage itself, above its rooms, are programs and stories, each a
/// room of its own; those of `common` are one room.
std::string room_of(const std::string& stem) {
  const std::string folder = stem.substr(0, stem.rfind('/'));
  return folder.find('/') == std::string::npos && folder != "common" ? stem : folder;
}

void find_all(const SourceFile& file, const std::vector<std::string>& lines, const std::regex& pattern,
              const std::string& what, std::vector<Violation>& violations) {
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::smatch match;
    if (std::regex_search(lines[i], match, pattern))
      violations.push_back({file.path, i + 1, what + ": '" + match.str() + "'"});
  }
}

bool exists(const SourceTree& tree, const std::string& path) { return fs::exists(tree.root / path); }

/// The part of a source line after //, or the whole line of a page.
std::string prose(const SourceFile& file, std::size_t line) {
  if (file.is_page()) return file.lines[line];
  return file.lines[line].size() > file.code[line].size() ? file.lines[line].substr(file.code[line].size()) : "";
}

void check_named_files(const SourceTree& tree, const SourceFile& file, const std::set<std::string>& pages,
                       std::vector<Violation>& violations) {
  static const std::regex path(
      R"(\b(common|formats|mechanism|reducer|meshes|tests|examples|cmake|scripts)/[A-Za-z0-9_./-]+\.(md|cpp|hpp|yaml|csv|txt|cmake)\b)");
  static const std::regex page(R"(\b[A-Z][A-Z_]+\.md\b)");
  for (std::size_t i = 0; i < file.lines.size(); ++i) {
    const std::string text = prose(file, i);
    if (text.find('.') == std::string::npos) continue;
    for (std::sregex_iterator it(text.begin(), text.end(), path), end; it != end; ++it)
      if (!exists(tree, it->str()))
        violations.push_back({file.path, i + 1, "names a file that is not there: " + it->str()});
    for (std::sregex_iterator it(text.begin(), text.end(), page), end; it != end; ++it)
      if (!pages.contains(it->str()))
        violations.push_back({file.path, i + 1, "names a page that is not there: " + it->str()});
  }
}

std::set<std::string> keys_of(const std::string& text, const std::regex& key) {
  std::set<std::string> keys;
  for (std::sregex_iterator it(text.begin(), text.end(), key), end; it != end; ++it) keys.insert(it->str());
  return keys;
}

/// Source keys in prose that no table row "| [key] | ..." of CONVENTIONS.md explains.
void check_keys(const SourceTree& tree, std::vector<Violation>& violations) {
  static const std::regex key(R"(\[[A-Z][A-Za-z]{1,4}[0-9]{2}\])");
  std::set<std::string> known;
  for (const SourceFile& file : tree.files)
    if (file.path == "CONVENTIONS.md")
      for (const std::string& line : file.lines)
        if (line.starts_with("| [")) known.merge(keys_of(line.substr(0, line.find('|', 1)), key));
  for (const SourceFile& file : tree.files)
    for (std::size_t i = 0; (file.is_page() || file.is_source()) && i < file.lines.size(); ++i)
      for (const std::string& found : keys_of(prose(file, i), key))
        if (!known.contains(found)) violations.push_back({file.path, i + 1, "CONVENTIONS.md has no source " + found});
}

}  // namespace

SourceTree read_tree(const fs::path& root) {
  SourceTree tree{root, {}};
  for (auto it = fs::recursive_directory_iterator(root); it != fs::recursive_directory_iterator(); ++it) {
    const std::string name = it->path().filename().string();
    if (it->is_directory()) {
      const bool is_hidden = name.starts_with('.') && name != ".ci";
      const bool is_built = it.depth() == 0 && name.starts_with("build");
      if (is_hidden || is_built || name == "references" || name == "__pycache__" || name == "node_modules")
        it.disable_recursion_pending();
    } else if (it->is_regular_file() && is_text(it->path())) {
      tree.files.push_back(read_file(root, it->path()));
    }
  }
  std::sort(tree.files.begin(), tree.files.end(), [](auto& a, auto& b) { return a.path < b.path; });
  return tree;
}

std::vector<Violation> check_dependencies(const SourceTree& tree) {
  std::vector<Violation> violations;
  for (const LibraryRule& rule : kLibraryRules) check_library(tree, rule, violations);
  for (const SourceFile& file : tree.files) {
    check_folders(file, violations);
    check_names(file, violations);
    check_numerics(file, violations);
    check_sorting(file, violations);
  }
  return violations;
}

std::vector<Violation> check_cycles(const SourceTree& tree) {
  Graph headers, rooms;
  for (const SourceFile& file : tree.files)
    for (const Include& include : file.includes) {
      const std::string from = without_ending(file.path), to = without_ending(include.target);
      if (first_folder(from) != first_folder(to) || !include.target.ends_with(".hpp") || from == to) continue;
      if (file.is_header()) headers[from].insert(to);
      const std::string from_room = room_of(from), to_room = room_of(to);
      if (from_room != to_room) rooms[from_room].insert(to_room);
    }
  std::vector<Violation> violations = cycles_of(headers, "includes in a circle: ");
  const std::vector<Violation> between = cycles_of(rooms, "rooms in a circle: ");
  violations.insert(violations.end(), between.begin(), between.end());
  return violations;
}

std::vector<Violation> check_headers(const SourceTree& tree) {
  std::vector<Violation> violations;
  std::map<std::string, std::string> first_include;  // of each .cpp, by its path
  for (const SourceFile& file : tree.files)
    if (!file.is_header() && !file.includes.empty()) first_include[file.path] = file.includes.front().target;
  for (const SourceFile& file : tree.files) {
    if (!file.is_header()) continue;
    if (std::find(file.code.begin(), file.code.end(), "#pragma once") == file.code.end())
      violations.push_back({file.path, 0, "has no #pragma once"});
    const auto own = first_include.find(without_ending(file.path) + ".cpp");
    if (own != first_include.end() && own->second != file.path)
      violations.push_back({own->first, 0, "must include " + file.path + " first"});
  }
  return violations;
}

std::vector<Violation> check_lengths(const SourceTree& tree) {
  std::vector<Violation> violations;
  for (const SourceFile& file : tree.files) {
    const std::size_t most = file.is_header() ? 300 : 500;
    if (file.is_source() && file.length() > most)
      violations.push_back({file.path, 0, std::to_string(file.length()) + " lines, at most " + std::to_string(most)});
  }
  return violations;
}

std::vector<Violation> check_rooms(const SourceTree& tree) {
  constexpr int most = 30;
  std::map<std::string, int> count;
  for (const SourceFile& file : tree.files)
    if (file.is_source()) ++count[file.path.substr(0, file.path.rfind('/'))];
  std::vector<Violation> violations;
  for (const auto& [folder, files] : count)
    if (files > most)
      violations.push_back({folder, 0, std::to_string(files) + " sources, at most " + std::to_string(most)});
  return violations;
}

std::vector<Violation> check_stories(const SourceTree& tree) {
  constexpr std::size_t page = 80;
  static const std::set<std::string> stories = {"mechanism/simulate.cpp",           "mechanism/step/step.cpp",
                                                "mechanism/equations/evaluate.cpp", "mechanism/build/build_model.cpp",
                                                "mechanism/study/study.cpp",        "reducer/reduce.cpp"};
  std::vector<Violation> violations;
  for (const SourceFile& file : tree.files)
    if (stories.contains(file.path) && file.length() > page)
      violations.push_back({file.path, 0, std::to_string(file.length()) + " lines, a story has at most 80"});
  return violations;
}

std::vector<Violation> check_wording(const SourceTree& tree) {
  // Split, so that this file does not find itself.
  static const std::regex promises(
      "\\b(TO"
      "DO|FIX"
      "ME|XX"
      "X|not "
      "implemented|place"
      "holder|for "
      "now)\\b");
  static const std::regex places(
      "(^|[^A-Za-z0-9_.])/(wo"
      "rk|tm"
      "p|ho"
      "me)/");
  static const std::regex typography(
      "\xE2\x80\x94|\xE2\x80\x98|\xE2\x80\x99|\xE2\x80\x9C|\xE2\x80\x9D|\xEF\xBB\xBF|\r");
  static const std::regex blanks("[ \\t]+$");
  std::vector<Violation> violations;
  for (const SourceFile& file : tree.files) {
    find_all(file, file.lines, promises, "promises instead of doing", violations);
    find_all(file, file.lines, places, "names a place of one machine", violations);
    find_all(file, file.lines, typography, "typographic dash or quote, or foreign line end", violations);
    find_all(file, file.lines, blanks, "blanks at the end of the line", violations);
  }
  return violations;
}

std::vector<Violation> check_links(const SourceTree& tree) {
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<Violation> violations;
  std::set<std::string> pages;
  for (const SourceFile& file : tree.files)
    if (file.is_page()) pages.insert(fs::path(file.path).filename().string());
  check_keys(tree, violations);
  for (const SourceFile& file : tree.files) {
    if (!file.is_page() && !file.is_source()) continue;
    check_named_files(tree, file, pages, violations);
    if (!file.is_page()) continue;
    for (std::size_t i = 0; i < file.lines.size(); ++i)
      for (std::sregex_iterator it(file.lines[i].begin(), file.lines[i].end(), link), end; it != end; ++it) {
        const std::string whole = (*it)[1], target = whole.substr(0, whole.find('#'));
        if (target.empty() || target.find("://") != std::string::npos || target.starts_with("mailto:")) continue;
        if (!fs::exists((tree.root / file.path).parent_path() / target))
          violations.push_back({file.path, i + 1, "dead link: " + target});
      }
  }
  return violations;
}

std::string to_text(const std::vector<Violation>& violations) {
  std::string text;
  for (const Violation& v : violations)
    text += v.path + (v.line ? ":" + std::to_string(v.line) : "") + ": " + v.what + "\n";
  return text;
}

}  // namespace tisserand::architecture
