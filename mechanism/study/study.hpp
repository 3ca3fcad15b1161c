// SPDX-License-Identifier: GPL-3.0-or-later
// A study: study.yaml -> runs -> tables, page, and the cheapest setting for an error.
#pragma once

#include <optional>
#include <string>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

enum class StudyPlace { here, slurm };

struct StudyRequest {
  std::string file;
  std::string folder;  ///< empty: <study>.study in the working folder
  std::optional<double> tolerance;
  std::string quantity;  ///< with `tolerance`; empty: all
  StudyPlace place = StudyPlace::here;
  std::optional<int> task;  ///< only this setting, as a job of Slurm
};

/// Runs what has not run yet, writes table.csv, table.json and index.html into the folder, and finds the setting for
/// `tolerance`. Returns a message for the user. Throws Error.
std::string perform_study(const StudyRequest& request, const StudyControl& control);

}  // namespace tisserand::mechanism
