// Results files of two runs against each other.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace tisserand::test_support {

/// Rows of the channels that the selection names, as of `output: {channels: ...}`.
Eigen::MatrixXd stored_rows(const std::string& file, const std::vector<std::string>& selection);

/// Of any value, at any row, in the units of the channels.
double largest_difference(const std::string& a, const std::string& b, const std::vector<std::string>& selection);
double largest_value(const std::string& file, const std::vector<std::string>& selection);

}  // namespace tisserand::test_support
