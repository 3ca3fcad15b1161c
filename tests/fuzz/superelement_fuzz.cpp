// Fuzzing target: any valid HDF5 container in place of a superelement gives a superelement or an Error, nothing else.
// The bytes say what the container holds (tests/formats/superelement_container.hpp); none: a sound superelement, which
// must be read.
#include <cstdio>
#include <cstdlib>
#include <string>

#include "common/error.hpp"
#include "formats/superelement.hpp"
#include "tests/formats/superelement_container.hpp"
#include "text_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string image = test_support::superelement_container(data, size);
  const std::string path = text_file(reinterpret_cast<const std::uint8_t*>(image.data()), image.size());
  try {
    formats::check(formats::read_superelement(path).superelement, path);
  } catch (const Error& error) {
    // The child process of hdf5::rehearse() has died, though the container is sound.
    const bool has_crashed = std::string(error.what()).find("HDF5 cannot read it") != std::string::npos;
    if (has_crashed || size == 0) {
      std::fprintf(stderr, "%s\n", error.what());
      std::abort();
    }
  }
  return 0;
}
