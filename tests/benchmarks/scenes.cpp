// SPDX-License-Identifier: GPL-3.0-or-later
// Superelements by static condensation and fixed-boundary modes of a chain of beam elements; the loop of a run with
// clocks.
#include "tests/benchmarks/scenes.hpp"

#include <time.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include "formats/results/results.hpp"
#include "mechanism/analyses/start.hpp"
#include "mechanism/run/output.hpp"
#include "mechanism/run/schedule.hpp"
#include "mechanism/step/step.hpp"
#include "tests/support/bodies/beam_superelement.hpp"
#include "tests/support/bodies/second_order_beam.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

using test_support::BeamData;

/// The beam of [Car00] 8 in the paper's units: E 2.1e6, nu 0.3, square section of 3.
BeamData paper_beam() {
  BeamData beam;
  beam.length = 141.42;
  beam.young = 2.1e6;
  beam.shear_modulus = 2.1e6 / 2.6;
  beam.density = 7.8e-3;
  beam.area = 9.0;
  beam.Iy = beam.Iz = 6.75;
  beam.J = 13.5;
  beam.shear_area_y = beam.shear_area_z = 7.5;
  return beam;
}

/// Stiffness and mass of `pieces` equal elements; rows base, tip, inner nodes.
struct FullBeam {
  Eigen::MatrixXd S, M;
};

FullBeam full_beam(const BeamData& beam, int pieces) {
  BeamData piece = beam;
  piece.length = beam.length / pieces;
  const formats::Superelement element = test_support::beam_superelement(piece);
  const int size = 6 * (pieces + 1);
  FullBeam full{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
  const auto first_row = [pieces](int node) { return node == 0 ? 0 : node == pieces ? 6 : 6 * (node + 1); };
  std::array<double, 12> sign;
  sign.fill(1.0);
  for (int k = 0; k < pieces; ++k) {
    std::array<int, 12> rows{};
    for (int i = 0; i < 12; ++i) rows[i] = first_row(k + i / 6) + i % 6;
    test_support::detail::scatter<12>(element.stiffness, rows, sign, full.S);
    test_support::detail::scatter<12>(element.mass, rows, sign, full.M);
  }
  return full;
}

void add_hinge_and_torque(const std::string& base, formats::Scene& scene) {
  scene.joints.push_back(test_support::joint("hinge", formats::JointKind::revolute, "ground", base,
                                             Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitZ()));
  formats::LoadSpec torque =
      test_support::constant_load("torque", formats::LoadKind::moment, base, Eigen::Vector3d::Zero());
  torque.components[2] = formats::TimeTable{{0.0, 0.2, 10.0, 10.2}, {0.0, 200.0, 200.0, 0.0}};
  scene.loads.push_back(torque);
  scene.output.every = 10;
}

/// t -> wz_base of the converged reference of the tests.
std::map<long, double> reference_rates(double step) {
  const std::string path = TISSERAND_SOURCE_DIR "/tests/verification/references/cardona/hinged_beam_200.csv";
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) throw std::runtime_error("cannot read " + path);
  std::map<long, double> rates;
  while (std::getline(file, line)) {
    const std::size_t comma = line.find(',');
    rates[std::lround(std::stod(line) / step)] = std::stod(line.substr(comma + 1));
  }
  return rates;
}

/// Results file of one run, removed at the end.
struct Output {
  std::string path =
      (std::filesystem::temp_directory_path() / fmt::format("benchmark-{}.results.h5", ::getpid())).string();
  formats::ResultsLayout layout;
  formats::ResultsRow row;
  std::unique_ptr<formats::ResultsWriter> writer;

  Output(const mechanism::Model& model, const formats::Scene& scene) : layout(mechanism::results_layout(model, scene)) {
    row.resize(layout);
    writer = std::make_unique<formats::ResultsWriter>(path, layout);
  }
  ~Output() {
    writer.reset();
    std::error_code ignored;
    std::filesystem::remove(path, ignored);
  }
  void write(const mechanism::Model& model, const mechanism::StepReport& step, double size,
             const mechanism::State& state, mechanism::Workspace& workspace) {
    mechanism::fill_row(model, state, workspace.now, row);
    row.step = size;
    row.iterations = step.iterations;
    row.residual = step.residual;
    row.constraint = step.constraint;
    writer->append(row);
  }
};

