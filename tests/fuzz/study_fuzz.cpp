// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as study.yaml give a Study or an Error, nothing else.
#include "common/error.hpp"
#include "formats/study/study.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  try {
    static_cast<void>(formats::read_study(text_file(data, size)));
  } catch (const Error&) {
  }
  return 0;
}
