// SPDX-License-Identifier: GPL-3.0-or-later
// Edit distance, wildcards, printable text, and files that are written under a temporary name and renamed.
#include "common/text.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <string_view>
#include <utility>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/temporaries.hpp"

namespace tisserand {
namespace {

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

/// UTF-8 sequence at the beginning of a text: its length and value, or length 0 if it is invalid.
struct Character {
  std::size_t length = 0;
  unsigned value = 0;
};

Character first_character(std::string_view text) {
  const auto byte = [text](std::size_t k) { return static_cast<unsigned char>(text[k]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {1, lead};
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4 || text.size() < length) return {};
  unsigned value = lead & (0x7fU >> length);
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(k) & 0xc0U) != 0x80U) return {};
    value = value << 6U | (byte(k) & 0x3fU);
  }
  constexpr std::array<unsigned, 5> least{0, 0, 0x80, 0x800, 0x10000};
  if (value < least[length] || value > 0x10ffff || (value >= 0xd800 && value < 0xe000)) return {};
  return {length, value};
}

bool is_harmless(unsigned value) {
  const bool turns = (value >= 0x202a && value <= 0x202e) || (value >= 0x2066 && value <= 0x2069) || value == 0x200e ||
                     value == 0x200f || value == 0x2028 || value == 0x2029;
  return value >= 0x20 && (value < 0x7f || value > 0x9f) && !turns;
}

[[noreturn]] void fail(const std::string& action, const std::string& path, int number) {
  throw Error(fmt::format("{}: {}", action, std::strerror(number)), path, remedy_of_errno(number));
}

/// The text with \xNN for unsafe characters, cut after `most` bytes. With `one_line`, line ends and tabs become blanks.
std::string escaped(std::string_view text, bool one_line, std::size_t most) {
  std::string result;
  while (!text.empty()) {
    const Character c = first_character(text);
    const std::size_t length = std::max<std::size_t>(c.length, 1);
    const bool blank = text[0] == '\n' || text[0] == '\t' || (one_line && text[0] == '\r');
    std::string piece(text.substr(0, length));
    if (blank && one_line)
      piece = " ";
    else if (!blank && (c.length == 0 || !is_harmless(c.value))) {
      std::string bytes;
      for (const char byte : piece) bytes += fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
      piece = bytes;
    }
    if (result.size() + piece.size() > most) return result + "...";
    result += piece;
    text.remove_prefix(length);
  }
  return result;
}

/// Own descriptor that a name such as /dev/stdout or /dev/fd/5 refers to, or -1.
int own_stream(const std::string& path) {
  if (path == "-" || path == "/dev/stdout") return STDOUT_FILENO;
  if (path == "/dev/stderr") return STDERR_FILENO;
  constexpr std::string_view folder = "/dev/fd/";
  int number = -1;
  if (!path.starts_with(folder)) return number;
  const char* end = path.data() + path.size();
  return std::from_chars(path.data() + folder.size(), end, number).ptr == end ? number : -1;
}

}  // namespace

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1;
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + change});
      if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]))
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::optional<std::string> nearest(const std::string& word, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  std::size_t smallest = 0;
  for (const std::string& candidate : known) {
    const std::size_t limit = std::clamp<std::size_t>(std::max(word.size(), candidate.size()) / 3, 1, 3);
    const std::size_t longer = std::max(word.size(), candidate.size()),
                      shorter = std::min(word.size(), candidate.size());
    if (longer - shorter > limit) continue;
    const std::size_t distance = edit_distance(word, candidate);
    if (distance <= limit && (!best || distance < smallest)) {
      best = candidate;
      smallest = distance;
    }
  }
  return best;
}

std::vector<std::string> nearest_names(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t most = 10;
  std::vector<std::pair<std::size_t, std::size_t>> ranked;  // distance, index
  for (std::size_t i = 0; i < known.size(); ++i) {
    const bool holds = !word.empty() && known[i].find(word) != std::string::npos;
    ranked.emplace_back(holds ? 0 : 1 + edit_distance(word, known[i]), i);
  }
  std::sort(ranked.begin(), ranked.end());
  std::vector<std::string> names;
  for (std::size_t i = 0; i < std::min(most, ranked.size()); ++i) names.push_back(known[ranked[i].second]);
  return names;
}

std::string join(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) text += separator;
    text += parts[i];
  }
  return text;
}

