// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as a table of numbers over time give a table or an Error, nothing else, by the names of
// columns and by their numbers.
#include "common/error.hpp"
#include "formats/tables/csv_table.hpp"
#include "formats/tables/input_table.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  if (size >= 4 && data[0] == 0x89) return 0;  // HDF5 has a target of its own
  const std::string path = text_file(data, size);
  for (const auto& [time, value] : {std::pair("1", "2"), std::pair("t", "x")}) {
    try {
      static_cast<void>(formats::read_input_table({path, time, value}));
    } catch (const Error&) {
    }
  }
  try {
    static_cast<void>(formats::read_csv_table(path));
  } catch (const Error&) {
  }
  return 0;
}
