// SPDX-License-Identifier: GPL-3.0-or-later
// Certificate of a superelement: computed after the reduction and from the file alone, printed and stored as JSON.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer {

/// Quantities from S̄ and M̄ only. Frequencies in 1/time of the units.
struct FileCertificate {
  formats::RigidProperties rigid;
  double rigid_residual = 0.0;  ///< max |S̄ R|/|S̄|, rotations scaled
  double characteristic_length = 1.0;
  std::vector<double> fixed_frequency;  ///< of all internal coordinates, boundary held
  std::vector<double> free_frequency;   ///< elastic, free part; at most 20
  std::string free_frequency_note;      ///< reason if there are none
  double stiffness_condition = 0.0;     ///< largest over smallest non-zero eigenvalue of the scaled S̄
  double mass_condition = 0.0;          ///< likewise for M̄
  std::vector<std::string> massless;    ///< directions without mass
  /// Γ = (M_IB + M_II Ψ) R_B of every internal mode in rigid motions of the boundary about the centre of mass, [x y z,
  /// about x y z]. Squares are modal effective masses ([Wij04]). Empty if the file is not canonical.
  std::vector<std::array<double, 6>> participation;
  std::array<double, 6> effective_mass_whole{};  ///< mass and inertia in these motions
  std::array<double, 6> effective_mass_left{};   ///< not in internal modes: at the boundary, in dropped modes
  std::vector<std::string> warnings;
};

/// Data of the modal body that accompanies the superelement.
struct ModalBodyCertificate {
  std::string reference;           ///< "center held", "mean axis"
  std::vector<double> frequency;   ///< frequencies of its modes
  formats::RigidProperties rigid;  ///< from the lumped masses
  std::string eigenvalue_solver;   ///< name, type, iterations; empty in older files
};

/// Discretisation error of the lowest frequencies: mesh_error/mesh_error.hpp.
struct MeshCertificate {
  bool boundary_held = false;              ///< of the part with its boundary held; otherwise free
  std::vector<double> frequency;           ///< of the reduced part
  std::vector<double> error;  ///< estimate of (f_h − f)/f: positive if the frequency is too high; NaN: unknown
  std::vector<double> beam, shell, solid;  ///< their contributions to (λ_h − λ)/λ_h
  std::vector<std::string> place;          ///< property whose elements cause most of it
  std::vector<std::string> unknown;        ///< reason why it is unknown; "" if it is known
};

/// Quantities that are known during the reduction only.
struct ModelCertificate {
  std::string content_id;
  std::string part;
  int nodes = 0, elements = 0;
  int beams = 0, shells = 0, solids = 0, springs = 0, masses = 0;
  int coordinates = 0;  ///< number of independent ones
  int spiders = 0;
  int eliminated = 0;                 ///< coordinates that spiders and equations made dependent
  int redundant = 0;                  ///< of these equations, those that others imply
  std::vector<std::string> inactive;  ///< coordinates without stiffness and mass, removed
  formats::RigidProperties rigid;     ///< of the mesh, from its full mass matrix
  int modes_requested = 0, modes_kept = 0, modes_available = 0;
  int moment_vectors = 0;         ///< internal coordinates after the modes
  int mechanisms = 0;             ///< internal coordinates without stiffness, before the modes
  std::optional<int> free_modes;  ///< elastic modes of the free part, of Rubin's and MacNeal's method
  std::optional<double> cutoff;
  std::optional<formats::Accuracy> accuracy;
  std::optional<double> first_dropped_frequency;
  std::string eigenvalue_solver;
  double mode_residual = 0.0;
  std::optional<int> modes_counted;    ///< below the cut, by inertia
  double boundary_rigid_defect = 0.0;  ///< before rigid motions were made exact
  double rigid_residual_before_projection = 0.0;
  double stiffness_coupling = 0.0;
  double orthonormality = 0.0;
  std::vector<double> free_frequency;  ///< elastic frequencies of the full model; empty for large parts
  /// Modal assurance of the full model's modes (rows) with the reduced part's, weighted with the mass.
  std::vector<std::vector<double>> assurance;
  /// For free frequencies of the reduced part below the first dropped mode: estimate of the truncation error, and
  /// bounds of the frequency of the full part.
  std::vector<double> truncation_estimate, truncation_lower, truncation_upper;
  MeshCertificate mesh_error;
  std::optional<ModalBodyCertificate> modal_body;
  std::vector<std::string> notes;     ///< whole sentences, for example on a completed cluster
  std::vector<std::string> warnings;  ///< from reading the part and from checks of the mesh
};

/// Quantities that are known during the import of foreign matrices only: deviations that the file no longer has.
struct ImportCertificate {
  std::string format;
  std::string source;
  double stiffness_asymmetry = 0.0;  ///< max |a_ij − a_ji| / √(a_ii a_jj)
  double mass_asymmetry = 0.0;
  double rigid_residual = 0.0;      ///< max |S R| / max |S|, rotations scaled, before rigid motions were projected out
  bool filtered = false;            ///< whether they were
  double stiffness_coupling = 0.0;  ///< max |S_BI| / max |S|
  bool canonical = false;           ///< S_BI = 0, M_II = 1, S_II diagonal and ascending: no change was necessary
  int massless_dropped = 0;         ///< internal directions without mass, condensed statically
};

/// Certificate from the file; `report` is the result of check() for `element`.
FileCertificate certify(const formats::Superelement& element, const formats::SuperelementReport& report);

/// Path of the certificate: name.superelement.h5 -> name.superelement.certificate.json.
std::string certificate_path(const std::string& superelement_path);

/// Certificate of a reduction as JSON.
std::string certificate_json(const formats::Superelement& element, const FileCertificate& file,
                             const ModelCertificate& model);

/// Writes the certificate of an import as JSON next to the file, completely or not at all.
void write_certificate(const std::string& superelement_path, const formats::Superelement& element,
                       const FileCertificate& file, const ImportCertificate& import);

/// The reduction's part of the JSON next to the file, if it exists and quotes the same content.
std::optional<ModelCertificate> read_certificate(const std::string& superelement_path, const std::string& content_id);

/// Centre of mass without round-off: coordinates below 1e-12 of the largest or of `length` are 0.
Eigen::Vector3d shown_centre(const formats::RigidProperties& rigid, double length);

/// Certificate as text for users; `model` may be absent.
std::string certificate_text(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model);

/// Frequency [1/time] of an eigenvalue ω²; 0 if round-off has made it negative.
double frequency(double lambda);

}  // namespace tisserand::reducer