template <class Visit>
Cost run_and_visit(const Case& input, Visit visit) {
  const formats::Scene& scene = input.scene;
  Cost cost;
  const double at_start = cpu_seconds();
  mechanism::BuiltModel built = mechanism::build_model(scene, input.body_files());
  mechanism::Workspace workspace(built.model);
  workspace.memory.tuning = input.tuning;
  const double built_at = cpu_seconds();
  (void)mechanism::start(scene, mechanism::StartFrom::poses, built, workspace);
  cost.seconds_model = built_at - at_start;
  cost.seconds_start = cpu_seconds() - built_at;
  mechanism::Schedule schedule(scene, built.model.breakpoints);
  Output output(built.model, scene);
  const double begin = cpu_seconds();
  while (!schedule.finished(built.state.time())) {
    const double before = built.state.time();
    const mechanism::StepReport step =
        mechanism::advance(built.model, scene.integrator, schedule.next(before), built.state, workspace);
    cost.iterations += step.iterations;
    cost.factorisations += step.factorisations;
    if (step.outcome != mechanism::StepOutcome::accepted) {
      ++cost.rejected;
      if (!schedule.retry(before, step)) throw std::runtime_error(mechanism::explain(built.model, step));
      continue;
    }
    ++cost.steps;
    visit(built.state);
    const mechanism::Schedule::Event event = schedule.accept(built.state.time());
    if (event.output) {
      const double at_output = cpu_seconds();
      output.write(built.model, step, built.state.time() - before, built.state, workspace);
      cost.seconds_output += cpu_seconds() - at_output;
    }
    if (event.breakpoint) mechanism::pass_breakpoint(built.model, scene, built.state, workspace);
  }
  cost.seconds_steps = cpu_seconds() - begin - cost.seconds_output;
  return cost;
}

}  // namespace

formats::Superelement reduced_beam(const BeamData& beam, int pieces, int modes) {
  const auto [S, M] = full_beam(beam, pieces);
  const Eigen::Index inner = S.rows() - 12;
  const Eigen::MatrixXd S_II = S.bottomRightCorner(inner, inner), M_II = M.bottomRightCorner(inner, inner);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> eigen(S_II, M_II);
  Eigen::MatrixXd Phi = Eigen::MatrixXd::Zero(S.rows(), 12 + modes);
  Phi.topLeftCorner(12, 12).setIdentity();
  Phi.bottomLeftCorner(inner, 12) = -S_II.ldlt().solve(S.bottomLeftCorner(inner, 12));
  Phi.bottomRightCorner(inner, modes) = eigen.eigenvectors().leftCols(modes);
  formats::Superelement element = test_support::beam_superelement(beam);
  element.method = "craig_bampton";
  for (int i = 0; i < modes; ++i) {
    element.dof_node.push_back(-1);
    element.dof_component.push_back(i);
  }
  const Eigen::MatrixXd mass = Phi.transpose() * M * Phi;
  element.mass = 0.5 * (mass + mass.transpose());
  element.mass.bottomRightCorner(modes, modes).setIdentity();
  const Eigen::MatrixXd stiffness = Phi.leftCols(12).transpose() * S * Phi.leftCols(12);
  element.stiffness.setZero(12 + modes, 12 + modes);
  element.stiffness.topLeftCorner(12, 12) = 0.5 * (stiffness + stiffness.transpose());
  element.stiffness.bottomRightCorner(modes, modes) = eigen.eigenvalues().head(modes).asDiagonal();
  return element;
}

Case hinged_beam(int modes, formats::Formulation formulation) {
  Case input{test_support::empty_scene(0.01, 20.0), {}};
  input.scene.integrator.formulation = formulation;
  test_support::add_file("beam", reduced_beam(paper_beam(), 24, modes), input.files);
  input.scene.bodies.push_back(test_support::superelement_body("beam", "beam"));
  add_hinge_and_torque("beam/base", input.scene);
  return input;
}

mechanism::BodyFiles Case::body_files() const {
  mechanism::BodyFiles all(files);
  all.companions = companions;
  return all;
}

