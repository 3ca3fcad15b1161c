// SPDX-License-Identifier: GPL-3.0-or-later
// What accuracy costs on smooth motions: CPU time at given errors of generalised_alpha, radau and, for the rigid chain,
// the plain Runge-Kutta method; as markdown. Arguments: names of scenes, none: all.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "mechanism/run/schedule.hpp"
#include "mechanism/run/stepper.hpp"
#include "tests/benchmarks/mechanisms.hpp"
#include "tests/benchmarks/runge_kutta_chain.hpp"
#include "tests/support/scenes/andrews.hpp"
#include "tests/support/scenes/scenes.hpp"

namespace tisserand::benchmarks {
namespace {

using Positions = Eigen::Matrix3Xd;

/// One run: what it reached, and its cost.
struct Point {
  Positions x;
  double seconds = 0.0, error = 0.0;
  long steps = 0, iterations = 0, factorisations = 0;
  bool done = true;
};

struct Subject {
  std::string name;
  Case input;
  double step;  ///< the coarsest of generalised_alpha
};

Point take(const Case& input) {
  test_support::Simulation run(input.scene, input.files);
  run.start();
  Point point;
  const double begin = cpu_seconds(), end = input.scene.integrator.end;
  while (run.state().time() < end - 1e-9 * end && point.done) point.done = run.step();
  point.seconds = cpu_seconds() - begin;
  if (!point.done) fmt::print("{} at t = {:.4g}\n", run.failure, run.state().time());
  point.x = run.state().x();
  point.steps = run.steps;
  point.iterations = run.iterations;
  point.factorisations = run.factorisations;
  return point;
}

Point radau(Subject subject, double tolerance) {
  formats::IntegratorSpec& options = subject.input.scene.integrator;
  options.method = formats::Method::radau;
  options.error_control = {true, tolerance, 0.0, 0.0};
  options.step = 1e-4 * options.end;
  return take(subject.input);
}

Point generalised_alpha(Subject subject, double step) {
  subject.input.scene.integrator.step = step;
  return take(subject.input);
}

void print(const std::string& method, const std::string& setting, const Point& p) {
  fmt::print("| {} | {} | {:.1e} | {:.4f} | {} | {:.2f} | {:.2f} |\n", method, setting, p.error, p.seconds, p.steps,
             static_cast<double>(p.iterations) / static_cast<double>(std::max(1L, p.steps)),
             static_cast<double>(p.factorisations) / static_cast<double>(std::max(1L, p.steps)));
  std::fflush(stdout);
}

/// Time at an error, between the points around it (of logarithms); empty outside of them.
std::string at_error(const std::vector<Point>& points, double error) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &a = points[i - 1], &b = points[i];
    if (!(a.error >= error && b.error < error)) continue;
    const double share = std::log(a.error / error) / std::log(a.error / b.error);
    return fmt::format("{:.4f}", a.seconds * std::pow(b.seconds / a.seconds, share));
  }
  return "-";
}

void compare(const Subject& subject) {
  fmt::print(
      "\n{}\n\n| method | setting | error | CPU s | steps | iterations/step | factorisations/step |\n"
      "| --- | --- | --- | --- | --- | --- | --- |\n",
      subject.name);
  const Point reference = radau(subject, 1e-12);
  const auto measured = [&](Point point) {
    point.error = (point.x - reference.x).colwise().norm().maxCoeff();
    return point;
  };
  std::vector<Point> alpha, radaus, plain;
  for (int k = 0; k < 8; ++k) {
    const double step = subject.step / (1 << (2 * k));
    alpha.push_back(measured(generalised_alpha(subject, step)));
    print("generalised_alpha", fmt::format("step {:.2e}", step), alpha.back());
    if (alpha.back().error < 1e-8 || alpha.back().seconds > 2.0) break;
  }
  for (int k = 2; k <= 10; ++k) {
    radaus.push_back(measured(radau(subject, std::pow(10.0, -k))));
    print("radau", fmt::format("tolerance 1e-{}", k), radaus.back());
  }
  if (subject.name == "chain") {
    const int links = static_cast<int>(subject.input.scene.bodies.size());
    const double end = subject.input.scene.integrator.end;
    const Eigen::Vector3d tip = runge_kutta_chain(links, end, 20000);
    for (int steps = 50; steps <= 12800; steps *= 2) {
      Point point;
      const double begin = cpu_seconds();
      const Eigen::Vector3d x = runge_kutta_chain(links, end, steps);
      point.seconds = cpu_seconds() - begin;
      point.steps = steps;
      point.error = (x - tip).norm();
      if (!std::isfinite(point.error)) continue;
      plain.push_back(point);
      print("Runge-Kutta 4", fmt::format("step {:.2e}", end / steps), point);
    }
  }
  fmt::print("\n| error | generalised_alpha | radau | Runge-Kutta 4 |\n| --- | --- | --- | --- |\n");
  for (const double error : {1e-4, 1e-6, 1e-8})
    fmt::print("| {:.0e} | {} | {} | {} |\n", error, at_error(alpha, error), at_error(radaus, error),
               at_error(plain, error));
}

Case shortened(Case input, double end) {
  input.scene.integrator.end = end;
  return input;
}

}  // namespace
}  // namespace tisserand::benchmarks

int main(int count, char** arguments) {
  using namespace tisserand::benchmarks;
  using tisserand::formats::Formulation;
  const std::vector<Subject> subjects{
      {"heavy_top", {tisserand::test_support::heavy_top_scene(1e-3, 0.5), {}}, 2e-3},
      {"andrews", shortened({tisserand::test_support::andrews(1e-5), {}}, 0.03), 1e-4},
      {"slider_crank", slider_crank_reduced(4, 0.05), 1e-4},
      {"chain", rigid_chain(100, 1000), 8e-3},
      {"hinged_beam", shortened(hinged_beam(4, Formulation::stabilised_index2), 2.0), 2e-2}};
  for (const Subject& subject : subjects)
    if (count == 1 ||
        std::any_of(arguments + 1, arguments + count, [&](const char* name) { return subject.name == name; }))
      compare(subject);
  return 0;
}
