// SPDX-License-Identifier: GPL-3.0-or-later
// The unit of scripts/build_minutes: the time to compile this file counts as 1. It uses the standard library and Eigen
// alone, with fixed flags and no precompiled header, and is in no program. Do not change it: every figure of the
// budget is a multiple of its time.
#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Cholesky>

double build_reference(const double* data, const std::vector<std::string>& words);

double build_reference(const double* data, const std::vector<std::string>& words) {
  using Square = Eigen::Matrix<double, 6, 6>;
  const Eigen::Map<const Square> given(data);
  const Square stiff = given * given.transpose() + Square::Identity();
  const Eigen::Vector<double, 6> x = stiff.llt().solve(stiff.rowwise().sum());
  std::map<std::string, std::size_t> counts;
  for (const std::string& word : words) ++counts[word];
  std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
  std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  return (stiff * x).norm() + static_cast<double>(sorted.empty() ? 0 : sorted.front().second);
}