Case hinged_beam(int modes, SecondOrderTerms terms) {
  constexpr int elements = 24;
  const BeamData beam = paper_beam();
  const test_support::SectionData section{.EA = beam.young * beam.area,
                                          .GJ = beam.shear_modulus * beam.J,
                                          .EI_y = beam.young * beam.Iy,
                                          .EI_z = beam.young * beam.Iz,
                                          .mass = beam.density * beam.area,
                                          .torsional_inertia = beam.density * (beam.Iy + beam.Iz),
                                          .rotary_y = beam.density * beam.Iy,
                                          .rotary_z = beam.density * beam.Iz};
  const test_support::SecondOrderBody made = test_support::second_order_beam(
      test_support::bernoulli_beam(section, beam.length, elements), {0, elements}, modes);
  Case input{test_support::empty_scene(0.01, 20.0), {}};
  test_support::add_file("beam", made.element, input.files);
  input.companions["beam"] = made.companion;
  formats::SuperelementBodySpec body = test_support::superelement_body("beam", "beam");
  body.inertia = terms.inertia;
  body.stiffening = terms.stiffening;
  input.scene.bodies.push_back(body);
  add_hinge_and_torque(fmt::format("beam/{}", made.element.node_name.front()), input.scene);
  return input;
}

Case nonlinear_beam(int elements, int nodes_per_element) {
  Case input{test_support::empty_scene(0.01, 20.0), {}};
  const BeamData beam = paper_beam();
  formats::BeamBodySpec body;
  body.name = "beam";
  body.to = {beam.length, 0.0, 0.0};
  body.elements = elements;
  body.nodes_per_element = nodes_per_element;
  body.section = {"square",          beam.area,         beam.Iy,           beam.Iz, beam.J,
                  beam.Iy + beam.Iz, beam.shear_area_y, beam.shear_area_z, ""};
  body.material = {"steel", beam.young, 0.3, beam.density, ""};
  input.scene.bodies.push_back(body);
  add_hinge_and_torque("beam/start", input.scene);
  return input;
}

Case chain(int elements, int steps) {
  const double step = 1e-3, length = 1.0;
  Case input{test_support::empty_scene(step, steps * step), {}};
  formats::Scene& scene = input.scene;
  scene.gravity = {0.0, 0.0, -9.81};
  scene.output.every = 10;
  BeamData beam;
  beam.length = length;
  test_support::add_file("link", reduced_beam(beam, 8, 4), input.files);
  for (int i = 0; i < elements; ++i) {
    formats::SuperelementBodySpec body = test_support::superelement_body(fmt::format("link{}", i), "link");
    body.start.pose.position = {i * length, 0.0, 0.0};
    scene.bodies.push_back(body);
    scene.joints.push_back(test_support::joint(
        fmt::format("joint{}", i), formats::JointKind::spherical, i == 0 ? "ground" : fmt::format("link{}/tip", i - 1),
        fmt::format("link{}/base", i), {i * length, 0.0, 0.0}, Eigen::Vector3d::UnitZ()));
  }
  return input;
}

double cpu_seconds() {
  timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

Cost run(const Case& input) {
  return run_and_visit(input, [](const mechanism::State&) {});
}

Cost run_hinged_beam(const Case& input, const std::string& base) {
  const double step = input.scene.integrator.step;
  const std::map<long, double> reference = reference_rates(step);
  const mechanism::BuiltModel built = mechanism::build_model(input.scene, input.body_files());
  int rotation = -1;
  for (const mechanism::Node& node : built.model.nodes)
    if (node.name == base) rotation = node.rotation;
  // The base turns about z alone, so that material and world rates agree.
  std::vector<double> rates(1, 0.0);
  rates.reserve(4096);
  Cost cost = run_and_visit(input, [&](const mechanism::State& state) { rates.push_back(state.v()[rotation + 2]); });
  double sum = 0.0;
  for (const auto& [index, rate] : reference) {
    const double error = std::abs(rates.at(static_cast<std::size_t>(index)) - rate);
    cost.error = std::max(cost.error, error);
    sum += error * error;
  }
  cost.error_rms = std::sqrt(sum / static_cast<double>(reference.size()));
  return cost;
}

Stopped::Stopped(const Case& input, double time)
    : scene(input.scene), built(mechanism::build_model(scene, input.body_files())), workspace(built.model) {
  (void)mechanism::start(scene, mechanism::StartFrom::poses, built, workspace);
  mechanism::Schedule schedule(scene, built.model.breakpoints);
  while (built.state.time() < time) {
    const auto step =
        mechanism::advance(built.model, scene.integrator, schedule.next(built.state.time()), built.state, workspace);
    if (step.outcome != mechanism::StepOutcome::accepted)
      throw std::runtime_error(mechanism::explain(built.model, step));
    (void)schedule.accept(built.state.time());
  }
}

}  // namespace tisserand::benchmarks
