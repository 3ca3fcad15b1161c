// Small text helpers of readers and writers: nearest key, join, and files that appear whole or not at all.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tisserand {

/// Number of insertions, deletions, substitutions and swaps of neighbours that turn `a` into `b` (optimal string
/// alignment), upper and lower case taken as equal. Cost: a.size() × b.size().
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The member of `known` with the smallest edit distance to `word`, or nothing if even that one differs in more than a
/// third of its letters (at least one, at most three).
std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& known);

/// The members of `known` nearest to `word`, the nearest first, at most ten: those that hold it, then by edit distance.
std::vector<std::string> nearest_names(const std::string& word, const std::vector<std::string>& known);

/// The parts with `separator` between them.
std::string join(const std::vector<std::string>& parts, const std::string& separator);

/// Names of the user's things for one line of a note, an error or a report: the first ten, "a, b, c and 290 more".
/// Lists of words that the program knows (keys, kinds, formats) are told whole, by join(). `total`: how many there are,
/// where `names` holds only the first ones.
std::string listed(const std::vector<std::string>& names, const std::string& separator = ", ", std::size_t total = 0);

/// Whether `text` matches `pattern`, in which * stands for any run of characters (also none, also with /).
bool matches_wildcard(const std::string& text, const std::string& pattern);

/// The text with what terminals would obey or stumble over as \xNN: control characters but line ends and tabs, marks
/// that turn the direction of writing, and bytes that are no UTF-8. Names and messages may come from damaged or foreign
/// files.
std::string printable(std::string_view text);

/// The same in one line: blanks for line ends and tabs; at most `most` bytes, then "...".
std::string printable_line(std::string_view text, std::size_t most);

/// A text file that grows beside its name and takes it in publish(); without that, nothing is left. Streams such as
/// /dev/stdout are written as they are, those of the program where it stands in them. Throws Error.
class TextFile {
 public:
  explicit TextFile(const std::string& path);
  ~TextFile();
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  void write(const std::string& text);
  void publish();
  /// Closes the complete file under its temporary name, which is returned for publish_file(); empty for a stream.
  std::string stage();

 private:
  std::string path_;
  std::string temporary_;
  int file_ = -1;
};

/// Writes `text` beside `path` and renames: the file appears whole or not at all. Throws Error (no permission, disk
/// full).
void write_text_file(const std::string& path, const std::string& text);

/// Name of the temporary file that write helpers use beside `path` until it is complete (same folder, unique per
/// process).
std::string temporary_beside(const std::string& path);

/// Renames `from` to `to` after the data of `from` have reached the disk. Throws Error and removes `from` on failure.
void publish_file(const std::string& from, const std::string& to);

/// What the user can do about a failed system call, by its errno: "free some space", "choose a folder that exists", ...
std::string remedy_of_errno(int error_number);

}  // namespace tisserand
