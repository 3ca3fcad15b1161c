// SPDX-License-Identifier: GPL-3.0-or-later
// `accuracy` holds whatever the part is attached to: free, each boundary node held alone, all held, and on springs.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "formats/part/part.hpp"
#include "formats/yaml/override.hpp"
#include "reducer/modes/truncation.hpp"
#include "tests/reducer/parts.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::testing::attached_accuracy_test {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A way to attach the boundary: rows that are held, and springs on their diagonal, over that of S̄.
struct Attachment {
  std::string name;
  std::vector<int> held;  ///< boundary nodes
  std::vector<int> on_springs;
  double springs = 0.0;
};

std::vector<Attachment> attachments(int nodes) {
  std::vector<int> all;
  for (int n = 0; n < nodes; ++n) all.push_back(n);
  std::vector<Attachment> result{{"free", {}, {}, 0.0}, {"all held", all, {}, 0.0}};
  for (int n = 0; n < nodes; ++n) result.push_back({fmt::format("node {} held", n), {n}, {}, 0.0});
  for (const double k : {1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0, 1e3}) {
    result.push_back({fmt::format("all on springs {}", k), {}, all, k});
    for (int n = 0; n < nodes; ++n) {
      result.push_back({fmt::format("node {} on springs {}", n, k), {}, {n}, k});
      std::vector<int> others;
      for (const int m : all)
        if (m != n) others.push_back(m);
      if (!others.empty()) result.push_back({fmt::format("node {} held, others on springs {}", n, k), {n}, others, k});
    }
  }
  return result;
}

/// ω of the attached part up to `most`, ascending; `diagonal`: that of S̄, the scale of the springs.
std::vector<double> frequencies(const formats::Superelement& e, const Attachment& a, const VectorXd& diagonal,
                                double most) {
  MatrixXd S = e.stiffness;
  std::vector<int> rows;
  const auto among = [](const std::vector<int>& list, int node) { return std::ranges::find(list, node) != list.end(); };
  for (int i = 0; i < e.size(); ++i) {
    const int node = e.dof_node[static_cast<std::size_t>(i)];
    if (node >= 0 && among(a.on_springs, node)) S(i, i) += a.springs * diagonal[i];
    if (node < 0 || !among(a.held, node)) rows.push_back(i);
  }
  std::vector<double> omega;
  const VectorXd lambda = eigenvalues(S(rows, rows), e.mass(rows, rows), -0.01 * most * most);
  for (const double value : lambda)
    if (value > 1e-6 * most * most && value < most * most) omega.push_back(std::sqrt(value));
  return omega;
}

const std::string materials = "materials: {steel: {E: 2.1e11, nu: 0.3, density: 7800}}\n";

formats::Part part_of(const std::string& text, const std::string& modes) {
  const test_support::TemporaryFolder folder;
  std::ofstream(folder.file("part.yaml")) << "part: p\n" << materials << text << modes;
  return formats::read_part(folder.file("part.yaml"), {});
}

/// Every frequency of every attachment up to `up_to` lies at most `error` above that of a reduction with modes up to
/// six times that and all moment vectors, whose own error is (1/36)³ of a part of the mass at most: 2e-5 times the
/// share that the first reduction leaves.
void expect_met(const std::string& text, double error, double up_to) {
  start_solvers();
  const formats::Superelement rich =
      reduce(part_of(text, fmt::format("cutoff: {}\nmoments: 1000\n", 6.0 * up_to))).superelement;
  const reducer::Reduction asked =
      reduce(part_of(text, fmt::format("accuracy: {{error: {}, up_to: {}}}\n", error, up_to)));
  const formats::Superelement& e = asked.superelement;
  ASSERT_LT(e.size(), rich.size());
  double worst = 0.0;
  for (const Attachment& a : attachments(static_cast<int>(e.node_name.size()))) {
    const double most = 2.0 * std::numbers::pi * up_to;
    const std::vector<double> right = frequencies(rich, a, rich.stiffness.diagonal(), most),
                              found = frequencies(e, a, rich.stiffness.diagonal(), most * (1.0 + 2.0 * error));
    ASSERT_GE(found.size(), right.size()) << a.name;
    for (std::size_t k = 0; k < right.size(); ++k) {
      EXPECT_LT(found[k] / right[k] - 1.0, error) << a.name << ", mode " << k;
      worst = std::max(worst, found[k] / right[k] - 1.0);
    }
  }
  EXPECT_GT(worst, 1e-4 * error);  // a bound, but one that notices
}

// Half of the modes that fit under the frequency do not move the rings at the ends. Held at one ring a former version
// erred by 1.6 % with 1e-4 asked for (tests/verification/trials).
TEST(AttachedAccuracy, Cylinder) {
  const std::string text =
      "cylinders: {c: {from: [0, 0, 0], to: [0.8, 0, 0], radius: 0.1, elements: [16, 16], thickness: 0.001, material: "
      "steel}}\n"
      "spiders: {a: {kind: rigid, on: c/start}, b: {kind: rigid, on: c/end}}\nboundary: [a, b]\n";
  expect_met(text, 1e-2, 535.0);
  expect_met(text, 1e-4, 535.0);
}

TEST(AttachedAccuracy, Cone) {
  const std::string text =
      "cylinders: {c: {from: [0, 0, 0], to: [0.6, 0, 0], radius: 0.15, end_radius: 0.08, elements: [12, 16], "
      "thickness: 0.002, material: steel}}\n"
      "spiders: {a: {kind: rigid, on: c/start}, b: {kind: rigid, on: c/end}}\nboundary: [a, b]\n";
  expect_met(text, 1e-3, 700.0);
}

TEST(AttachedAccuracy, Plate) {
  const std::string text =
      "plates: {s: {corners: [[0, 0, 0], [0.6, 0, 0], [0.6, 0.4, 0]], elements: [12, 8], thickness: 0.005, material: "
      "steel}}\n"
      "points: {p: [0, 0, 0], q: [0.6, 0, 0], r: [0.6, 0.4, 0]}\nboundary: [p, q, r]\n";
  expect_met(text, 1e-2, 150.0);
  expect_met(text, 1e-4, 150.0);
}

}  // namespace
}  // namespace tisserand::testing::attached_accuracy_test
