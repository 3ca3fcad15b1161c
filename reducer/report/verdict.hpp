// One line on a superelement: whether it is good enough, and for what.
#pragma once

#include <optional>
#include <string>

#include "common/units.hpp"
#include "reducer/report/certificate.hpp"

namespace tisserand::reducer {

/// "Hz", "1/ms", "1/time": unit of frequencies.
std::string frequency_unit(const Units& units);

/// Errors of the lowest frequencies together: by the mesh and by dropped modes.
struct FrequencyError {
  double frequency = 0.0;
  double mesh = 0.0, dropped = 0.0;  ///< sizes of relative errors; NaN: unknown

  double whole() const { return mesh + dropped; }
};

/// Errors of the free frequencies of the reduced part, or of the fixed ones where the mesh was judged with the boundary
/// held. The truncation error is measured against the full model where that was solved; else it is the estimate, else
/// its bound. Modes without an estimate of the discretisation error are omitted.
std::vector<FrequencyError> frequency_errors(const FileCertificate& file, const ModelCertificate& model);

/// A line without end: "good enough for vibrations up to 431 Hz: ...", "not good enough: ...", "not known: ...". The
/// limit is what the part asks for with `modes: {error, up_to}`, else 5 %. `model` absent: nothing is known of the full
/// part.
std::string verdict(const FileCertificate& file, const std::optional<ModelCertificate>& model, const Units& units);

}  // namespace tisserand::reducer
