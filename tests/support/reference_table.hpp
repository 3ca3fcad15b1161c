// SPDX-License-Identifier: GPL-3.0-or-later
// Rows of numbers of a CSV file under tests/verification/references.
#pragma once

#include <string>
#include <vector>

namespace tisserand::test_support {

/// Without the header line.
std::vector<std::vector<double>> reference_rows(const std::string& file);

}  // namespace tisserand::test_support
