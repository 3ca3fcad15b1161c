// A script on gnuplot's standard input, a picture beside its name until it is whole.
#include "common/gnuplot.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>

#include "common/child.hpp"
#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {
namespace {

/// Feeds the script to gnuplot (-d: without the user's settings) and waits. Throws Error with gnuplot's message.
void run_gnuplot(const std::string& script) {
  if (!is_program("gnuplot"))
    throw Error("gnuplot is not installed", "plot", "install it with: apt-get install gnuplot-nox");
  ChildRequest request;
  request.words = {"gnuplot", "-d"};
  request.input = script;
  const ChildReport report = run_child(request);
  if (report.ending != ChildEnding::left || report.code != 0)
    throw Error("gnuplot failed: " + report.text + report.complaint, "plot", "try other ranges or channels");
}

/// gnuplot does not notice a full disk: a picture that was cut short lacks its end.
bool is_whole(const std::string& picture) {
  const std::string end = picture.ends_with(".png") ? std::string("IEND\xae\x42\x60\x82") : std::string("</svg>");
  std::ifstream file(picture, std::ios::binary);
  file.seekg(0, std::ios::end);
  const std::streamoff size = file.tellg(), tail = std::min<std::streamoff>(size, 64);
  std::string text(tail > 0 ? static_cast<std::size_t>(tail) : 0, '\0');
  file.seekg(size - tail);
  return !text.empty() && file.read(text.data(), tail) && text.find(end) != std::string::npos;
}

}  // namespace

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f)
      throw Error("control character in the text '" + text + "'", "plot", "use a text of one line without tabs");
    quoted += c;
    if (c == '\'') quoted += '\'';
  }
  return quoted + "'";
}

void draw_with_gnuplot(const std::string& output,
                       const std::function<std::string(const std::string& picture)>& script) {
  const std::filesystem::path path(output);
  const std::string folder = path.has_parent_path() ? path.parent_path().string() : ".";
  if (::access(folder.c_str(), W_OK | X_OK) != 0)
    throw Error("cannot write into the folder '" + folder + "'", output, remedy_of_errno(errno));
  const std::filesystem::path picture = temporary_beside(output) + path.extension().string();
  try {
    run_gnuplot(script(picture.string()));
    if (!std::filesystem::exists(picture))
      throw Error("the picture could not be written", output, "check that its folder exists and may be written");
    if (!is_whole(picture.string()))
      throw Error("the picture could not be written to its end: the disk is full, or files may not grow so large",
                  output, remedy_of_errno(ENOSPC));
    publish_file(picture.string(), output);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(picture, ignored);
    throw;
  }
}

}  // namespace tisserand
