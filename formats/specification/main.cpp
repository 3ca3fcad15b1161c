// SPDX-License-Identifier: GPL-3.0-or-later
// specification FOLDER: writes schema/*.json and the tables of PART.md and SCENE.md below the root of the tree.
#include <cstdio>
#include <fstream>
#include <iterator>

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/text.hpp"
#include "formats/specification/specification.hpp"

namespace {

std::string content(const std::string& path) {
  std::ifstream stream(path);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void update(const std::string& path, const std::string& text) {
  if (content(path) == text) return;
  tisserand::write_text_file(path, text);
  fmt::print("written: {}\n", path);
}

}  // namespace

int main(int count, char** arguments) {
  using namespace tisserand::formats;
  const std::string root = count > 1 ? std::string(arguments[1]) + "/" : "";
  try {
    for (const FileKind& kind : file_kinds()) {
      update(root + kind.schema_file(), schema_text(kind));
      const std::string page = root + kind.page_file();
      update(page, with_field_tables(content(page), page, kind.sets));
    }
  } catch (const tisserand::Error& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  return 0;
}
