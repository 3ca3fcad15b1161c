// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes *.companion.h5 files, and computes the identity of their content.
#include "formats/companion/companion.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "common/error.hpp"
#include "common/output_path.hpp"
#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/companion/arrays.hpp"
#include "formats/hdf5/head.hpp"

namespace tisserand::formats {
namespace {

using RowMajor3X = Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor>;
using RowMajorX = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

static_assert(std::endian::native == std::endian::little, "companion_id is defined on little-endian bytes");

constexpr hdf5::FileKind companion_kind{
    "tisserand-companion", "companion file",
    "give a *.companion.h5 file, as `reducer run` writes it with `second_order: yes` in the part file",
    "reduce the part again with a program of the same major version"};
constexpr std::uint64_t max_load_cases = 1000, max_trapped_rows = 2000;
const std::vector<std::string> second_order_datasets{"/H", "/C", "/E", "/N", "/T", "/S0", "/S1", "/mass"};

std::uint64_t length_of(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t limit,
                        const std::string& meaning) {
  const hdf5::Shape shape = file.info(dataset).shape;
  if (shape.size() == 1 && shape[0] >= 1 && shape[0] <= limit) return shape[0];
  throw Error(
      fmt::format("has shape {}, expected one dimension of 1 to {} ({})", hdf5::shape_text(shape), limit, meaning),
      fmt::format("{}: {}", file.path(), dataset), "compare the file with formats/COMPANION.md");
}

/// Number of coordinates: columns of /S1.
std::uint64_t coordinates_of(const hdf5::InputFile& file) {
  const hdf5::Shape shape = file.info("/S1").shape;
  if (shape.size() == 2 && shape[0] == 3 && shape[1] >= 1 && shape[1] <= max_companion_size) return shape[1];
  throw Error(fmt::format("has shape {}, expected 3 x n with at most {} coordinates n", hdf5::shape_text(shape),
                          max_companion_size),
              file.path() + ": /S1", "keep fewer nodes or modes, or compare the file with formats/COMPANION.md");
}

Eigen::VectorXd read_vector(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t n,
                            const std::string& meaning) {
  Eigen::VectorXd values(static_cast<Eigen::Index>(n));
  file.read(dataset, {n}, meaning, values.data());
  return values;
}

void read_trapped(const hdf5::InputFile& file, std::uint64_t n, Companion& c) {
  constexpr std::uint64_t most = max_companion_size;
  const hdf5::Shape shape = file.info("/Lambda").shape;
  if (shape.empty() || shape[0] < 1 || shape[0] > max_trapped_rows || shape[0] * n * n > most * most * most)
    throw Error(fmt::format("has shape {}, expected 1 to {} matrices of n = {} coordinates", hdf5::shape_text(shape),
                            std::min(max_trapped_rows, most * most * most / (n * n)), n),
                file.path() + ": /Lambda", "keep only the largest rows, or compare the file with formats/COMPANION.md");
  c.Lambda.resize(shape[0]);
  read_symmetric(file, "/Lambda", n, c.Lambda);
}

void read_second_order(const hdf5::InputFile& file, Companion& c) {
  for (const std::string& dataset : second_order_datasets)
    if (!file.has(dataset))
      throw Error("is missing, but other second-order arrays are present", file.path() + ": " + dataset,
                  "write all of H, C, E, N, T, S0, S1 and mass, or none of them");
  const std::uint64_t n = coordinates_of(file);
  c.mass = read_vector(file, "/mass", 1, "one number")[0];
  c.S0 = read_vector(file, "/S0", 3, "three numbers");
  RowMajor3X S1(3, static_cast<Eigen::Index>(n));
  file.read("/S1", {3, n}, "3 x n", S1.data());
  c.S1 = S1;
  c.H.resize(n);
  read_symmetric(file, "/H", n, c.H);
  read_general(file, "/C", n, c.C);
  read_symmetric(file, "/E", n, c.E);
  read_symmetric(file, "/N", n, c.N);
  read_symmetric(file, "/T", n, c.T);
  if (file.has("/W")) read_general(file, "/W", n, c.W);
  if (file.has("/Lambda")) read_trapped(file, n, c);
}

void read_load_cases(const hdf5::InputFile& file, Companion& c) {
  if (!file.has("/load_cases")) return;
  const std::vector<std::string> names = file.members("/load_cases");
  if (names.size() > max_load_cases)
    throw Error(fmt::format("has {} members, at most {} are read", names.size(), max_load_cases),
                file.path() + ": /load_cases", "keep fewer load cases");
  for (const std::string& name : names) {
    LoadCase load;
    load.name = name;
    const std::string group = "/load_cases/" + name, force = group + "/force", stiffness = group + "/stiffness";
    if (file.has(force)) {
      const std::uint64_t n = length_of(file, force, 10'000, "n coordinates of the superelement");
      load.force = read_vector(file, force, n, "n coordinates of the superelement");
    }
    if (file.has(stiffness)) {
      if (load.force.size() == 0)
        throw Error("has no dataset 'force' in its group", fmt::format("{}: {}", file.path(), stiffness),
                    "write the dataset 'force' too");
      load.stiffness = read_symmetric(file, stiffness, static_cast<std::uint64_t>(load.force.size()));
    }
    c.load_cases.push_back(std::move(load));
  }
}

/// Contents of a file before check().
struct UncheckedCompanion {
  Companion companion;
  std::string stated_id;  ///< empty: no identity stated
};

UncheckedCompanion read_unchecked_companion(const std::string& path) {
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  hdf5::check_format(file, companion_kind);
  UncheckedCompanion result;
  Companion& c = result.companion;
  c.minor_version = hdf5::minor_version(file);
  c.content_id = file.text_attribute("/", "superelement");
  c.producer = file.text_attribute("/", "producer");
  c.units = hdf5::read_units(file);
  c.reference_point = read_vector(file, "/frame/reference_point", 3, "three numbers");
  const std::uint64_t nodes = length_of(file, "/frame/weights", 10'000, "nB boundary nodes");
  c.weights = read_vector(file, "/frame/weights", nodes, "nB boundary nodes");
  bool any = false;
  for (const std::string& dataset : second_order_datasets) any = any || file.has(dataset);
  if (any) read_second_order(file, c);
  read_load_cases(file, c);
  if (file.has_attribute("/", "content_id")) result.stated_id = file.text_attribute("/", "content_id");
  return result;
}

void write_companion_head(const hdf5::Output& out, const Companion& c) {
  hdf5::write_attribute(out, "/", "format", companion_kind.format);
  hdf5::write_attribute(out, "/", "version", fmt::format("1.{}", c.minor_version));
  hdf5::write_attribute(out, "/", "producer", c.producer);
  hdf5::write_attribute(out, "/", "superelement", c.content_id);
  hdf5::write_attribute(out, "/", "content_id", c.companion_id);
  hdf5::write_units(out, c.units);
  hdf5::write_dataset(out, "/frame/reference_point", c.reference_point);
  hdf5::write_dataset(out, "/frame/weights", c.weights);
}

void write_second_order(const hdf5::Output& out, const Companion& c) {
  const auto n = static_cast<std::uint64_t>(c.S1.cols());
  const RowMajor3X S1 = c.S1;
  const hdf5::Output packed{out.id, out.where, hdf5::Packing::small};
  hdf5::write_dataset(out, "/mass", {1}, &c.mass);
  hdf5::write_dataset(out, "/S0", c.S0);
  hdf5::write_dataset(out, "/S1", {3, n}, S1.data());
  const auto write_triangles = [&](const char* name, std::span<const Eigen::MatrixXd> matrices) {
    hdf5::write_dataset(packed, name, {matrices.size(), n * (n + 1) / 2}, upper_triangles(matrices).data());
  };
  write_triangles("/H", c.H);
  const auto write_general = [&](const char* name, const std::array<Eigen::MatrixXd, 3>& matrices) {
    std::vector<double> values;
    for (const RowMajorX matrix : matrices) values.insert(values.end(), matrix.data(), matrix.data() + matrix.size());
    hdf5::write_dataset(packed, name, {3, n, n}, values.data());
  };
  write_general("/C", c.C);
  write_triangles("/E", c.E);
  write_triangles("/N", c.N);
  write_triangles("/T", c.T);
  if (c.has_relative_turns()) write_general("/W", c.W);
  if (!c.Lambda.empty()) write_triangles("/Lambda", c.Lambda);
}

void write_load_cases(const hdf5::Output& out, const Companion& c) {
  for (const LoadCase& load : c.load_cases) {
    const auto n = static_cast<std::uint64_t>(load.force.size());
    const std::string group = "/load_cases/" + load.name;
    if (n > 0) hdf5::write_dataset(out, group + "/force", load.force);
    if (load.stiffness.size() > 0)
      hdf5::write_dataset({out.id, out.where, hdf5::Packing::small}, group + "/stiffness", {n * (n + 1) / 2},
                          upper_triangles({&load.stiffness, 1}).data());
  }
}

/// Hash over values and texts. Each list of values is preceded by its length.
class Identity {
 public:
  void add(const double* values, std::size_t count) {
    const std::uint64_t size = count;
    sha_.add(&size, sizeof size);
    if (count > 0) sha_.add(values, count * sizeof(double));
  }
  void add(const std::string& text) { sha_.add(text.c_str(), text.size() + 1); }
  void add_symmetric(std::span<const Eigen::MatrixXd> matrices) {
    const std::vector<double> values = upper_triangles(matrices);
    add(values.data(), values.size());
  }
  std::string hex() { return sha_.hex(); }

 private:
  Sha256 sha_;
};

}  // namespace

std::string companion_path(const std::string& superelement_file) {
  return without_ending(superelement_file, {".superelement.h5", ".h5"}) + ".companion.h5";
}

std::string companion_id(const Companion& c) {
  Identity identity;
  identity.add(c.content_id);
  identity.add(c.reference_point.data(), 3);
  identity.add(c.weights.data(), static_cast<std::size_t>(c.weights.size()));
  if (c.has_second_order()) {
    identity.add(&c.mass, 1);
    identity.add(c.S0.data(), 3);
    const RowMajor3X S1 = c.S1;
    identity.add(S1.data(), static_cast<std::size_t>(S1.size()));
    identity.add_symmetric(c.H);
    for (const RowMajorX C : c.C) identity.add(C.data(), static_cast<std::size_t>(C.size()));
    for (const auto* arrays : {&c.E, &c.N, &c.T}) identity.add_symmetric(*arrays);
    if (c.has_relative_turns())
      for (const RowMajorX W : c.W) identity.add(W.data(), static_cast<std::size_t>(W.size()));
    if (!c.Lambda.empty()) identity.add_symmetric(c.Lambda);
  }
  for (const LoadCase& load : c.load_cases) {
    identity.add(load.name);
    identity.add(load.force.data(), static_cast<std::size_t>(load.force.size()));
    identity.add_symmetric({&load.stiffness, 1});
  }
  return identity.hex();
}

Companion read_companion(const std::string& path, const Superelement& superelement) {
  UncheckedCompanion file = read_unchecked_companion(path);
  Companion& c = file.companion;
  check(c, superelement, path);
  c.companion_id = companion_id(c);
  if (!file.stated_id.empty() && file.stated_id != c.companion_id)
    throw Error(fmt::format("is {}..., but the contents give {}...: the file was changed after it was written",
                            printable_line(file.stated_id, 12), c.companion_id.substr(0, 12)),
                path + ": attribute 'content_id'",
                "reduce the part again; after a change by hand, compute the attribute again");
  return std::move(file.companion);
}

std::string companion_image(const std::string& path, Companion& companion, const Superelement& superelement) {
  check(companion, superelement, path);
  companion.companion_id = companion_id(companion);
  hdf5::Handle file = hdf5::create_in_memory(path);
  const hdf5::Output out{file.id(), path};
  write_companion_head(out, companion);
  if (companion.has_second_order()) write_second_order(out, companion);
  write_load_cases(out, companion);
  return hdf5::file_image(std::move(file), path);
}

void write_companion(const std::string& path, Companion& companion, const Superelement& superelement) {
  write_text_file(path, companion_image(path, companion, superelement));
}

}  // namespace tisserand::formats