std::string listed(const std::vector<std::string>& names, const std::string& separator, std::size_t total) {
  constexpr std::size_t shown = 10;
  total = std::max(total, names.size());
  const auto count = static_cast<std::ptrdiff_t>(std::min(shown, names.size()));
  const std::string text = join({names.begin(), names.begin() + count}, separator);
  const std::size_t more = total - static_cast<std::size_t>(count);
  return more == 0 ? text : fmt::format("{} and {} more", text, more);
}

std::string printable(std::string_view text) { return escaped(text, false, std::string::npos); }

std::string printable_line(std::string_view text, std::size_t most) { return escaped(text, true, most); }

bool matches_wildcard(const std::string& text, const std::string& pattern) {
  std::size_t t = 0, p = 0, star = std::string::npos, resume = 0;
  while (t < text.size()) {
    if (p < pattern.size() && pattern[p] == '*') {
      star = p++;
      resume = t;
    } else if (p < pattern.size() && pattern[p] == text[t]) {
      ++p;
      ++t;
    } else if (star != std::string::npos) {
      p = star + 1;
      t = ++resume;
    } else {
      return false;
    }
  }
  while (p < pattern.size() && pattern[p] == '*') ++p;
  return p == pattern.size();
}

std::string remedy_of_errno(int error_number) {
  switch (error_number) {
    case ENOSPC:
    case EDQUOT:
      return "free some space or write to another disk";
    case EACCES:
    case EPERM:
    case EROFS:
      return "choose a place that you may write to";
    case ENOENT:
    case ENOTDIR:
      return "choose a folder that exists, or create it first";
    case EISDIR:
      return "give the name of a file, not of a folder";
    case ENOMEM:
      return "close other programs, raise the limit (`ulimit -v`), or make the model smaller";
    default:
      return "choose another place or name";
  }
}

std::string temporary_beside(const std::string& path) {
  static std::atomic<unsigned> counter{0};
  std::string name = fmt::format("{}.tmp-{}-{}", path, ::getpid(), counter.fetch_add(1));
  note_temporary(name);
  return name;
}

TextFile::TextFile(const std::string& path) : path_(path) {
  if (is_stream(path)) {
    // Opening a file behind the stream by its name would write from its beginning, over what the shell's >> must keep.
    const int own = own_stream(path);
    file_ = own >= 0 ? ::fcntl(own, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (file_ < 0) fail("cannot open", path_, errno);
    return;
  }
  temporary_ = temporary_beside(path);
  file_ = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
  if (file_ < 0) fail("cannot create the file", path_, errno);
}

TextFile::~TextFile() {
  if (file_ < 0) return;
  ::close(file_);
  if (temporary_.empty()) return;
  ::unlink(temporary_.c_str());
  forget_temporary(temporary_);
}

void TextFile::write(const std::string& text) {
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t written = ::write(file_, text.data() + done, text.size() - done);
    if (written < 0 && errno == EINTR) continue;
    if (written < 0 && errno == EPIPE) return;  // the reader has left
    if (written < 0) fail("cannot write the file", path_, errno);
    done += static_cast<std::size_t>(written);
  }
}

void TextFile::publish() {
  if (::fsync(file_) != 0 && errno != EINVAL && errno != EROFS) fail("cannot write the file", path_, errno);
  const auto lock = publishing();
  if (!temporary_.empty() && ::rename(temporary_.c_str(), path_.c_str()) != 0)
    fail("cannot move the complete file to its name", path_, errno);
  forget_temporary(temporary_);
  ::close(file_);
  file_ = -1;
}

std::string TextFile::stage() {
  if (::fsync(file_) != 0 && errno != EINVAL && errno != EROFS) fail("cannot write the file", path_, errno);
  ::close(file_);
  file_ = -1;
  return temporary_;
}

void publish_file(const std::string& from, const std::string& to) {
  const int file = ::open(from.c_str(), O_RDONLY | O_CLOEXEC);
  int number = file < 0 ? errno : 0;
  if (file >= 0 && ::fsync(file) != 0) number = errno;
  if (file >= 0) ::close(file);
  const auto lock = publishing();
  const bool moved = number == 0 && ::rename(from.c_str(), to.c_str()) == 0;
  if (!moved && number == 0) number = errno;
  if (!moved) ::unlink(from.c_str());
  forget_temporary(from);
  if (moved) return;
  fail("cannot write the file", to, number);
}

void write_text_file(const std::string& path, const std::string& text) {
  TextFile file(path);
  file.write(text);
  file.publish();
}

}  // namespace tisserand
