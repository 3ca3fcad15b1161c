// SPDX-License-Identifier: GPL-3.0-or-later
// Selected channels, row by row.
#include "tests/support/stored_motion.hpp"

#include "formats/results/results.hpp"

namespace tisserand::test_support {

Eigen::MatrixXd stored_rows(const std::string& file, const std::vector<std::string>& selection) {
  const formats::ResultsReader reader(file);
  std::vector<std::string> names;
  for (const formats::Channel& channel : formats::select_channels(reader.channels(), selection, "test"))
    names.push_back(channel.name);
  return reader.read_rows(names, 0, reader.rows());
}

double largest_difference(const std::string& a, const std::string& b, const std::vector<std::string>& selection) {
  return (stored_rows(a, selection) - stored_rows(b, selection)).cwiseAbs().maxCoeff();
}

double largest_value(const std::string& file, const std::vector<std::string>& selection) {
  return stored_rows(file, selection).cwiseAbs().maxCoeff();
}

}  // namespace tisserand::test_support
