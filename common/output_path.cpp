// SPDX-License-Identifier: GPL-3.0-or-later
// Checks the path of an output before the work for it begins.
#include "common/output_path.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string_view>

#include "common/error.hpp"
#include "common/text.hpp"

namespace tisserand {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view hdf5_signature{"\x89HDF\r\n\x1a\n", 8};

/// Whether `path` is a file other than HDF5. Empty and unreadable files do not count: writing reports the latter.
bool is_of_another_kind(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(hdf5_signature.size(), '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  const auto count = static_cast<std::size_t>(file.gcount());
  return count > 0 && head.substr(0, count) != hdf5_signature.substr(0, count);
}

void require_folder(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return;
  const int number = errno;
  throw Error(fmt::format("cannot write to the folder '{}': {}", folder, std::strerror(number)), path,
              remedy_of_errno(number));
}

/// Endings of two parts, each of which marks one kind of file of this project.
constexpr std::array<std::string_view, 8> own_endings{".superelement.h5",  ".companion.h5",    ".recovery.h5",
                                                      ".modal.h5",         ".checkpoint.h5",   ".results.h5",
                                                      ".certificate.json", ".certificate.html"};

std::string ending_of(const std::string& path) {
  for (const std::string_view own : own_endings)
    if (path.ends_with(own)) return std::string(own);
  return fs::path(path).extension().string();
}

}  // namespace

std::string without_ending(const std::string& path, const std::vector<std::string>& endings) {
  for (const std::string& ending : endings)
    if (path.size() > ending.size() && path.ends_with(ending)) return path.substr(0, path.size() - ending.size());
  return path;
}

bool is_stream(const std::string& path) {
  if (path == "-") return true;
  if (path.starts_with("/dev/") && !path.starts_with("/dev/shm/")) return true;
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

void require_output(const std::string& path, const std::vector<std::string>& endings,
                    const std::vector<std::string>& inputs) {
  if (path.empty()) throw Error("the name of the output file is empty", "-o", "give the name of a file");
  const bool is_hdf5 = std::ranges::any_of(endings, [](const std::string& one) { return one.ends_with(".h5"); });
  if (is_stream(path)) {
    if (is_hdf5) throw Error("is a device or pipe, not a file", path, "give -o the name of a file");
    return;
  }
  std::error_code ignored;
  if (path.ends_with('/') || fs::is_directory(path, ignored))
    throw Error("is a folder, not a file", path, "give -o the name of a file");
  require_folder(path);
  for (const std::string& input : inputs)
    if (fs::equivalent(input, path, ignored))
      throw Error("the output would replace its own input", path, "give -o another name");
  if (std::ranges::find(endings, ending_of(path)) == endings.end())
    throw Error("does not end in " + join(endings, " or "), path,
                "give -o a name with such an ending: other endings belong to other kinds of file");
  if (is_hdf5 && is_of_another_kind(path))
    throw Error("exists and is a file of another kind (not HDF5)", path,
                "give -o another name, or remove that file first");
}

}  // namespace tisserand
