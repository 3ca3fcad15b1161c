// SPDX-License-Identifier: GPL-3.0-or-later
// Reductions whose recovery data stay in memory.
#include "tests/reducer/recovery/recovered.hpp"

#include "common/error.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing {

namespace {

void keep(const reducer::RecoverySource& source, Recovered& result) {
  std::array<Eigen::Index, 5> filled{}, answered{}, shaped{};
  result.tables = reducer::recovery_tables(source);
  formats::check(result.tables, "part.recovery.h5");
  for (const formats::RecoveryField field : formats::recovery_fields)
    result.field[static_cast<std::size_t>(field)].resize(
        static_cast<Eigen::Index>(formats::width(field)) * formats::items(result.tables, field),
        result.tables.coordinates());
  for (std::size_t f = 0; f < 5; ++f)
    result.loads[f].resize(result.field[f].rows(), result.tables.loads ? result.tables.loads->columns() : 0);
  for (std::size_t f = 0; f < 2; ++f)
    result.second_order[f].resize(result.field[f].rows(),
                                  result.tables.second_order ? result.tables.second_order->shapes() : 0);
  const auto unheard = [](double /*done*/) {};
  const auto fill = [](auto& fields, std::array<Eigen::Index, 5>& rows_of) {
    return [&](formats::RecoveryField field, const Eigen::MatrixXd& rows) {
      const auto f = static_cast<std::size_t>(field);
      fields[f].middleRows(rows_of[f], rows.rows()) = rows;
      rows_of[f] += rows.rows();
    };
  };
  const auto forces = [&](formats::NodalForce force, const Eigen::MatrixXd& rows) {
    Eigen::MatrixXd& all = result.forces[static_cast<std::size_t>(force)];
    all.conservativeResize(all.rows() + rows.rows(), rows.cols());
    all.bottomRows(rows.rows()) = rows;
  };
  reducer::recovery_fields(
      source, result.tables, unheard,
      {fill(result.field, filled), fill(result.loads, answered), fill(result.second_order, shaped), forces});
  for (std::size_t f = 0; f < filled.size(); ++f) TISSERAND_ENSURE(filled[f] == result.field[f].rows(), "field {}", f);
}

}  // namespace

Recovered recovered(const reducer::Mesh& mesh, int modes) {
  start_solvers();
  formats::Part part;
  part.name = "part";
  part.file = "part.yaml";
  part.units = Units::si();
  part.modes.count = modes;
  return recovered(mesh, std::move(part));
}

Recovered recovered(const reducer::Mesh& mesh, formats::Part part) {
  start_solvers();
  part.recovery = true;
  Recovered result;
  result.superelement =
      reducer::reduce_mesh(
          mesh, part, [](const std::string&) {}, [&](const reducer::RecoverySource& source) { keep(source, result); })
          .superelement;
  return result;
}

std::pair<Recovered, formats::ModalBody> recovered_modal_body(formats::Part part) {
  start_solvers();
  part.recovery = true;
  Recovered result;
  reducer::Reduction reduction = reducer::reduce(
      part, [](const std::string&) {},
      [&](const reducer::RecoverySource& source) {
        if (source.is_modal) keep(source, result);
      });
  return {std::move(result), std::move(*reduction.modal_body)};
}

void write(const Recovered& r, const std::string& path) {
  formats::RecoveryWriter writer(path, r.tables);
  for (const formats::RecoveryField field : formats::recovery_fields) {
    writer.append(field, r.of(field));
    if (r.tables.loads) writer.append_loads(field, r.loads[static_cast<std::size_t>(field)]);
  }
  for (const formats::RecoveryField field : {formats::RecoveryField::translation, formats::RecoveryField::rotation})
    writer.append_second_order(field, r.second_order[static_cast<std::size_t>(field)]);
  for (const formats::NodalForce force : formats::nodal_forces)
    if (r.tables.loads && r.tables.loads->has_forces())
      writer.append_forces(force, r.forces[static_cast<std::size_t>(force)]);
  writer.finish();
}

void set_boundary(reducer::Mesh& mesh, const std::vector<int>& nodes, bool rotations) {
  for (std::size_t k = 0; k < nodes.size(); ++k)
    mesh.boundary.push_back({"b" + std::to_string(k), nodes[k], true, rotations});
}

Eigen::VectorXd boundary_motion(const Recovered& r,
                                const std::function<Eigen::Matrix<double, 6, 1>(const Eigen::Vector3d&)>& motion) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(r.tables.coordinates());
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    const int node = r.tables.dof_node[static_cast<std::size_t>(k)];
    if (node < 0) continue;
    const Eigen::Vector3d X = r.tables.position.col(r.tables.boundary_node[static_cast<std::size_t>(node)]);
    y[k] = motion(X)[r.tables.dof_component[static_cast<std::size_t>(k)]];
  }
  return y;
}

}  // namespace tisserand::testing
