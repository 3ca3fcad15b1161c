// SPDX-License-Identifier: GPL-3.0-or-later
// docs/STABILITY.md from the outcomes of the matrix.
#pragma once

#include <string>
#include <vector>

#include "tests/stability/matrix.hpp"

namespace tisserand::stability {

struct Judged {
  Cell cell;
  Outcome outcome;
};

std::string page_of(const std::vector<Case>& cases, const std::vector<Judged>& judged);

}  // namespace tisserand::stability
