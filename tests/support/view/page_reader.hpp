// SPDX-License-Identifier: GPL-3.0-or-later
// A page of `mechanism view` read back as formats/PAGE.md says, independently of what writes it.
#pragma once

#include <string>

#include <Eigen/Core>
#include <nlohmann/json.hpp>

namespace tisserand::test_support {

class PageReader {
 public:
  explicit PageReader(const std::string& page);

  const nlohmann::json& header() const { return header_; }
  const nlohmann::json& run(std::size_t i = 0) const { return header_["runs"][i]; }
  /// One array, its last extent as columns (one column of a list).
  Eigen::MatrixXd read(const nlohmann::json& array) const;
  /// Position of a place at row t: fixed in a body, in the world, or its own.
  Eigen::Vector3d place(const nlohmann::json& run, const nlohmann::json& place, Eigen::Index t) const;
  /// Vertices of a body in the world at row t, 3 x V.
  Eigen::Matrix3Xd vertices(const nlohmann::json& run, const nlohmann::json& body, Eigen::Index t) const;

 private:
  nlohmann::json header_;
  std::string stream_;
};

/// The text between <script ... id="..."> and </script>.
std::string script_of(const std::string& page, const std::string& id);

}  // namespace tisserand::test_support
