// SPDX-License-Identifier: GPL-3.0-or-later
// Writes and reads checkpoints.
#include "formats/results/checkpoint.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/error.hpp"
#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/hdf5/file.hpp"

namespace tisserand::formats {
namespace {

constexpr const char* format_name = "tisserand-checkpoint";
constexpr std::uint64_t max_numbers = std::uint64_t{1} << 32;

/// SHA-256 of the numbers and of the values of the scene, which reveals damage.
std::string content_id(const Checkpoint& c) {
  Sha256 sha;
  sha.add(&c.time, sizeof c.time);
  sha.add(c.state.data(), c.state.size() * sizeof(double));
  sha.add(c.schedule.data(), c.schedule.size() * sizeof(double));
  sha.add(c.values.data(), c.values.size());
  sha.add(c.off.data(), c.off.size());
  return sha.hex();
}

std::vector<double> read_numbers(const hdf5::InputFile& file, const std::string& dataset) {
  const hdf5::DatasetInfo info = file.info(dataset);
  if (info.shape.size() != 1 || info.shape[0] > max_numbers)
    throw Error(fmt::format("has shape {}, expected one dimension", hdf5::shape_text(info.shape)),
                fmt::format("{}: {}", file.path(), dataset), "write the checkpoint again");
  std::vector<double> values(info.shape[0]);
  file.read(dataset, {info.shape[0]}, "numbers", values.data());
  return values;
}

std::string format_of(const hdf5::InputFile& file) {
  return file.has_attribute("/", "format") ? file.text_attribute("/", "format") : "";
}

/// Integer attribute from 0 to `most`.
double count_attribute(const hdf5::InputFile& file, const std::string& name, double most) {
  const double value = file.number_attribute("/", name);
  if (value >= 0.0 && value <= most) return value;
  throw Error(fmt::format("is damaged: attribute '{}' is {}, which is not a valid number of items", name, value),
              file.path(), "use an older checkpoint");
}

Checkpoint read_unchecked(const std::string& path) {
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  const std::string format = format_of(file);
  if (format != format_name)
    throw Error(format.empty()
                    ? "is an HDF5 file, but not a checkpoint (it has no attribute 'format')"
                    : fmt::format("is a file of the kind '{}', expected '{}'", format.substr(0, 60), format_name),
                path, "give a *.checkpoint.h5 file");
  const std::string version = file.text_attribute("/", "version");
  if (!version.starts_with("1."))
    throw Error(fmt::format("is '{}', this program reads versions 1.x", version.substr(0, 20)),
                path + ": attribute 'version'", "use the program that wrote it");
  Checkpoint c;
  c.scene = file.text_attribute("/", "scene");
  c.producer = file.text_attribute("/", "producer");
  c.fingerprint = file.text_attribute("/", "fingerprint");
  c.state_version = static_cast<int>(count_attribute(file, "state_version", 1e9));
  c.time = file.number_attribute("/", "time");
  if (file.has_attribute("/", "run")) {  // since 1.1
    c.results = file.text_attribute("/", "results");
    c.run = file.text_attribute("/", "run");
    c.rows = static_cast<std::size_t>(count_attribute(file, "rows", 1e15));
  }
  c.state = read_numbers(file, "/state");
  c.schedule = read_numbers(file, "/schedule");
  if (file.has("/values")) c.values = file.read_text("/values");  // since 1.2
  if (file.has("/off")) c.off = file.read_text("/off");           // since 1.3
  const bool finite = std::isfinite(c.time) &&
                      std::ranges::all_of(c.state, [](double x) { return std::isfinite(x); }) &&
                      std::ranges::all_of(c.schedule, [](double x) { return std::isfinite(x); });
  if (!finite || file.text_attribute("/", "content_id") != content_id(c))
    throw Error("is damaged: its contents changed after it was written", path, "use an older checkpoint");
  return c;
}

}  // namespace

void write_checkpoint(const std::string& path, const Checkpoint& c) {
  hdf5::Handle file = hdf5::create_in_memory(path);
  const hdf5::Output out{file.id(), path};
  const auto text = [&](const char* name, const std::string& value) { hdf5::write_attribute(out, "/", name, value); };
  text("format", format_name);
  text("version", "1.3");
  text("scene", c.scene);
  text("producer", c.producer);
  text("fingerprint", c.fingerprint);
  text("content_id", content_id(c));
  text("results", c.results);
  text("run", c.run);
  hdf5::write_attribute(out, "/", "rows", static_cast<double>(c.rows));
  hdf5::write_attribute(out, "/", "state_version", c.state_version);
  hdf5::write_attribute(out, "/", "time", c.time);
  hdf5::write_dataset(out, "/state", c.state);
  hdf5::write_dataset(out, "/schedule", c.schedule);
  if (!c.values.empty()) hdf5::write_text(out, "/values", c.values);
  if (!c.off.empty()) hdf5::write_text(out, "/off", c.off);
  write_text_file(path, hdf5::file_image(std::move(file), path));
}

Checkpoint read_checkpoint(const std::string& path) { return read_unchecked(path); }

bool is_checkpoint(const std::string& path) {
  return format_of(hdf5::InputFile(path, hdf5::Completeness::any)) == format_name;
}

}  // namespace tisserand::formats
