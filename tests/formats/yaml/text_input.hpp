// SPDX-License-Identifier: GPL-3.0-or-later
// Texts as files for the tests of the readers of part.yaml and scene.yaml.
#pragma once

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <ostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/yaml/override.hpp"

namespace tisserand::formats {

/// A folder that disappears with the object.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "tisserand-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(path_ + "/" + name, std::ios::binary) << text;
    return path_ + "/" + name;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("the test text has no '" + from + "'");
  return text.replace(at, from.size(), to);
}

inline std::string replaced_all(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

/// A text without its mark ^, and the place of the mark as file:line:column.
struct Marked {
  std::string text;
  std::string place;
};

inline Marked take_mark(const std::string& text, const std::string& file) {
  const std::size_t at = text.find('^');
  if (at == std::string::npos) return {text, ""};
  const auto line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const std::size_t begin = text.rfind('\n', at) + 1;  // npos + 1 = 0
  return {text.substr(0, at) + text.substr(at + 1), fmt::format("{}:{}:{}", file, line, at - begin + 1)};
}

/// A change of a good text and the whole error text that it must give; ^ in the change (which is taken out) is the
/// place that stands for ^ in the error.
struct BadText {
  std::string from;
  std::string to;
  std::string expected;

  friend std::ostream& operator<<(std::ostream& out, const BadText& bad) { return out << bad.to; }
};

/// Overrides from "path=value" texts.
inline std::vector<Override> overrides(const std::vector<std::string>& texts) {
  std::vector<Override> list;
  for (const std::string& text : texts) list.push_back(parse_override(text));
  return list;
}

/// The text of the Error that `read(path)` throws, without the folder; "" if it throws none.
template <class Read>
std::string error_of(const Folder& folder, const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    std::string text = error.what();
    const std::string prefix = folder.path() + "/";
    for (std::size_t at = text.find(prefix); at != std::string::npos; at = text.find(prefix))
      text.erase(at, prefix.size());
    return text;
  }
  return "";
}

}  // namespace tisserand::formats
