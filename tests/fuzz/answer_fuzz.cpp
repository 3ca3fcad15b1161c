// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as the answer of the program that runs gmsh give a mesh or an Error, nothing else.
#include <cstdint>
#include <string>

#include "common/error.hpp"
#include "reducer/mesher/parcel.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  try {
    static_cast<void>(reducer::unpack_answer({reinterpret_cast<const char*>(data), size}, "strange.geo"));
  } catch (const Error&) {
  }
  return 0;
}
