// SPDX-License-Identifier: GPL-3.0-or-later
// Parts and helpers shared by the tests of the reducer and the table of verification.
#include "tests/reducer/parts.hpp"

#include <Eigen/Eigenvalues>

#include "reducer/algebra/petsc.hpp"
#include "reducer/sources/build_mesh.hpp"
#include "reducer/startup.hpp"

namespace tisserand::testing {

using Eigen::Vector3d;

void start_solvers() {
  reducer::prepare_environment();
  static const reducer::SolverSession session;
}

formats::Part cardona_beam(int elements, int modes) {
  formats::Part part;
  part.name = "beam";
  part.file = "beam.part.yaml";
  part.materials.push_back({"steel", 2.1e6, 0.3, 7.8e-3, ""});
  part.sections.push_back({"square", 9.0, 6.75, 6.75, 13.5, 13.5, 7.5, 7.5, ""});
  part.points = {{"base", Vector3d::Zero(), ""}, {"tip", Vector3d(141.42, 0.0, 0.0), ""}};
  formats::BeamLine rod;
  rod.name = "rod";
  rod.from = "base";
  rod.to = "tip";
  rod.section = "square";
  rod.material = "steel";
  rod.elements = elements;
  part.beams.push_back(rod);
  part.boundary = {{"base", "base", true, true, ""}, {"tip", "tip", true, true, ""}};
  part.modes.count = modes;
  return part;
}

formats::Part plain_beam(const Vector3d& from, const Vector3d& to, int elements, int modes) {
  formats::Part part = cardona_beam(elements, modes);
  part.materials[0] = {"steel", 2.1e11, 0.3, 7850.0, ""};
  part.sections[0] = {"square", 2e-3, 3e-7, 8e-7, 6e-7, 11e-7, 1.6e-3, 1.5e-3, ""};
  part.points[0].position = from;
  part.points[1].position = to;
  return part;
}

formats::Part space_frame(int modes) {
  formats::Part part = plain_beam(Vector3d::Zero(), Vector3d::Zero(), 1, modes);
  part.name = "frame";
  part.file = "frame.part.yaml";
  part.materials.push_back({"light", 7e10, 0.33, 2700.0, ""});
  part.sections.push_back({"stout", 5e-3, 4e-6, 2e-6, 3e-6, 6e-6, 0.0, 3e-3, ""});
  part.points = {{"a", Vector3d(0.1, -0.2, 0.3), ""},
                 {"b", Vector3d(2.0, 0.3, 0.1), ""},
                 {"c", Vector3d(0.7, 1.6, 0.9), ""},
                 {"hub", Vector3d(0.9, 0.5, 0.4), ""},
                 {"end", Vector3d(1.3, 1.1, -0.6), ""}};
  const formats::BeamLine line = part.beams[0];
  part.beams.clear();
  const auto add = [&](const char* name, const char* from, const char* to, const char* section, const char* material,
                       int elements) {
    formats::BeamLine beam = line;
    beam.name = name;
    beam.from = from;
    beam.to = to;
    beam.section = section;
    beam.material = material;
    beam.elements = elements;
    part.beams.push_back(beam);
  };
  add("one", "a", "hub", "square", "steel", 4);
  add("two", "hub", "b", "stout", "light", 3);
  add("three", "hub", "c", "square", "light", 3);
  add("bow", "b", "c", "square", "steel", 5);
  add("whip", "hub", "end", "square", "steel", 3);
  part.beams[3].through = Vector3d(1.9, 1.4, 0.2);
  part.beams[1].orientation = Vector3d(0.2, -0.1, 1.0);
  formats::PointMass mass;
  mass.name = "lump";
  mass.at = "end";
  mass.mass = 3.0;
  mass.inertia << 0.02, 0.001, -0.002, 0.001, 0.03, 0.003, -0.002, 0.003, 0.025;
  part.point_masses.push_back(mass);
  part.boundary = {{"A", "a", true, true, ""}, {"B", "b", true, true, ""}, {"C", "c", true, true, ""}};
  return part;
}

void set_theory(formats::Part& part, formats::BeamTheory theory) {
  for (formats::BeamLine& beam : part.beams) beam.theory = theory;
}

void set_mass(formats::Part& part, formats::MassMatrix mass_matrix, bool rotary_inertia) {
  for (formats::BeamLine& beam : part.beams) {
    beam.mass_matrix = mass_matrix;
    beam.rotary_inertia = rotary_inertia;
  }
}

reducer::Reduction reduce(const formats::Part& part) {
  start_solvers();
  return reducer::reduce(part, [](const std::string&) {});
}

FullModel full_model(const formats::Part& part) {
  start_solvers();
  FullModel full{reducer::build_mesh(part), {}, {}, {}};
  full.system = reducer::build_system(full.mesh, part.file);
  const reducer::SystemMatrices matrices = reducer::to_petsc(full.system.matrices);
  full.S = reducer::dense(matrices.stiffness);
  full.M = reducer::dense(matrices.mass);
  return full;
}

Eigen::VectorXd angular_frequencies(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, const std::vector<int>& keep) {
  const Eigen::MatrixXd s = S(keep, keep), m = M(keep, keep);
  return eigenvalues(s, m, 0.0).cwiseMax(0.0).cwiseSqrt();
}

Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& S, const Eigen::MatrixXd& M, double shift) {
  // μ = 1/(λ − shift) of M x = μ (S − shift M) x: accurate at the low end, where S itself has lost digits.
  const Eigen::MatrixXd shifted = S - shift * M;
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(M, shifted, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().reverse().cwiseInverse().array() + shift;
}

double relative_difference(const Eigen::MatrixXd& actual, const Eigen::MatrixXd& expected) {
  return (actual - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

}  // namespace tisserand::testing
