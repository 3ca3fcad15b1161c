// SPDX-License-Identifier: GPL-3.0-or-later
// Stored rows of a results file, and comparison of two results files.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::test_support {

/// Rows of the channels that the selection names, as in `output: {channels: ...}`.
Eigen::MatrixXd stored_rows(const std::string& file, const std::vector<std::string>& selection);

/// Largest difference, or largest size, of any value at any row, in the units of the channels.
double largest_difference(const std::string& a, const std::string& b, const std::vector<std::string>& selection);
double largest_value(const std::string& file, const std::vector<std::string>& selection);

}  // namespace tisserand::test_support
