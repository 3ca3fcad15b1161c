// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as matrices of Abaqus, CalculiX, Matrix Market or FEDEM give a superelement or an Error,
// nothing else. The first byte chooses the format (a, c, m, f); a line "====" begins the next file.
#include <algorithm>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "common/error.hpp"
#include "reducer/exchange/abaqus_matrix.hpp"
#include "reducer/exchange/calculix_matrix.hpp"
#include "reducer/exchange/fmx.hpp"
#include "reducer/exchange/matrix_market.hpp"
#include "reducer/exchange/places.hpp"
#include "reducer/exchange/to_superelement.hpp"
#include "text_file.hpp"

namespace {

using namespace tisserand::reducer::exchange;

/// The next part of the text as a file of the name of `path` with `ending`.
std::string next_file(std::string_view& text, const std::string& path, const std::string& ending) {
  const std::size_t end = std::min(text.find("====\n"), text.size());
  const std::string file = path + ending;
  if (std::FILE* stream = std::fopen(file.c_str(), "wb")) {
    std::fwrite(text.data(), 1, end, stream);
    std::fclose(stream);
  }
  text.remove_prefix(std::min(end + 5, text.size()));
  return file;
}

ReducedMatrices read(char format, std::string_view text, const std::string& path) {
  const std::string first = next_file(text, path, ".sti"), second = next_file(text, path, ".mas"),
                    third = next_file(text, path, ".dof"), fourth = next_file(text, path, ".csv");
  if (format == 'm') return read_matrix_market({first, second, third});
  if (format == 'f') return read_fmx({first, second, third});
  ReducedMatrices matrices =
      format == 'c' ? read_calculix_matrices(first, {9}) : read_abaqus_matrices({first, second}, {9});
  matrices.places = read_places(fourth);
  return matrices;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string path = tisserand::text_file(data, 0);
  try {
    static_cast<void>(
        to_superelement(read(static_cast<char>(data[0]), {reinterpret_cast<const char*>(data) + 1, size - 1}, path),
                        {"part", tisserand::Units::si(), {}}));
  } catch (const tisserand::Error&) {
  }
  return 0;
}
