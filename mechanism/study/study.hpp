// SPDX-License-Identifier: GPL-3.0-or-later
// A study: study.yaml -> runs -> tables, page, and the cheapest setting for an error.
#pragma once

#include <optional>
#include <string>

#include "mechanism/study/campaign.hpp"

namespace tisserand::mechanism {

/// Where the runs of a study are computed: on this machine, or as a job array of Slurm.
enum class StudyPlace { here, slurm };

/// Request for a study, from the command line.
struct StudyRequest {
  std::string file;                 ///< path of the study file
  std::string folder;               ///< folder for the files of the study; empty: <study>.study in the working folder
  std::optional<double> tolerance;  ///< error for which the cheapest setting is sought; absent: none
  std::string quantity;             ///< with `tolerance`: name of the quantities that count; empty: all
  StudyPlace place = StudyPlace::here;
  std::optional<int> task;  ///< number of the only setting to run, as a job of Slurm
};

/// Performs a study: runs what has not run yet, and writes table.csv, table.json and index.html into the folder. With
/// `tolerance` it finds the cheapest setting with this error. Returns a message for the user. Throws Error.
std::string perform_study(const StudyRequest& request, const StudyControl& control);

}  // namespace tisserand::mechanism
