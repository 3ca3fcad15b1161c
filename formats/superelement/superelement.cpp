// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes *.superelement.h5 files, and computes the identity of their content.
#include "formats/superelement/superelement.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>

#include "common/error.hpp"
#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/superelement/scaling.hpp"

namespace tisserand::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "content_id is defined on little-endian bytes");

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajor3 = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;

constexpr hdf5::FileKind kind{"tisserand-superelement", "superelement file",
                              "give a *.superelement.h5 file, as `reducer run` writes it",
                              "reduce the part again with a program of the same major version"};
constexpr std::size_t max_label = 255;

const std::vector<std::string> known_attributes{"format",          "version",         "name",
                                                "method",          "producer",        "length_unit",
                                                "mass_unit",       "time_unit",       "length_unit_label",
                                                "mass_unit_label", "time_unit_label", "content_id"};

/// Length of a one-dimensional dataset, checked against `limit` before memory is allocated.
std::uint64_t bounded_length(const hdf5::InputFile& file, const std::string& dataset, const std::string& meaning) {
  const hdf5::Shape shape = file.info(dataset).shape;
  const std::string where = fmt::format("{}: {}", file.path(), dataset);
  if (shape.size() != 1)
    throw Error(fmt::format("has shape {}, expected one dimension ({})", hdf5::shape_text(shape), meaning), where,
                "compare the file with formats/SUPERELEMENT.md");
  if (shape[0] < 1 || shape[0] > static_cast<std::uint64_t>(max_coordinates))
    throw Error(fmt::format("has {} entries, expected 1 to {} ({})", shape[0], max_coordinates, meaning), where,
                "compare the file with formats/SUPERELEMENT.md");
  return shape[0];
}

std::vector<int> read_integers(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                               const std::string& meaning) {
  std::vector<std::int64_t> wide(n);
  file.read(dataset, {n}, meaning, wide.data());
  std::vector<int> values;
  for (std::size_t i = 0; i < wide.size(); ++i) {
    if (wide[i] < std::numeric_limits<int>::min() || wide[i] > std::numeric_limits<int>::max())
      throw Error(fmt::format("entry {} is {}, outside the range of 32-bit integers", i, wide[i]),
                  fmt::format("{}: {}", file.path(), dataset), "correct the number");
    values.push_back(static_cast<int>(wide[i]));
  }
  return values;
}

Eigen::MatrixXd read_matrix(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n) {
  const hdf5::Shape found = file.info(dataset).shape;
  if (found != hdf5::Shape{n, n})
    throw Error(
        fmt::format("has shape {}, expected {} x {} (n = {} entries of /dof/node)", hdf5::shape_text(found), n, n, n),
        fmt::format("{}: {}", file.path(), dataset), "compare the file with formats/SUPERELEMENT.md");
  RowMajor values(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  file.read(dataset, {n, n}, fmt::format("n x n, n = {} entries of /dof/node", n), values.data());
  return values;
}

/// One-line warning about contents beyond version 1.0, or empty.
std::string unknown_items(const hdf5::InputFile& file) {
  std::vector<std::string> unknown;
  const auto note = [&](const std::string& group, const std::vector<std::string>& known) {
    for (const std::string& name : file.members(group))
      if (std::find(known.begin(), known.end(), name) == known.end())
        unknown.push_back((group == "/" ? "/" : group + "/") + name);
  };
  note("/", {"boundary", "dof", "stiffness", "mass"});
  note("/boundary", {"name", "position"});
  note("/dof", {"node", "component"});
  for (const std::string& name : file.attributes("/"))
    if (std::find(known_attributes.begin(), known_attributes.end(), name) == known_attributes.end())
      unknown.push_back(fmt::format("attribute '{}'", name));
  if (unknown.empty()) return "";
  return fmt::format("{}: ignored, because they are not part of format version 1.0: {}.", file.path(), listed(unknown));
}

Superelement read_fields(const hdf5::InputFile& file) {
  Superelement e;
  e.name = file.text_attribute("/", "name");
  e.method = file.text_attribute("/", "method");
  e.producer = file.text_attribute("/", "producer");
  e.units = hdf5::read_units(file);

  const std::uint64_t nodes = bounded_length(file, "/boundary/name", "nB names of boundary nodes");
  const std::uint64_t n = bounded_length(file, "/dof/node", "n rows of /stiffness and /mass");
  e.node_name = file.read_texts("/boundary/name", nodes, "nB names of boundary nodes");
  RowMajor3 position(static_cast<Eigen::Index>(nodes), 3);
  file.read("/boundary/position", {nodes, 3}, fmt::format("nB x 3, nB = {} entries of /boundary/name", nodes),
            position.data());
  e.node_position = position;
  const std::string meaning = fmt::format("n = {} entries of /dof/node", n);
  e.dof_node = read_integers(file, "/dof/node", n, meaning);
  e.dof_component = read_integers(file, "/dof/component", n, meaning);
  e.stiffness = read_matrix(file, "/stiffness", n);
  e.mass = read_matrix(file, "/mass", n);
  return e;
}

/// Contents of a file before check().
struct Unchecked {
  Superelement superelement;
  std::optional<std::string> content_id;
  std::string unknown;
};

Unchecked read_unchecked(const std::string& path) {
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  hdf5::check_format(file, kind);
  Unchecked result{read_fields(file), std::nullopt, unknown_items(file)};
  if (file.has_attribute("/", "content_id")) result.content_id = file.text_attribute("/", "content_id");
  return result;
}

void write_fields(const hdf5::Output& out, const Superelement& e) {
  const auto n = static_cast<std::uint64_t>(e.size()), nodes = static_cast<std::uint64_t>(e.node_name.size());
  hdf5::write_attribute(out, "/", "format", kind.format);
  hdf5::write_attribute(out, "/", "version", "1.0");
  hdf5::write_attribute(out, "/", "name", e.name);
  hdf5::write_attribute(out, "/", "method", e.method);
  hdf5::write_attribute(out, "/", "producer", e.producer);
  hdf5::write_units(out, e.units);
  hdf5::write_attribute(out, "/", "content_id", e.content_id);
  hdf5::write_texts(out, "/boundary/name", e.node_name);
  const RowMajor3 position = e.node_position;
  hdf5::write_dataset(out, "/boundary/position", {nodes, 3}, position.data());
  hdf5::write_dataset(out, "/dof/node", e.dof_node);
  hdf5::write_dataset(out, "/dof/component", e.dof_component);
  const RowMajor stiffness = e.stiffness, mass = e.mass;
  hdf5::write_dataset(out, "/stiffness", {n, n}, stiffness.data());
  hdf5::write_dataset(out, "/mass", {n, n}, mass.data());
}

/// Checks texts for control characters and length, so that they fit attributes and messages.
void check_labels(const Superelement& e, const std::string& where) {
  const auto check_label = [&](const std::string& name, const std::string& value) {
    bool clean = value.size() <= max_label;
    for (const char c : value) clean = clean && static_cast<unsigned char>(c) >= 32 && c != 127;
    if (!clean)
      throw Error(fmt::format("has {} bytes or control characters, expected one line of at most {} bytes", value.size(),
                              max_label),
                  fmt::format("{}: attribute '{}'", where, name), "shorten it");
  };
  check_label("name", e.name);
  check_label("method", e.method);
  check_label("producer", e.producer);
}

}  // namespace

