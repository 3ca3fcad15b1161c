// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as the CSV file of a reference history give a history or an Error, nothing else, by the
// names of columns and by their numbers.
#include "common/error.hpp"
#include "mechanism/histories/series.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string path = text_file(data, size);
  for (const auto& [x, y] : {std::pair("1", "2"), std::pair("t", "x")}) {
    try {
      static_cast<void>(mechanism::read_reference({path, x, y, "reference"}));
    } catch (const Error&) {
    }
  }
  return 0;
}
