// SPDX-License-Identifier: GPL-3.0-or-later
// Recommendation of an inertia option for each superelement, from replayed motions.
#pragma once

#include <string>
#include <vector>

#include "mechanism/ledger/comparison.hpp"

namespace tisserand::mechanism {

/// Windows that were computed with one inertia option, and their cost relative to the scene as given.
struct InertiaRun {
  std::string option;
  const std::vector<WindowHistory>* windows = nullptr;
  double cost = 0.0;
  double* differs = nullptr;  ///< receives the difference between the option and F; may be null
};

/// Sentence that recommends an inertia option for a superelement: the cheapest one that differs from F by at most 1 %.
/// F contains all of the mass. Without a companion file there is no F. Then no option is known to be right, unless all
/// agree within 1 %. `length`: size of the scene.
std::string inertia_verdict(const std::string& body, const std::vector<InertiaRun>& runs, const MeasureSizes& sizes,
                            double length);

}  // namespace tisserand::mechanism
