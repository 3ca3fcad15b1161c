// SPDX-License-Identifier: GPL-3.0-or-later
// Fuzzing target: any valid HDF5 container in place of a results file or a checkpoint gives what all commands, and the
// inputs of a scene, read of it, or an Error, nothing else. The first byte says which; the others are as in
// superelement_fuzz.cpp. None: sound results of three rows, which must be read. A checkpoint without its content_id is
// refused, after it was read.
#include "container_target.hpp"
#include "formats/results/checkpoint.hpp"
#include "formats/results/results.hpp"
#include "formats/tables/input_table.hpp"
#include "tests/support/results_rows.hpp"

namespace tisserand {
namespace {

void write_results(const std::string& path) {
  const formats::ResultsLayout layout = test_support::example_layout();
  formats::ResultsWriter writer(path, layout);
  formats::ResultsRow row;
  row.resize(layout);
  for (int t = 0; t < 3; ++t) {
    test_support::fill_row(t, row);
    writer.append(row);
  }
  writer.finish(true, "", "{}");
}

void read_results(const std::string& path) {
  const formats::ResultsReader reader(path);
  const std::string texts = reader.reason() + reader.report_json() + reader.scene();
  const std::vector<double> time = reader.time();
  std::vector<std::string> names;
  for (const formats::Channel& channel : reader.channels()) names.push_back(channel.name);
  if (!names.empty()) static_cast<void>(reader.read(names.back()));
  static_cast<void>(reader.read_rows(names, 0, reader.rows()));
  static_cast<void>(formats::read_input_table({path, "time", "energy/total"}));
}

void write_checkpoint(const std::string& path) {
  formats::write_checkpoint(
      path, {"scene", "mechanism", "fingerprint", 1, 0.5, "a.results.h5", "run", 3, {1.0, 2.0, 3.0}, {4.0, 5.0}, ""});
}

}  // namespace
}  // namespace tisserand

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tisserand;
  static const std::string results = sound_file("results", write_results);
  static const std::string checkpoint = sound_file("checkpoint", write_checkpoint);
  if (size > 0 && data[0] % 2 == 1)
    run_container(checkpoint, data + 1, size - 1, true, [](const std::string& path) {
      if (formats::is_checkpoint(path)) static_cast<void>(formats::read_checkpoint(path));
    });
  else
    run_container(results, data + (size > 0), size - (size > 0), false, read_results);
  return 0;
}
