// SPDX-License-Identifier: GPL-3.0-or-later
// Errors of a run: its channels compared with the reference histories, in the norms of the study.
#pragma once

#include <string>
#include <vector>

#include "formats/study/study.hpp"
#include "mechanism/histories/series.hpp"
#include "mechanism/study/cells.hpp"

namespace tisserand::mechanism {

/// Histories of the given channels in a results file, one per quantity of the study. Throws Error that names the
/// nearest channels of the file.
std::vector<Series> read_quantities(const std::string& results, const std::vector<std::string>& channels);

/// Histories from the reference file of the study, one per quantity: columns of CSV, or channels of results.
std::vector<Series> read_reference_file(const formats::Study& study);

/// Size of one history in the norm of `quantity`: its largest absolute value (max, final, peak), its RMS (rms), or the
/// instant of its largest absolute value (peak_time).
double size_of(const Series& series, const formats::StudyQuantity& quantity);

/// Error of a history, divided by `scale` of the quantity or by the size of the reference:
///   max        max |y - y_ref|, at the instants of the reference
///   rms        sqrt(∫(y - y_ref)² dt / ∫dt)
///   final      |y - y_ref| at the last common instant
///   peak       ||y|_max - |y_ref|_max|, between stored instants by a parabola
///   peak_time  |t - t_ref| of the instants of |y|_max and |y_ref|_max
/// Throws Error if the histories have too little time in common or the reference is zero.
double error_of(const Series& series, const Series& reference, const formats::StudyQuantity& quantity);

}  // namespace tisserand::mechanism
