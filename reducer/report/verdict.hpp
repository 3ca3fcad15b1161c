// SPDX-License-Identifier: GPL-3.0-or-later
// Verdict about a superelement in one line: whether it is good enough, and for what.
#pragma once

#include <optional>
#include <string>

#include "common/units.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Unit of frequencies: "Hz", "1/ms", "1/time".
std::string frequency_unit(const Units& units);

/// Errors of one of the lowest frequencies: discretisation and truncation error.
struct FrequencyError {
  double frequency = 0.0;
  double mesh = 0.0, dropped = 0.0;  ///< sizes of relative errors; NaN: unknown

  double whole() const { return mesh + dropped; }
};

/// Errors of the free frequencies of the reduced part, or of the fixed ones if the mesh was judged with the boundary
/// held. The truncation error is measured against the full model if that was solved. Otherwise it is the estimate, or
/// its bound. Modes without an estimate of the discretisation error are omitted.
std::vector<FrequencyError> frequency_errors(const FileCertificate& file, const ModelCertificate& model);

/// Line without line end: "good enough for vibrations up to 431 Hz: ...", "not good enough: ...", "not known: ...". The
/// limit is that of `modes: {error, up_to}` of the part, else 5 %. Without `model` nothing is known of the full part.
std::string verdict(const FileCertificate& file, const std::optional<ModelCertificate>& model, const Units& units);

}  // namespace tisserand::reducer
