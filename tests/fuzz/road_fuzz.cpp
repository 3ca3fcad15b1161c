// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as a table of heights or an OpenCRG file give heights whose faults are told, or an Error,
// nothing else.
#include "common/error.hpp"
#include "formats/roads/crg.hpp"
#include "formats/roads/height_grid_file.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand::formats;
  const std::string path = tisserand::text_file(data, size);
  const auto try_to = [](const auto& read) {
    try {
      static_cast<void>(fault_of(read()));
    } catch (const tisserand::Error&) {
    }
  };
  try_to([&] { return read_crg(path); });
  try_to([&] { return read_height_grid(path, std::nullopt); });
  try_to([&] { return read_height_grid(path, RegularGrid{0.0, -1.0, 0.5}); });
  return 0;
}
