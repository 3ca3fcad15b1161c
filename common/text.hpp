// SPDX-License-Identifier: GPL-3.0-or-later
// Text helpers of readers and writers: nearest key, lists, printable text, files that appear complete or not at all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand {

/// Number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (optimal string
/// alignment), ignoring case. Cost: a.size() × b.size().
std::size_t edit_distance(const std::string& a, const std::string& b);

/// Member of `known` with the smallest edit distance to `word`. Nothing if more than a third of the letters differ
/// (limit at least one, at most three).
std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& known);

/// At most ten members of `known`, nearest first: first those that contain `word`, then by edit distance.
std::vector<std::string> nearest_names(const std::string& word, const std::vector<std::string>& known);

/// One text of all parts, with `separator` between them.
std::string join(const std::vector<std::string>& parts, const std::string& separator);

/// Short list of names that the user chose, on one line: the first ten, "a, b, c and 290 more". Use join() for words of
/// the program (keys, kinds, formats), whose lists are printed whole. `total`: number of all names if `names` holds
/// only the first.
std::string listed(const std::vector<std::string>& names, const std::string& separator = ", ", std::size_t total = 0);

/// Whether `text` matches `pattern`, in which * stands for any run of characters (also none, also with /).
bool matches_wildcard(const std::string& text, const std::string& pattern);

/// The text with \xNN in place of what could harm a terminal: control characters except line ends and tabs, marks that
/// change the writing direction, invalid UTF-8. Names and messages may come from untrusted files.
std::string printable(std::string_view text);

/// Result of printable() on one line: line ends and tabs become blanks, and "..." follows after `most` bytes.
std::string printable_line(std::string_view text, std::size_t most);

/// Text file written under a temporary name until publish(); without publish() nothing is left. Streams such as
/// /dev/stdout are written directly, through the program's own descriptor if the name refers to one. Throws Error.
class TextFile {
 public:
  explicit TextFile(const std::string& path);
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  void write(const std::string& text);
  void publish();
  /// Closes the complete file and returns its temporary name for publish_file(). Empty for a stream.
  std::string stage();

 private:
  std::string path_;
  std::string temporary_;
  int file_ = -1;
};

/// Writes `text` to a temporary file and renames it, so the file appears complete or not at all. Throws Error (no
/// permission, disk full).
void write_text_file(const std::string& path, const std::string& text);

/// New temporary name in the folder of `path`, unique per process, for a file that is not complete.
std::string temporary_beside(const std::string& path);

/// Renames `from` to `to` after its data have reached the disk. Throws Error and removes `from` on failure.
void publish_file(const std::string& from, const std::string& to);

/// Remedy for a failed system call by its errno, as text: "free some space", "choose a folder that exists", ...
std::string remedy_of_errno(int error_number);

}  // namespace tisserand
