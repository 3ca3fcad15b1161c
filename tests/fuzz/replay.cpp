// SPDX-License-Identifier: GPL-3.0-or-later
// Runs a fuzzing target over the files of its corpus, without libFuzzer: what ctest does with every compiler.
#include <sys/resource.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

constexpr double kMostSeconds = 10.0;    // for one file; hundredths are usual
constexpr long kMostMemory = 2'000'000;  // KiB of the whole process, sanitizers included

/// Processor time, which does not depend on what else the machine does.
double seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// False, with a line, if the file took too long or too much.
bool run(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const double start = seconds();
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  const double gone = seconds() - start;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  if (gone <= kMostSeconds && usage.ru_maxrss <= kMostMemory) return true;
  std::printf("%s: %.1f s, %ld KiB\n", path.c_str(), gone, usage.ru_maxrss);
  return false;
}

}  // namespace

/// replay FOLDER...: 0 if every file of the folders passes and there is at least one.
int main(int count, char** arguments) {
  std::vector<std::filesystem::path> files;
  for (int k = 1; k < count; ++k)
    for (const auto& entry : std::filesystem::directory_iterator(arguments[k]))
      if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  const bool all = std::all_of(files.begin(), files.end(), run);
  std::printf("%zu files\n", files.size());
  return all && !files.empty() ? 0 : 1;
}
