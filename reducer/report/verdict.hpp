// SPDX-License-Identifier: GPL-3.0-or-later
// Verdict about a superelement in one line: whether it is good enough, and for what.
#pragma once

#include <optional>
#include <string>

#include "common/units.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// Unit of frequencies as text: "Hz", "1/ms", "1/time".
std::string frequency_unit(const Units& units);

/// Discretisation and truncation error of one of the lowest frequencies of the reduced part.
struct FrequencyError {
  double frequency = 0.0;
  double mesh = 0.0, dropped = 0.0;  ///< magnitudes of the relative discretisation and truncation error; NaN: unknown

  double whole() const { return mesh + dropped; }
};

/// Errors of the free frequencies of the reduced part, or of the fixed ones if discretisation errors were computed
/// with the boundary held. The truncation error is the difference to the unreduced part, if its modes were computed.
/// Otherwise it is the estimate, or the bound if there is no estimate. Modes without an estimate of the discretisation
/// error are omitted.
std::vector<FrequencyError> frequency_errors(const FileCertificate& file, const ModelCertificate& model);

/// Verdict about a superelement in one line, without line end: "good enough for vibrations up to 431 Hz: ...", "not
/// good enough: ...", "not known: ...". The limit of the errors is that of `modes: {error, up_to}` of the part, or 5 %
/// without it. Without `model` nothing is known of the unreduced part.
std::string verdict(const FileCertificate& file, const std::optional<ModelCertificate>& model, const Units& units);

}  // namespace tisserand::reducer
