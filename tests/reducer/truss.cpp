// SPDX-License-Identifier: GPL-3.0-or-later
// Reads the truss from the references and joins its reduced components.
#include "tests/reducer/truss.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include <nlohmann/json.hpp>

#include "reducer/system/partition.hpp"
#include "tests/reducer/parts.hpp"

namespace tisserand::testing {
namespace {

using Eigen::Vector3d;
using nlohmann::json;

const std::vector<std::string> interface_grids{"3", "11", "19", "27"};

/// Bars without shear flexibility, consistent mass without rotary inertia of bending.
void add_component(const json& component, const std::string& prefix, formats::Part& part) {
  for (const auto& [id, m] : component.at("mat1").items())
    part.materials.push_back(
        {prefix + id, m.at("E"), m.at("E").get<double>() / (2.0 * m.at("G").get<double>()) - 1.0, m.at("rho"), ""});
  for (const auto& [id, s] : component.at("pbar").items()) {
    const double I = s.at("I1"), I2 = s.at("I2");
    part.sections.push_back({prefix + id, s.at("A"), I, I2, s.at("J"), I + I2, 0.0, 0.0, ""});
  }
  for (const auto& [id, x] : component.at("grid").items()) {
    const std::string name = "g" + id;
    const auto same = [&](const formats::NamedPoint& p) { return p.name == name; };
    if (std::none_of(part.points.begin(), part.points.end(), same))
      part.points.push_back({name, Vector3d(x[0], x[1], x[2]), ""});
  }
  for (const json& bar : component.at("cbar")) {
    formats::BeamLine line;
    line.name = prefix + std::to_string(bar.at("id").get<int>());
    line.from = "g" + bar.at("ga").get<std::string>();
    line.to = "g" + bar.at("gb").get<std::string>();
    line.section = prefix + bar.at("pid").get<std::string>();
    line.material = prefix + component.at("pbar").at(bar.at("pid").get<std::string>()).at("mat").get<std::string>();
    line.elements = 1;
    line.theory = formats::BeamTheory::euler_bernoulli;
    line.rotary_inertia = false;
    part.beams.push_back(line);
  }
}

/// The polar moment enters the mass alone. ρAL/12 [1 -1; -1 1] is what NASTRAN has more along the axis than the
/// consistent mass ρAL [1/3 1/6; 1/6 1/3].
FullModel with_nastran_mass(formats::Part part) {
  for (formats::Section& section : part.sections) section.polar_moment = 0.0;
  FullModel full = full_model(part);
  for (const reducer::BeamElement& beam : full.mesh.beams) {
    const reducer::BeamElementData& data = full.mesh.beam_properties[beam.property].data;
    const Vector3d axis = beam.R_PE.col(0);
    const double length = (full.mesh.position.col(beam.second) - full.mesh.position.col(beam.first)).norm();
    const Eigen::Matrix3d more = data.material.density * data.section.area * length / 12.0 * axis * axis.transpose();
    const Eigen::Index a = 6 * beam.first, b = 6 * beam.second;
    full.M.block<3, 3>(a, a) += more;
    full.M.block<3, 3>(b, b) += more;
    full.M.block<3, 3>(a, b) -= more;
    full.M.block<3, 3>(b, a) -= more;
  }
  return full;
}

Eigen::VectorXd frequencies(const Eigen::VectorXd& lambda) {
  return lambda.cwiseMax(0.0).cwiseSqrt() / (2.0 * std::numbers::pi);
}

}  // namespace

formats::Part truss(const std::vector<std::string>& components, int modes) {
  const json model = json::parse(std::ifstream(TISSERAND_REFERENCES "/truss/model.json"));
  formats::Part part;
  part.name = "truss";
  part.file = "model.json";
  part.modes.count = modes;
  for (const std::string& component : components) add_component(model.at(component), component + "_", part);
  for (const std::string& grid : interface_grids) part.boundary.push_back({"g" + grid, "g" + grid, true, true, ""});
  return part;
}

Eigen::VectorXd assembled_frequencies(int inboard_modes, int outboard_modes) {
  const formats::Superelement a = reduce(truss({"inboard"}, inboard_modes)).superelement;
  const formats::Superelement b = reduce(truss({"outboard"}, outboard_modes)).superelement;
  const Eigen::Index n = a.size() + b.size() - 24;
  Eigen::MatrixXd S = Eigen::MatrixXd::Zero(n, n), M = S;
  const auto add = [&](const formats::Superelement& e, Eigen::Index first_mode) {
    std::vector<Eigen::Index> row(static_cast<std::size_t>(e.size()));
    for (std::size_t i = 0; i < row.size(); ++i)
      row[i] = static_cast<Eigen::Index>(i) < 24 ? static_cast<Eigen::Index>(i)
                                                 : first_mode + static_cast<Eigen::Index>(i) - 24;
    S(row, row) += e.stiffness;
    M(row, row) += e.mass;
  };
  add(a, 24);
  add(b, a.size());
  return frequencies(eigenvalues(S, M, -100.0));
}

Eigen::VectorXd full_frequencies() {
  const FullModel full = full_model(truss({"inboard", "outboard"}, 0));
  return frequencies(eigenvalues(full.S, full.M, -100.0));
}

Eigen::VectorXd nastran_full_frequencies() {
  const FullModel full = with_nastran_mass(truss({"inboard", "outboard"}, 0));
  return frequencies(eigenvalues(full.S, full.M, -100.0));
}

Eigen::VectorXd nastran_held_frequencies(const std::string& component) {
  const FullModel full = with_nastran_mass(truss({component}, 0));
  return angular_frequencies(full.S, full.M, reducer::partition(full.mesh, full.system).internal) /
         (2.0 * std::numbers::pi);
}

}  // namespace tisserand::testing
