// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any bytes as Nastran bulk data give a Deck or an Error, nothing else. A first byte '!' ignores
// unknown cards.
#include <string>

#include "common/error.hpp"
#include "reducer/decks/deck.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const bool ignores = size > 0 && data[0] == '!';
  const std::string path = text_file(data + (ignores ? 1 : 0), size - (ignores ? 1 : 0));
  try {
    static_cast<void>(
        reducer::read_nastran(path, {ignores ? reducer::UnknownCards::ignore : reducer::UnknownCards::refuse}));
  } catch (const Error&) {
  }
  return 0;
}
