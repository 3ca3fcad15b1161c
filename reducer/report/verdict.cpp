// SPDX-License-Identifier: GPL-3.0-or-later
// Sentence about the errors of frequencies.
#include "reducer/report/verdict.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace tisserand::reducer {
namespace {

constexpr double tolerated = 0.05;

std::string percent(double share) { return fmt::format("{:.2g} %", 100.0 * share); }

/// Relative truncation error of the free frequency k of the reduced part.
double dropped_error(const FileCertificate& file, const ModelCertificate& model, std::size_t k) {
  if (k >= file.free_frequency.size()) return std::numeric_limits<double>::quiet_NaN();
  const double f = file.free_frequency[k];
  if (k < model.free_frequency.size()) return std::abs(f / model.free_frequency[k] - 1.0);
  if (model.modes_available > 0 && model.modes_kept >= model.modes_available) return 0.0;
  if (k >= model.truncation_estimate.size()) return std::numeric_limits<double>::quiet_NaN();
  if (std::isfinite(model.truncation_estimate[k])) return std::abs(model.truncation_estimate[k]);
  const bool bounded = k < model.truncation_lower.size() && model.truncation_lower[k] > 0.0;
  return bounded ? f / model.truncation_lower[k] - 1.0 : std::numeric_limits<double>::quiet_NaN();
}

std::string parts_text(const FrequencyError& error) {
  return fmt::format("mesh {}, dropped modes {}", percent(error.mesh), percent(error.dropped));
}

std::string unknown_text(const FrequencyError& error, const std::string& unit) {
  return fmt::format("the error {} is unknown for the frequency {:.4g} {}",
                     std::isfinite(error.mesh) ? "by dropped modes" : "of the mesh", error.frequency, unit);
}

/// Verdict by the accuracy that the part requests.
std::string asked_text(const std::vector<FrequencyError>& errors, const formats::Accuracy& asked,
                       const std::string& unit) {
  const std::string aim = fmt::format("requested: {} up to {:.4g} {}", percent(asked.error), asked.up_to, unit);
  const FrequencyError* worst = nullptr;
  double known_to = 0.0;
  for (const FrequencyError& error : errors) {
    known_to = error.frequency;
    if (error.frequency > asked.up_to) break;
    if (!std::isfinite(error.whole())) return fmt::format("not known: {} ({})", unknown_text(error, unit), aim);
    if (worst == nullptr || error.whole() > worst->whole()) worst = &error;
  }
  if (worst == nullptr)
    return errors.empty() ? fmt::format("not known: no frequency was compared ({})", aim)
                          : fmt::format("good enough: no frequency of the free part lies below {:.4g} {} ({})",
                                        asked.up_to, unit, aim);
  if (worst->whole() > asked.error)
    return fmt::format("not good enough: the frequency {:.4g} {} has an error of about {} ({}); {}", worst->frequency,
                       unit, percent(worst->whole()), parts_text(*worst), aim);
  const std::string text = fmt::format("errors of at most about {} ({})", percent(worst->whole()), parts_text(*worst));
  if (known_to < asked.up_to)
    return fmt::format("good enough up to {:.4g} {}, the highest frequency with an estimated error of the mesh: {}; {}",
                       known_to, unit, text, aim);
  return fmt::format("good enough: frequencies have {}; {}", text, aim);
}

std::string usual_text(const std::vector<FrequencyError>& errors, const std::string& kind, const std::string& unit) {
  const FrequencyError *last = nullptr, *worst = nullptr, *next = nullptr;
  for (const FrequencyError& error : errors) {
    if (!(error.whole() <= tolerated)) {
      next = &error;
      break;
    }
    last = &error;
    if (worst == nullptr || error.whole() > worst->whole()) worst = &error;
  }
  const std::string beyond = next == nullptr ? ""
                             : std::isfinite(next->whole())
                                 ? fmt::format("the frequency {:.4g} {} has an error of about {} ({})", next->frequency,
                                               unit, percent(next->whole()), parts_text(*next))
                                 : unknown_text(*next, unit);
  if (last == nullptr && next == nullptr) return "not known: no frequency was compared with the full part";
  if (last == nullptr)
    return fmt::format("{}: {}", std::isfinite(next->whole()) ? "not good enough" : "not known", beyond);
  return fmt::format(
      "good enough for vibrations up to {:.4g} {}: frequencies of the {} part have errors of at most about {} ({}){}",
      last->frequency, unit, kind, percent(worst->whole()), parts_text(*worst),
      beyond.empty() ? "" : "; above, " + beyond);
}

}  // namespace

std::string frequency_unit(const Units& units) {
  if (!units.named()) return "1/time";
  return units.time.factor == 1.0 ? "Hz" : "1/" + units.time.label;
}

std::vector<FrequencyError> frequency_errors(const FileCertificate& file, const ModelCertificate& model) {
  const MeshCertificate& mesh = model.mesh_error;
  const std::size_t count =
      mesh.boundary_held ? mesh.error.size() : std::min(mesh.error.size(), file.free_frequency.size());
  std::vector<FrequencyError> errors;
  for (std::size_t k = 0; k < count; ++k)
    errors.push_back({mesh.boundary_held ? mesh.frequency[k] : file.free_frequency[k], std::abs(mesh.error[k]),
                      mesh.boundary_held ? 0.0 : dropped_error(file, model, k)});
  return errors;
}

std::string verdict(const FileCertificate& file, const std::optional<ModelCertificate>& model, const Units& units) {
  if (!file.free_frequency_note.empty()) return "not known for vibrations: " + file.free_frequency_note;
  if (!model) return "not known: no data of the full part are stored, so the errors cannot be estimated";
  const std::vector<FrequencyError> errors = frequency_errors(file, *model);
  const std::string unit = frequency_unit(units);
  const std::string text = model->accuracy
                               ? asked_text(errors, *model->accuracy, unit)
                               : usual_text(errors, model->mesh_error.boundary_held ? "held" : "free", unit);
  const std::size_t warnings = file.warnings.size() + model->warnings.size();
  if (warnings == 0) return text;
  return fmt::format("{}; {} warning{} below", text, warnings, warnings > 1 ? "s" : "");
}

}  // namespace tisserand::reducer
