// SPDX-License-Identifier: GPL-3.0-or-later
// Call of `reducer run` as a child process.
#include "mechanism/study/parts.hpp"

#include <filesystem>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand::mechanism {
namespace {

/// Path of `reducer`: in the folder of this program, else on the PATH; empty: not found.
std::string reducer_program() {
  const std::string beside = (std::filesystem::path(own_program()).parent_path() / "reducer").string();
  if (is_program(beside)) return beside;
  return is_program("reducer") ? "reducer" : "";
}

}  // namespace

void reduce_part(const PartRequest& part, const std::function<bool()>& is_stopped) {
  if (std::filesystem::exists(part.superelement)) return;
  const std::string program = reducer_program();
  if (program.empty())
    throw Error(fmt::format("this study reduces part '{}', but the program reducer is missing", part.name), part.file,
                "install it, or vary only settings that use existing superelement files");
  std::filesystem::create_directories(std::filesystem::path(part.superelement).parent_path());
  ChildRequest request;
  request.words = {program, "run", part.file, "-o", part.superelement};
  for (const std::string& word : setting_words(part.settings)) request.words.push_back(word);
  request.is_stopped = is_stopped;
  const ChildReport report = run_child(request);
  if (report.ending == ChildEnding::stopped) return;
  if (report.ending != ChildEnding::left || report.code != 0)
    throw Error(fmt::format("the part could not be reduced: {}", printable_line(report.complaint, 500)), part.file,
                "see `reducer run --help`");
}

}  // namespace tisserand::mechanism