std::string content_id(const Superelement& element) {
  Sha256 sha;
  const std::uint64_t counts[] = {static_cast<std::uint64_t>(element.size()), element.node_name.size()};
  sha.add(counts, sizeof counts);
  sha.add(element.dof_node.data(), element.dof_node.size() * sizeof(std::int32_t));
  sha.add(element.dof_component.data(), element.dof_component.size() * sizeof(std::int32_t));
  for (const std::string& name : element.node_name) sha.add(name.c_str(), name.size() + 1);
  const auto add = [&sha](const RowMajor& matrix) {
    sha.add(matrix.data(), static_cast<std::size_t>(matrix.size()) * sizeof(double));
  };
  add(element.node_position);
  add(element.stiffness);
  add(element.mass);
  return sha.hex();
}

LoadedSuperelement read_superelement(const std::string& path) {
  Unchecked file = read_unchecked(path);
  LoadedSuperelement loaded{std::move(file.superelement), {}};
  Superelement& e = loaded.superelement;
  check_labels(e, path);
  e.content_id = content_id(e);
  const std::string stated = file.content_id.value_or(e.content_id);
  loaded.report = check(e, path);
  if (stated != e.content_id)
    throw Error(fmt::format("is {}..., but the contents give {}...: the file was changed after it was written",
                            stated.substr(0, 12), e.content_id.substr(0, 12)),
                path + ": attribute 'content_id'",
                "reduce the part again; after a change by hand, compute the attribute again");
  if (!file.content_id)
    loaded.report.warnings.push_back(path + ": has no attribute 'content_id', so damage cannot be detected.");
  if (!file.unknown.empty()) loaded.report.warnings.push_back(file.unknown);
  if (needs_filter(loaded.report)) {
    filter_rigid_motions(e);
    loaded.report.filtered = true;
    loaded.report.warnings.push_back(filter_note(loaded.report, path));
  }
  return loaded;
}

std::string superelement_image(const std::string& path, Superelement& element) {
  check_labels(element, path);
  static_cast<void>(check(element, path));
  element.content_id = content_id(element);
  hdf5::Handle file = hdf5::create_in_memory(path);
  write_fields({file.id(), path}, element);
  return hdf5::file_image(std::move(file), path);
}

void write_superelement(const std::string& path, Superelement& element) {
  write_text_file(path, superelement_image(path, element));
}

}  // namespace tisserand::formats
