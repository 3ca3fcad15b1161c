// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of modes, and pairs of eigenvalues of two runs.
#include "tests/support/crossings/small_motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "formats/results/results.hpp"
#include "mechanism/simulate.hpp"
#include "tests/support/temporary_folder.hpp"

namespace tisserand::test_support::crossings {

using std::complex;

std::vector<complex<double>> eigenvalues(const formats::Scene& given, const mechanism::BodyFiles& files,
                                         const mechanism::State* begin) {
  formats::Scene scene = given;
  scene.analysis = formats::AnalysisKind::modes;
  scene.modes.count = 200;
  const TemporaryFolder folder;
  mechanism::RunRequest request{scene, files, std::nullopt, folder.file("modes.results.h5"), "", std::nullopt};
  if (begin != nullptr) request.begin = *begin;
  const mechanism::RunEnd end = mechanism::simulate(request, {});
  const formats::ResultsReader reader(end.report.results);
  const std::vector<double> real = reader.read("modes/eigenvalue/real"),
                            imaginary = reader.read("modes/eigenvalue/imaginary");
  std::vector<complex<double>> values;
  for (std::size_t i = 0; i < real.size(); ++i)
    if (imaginary[i] >= 0.0) values.emplace_back(real[i], imaginary[i]);
  std::ranges::sort(values, {}, [](const complex<double>& value) { return std::abs(value); });
  return values;
}

double mode_difference(const std::vector<complex<double>>& a, const std::vector<complex<double>>& b, double time) {
  if (a.size() != b.size() || a.empty()) return std::numeric_limits<double>::infinity();
  double largest = 0.0;
  std::vector<complex<double>> rest = b;
  for (const complex<double>& value : a) {
    // The nearest that is left: those of one size have no order.
    const auto distance = [&](const complex<double>& other) { return std::abs(time * other - value); };
    const auto nearest = std::ranges::min_element(rest, {}, distance);
    largest = std::max(largest, distance(*nearest) / (std::abs(value) + 1e-4 * std::abs(a.back())));
    rest.erase(nearest);
  }
  return largest;
}

}  // namespace tisserand::test_support::crossings
