// SPDX-License-Identifier: GPL-3.0-or-later
// Reads and writes *.modal.h5 files.
#include "formats/modal_body/modal_body.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"
#include "formats/modal_body/arrays.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr hdf5::FileKind kind{"tisserand-modal-body", "modal body file",
                              "give a *.modal.h5 file (formats/MODAL_BODY.md)",
                              "write the body again with a program of the same major version"};
constexpr std::uint64_t max_nodes = 100'000, max_modes = 500, max_values = 30'000'000, max_residual = 5000;

/// Length of a one-dimensional dataset, checked against `limit` before memory is allocated.
std::uint64_t bounded_extent(const hdf5::InputFile& file, const std::string& dataset, std::uint64_t limit,
                             const std::string& meaning) {
  const hdf5::Shape shape = file.info(dataset).shape;
  if (shape.size() == 1 && shape[0] <= limit) return shape[0];
  throw Error(
      fmt::format("has shape {}, expected one dimension of at most {} ({})", hdf5::shape_text(shape), limit, meaning),
      fmt::format("{}: {}", file.path(), dataset), "compare the file with formats/MODAL_BODY.md");
}

std::vector<double> read_values(const hdf5::InputFile& file, const std::string& dataset, const hdf5::Shape& shape,
                                const std::string& meaning) {
  std::uint64_t count = 1;
  for (const std::uint64_t extent : shape) count *= extent;
  if (count > max_values)
    throw Error(fmt::format("{} values are too many, at most {} are read", count, max_values),
                fmt::format("{}: {}", file.path(), dataset), "keep fewer nodes or modes");
  const hdf5::Shape found = file.info(dataset).shape;
  if (found != shape)
    throw Error(
        fmt::format("has shape {}, expected {} ({})", hdf5::shape_text(found), hdf5::shape_text(shape), meaning),
        fmt::format("{}: {}", file.path(), dataset), "compare the file with formats/MODAL_BODY.md");
  std::vector<double> values(count);
  if (count > 0) file.read(dataset, shape, meaning, values.data());
  return values;
}

// Conversion between the values of a file, row by row, and an array of that shape.
template <class Matrix>
void take(const double* values, Index rows, Index columns, Matrix& matrix) {
  matrix = Eigen::Map<const RowMajor>(values, rows, columns);
}
template <class Matrix>
void take(const std::vector<double>& values, const hdf5::Shape& shape, Matrix& matrix) {
  take(values.data(), static_cast<Index>(shape[0]), shape.size() > 1 ? static_cast<Index>(shape[1]) : 1, matrix);
}
void take(const std::vector<double>& values, const hdf5::Shape& /*shape*/, double& number) { number = values[0]; }
template <class Matrix>
void take(const std::vector<double>& values, const hdf5::Shape& shape, std::vector<Matrix>& matrices) {
  matrices.resize(shape[0]);
  for (std::size_t k = 0; k < shape[0]; ++k)
    take(values.data() + k * shape[1] * shape[2], static_cast<Index>(shape[1]), static_cast<Index>(shape[2]),
         matrices[k]);
}
template <class Array>
void take(const std::vector<double>& values, const hdf5::Shape& shape, Blocks<Array>& blocks) {
  blocks.array.resize(9 * static_cast<Index>(shape[0]), shape.size() > 3 ? static_cast<Index>(shape[1]) : 1);
  for (std::size_t first = 0; first < values.size(); first += 9)
    Eigen::Map<Eigen::Matrix3d>(blocks.array.data() + first) = Eigen::Map<const RowMajor>(values.data() + first, 3, 3);
}

template <class Matrix>
void give(const Matrix& matrix, std::vector<double>& values) {
  for (Index i = 0; i < matrix.rows(); ++i)
    for (Index j = 0; j < matrix.cols(); ++j) values.push_back(matrix(i, j));
}
void give(const double& number, std::vector<double>& values) { values.push_back(number); }
template <class Matrix>
void give(const std::vector<Matrix>& matrices, std::vector<double>& values) {
  for (const Matrix& matrix : matrices) give(matrix, values);
}
template <class Array>
void give(const Blocks<Array>& blocks, std::vector<double>& values) {
  for (Index first = 0; first < blocks.array.size(); first += 9)
    give(Eigen::Map<const Eigen::Matrix3d>(blocks.array.data() + first), values);
}

void read_reference(const hdf5::InputFile& file, ModalBody& body) {
  const std::string word = file.text_attribute("/", "reference");
  if (word != "nodes" && word != "mean_axis")
    throw Error(fmt::format("is '{}', expected nodes or mean_axis", word.substr(0, 60)),
                file.path() + ": attribute 'reference'", "correct the word");
  body.reference = word == "nodes" ? ModalReference::nodes : ModalReference::mean_axis;
  if (body.reference == ModalReference::mean_axis) return;
  std::vector<std::int64_t> node(6), component(6);
  file.read("/reference/node", {6}, "six reference conditions", node.data());
  file.read("/reference/component", {6}, "six reference conditions", component.data());
  for (std::size_t i = 0; i < 6; ++i) {
    const auto narrow = [&](std::int64_t value) {
      return static_cast<int>(value < 0 || value > static_cast<std::int64_t>(max_nodes) ? -1 : value);
    };
    body.reference_node.push_back(narrow(node[i]));
    body.reference_component.push_back(narrow(component[i]));
  }
}

