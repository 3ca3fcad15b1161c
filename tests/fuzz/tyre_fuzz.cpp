// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as a tyre property file give coefficients or an Error, nothing else, in SI and in mm and t.
#include "common/error.hpp"
#include "formats/tyres/tyre_property_file.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string path = text_file(data, size);
  Units small;
  small.length = length_unit("mm");
  small.mass = mass_unit("t");
  small.time = time_unit("s");
  for (const Units& units : {Units::si(), small, Units::consistent()}) {
    try {
      static_cast<void>(formats::read_tyre_property_file(path, units, {{"LMUX", 0.5}}));
    } catch (const Error&) {
    }
  }
  return 0;
}
