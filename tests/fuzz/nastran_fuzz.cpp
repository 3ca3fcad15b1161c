// Fuzzing target: any bytes as a Nastran deck give a mesh or an Error, nothing else.
#include "common/error.hpp"
#include "reducer/decks/deck.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const auto unknown = size % 2 == 0 ? reducer::UnknownCards::ignore : reducer::UnknownCards::refuse;
  try {
    reducer::read_nastran(text_file(data, size), {unknown});
  } catch (const Error&) {
  }
  return 0;
}
