// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any valid HDF5 container in place of a companion gives a companion or an Error, nothing else. The
// bytes say what the container holds (tests/formats/hdf5/mutated_container.hpp); none: a sound one, which must be read.
#include "container_target.hpp"
#include "formats/companion/companion.hpp"
#include "tests/support/bodies/second_order_network.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  static const test_support::SecondOrderBody body = [] {
    auto network = test_support::second_order_network(1, Eigen::Vector4d(0.25, 0.25, 0.25, 0.25));
    test_support::add_trapped_stress(network);
    return network;
  }();
  static const std::string sound = sound_file("companion", [](const std::string& path) {
    formats::Companion companion = body.companion;
    formats::write_companion(path, companion, body.element);
  });
  run_container(sound, data, size, false,
                [](const std::string& path) { static_cast<void>(formats::read_companion(path, body.element)); });
  return 0;
}
