// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any valid HDF5 container in place of a recovery file gives all that a reader takes from it, or an
// Error, nothing else. The bytes are as in superelement_fuzz.cpp; the content_id is needed.
#include "container_target.hpp"
#include "formats/recovery/recovery.hpp"
#include "tests/support/bodies/small_recovery.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  static const std::string sound = sound_file("recovery", test_support::write_small_recovery);
  run_container(sound, data, size, true, [](const std::string& path) {
    const formats::RecoveryReader reader(path);
    for (const formats::RecoveryField field : formats::recovery_fields)
      static_cast<void>(reader.read(field, 0, formats::items(reader.recovery(), field)));
    for (const formats::RecoveryField field : {formats::RecoveryField::translation, formats::RecoveryField::rotation})
      static_cast<void>(reader.read_second_order(field, 0, reader.recovery().nodes()));
  });
  return 0;
}
