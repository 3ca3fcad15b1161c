// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any valid HDF5 container in place of a superelement gives a superelement or an Error, nothing else.
// The bytes say what the container holds (tests/formats/hdf5/mutated_container.hpp); none: a sound superelement, which
// must be read.
#include "container_target.hpp"
#include "formats/superelement/superelement.hpp"
#include "tests/support/bodies/beam_superelement.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  static const std::string sound = sound_file("superelement", [](const std::string& path) {
    formats::Superelement beam = test_support::craig_bampton_beam(test_support::BeamData(), 1);
    formats::write_superelement(path, beam);
  });
  run_container(sound, data, size, false,
                [](const std::string& path) { formats::check(formats::read_superelement(path).superelement, path); });
  return 0;
}
