// Fuzzing target: any valid HDF5 container in place of a superelement gives a superelement or an Error, nothing else.
// The bytes say what the container holds (tests/formats/superelement/superelement_container.hpp); none: a sound
// superelement, which must be read.
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "formats/hdf5/file.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/formats/superelement/superelement_container.hpp"
#include "text_file.hpp"

namespace tisserand::formats::hdf5 {

/// In place of the child process of formats/hdf5/rehearsal.cpp, which would hide a crash behind an Error and costs a
/// fork: the containers are sound, so nothing may crash here.
void rehearse(const std::string&, const std::function<void()>&) {}
bool survives(const std::vector<std::string>&, const std::function<void(const std::string&)>&) { return true; }

}  // namespace tisserand::formats::hdf5

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  const std::string image = test_support::superelement_container(data, size);
  const std::string path = text_file(reinterpret_cast<const std::uint8_t*>(image.data()), image.size());
  try {
    formats::check(formats::read_superelement(path).superelement, path);
  } catch (const Error& error) {
    if (size > 0) return 0;
    std::fprintf(stderr, "the sound superelement is refused: %s\n", error.what());
    std::abort();
  }
  return 0;
}
