// SPDX-License-Identifier: GPL-3.0-or-later
// Certificate as JSON next to the superelement file, and as text for users.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <type_traits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/error.hpp"
#include "common/text.hpp"
#include "common/units.hpp"
#include "reducer/report/certificate.hpp"
#include "reducer/report/verdict.hpp"

namespace tisserand::reducer {
namespace {

using nlohmann::json;

json as_json(const formats::RigidProperties& rigid) {
  json inertia = json::array();
  for (int i = 0; i < 3; ++i) inertia.push_back({rigid.inertia(i, 0), rigid.inertia(i, 1), rigid.inertia(i, 2)});
  return {{"mass", rigid.mass},
          {"center_of_mass", {rigid.center_of_mass.x(), rigid.center_of_mass.y(), rigid.center_of_mass.z()}},
          {"inertia", inertia}};
}

void read_json(const json& j, formats::RigidProperties& rigid) {
  rigid.mass = j.at("mass");
  for (int i = 0; i < 3; ++i) {
    rigid.center_of_mass[i] = j.at("center_of_mass").at(i);
    for (int k = 0; k < 3; ++k) rigid.inertia(i, k) = j.at("inertia").at(i).at(k);
  }
}

json file_json(const FileCertificate& c) {
  return {{"rigid", as_json(c.rigid)},
          {"rigid_residual", c.rigid_residual},
          {"characteristic_length", c.characteristic_length},
          {"fixed_boundary_frequency", c.fixed_frequency},
          {"free_frequency", c.free_frequency},
          {"free_frequency_note", c.free_frequency_note},
          {"stiffness_condition", c.stiffness_condition},
          {"mass_condition", c.mass_condition},
          {"massless_directions", c.massless},
          {"participation", c.participation},
          {"effective_mass_whole", c.effective_mass_whole},
          {"effective_mass_left", c.effective_mass_left},
          {"warnings", c.warnings}};
}

std::vector<double> numbers_or_unknown(const json& list) {
  std::vector<double> values;
  for (const json& value : list)
    values.push_back(value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>());
  return values;
}

/// The fields of a certificate, listed once for writing and reading. `later`: files of older versions lack the field.
/// `unknown`: some of its numbers may be NaN.
template <class C, class Type>
concept Is = std::same_as<std::remove_const_t<C>, Type>;

void fields(Is<formats::Accuracy> auto& c, const auto& field) {
  field("error", c.error);
  field("up_to", c.up_to);
}

void fields(Is<ModalBodyCertificate> auto& c, const auto& field) {
  field("reference", c.reference);
  field("frequency", c.frequency);
  field("rigid", c.rigid);
  field.later("eigenvalue_solver", c.eigenvalue_solver);
}

void fields(Is<MeshCertificate> auto& c, const auto& field) {
  field("boundary_held", c.boundary_held);
  field("frequency", c.frequency);
  field.unknown("error", c.error);
  field("beams", c.beam);
  field("shells", c.shell);
  field("solids", c.solid);
  field("place", c.place);
  field.later("unknown", c.unknown);
}

void fields(Is<ModelCertificate> auto& c, const auto& field) {
  field("part", c.part);
  field("nodes", c.nodes);
  field("elements", c.elements);
  field("coordinates", c.coordinates);
  field("rigid", c.rigid);
  field("modes_requested", c.modes_requested);
  field("modes_kept", c.modes_kept);
  field("modes_available", c.modes_available);
  field.later("mechanisms", c.mechanisms);
  field.later("moment_vectors", c.moment_vectors);
  field.later("free_modes", c.free_modes);
  field("cutoff", c.cutoff);
  field("accuracy", c.accuracy);
  field.unknown("truncation_estimate", c.truncation_estimate);
  field("truncation_lower", c.truncation_lower);
  field("truncation_upper", c.truncation_upper);
  field("first_dropped_frequency", c.first_dropped_frequency);
  field("eigenvalue_solver", c.eigenvalue_solver);
  field("mode_residual", c.mode_residual);
  field("modes_counted", c.modes_counted);
  field("boundary_rigid_defect", c.boundary_rigid_defect);
  field("rigid_residual_before_projection", c.rigid_residual_before_projection);
  field("stiffness_coupling", c.stiffness_coupling);
  field("orthonormality", c.orthonormality);
  field("free_frequency", c.free_frequency);
  field.later("assurance", c.assurance);
  field("notes", c.notes);
  field("beams", c.beams);
  field("shells", c.shells);
  field("solids", c.solids);
  field("springs", c.springs);
  field("masses", c.masses);
  field("spiders", c.spiders);
  field("eliminated", c.eliminated);
  field("redundant", c.redundant);
  field("inactive", c.inactive);
  field.later("mesh_error", c.mesh_error);
  field.later("modal_body", c.modal_body);
  field("warnings", c.warnings);
}

template <class T>
json as_json(const std::optional<T>& value);
json as_json(const auto& value);
template <class T>
void read_json(const json& j, std::optional<T>& value);
void read_json(const json& j, auto& value);

struct Writer {
  json& j;
  void operator()(const char* key, const auto& value) const { j[key] = as_json(value); }
  void later(const char* key, const auto& value) const { j[key] = as_json(value); }
  void unknown(const char* key, const std::vector<double>& values) const { j[key] = values; }  // NaN: null
};

struct Reader {
  const json& j;
  void operator()(const char* key, auto& value) const { read_json(j.at(key), value); }
  void later(const char* key, auto& value) const {
    if (const auto found = j.find(key); found != j.end()) read_json(*found, value);
  }
  void unknown(const char* key, std::vector<double>& values) const { values = numbers_or_unknown(j.at(key)); }
};

template <class T>
json as_json(const std::optional<T>& value) {
  return value ? as_json(*value) : json(nullptr);
}
json as_json(const auto& value) {
  json j;
  if constexpr (requires(Writer writer) { fields(value, writer); })
    fields(value, Writer{j});
  else
    j = value;
  return j;
}

template <class T>
void read_json(const json& j, std::optional<T>& value) {
  if (!j.is_null()) read_json(j, value.emplace());
}
void read_json(const json& j, auto& value) {
  if constexpr (requires(Reader reader) { fields(value, reader); })
    fields(value, Reader{j});
  else
    j.get_to(value);
}

json import_json(const ImportCertificate& c) {
  return {{"format", c.format},
          {"source", c.source},
          {"stiffness_asymmetry", c.stiffness_asymmetry},
          {"mass_asymmetry", c.mass_asymmetry},
          {"rigid_residual", c.rigid_residual},
          {"filtered", c.filtered},
          {"stiffness_coupling", c.stiffness_coupling},
          {"canonical", c.canonical},
          {"massless_dropped", c.massless_dropped}};
}

/// First fields of every certificate.
json base_json(const formats::Superelement& element, const FileCertificate& file) {
  return {{"format", "tisserand-certificate"},
          {"content_id", element.content_id},
          {"name", element.name},
          {"producer", element.producer},
          {"file", file_json(file)}};
}

/// Value, or 0 if it is below 1e-12 of the largest, which is round-off.
double clean(double value, double largest) { return std::abs(value) < 1e-12 * largest ? 0.0 : value; }

std::string rigid_text(const char* source, const formats::RigidProperties& rigid, double length, const Units& units) {
  const Eigen::Vector3d c = shown_centre(rigid, length);
  std::string text = fmt::format("{:<19}mass {:.9g}{}, centre of mass ({:.9g}, {:.9g}, {:.9g}){}\n", source, rigid.mass,
                                 after_number(unit_label(units, 0, 1, 0)), c.x(), c.y(), c.z(),
                                 after_number(unit_label(units, 1, 0, 0)));
  const double largest = rigid.inertia.cwiseAbs().maxCoeff();
  for (int i = 0; i < 3; ++i)
    text += fmt::format("{:<19}{} {:>16.9g} {:>16.9g} {:>16.9g}{}\n", "", i == 0 ? "inertia" : "       ",
                        clean(rigid.inertia(i, 0), largest), clean(rigid.inertia(i, 1), largest),
                        clean(rigid.inertia(i, 2), largest), i == 0 ? after_number(unit_label(units, 2, 1, 0)) : "");
  return text;
}

/// Truncation error, or its bound if the error is not known within a factor of two.
std::string estimate_text(const ModelCertificate& model, const FileCertificate& file, std::size_t k) {
  if (std::isfinite(model.truncation_estimate[k])) return fmt::format("{:.1e}", model.truncation_estimate[k]);
  const bool bounded = k < file.free_frequency.size() && model.truncation_lower[k] > 0.0;
  return bounded ? fmt::format("<{:.1e}", file.free_frequency[k] / model.truncation_lower[k] - 1.0) : "unknown";
}

/// Table of frequencies. `model`: of the full part if that is small, and the truncation error.
std::string frequency_table(const FileCertificate& file, const std::optional<ModelCertificate>& model,
                            const Units& units) {
  const std::size_t count = std::max(file.fixed_frequency.size(), file.free_frequency.size());
  if (count == 0) return "";
  const std::vector<double> none;
  const std::vector<double>& full = model ? model->free_frequency : none;
  const std::vector<double>& estimate = model ? model->truncation_estimate : none;
  const std::string unit = frequency_unit(units);
  // Values after the modes with the boundary held are no modes of the part.
  const std::size_t modes = !model              ? count
                            : model->free_modes ? 0
                                                : static_cast<std::size_t>(model->mechanisms + model->modes_kept);
  std::string text = fmt::format("frequencies [{}]\n  {:>4} {:>16} {:>16} {:>16} {:>10} {:>10}\n", unit, "mode",
                                 "boundary fixed", "free, reduced", full.empty() ? "" : "free, full",
                                 full.empty() ? "" : "error", estimate.empty() ? "" : "estimate");
  const auto cell = [](const std::vector<double>& v, std::size_t k) {
    return k < v.size() ? fmt::format("{:.8g}", v[k]) : std::string("-");
  };
  constexpr std::size_t most_rows = 20;
  for (std::size_t k = 0; k < std::min(count, most_rows); ++k) {
    const bool both = k < full.size() && k < file.free_frequency.size();
    text += fmt::format("  {:>4} {:>16} {:>16} {:>16} {:>10} {:>10}\n", k + 1,
                        cell(file.fixed_frequency, k) + (k < modes || k >= file.fixed_frequency.size() ? "" : "*"),
                        cell(file.free_frequency, k), full.empty() ? "" : cell(full, k),
                        both ? fmt::format("{:.1e}", file.free_frequency[k] / full[k] - 1.0) : "",
                        k < estimate.size() ? estimate_text(*model, file, k) : "");
  }
  if (file.fixed_frequency.size() > modes)
    text += fmt::format("  {:>4} value of {}, which is not a mode of the part\n", "*",
                        model && model->free_modes ? "an internal vector from free modes" : "a moment vector");
  if (count > most_rows) text += fmt::format("  {:>4} {} more in the certificate file\n", "...", count - most_rows);
  return text;
}

/// Shares of mass and inertia in per cent: of the first ten modes with one per cent in some direction, their sum, and
/// the rest.
std::string effective_mass_text(const FileCertificate& c) {
  if (c.participation.empty()) return "";
  std::string text = fmt::format("effective mass of the held part [%]\n  {:>4} {:>9} {:>9} {:>9} {:>9} {:>9} {:>9}\n",
                                 "mode", "x", "y", "z", "about x", "about y", "about z");
  const auto line = [&](const std::string& name, const auto& mass_along) {
    text += fmt::format("  {:>4}", name);
    for (std::size_t k = 0; k < 6; ++k) {
      const double whole = c.effective_mass_whole[k];
      text += whole > 0.0 ? fmt::format(" {:>9.2f}", 100.0 * mass_along(k) / whole) : fmt::format(" {:>9}", "-");
    }
    text += "\n";
  };
  constexpr int most_rows = 10;
  int reported = 0;
  for (std::size_t m = 0; m < c.participation.size() && reported < most_rows; ++m) {
    const auto& row = c.participation[m];
    const auto square = [&row](std::size_t k) { return row[k] * row[k]; };
    bool matters = false;
    for (std::size_t k = 0; k < 6; ++k) matters = matters || square(k) > 0.01 * c.effective_mass_whole[k];
    if (!matters) continue;
    line(fmt::format("{}", m + 1), square);
    ++reported;
  }
  line("sum", [&c](std::size_t k) { return c.effective_mass_whole[k] - c.effective_mass_left[k]; });
  line("rest", [&c](std::size_t k) { return c.effective_mass_left[k]; });
  return text;
}

/// Assurance of each mode with all full modes of its frequency (within 0.1 %), because double modes may be turned.
std::string assurance_text(const FileCertificate& file, const ModelCertificate& c) {
  double least = 2.0;
  std::size_t worst = 0;
  // Above the first dropped mode the reduced part need not have the modes of the full one.
  const double end = c.first_dropped_frequency.value_or(std::numeric_limits<double>::infinity());
  for (std::size_t k = 0; k < std::min(c.assurance.size(), file.free_frequency.size()); ++k) {
    if (file.free_frequency[k] > end) break;
    if (k >= c.assurance[0].size()) break;
    // The order of modes may change: take the most similar one, with those of the same frequency.
    std::size_t like = 0;
    for (std::size_t i = 0; i < c.assurance.size(); ++i)
      if (c.assurance[i][k] > c.assurance[like][k]) like = i;
    double sum = 0.0;
    for (std::size_t i = 0; i < c.assurance.size(); ++i)
      if (std::abs(c.free_frequency[i] - c.free_frequency[like]) < 1e-3 * c.free_frequency[like])
        sum += c.assurance[i][k];
    if (sum < least) {
      least = sum;
      worst = k;
    }
  }
  if (least > 1.5) return "";
  return fmt::format(
      "{:<19}at least {:.6f} with the free modes of the full model, below the first dropped frequency (mode {})\n",
      "modal assurance", least, worst + 1);
}

std::string modal_body_text(const ModalBodyCertificate& c, double length, const Units& units) {
  std::vector<std::string> frequencies;
  for (const double value : c.frequency) frequencies.push_back(fmt::format("{:.6g}", value));
  return fmt::format("{:<19}{} modes, {}: {} {}\n", "modal body", c.frequency.size(), c.reference, listed(frequencies),
                     frequency_unit(units)) +
         (c.eigenvalue_solver.empty() ? "" : fmt::format("{:<19}its eigenvalues by {}\n", "", c.eigenvalue_solver)) +
         rigid_text("lumped masses", c.rigid, length, units);
}

/// Kinds of elements, ties, and coordinates without stiffness and mass; empty for parts of beams only.
std::string contents_text(const ModelCertificate& c) {
  std::vector<std::string> kinds;
  for (const auto& [count, name] : {std::pair{c.beams, "beams"},
                                    {c.shells, "shells"},
                                    {c.solids, "solids"},
                                    {c.springs, "springs"},
                                    {c.masses, "masses"}})
    if (count > 0) kinds.push_back(fmt::format("{} {}", count, name));
  std::string text = kinds.size() > 1 || c.beams == 0 ? fmt::format("{:<19}{}\n", "", join(kinds, ", ")) : "";
  if (c.eliminated > 0)
    text += fmt::format("{:<19}{} spiders, {} coordinates eliminated, {} redundant equations\n", "ties", c.spiders,
                        c.eliminated, c.redundant);
  if (!c.inactive.empty())
    text += fmt::format("{:<19}{} coordinates without stiffness and mass: {}\n", "inactive", c.inactive.size(),
                        listed(c.inactive));
  return text;
}

/// Internal vectors of the part and their number.
std::string modes_text(const ModelCertificate& c, const std::string& unit) {
  const std::string first =
      c.first_dropped_frequency ? fmt::format(" at {:.8g} {}", *c.first_dropped_frequency, unit) : std::string();
  if (c.free_modes)
    return fmt::format("{:<19}{} of the free part, {} internal vectors{}\n", "modes", *c.free_modes, c.modes_kept,
                       first.empty() ? "" : "; first mode with the boundary held" + first);
  std::string text = fmt::format("{:<19}{} kept ({} asked for, {} exist)", "internal modes", c.modes_kept,
                                 c.modes_requested, c.modes_available);
  if (!first.empty()) text += ", first dropped" + first;
  text += fmt::format(
      "\n{:<19}{}", "count by inertia",
      c.modes_counted ? fmt::format("{} modes up to the highest kept one", *c.modes_counted) : "not counted");
  if (c.mechanisms > 0)
    text += fmt::format("\n{:<19}{} motions without stiffness, listed before the modes", "mechanisms", c.mechanisms);
  if (c.moment_vectors > 0) text += fmt::format("\n{:<19}{}", "moment vectors", c.moment_vectors);
  return text + "\n";
}

/// Discretisation errors of the lowest frequencies, in per cent.
std::string mesh_text(const MeshCertificate& c) {
  if (c.error.empty()) return "";
  std::vector<std::string> words;
  for (const double error : c.error)
    words.push_back(std::isfinite(error) ? fmt::format("{:+.3g} %", 100.0 * error) : "unknown");
  std::string text = fmt::format("{:<19}{} of the lowest {} frequencies (estimate; +: too high)\n", "error of the mesh",
                                 listed(words), c.boundary_held ? "fixed" : "free");
  std::map<std::string, std::vector<std::string>> modes;  // key: reason
  for (std::size_t k = 0; k < c.unknown.size(); ++k)
    if (!c.unknown[k].empty()) modes[c.unknown[k]].push_back(fmt::format("{}", k + 1));
  for (const auto& [reason, list] : modes)
    text += fmt::format("{:<19}unknown for {} {}: {}\n", "", list.size() > 1 ? "modes" : "mode", listed(list), reason);
  return text;
}

std::string model_text(const ModelCertificate& c, const Units& units) {
  std::string text = fmt::format("{:<19}{} nodes, {} elements, {} coordinates ({})\n", "full model", c.nodes,
                                 c.elements, c.coordinates, c.part);
  text += contents_text(c);
  text += modes_text(c, frequency_unit(units));
  if (!c.eigenvalue_solver.empty())
    text += fmt::format("{:<19}{}, largest residual {:.1e}\n", "eigenvalues by", c.eigenvalue_solver, c.mode_residual);
  text += fmt::format("{:<19}rigid motions of boundary modes: {:.1e}, of S: {:.1e}; S_BI: {:.1e}; M_II - 1: {:.1e}\n",
                      "round-off removed", c.boundary_rigid_defect, c.rigid_residual_before_projection,
                      c.stiffness_coupling, c.orthonormality);
  text += mesh_text(c.mesh_error);
  for (const std::string& note : c.notes) text += fmt::format("{:<19}{}\n", "note", note);
  for (const std::string& warning : c.warnings) text += fmt::format("{:<19}{}\n", "warning", warning);
  return text;
}

}  // namespace

std::string certificate_json(const formats::Superelement& element, const FileCertificate& file,
                             const ModelCertificate& model) {
  json j = base_json(element, file);
  j["verdict"] = verdict(file, model, element.units);
  j["model"] = as_json(model);
  return j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

void write_certificate(const std::string& superelement_path, const formats::Superelement& element,
                       const FileCertificate& file, const ImportCertificate& import) {
  json j = base_json(element, file);
  j["import"] = import_json(import);
  write_text_file(certificate_path(superelement_path),
                  j.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
}

std::optional<ModelCertificate> read_certificate(const std::string& superelement_path, const std::string& content_id) {
  std::ifstream file(certificate_path(superelement_path));
  if (!file) return std::nullopt;
  try {
    const json j = json::parse(file);
    if (j.at("content_id") != content_id) return std::nullopt;
    ModelCertificate model;
    read_json(j.at("model"), model);
    model.content_id = content_id;
    return model;
  } catch (const json::exception&) {
    return std::nullopt;  // not a certificate of this program: only the file is shown
  }
}

Eigen::Vector3d shown_centre(const formats::RigidProperties& rigid, double length) {
  const Eigen::Vector3d& c = rigid.center_of_mass;
  const double size = std::max(length, c.cwiseAbs().maxCoeff());
  return {clean(c.x(), size), clean(c.y(), size), clean(c.z(), size)};
}

std::string certificate_text(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model) {
  std::string text = fmt::format("{:<19}{}\n", "verdict", verdict(file, model, element.units));
  text += fmt::format("{:<19}{} ({}, by {})\n", "superelement", element.name, element.method, element.producer);
  text += fmt::format("{:<19}{}\n", "content id", element.content_id.substr(0, 16));
  const auto internal = static_cast<Eigen::Index>(file.fixed_frequency.size());
  text += fmt::format("{:<19}{} ({} coordinates) and {} internal coordinates\n", "boundary nodes",
                      listed(element.node_name), element.size() - internal, internal);
  if (model) text += model_text(*model, element.units);
  text += rigid_text("from reduced mass", file.rigid, file.characteristic_length, element.units);
  if (model) text += rigid_text("from the mesh", model->rigid, file.characteristic_length, element.units);
  text += fmt::format("{:<19}{:.1e}\n", "rigid motions S R", file.rigid_residual);
  text += fmt::format("{:<19}S {:.2e}, M {:.2e} (rotations scaled by {:.6g})\n", "condition", file.stiffness_condition,
                      file.mass_condition, file.characteristic_length);
  text += fmt::format("{:<19}{}\n", "without mass", file.massless.empty() ? "none" : listed(file.massless, "; "));
  text += frequency_table(file, model, element.units);
  if (model) text += assurance_text(file, *model);
  text += effective_mass_text(file);
  if (!file.free_frequency_note.empty())
    text += fmt::format("{:<19}no free frequencies: {}\n", "note", file.free_frequency_note);
  if (model && model->modal_body)
    text += modal_body_text(*model->modal_body, file.characteristic_length, element.units);
  for (const std::string& warning : file.warnings) text += fmt::format("{:<19}{}\n", "warning", warning);
  return text;
}

}  // namespace tisserand::reducer