ModalResidual read_residual(const hdf5::InputFile& file) {
  ModalResidual residual;
  if (!file.has("/residual/node")) return residual;
  const std::uint64_t f = bounded_extent(file, "/residual/node", max_residual, "f components of nodes");
  std::vector<std::int64_t> node(f), component(f);
  file.read("/residual/node", {f}, "rows of /nodes/name", node.data());
  file.read("/residual/component", {f}, "components", component.data());
  for (std::size_t k = 0; k < f; ++k) {
    residual.node.push_back(static_cast<int>(std::clamp<std::int64_t>(node[k], -1, max_nodes)));
    residual.component.push_back(static_cast<int>(std::clamp<std::int64_t>(component[k], -1, 6)));
  }
  return residual;
}

ModalBody read_unchecked(const std::string& path) {
  const hdf5::InputFile file(path, hdf5::Completeness::closed);
  hdf5::check_format(file, kind);
  ModalBody body;
  body.name = file.text_attribute("/", "name");
  body.producer = file.text_attribute("/", "producer");
  body.units = hdf5::read_units(file);
  body.all_nodes = file.number_attribute("/", "all_nodes") != 0.0;
  read_reference(file, body);
  const std::uint64_t n = bounded_extent(file, "/nodes/name", max_nodes, "n names of nodes");
  const std::uint64_t m = bounded_extent(file, "/modes/omega2", max_modes, "m modes");
  body.node_name = file.read_texts("/nodes/name", n, "n names of nodes");
  body.residual = read_residual(file);
  for_each_array(body, {n, m, body.residual.node.size()},
                 [&](const char* dataset, const hdf5::Shape& shape, const char* meaning, auto&& array) {
                   take(read_values(file, dataset, shape, meaning), shape, array);
                 });
  return body;
}

void write_head(const hdf5::Output& out, const ModalBody& body) {
  hdf5::write_attribute(out, "/", "format", kind.format);
  hdf5::write_attribute(out, "/", "version", body.residual.node.empty() ? "1.0" : "1.1");
  hdf5::write_attribute(out, "/", "name", body.name);
  hdf5::write_attribute(out, "/", "producer", body.producer);
  hdf5::write_units(out, body.units);
  hdf5::write_attribute(out, "/", "all_nodes", body.all_nodes ? 1 : 0);
  const bool nodes = body.reference == ModalReference::nodes;
  hdf5::write_attribute(out, "/", "reference", nodes ? "nodes" : "mean_axis");
  if (!nodes) return;
  hdf5::write_dataset(out, "/reference/node", body.reference_node);
  hdf5::write_dataset(out, "/reference/component", body.reference_component);
}

void write_arrays(const hdf5::Output& out, const ModalBody& body) {
  const ModalSizes sizes{body.node_name.size(), static_cast<std::uint64_t>(body.modes()), body.residual.node.size()};
  hdf5::write_texts(out, "/nodes/name", body.node_name);
  for_each_array(body, sizes, [&](const char* dataset, const hdf5::Shape& shape, const char*, auto&& array) {
    std::vector<double> values;
    give(array, values);
    hdf5::write_dataset(out, dataset, shape, values.data());
  });
  if (sizes.f == 0) return;
  hdf5::write_dataset(out, "/residual/node", body.residual.node);
  hdf5::write_dataset(out, "/residual/component", body.residual.component);
}

}  // namespace

std::string content_id(const ModalBody& body) {
  Sha256 sha;
  const auto add = [&sha](const double* values, Index count) {
    sha.add(values, static_cast<std::size_t>(count) * sizeof(double));
  };
  const std::uint64_t counts[] = {static_cast<std::uint64_t>(body.modes()), body.node_name.size()};
  sha.add(counts, sizeof counts);
  add(body.frame_position.data(), 3);
  add(body.omega2.data(), body.omega2.size());
  add(body.node_mass.data(), body.node_mass.size());
  const RowMajor position = body.node_position;
  add(position.data(), position.size());
  for (const auto& X : body.X) add(X.data(), X.size());
  for (const std::string& name : body.node_name) sha.add(name.c_str(), name.size() + 1);
  return sha.hex();
}

LoadedModalBody read_modal_body(const std::string& path) {
  LoadedModalBody loaded{read_unchecked(path), {}};
  loaded.warnings = check(loaded.body, path);
  return loaded;
}

std::string modal_body_image(const std::string& path, const ModalBody& body) {
  static_cast<void>(check(body, path));
  hdf5::Handle file = hdf5::create_in_memory(path);
  const hdf5::Output out{file.id(), path};
  write_head(out, body);
  write_arrays(out, body);
  return hdf5::file_image(std::move(file), path);
}

void write_modal_body(const std::string& path, const ModalBody& body) {
  write_text_file(path, modal_body_image(path, body));
}

}  // namespace tisserand::formats
