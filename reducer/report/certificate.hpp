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

/// Part of the certificate that follows from S̄ and M̄ of a superelement file alone. R are the rigid motions.
/// Frequencies are in 1/time of the units of the file.
struct FileCertificate {
  formats::RigidProperties rigid;
  double rigid_residual = 0.0;  ///< max |S̄ R|/|S̄|, rotations scaled
  double characteristic_length = 1.0;
  std::vector<double> fixed_frequency;  ///< frequencies of all internal coordinates with the boundary held
  std::vector<double> free_frequency;   ///< elastic frequencies of the free reduced part, at most 20
  std::string free_frequency_note;      ///< reason if there are no free frequencies
  double stiffness_condition = 0.0;     ///< ratio of the largest to the smallest non-zero eigenvalue of the scaled S̄
  double mass_condition = 0.0;          ///< ratio of the largest to the smallest non-zero eigenvalue of the scaled M̄
  std::vector<std::string> massless;    ///< directions without mass
  /// Participation Γ = (M_IB + M_II Ψ) R_B of every internal mode in the rigid motions R_B of the boundary about the
  /// centre of mass, [x y z, about x y z]. The squares are modal effective masses ([Wij04]). It is empty if the file
  /// is not canonical.
  std::vector<std::array<double, 6>> participation;
  /// Effective mass of the whole part: mass and inertia in the six rigid motions.
  std::array<double, 6> effective_mass_whole{};
  /// Effective mass that internal modes do not have: at the boundary and in dropped modes.
  std::array<double, 6> effective_mass_left{};
  std::vector<std::string> warnings;
};

/// Data for the certificate about the modal body that accompanies the superelement.
struct ModalBodyCertificate {
  std::string reference;           ///< reference condition: "center held", "mean axis"
  std::vector<double> frequency;   ///< frequencies of its modes
  formats::RigidProperties rigid;  ///< rigid properties by the lumped masses
  std::string eigenvalue_solver;   ///< name, method and iterations of the solver; empty in older files
};

/// Discretisation errors of the lowest frequencies of the reduced part, one entry per frequency, by
/// mesh_error/mesh_error.hpp.
struct MeshCertificate {
  bool boundary_held = false;              ///< true: frequencies with the boundary held; false: of the free part
  std::vector<double> frequency;           ///< frequencies f_h of the reduced part
  std::vector<double> error;               ///< estimate of (f_h − f)/f, f without discretisation error; NaN: unknown
  std::vector<double> beam, shell, solid;  ///< contribution of each kind of element to (λ_h − λ)/λ_h
  std::vector<std::string> place;          ///< name of the property whose elements cause most of the error
  std::vector<std::string> unknown;        ///< reason why the error is unknown; "" if it is known
};

/// Part of the certificate that is known only during the reduction: size of the model, modes, defects and errors.
struct ModelCertificate {
  std::string content_id;
  std::string part;
  int nodes = 0, elements = 0;
  int beams = 0, shells = 0, solids = 0, springs = 0, masses = 0;
  int coordinates = 0;  ///< number of independent coordinates
  int spiders = 0;
  int eliminated = 0;                 ///< number of coordinates that spiders and equations made dependent
  int redundant = 0;                  ///< number of equations of ties that other equations imply
  std::vector<std::string> inactive;  ///< names of coordinates without stiffness and mass, which were removed
  formats::RigidProperties rigid;     ///< rigid properties of the mesh, by its full mass matrix
  int modes_requested = 0, modes_kept = 0, modes_available = 0;
  int moment_vectors = 0;  ///< number of moment vectors, the internal coordinates after the modes
  int mechanisms = 0;      ///< number of internal coordinates without stiffness, before the modes
  /// Number of kept modes of the free part by Rubin's or MacNeal's method; absent for craig_bampton.
  std::optional<int> free_modes;
  std::optional<double> cutoff;
  std::optional<formats::Accuracy> accuracy;
  std::optional<double> first_dropped_frequency;
  std::string eigenvalue_solver;
  double mode_residual = 0.0;
  /// Number of eigenvalues below the cut, by Sylvester's law of inertia; absent if not counted.
  std::optional<int> modes_counted;
  double boundary_rigid_defect = 0.0;  ///< BoundaryModes::rigid_defect
  double rigid_residual_before_projection = 0.0;
  double stiffness_coupling = 0.0;
  double orthonormality = 0.0;
  std::vector<double> free_frequency;  ///< elastic free frequencies of the unreduced part; empty for large parts
  /// Modal assurance criterion, weighted with the mass, of modes of the unreduced part (rows) with modes of the
  /// reduced part (columns).
  std::vector<std::vector<double>> assurance;
  /// Truncation errors of the free frequencies of the reduced part below the first dropped mode. They are estimates of
  /// the relative error, and lower and upper bounds of the frequencies of the unreduced part.
  std::vector<double> truncation_estimate, truncation_lower, truncation_upper;
  MeshCertificate mesh_error;
  std::optional<ModalBodyCertificate> modal_body;
  std::vector<std::string> notes;     ///< notes in whole sentences, for example on a completed cluster
  std::vector<std::string> warnings;  ///< warnings from reading the part and from checks of the mesh
};

/// Part of the certificate that is known only during the import of foreign matrices: deviations that the import
/// removes.
struct ImportCertificate {
  std::string format;
  std::string source;
  double stiffness_asymmetry = 0.0;  ///< asymmetry max |a_ij − a_ji| / √(a_ii a_jj) of the stiffness
  double mass_asymmetry = 0.0;
  /// Largest entry of |S R| over the largest entry of |S|, before the rigid motions R were projected out of S.
  /// The rotations in R are scaled with a length of the part.
  double rigid_residual = 0.0;
  bool filtered = false;            ///< true if rigid motions were projected out of S
  double stiffness_coupling = 0.0;  ///< coupling max |S_BI| / max |S| of boundary and internal coordinates
  /// true if no change was necessary: S_BI = 0, M_II = 1, S_II diagonal and ascending.
  bool canonical = false;
  int massless_dropped = 0;  ///< number of internal directions without mass, which were condensed statically
};

/// Computes the certificate from S̄ and M̄ of `element`. `report`: result of check() for `element`.
FileCertificate certify(const formats::Superelement& element, const formats::SuperelementReport& report);

/// Path of the certificate of a superelement file: name.superelement.h5 gives name.superelement.certificate.json.
std::string certificate_path(const std::string& superelement_path);

/// Certificate of a reduction as JSON.
std::string certificate_json(const formats::Superelement& element, const FileCertificate& file,
                             const ModelCertificate& model);

/// Writes the certificate of an import as JSON next to the superelement file. The file is complete or does not exist.
void write_certificate(const std::string& superelement_path, const formats::Superelement& element,
                       const FileCertificate& file, const ImportCertificate& import);

/// Reads the reduction's part of the certificate next to a superelement file. Returns nothing if there is no
/// certificate, or if it names another content than `content_id`.
std::optional<ModelCertificate> read_certificate(const std::string& superelement_path, const std::string& content_id);

/// Centre of mass of `rigid` without round-off: coordinates below 1e-12 of the largest coordinate or of `length`
/// become 0.
Eigen::Vector3d shown_centre(const formats::RigidProperties& rigid, double length);

/// Certificate as text for users. `model`: the part of the reduction, if it is known.
std::string certificate_text(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model);

/// Frequency [1/time] of an eigenvalue ω²; 0 if round-off has made it negative.
double frequency(double lambda);

}  // namespace tisserand::reducer
