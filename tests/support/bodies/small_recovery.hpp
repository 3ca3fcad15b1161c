// SPDX-License-Identifier: GPL-3.0-or-later
// A recovery file made by hand: one beam, one shell and one solid at seven nodes, with any numbers as fields.
#pragma once

#include <string>

#include <Eigen/Core>

#include "formats/recovery/recovery.hpp"

namespace tisserand::test_support {

/// Belongs to craig_bampton_beam({}, 1): 13 coordinates.
formats::Recovery small_recovery();

/// Rows of a field as write_small_recovery() writes them: different numbers everywhere.
Eigen::MatrixXd small_field(const formats::Recovery& recovery, formats::RecoveryField field);

void write_small_recovery(const std::string& path);

}  // namespace tisserand::test_support
