// Which inertia option of a superelement is right for a motion.
#pragma once

#include <string>
#include <vector>

#include "mechanism/ledger/comparison.hpp"

namespace tisserand::mechanism {

/// The windows with one option, and what they cost over the scene as it is.
struct InertiaRun {
  std::string option;
  const std::vector<WindowHistory>* windows = nullptr;
  double cost = 0.0;
  double* differs = nullptr;  ///< gets what the option differs by from F; may be null
};

/// Against F, which has all of the mass: the cheapest option that changes nothing by more than 1 %. Without a companion
/// file, and so without F, none is known to be right, unless they agree.
std::string inertia_verdict(const std::string& body, const std::vector<InertiaRun>& runs, const MeasureSizes& sizes,
                            double length);

}  // namespace tisserand::mechanism
