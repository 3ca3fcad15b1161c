// Modal bodies between memory and *.modal.h5.
#include "formats/modal_body/modal_body.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "common/sha256.hpp"
#include "common/text.hpp"
#include "formats/hdf5/head.hpp"

namespace tisserand::formats {
namespace {

using Eigen::Index;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr hdf5::FileKind kind{"tisserand-modal-body", "modal body file",
                              "give a *.modal.h5 file (formats/MODAL_BODY.md)",
                              "write the body again with a program of the same major version"};
constexpr std::uint64_t max_nodes = 100'000, max_modes = 500, max_values = 30'000'000, max_residual = 5000;

/// Length of a dataset before memory is taken; `rank`: of the dataset.
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

Eigen::MatrixXd matrix_of(const std::vector<double>& values, Index rows, Index columns) {
  return Eigen::Map<const RowMajor>(values.data(), rows, columns);
}

Eigen::Matrix3d matrix3_of(const std::vector<double>& values, std::size_t first) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data() + first);
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

void read_nodes(const hdf5::InputFile& file, std::uint64_t n, std::uint64_t m, ModalBody& body) {
  const auto rows = static_cast<Index>(n);
  body.node_name = file.read_texts("/nodes/name", n, "n names of nodes");
  body.node_position = matrix_of(read_values(file, "/nodes/position", {n, 3}, "n x 3 positions"), rows, 3);
  body.node_mass = matrix_of(read_values(file, "/nodes/mass", {n}, "n masses"), rows, 1);
  const std::vector<double> inertia = read_values(file, "/nodes/inertia", {n, 3, 3}, "n x 3 x 3 inertias");
  const std::vector<double> X = read_values(file, "/modes/X", {n, 6, m}, "n x 6 x m rows of the modes");
  for (std::size_t k = 0; k < n; ++k) {
    body.node_inertia.push_back(matrix3_of(inertia, 9 * k));
    body.X.emplace_back(Eigen::Map<const RowMajor>(X.data() + 6 * m * k, 6, static_cast<Index>(m)));
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
  const auto n = static_cast<Index>(f);
  residual.flexibility = matrix_of(read_values(file, "/residual/flexibility", {f, f}, "f x f"), n, n);
  residual.mass = matrix_of(read_values(file, "/residual/mass", {f, f}, "f x f"), n, n);
  residual.coupling = matrix_of(read_values(file, "/residual/coupling", {6, f}, "6 x f"), 6, n);
  return residual;
}

/// Blocks of 3 x 3 stored row by row, as columns of 9 numbers each.
void blocks_of(const std::vector<double>& values, double* columns) {
  for (std::size_t first = 0; first < values.size(); first += 9)
    Eigen::Map<Eigen::Matrix3d>(columns + first) = matrix3_of(values, first);
}

void read_integrals(const hdf5::InputFile& file, std::uint64_t m, ModalIntegrals& sums) {
  const auto columns = static_cast<Index>(m);
  const auto values = [&](const char* name, const hdf5::Shape& shape, const char* meaning) {
    return read_values(file, std::string("/integrals/") + name, shape, meaning);
  };
  sums.mass = values("mass", {1}, "one number")[0];
  sums.c0 = matrix_of(values("c0", {3}, "three numbers"), 3, 1);
  sums.C1 = matrix_of(values("C1", {3, m}, "3 x m"), 3, columns);
  sums.P0 = matrix3_of(values("P0", {3, 3}, "3 x 3"), 0);
  sums.P1.resize(9 * columns);
  blocks_of(values("P1", {m, 3, 3}, "m x 3 x 3"), sums.P1.data());
  sums.P2.resize(9 * columns, columns);
  blocks_of(values("P2", {m, m, 3, 3}, "m x m x 3 x 3"), sums.P2.data());
  sums.J_mu = matrix3_of(values("J_mu", {3, 3}, "3 x 3"), 0);
  sums.N_mu = matrix_of(values("N_mu", {3, m}, "3 x m"), 3, columns);
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
  body.frame_position = matrix_of(read_values(file, "/frame/position", {3}, "three numbers"), 3, 1);
  body.frame_orientation = matrix_of(read_values(file, "/frame/orientation", {4}, "w x y z"), 4, 1);
  const std::uint64_t n = bounded_extent(file, "/nodes/name", max_nodes, "n names of nodes");
  const std::uint64_t m = bounded_extent(file, "/modes/omega2", max_modes, "m modes");
  body.omega2 = matrix_of(read_values(file, "/modes/omega2", {m}, "m modes"), static_cast<Index>(m), 1);
  body.zeta = matrix_of(read_values(file, "/modes/zeta", {m}, "m modes"), static_cast<Index>(m), 1);
  read_nodes(file, n, m, body);
  read_integrals(file, m, body.integrals);
  body.residual = read_residual(file);
  return body;
}

/// Columns of 9 numbers as 3 x 3 blocks stored row by row.
std::vector<double> rows_of(const double* columns, Index count) {
  std::vector<double> values(static_cast<std::size_t>(count));
  for (Index first = 0; first < count; first += 9)
    Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(values.data() + first) =
        Eigen::Map<const Eigen::Matrix3d>(columns + first);
  return values;
}

void write_head(hdf5::Id file, const ModalBody& body, const std::string& where) {
  hdf5::write_text_attribute(file, "/", "format", kind.format, where);
  hdf5::write_text_attribute(file, "/", "version", body.residual.node.empty() ? "1.0" : "1.1", where);
  hdf5::write_text_attribute(file, "/", "name", body.name, where);
  hdf5::write_text_attribute(file, "/", "producer", body.producer, where);
  hdf5::write_units(file, body.units, where);
  hdf5::write_integer_attribute(file, "/", "all_nodes", body.all_nodes ? 1 : 0, where);
  const bool nodes = body.reference == ModalReference::nodes;
  hdf5::write_text_attribute(file, "/", "reference", nodes ? "nodes" : "mean_axis", where);
  hdf5::write_dataset(file, "/frame/position", {3}, body.frame_position.data(), where);
  hdf5::write_dataset(file, "/frame/orientation", {4}, body.frame_orientation.data(), where);
  if (!nodes) return;
  hdf5::write_dataset(file, "/reference/node", {6}, body.reference_node.data(), where);
  hdf5::write_dataset(file, "/reference/component", {6}, body.reference_component.data(), where);
}

void write_nodes(hdf5::Id file, const ModalBody& body, const std::string& where) {
  const auto n = static_cast<std::uint64_t>(body.node_name.size()), m = static_cast<std::uint64_t>(body.modes());
  std::vector<double> inertia, X;
  for (std::size_t k = 0; k < n; ++k) {
    const std::vector<double> one = rows_of(body.node_inertia[k].data(), 9);
    inertia.insert(inertia.end(), one.begin(), one.end());
    const RowMajor rows = body.X[k];
    X.insert(X.end(), rows.data(), rows.data() + rows.size());
  }
  const RowMajor position = body.node_position;
  hdf5::write_texts(file, "/nodes/name", body.node_name, where);
  hdf5::write_dataset(file, "/nodes/position", {n, 3}, position.data(), where);
  hdf5::write_dataset(file, "/nodes/mass", {n}, body.node_mass.data(), where);
  hdf5::write_dataset(file, "/nodes/inertia", {n, 3, 3}, inertia.data(), where);
  hdf5::write_dataset(file, "/modes/X", {n, 6, m}, X.data(), where);
  hdf5::write_dataset(file, "/modes/omega2", {m}, body.omega2.data(), where);
  hdf5::write_dataset(file, "/modes/zeta", {m}, body.zeta.data(), where);
}

void write_residual(hdf5::Id file, const ModalResidual& residual, const std::string& where) {
  const auto f = static_cast<std::uint64_t>(residual.node.size());
  if (f == 0) return;
  const RowMajor flexibility = residual.flexibility, mass = residual.mass, coupling = residual.coupling;
  hdf5::write_dataset(file, "/residual/node", {f}, residual.node.data(), where);
  hdf5::write_dataset(file, "/residual/component", {f}, residual.component.data(), where);
  hdf5::write_dataset(file, "/residual/flexibility", {f, f}, flexibility.data(), where);
  hdf5::write_dataset(file, "/residual/mass", {f, f}, mass.data(), where);
  hdf5::write_dataset(file, "/residual/coupling", {6, f}, coupling.data(), where);
}

void write_integrals(hdf5::Id file, const ModalIntegrals& sums, const std::string& where) {
  const auto m = static_cast<std::uint64_t>(sums.C1.cols());
  const auto write = [&](const char* name, const hdf5::Shape& shape, const double* values) {
    hdf5::write_dataset(file, std::string("/integrals/") + name, shape, values, where);
  };
  const RowMajor C1 = sums.C1, N_mu = sums.N_mu;
  write("mass", {1}, &sums.mass);
  write("c0", {3}, sums.c0.data());
  write("C1", {3, m}, C1.data());
  write("P0", {3, 3}, rows_of(sums.P0.data(), 9).data());
  write("P1", {m, 3, 3}, rows_of(sums.P1.data(), sums.P1.size()).data());
  write("P2", {m, m, 3, 3}, rows_of(sums.P2.data(), sums.P2.size()).data());
  write("J_mu", {3, 3}, rows_of(sums.J_mu.data(), 9).data());
  write("N_mu", {3, m}, N_mu.data());
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
  write_head(file.id(), body, path);
  write_nodes(file.id(), body, path);
  write_integrals(file.id(), body.integrals, path);
  write_residual(file.id(), body.residual, path);
  return hdf5::file_image(std::move(file), path);
}

void write_modal_body(const std::string& path, const ModalBody& body) {
  write_text_file(path, modal_body_image(path, body));
}

}  // namespace tisserand::formats
