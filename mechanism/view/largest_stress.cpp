// SPDX-License-Identifier: GPL-3.0-or-later
// Largest stress from products of stress per amplitude and amplitudes, a few instants at once.
#include "mechanism/view/largest_stress.hpp"

#include <algorithm>
#include <cmath>

namespace tisserand::mechanism {
namespace {

using Eigen::Index;

constexpr Index most_products = 4'000'000;  // size of one product

/// Square of the equivalent stress (von Mises) of [xx yy zz xy yz zx].
double squared_mises(const double* s) {
  const double a = s[0] - s[1], b = s[1] - s[2], c = s[2] - s[0];
  return 0.5 * (a * a + b * b + c * c) + 3.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5]);
}

}  // namespace

formats::Json largest_stress(const ViewedRun& run, const ViewedBody& body, const BodyShape& shape) {
  const Index rows = shape.stress.rows(), instants = std::min(run.times.size(), shape.deformation.amplitudes.rows());
  if (rows == 0 || shape.stress.cols() == 0) return nullptr;
  double largest = -1.0;
  Index vertex = 0, instant = 0;
  const Index chunk = std::max<Index>(1, most_products / rows);
  for (Index first = 0; first < instants; first += chunk) {
    const Index count = std::min(chunk, instants - first);
    const Eigen::MatrixXd stresses = shape.stress * shape.deformation.amplitudes.middleRows(first, count).transpose();
    for (Index t = 0; t < count; ++t)
      for (Index v = 0; v < rows / 6; ++v)
        if (const double value = squared_mises(stresses.col(t).data() + 6 * v); value > largest)
          largest = value, vertex = v, instant = first + t;
  }
  if (!(largest >= 0.0)) return nullptr;
  const Eigen::Vector3d place = shape.surface.vertices[static_cast<std::size_t>(vertex)] + body.origin;
  return {{"value", std::sqrt(largest)}, {"place", {place.x(), place.y(), place.z()}}, {"time", run.times[instant]}};
}

}  // namespace tisserand::mechanism
