// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any valid HDF5 container in place of a modal body gives a modal body or an Error, nothing else. The
// bytes are as in superelement_fuzz.cpp; none: the rod of [GA00] 4.3 with two modes, which must be read.
#include "container_target.hpp"
#include "formats/modal_body/modal_body.hpp"
#include "tests/support/bodies/lumped_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  static const std::string sound = sound_file("modal", [](const std::string& path) {
    const test_support::LumpedModel rod = test_support::lumped_rod(test_support::paper_rod());
    formats::write_modal_body(path, test_support::modal_body(rod, test_support::rod_conditions(8), 2));
  });
  run_container(sound, data, size, false,
                [](const std::string& path) { static_cast<void>(formats::read_modal_body(path)); });
  return 0;
}
