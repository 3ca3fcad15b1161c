// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as a DMIG punch file give a superelement or an Error, nothing else.
#include <string>

#include "common/error.hpp"
#include "reducer/exchange/dmig.hpp"
#include "reducer/exchange/to_superelement.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string path = text_file(data, size);
  try {
    static_cast<void>(reducer::exchange::to_superelement(reducer::exchange::read_dmig({path, "", "KAAX", "MAAX"}),
                                                         {"part", Units::si(), {}}));
  } catch (const Error&) {
  }
  return 0;
}
