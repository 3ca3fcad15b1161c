// What a superelement is worth: computed after the reduction and from the file alone, printed and stored as JSON.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "formats/part/part.hpp"
#include "formats/superelement/superelement.hpp"

namespace tisserand::reducer {

/// What S̄ and M̄ alone tell. Frequencies in 1/time of the units.
struct FileCertificate {
  formats::RigidProperties rigid;
  double rigid_residual = 0.0;  ///< max |S̄ R|/|S̄|, rotations scaled
  double characteristic_length = 1.0;
  std::vector<double> fixed_frequency;  ///< all internal coordinates, boundary held
  std::vector<double> free_frequency;   ///< elastic, nothing held; at most 20
  std::string free_frequency_note;      ///< why there are none
  double stiffness_condition = 0.0;     ///< largest over smallest eigenvalue ≠ 0 of the scaled S̄
  double mass_condition = 0.0;          ///< likewise of M̄
  std::vector<std::string> massless;    ///< directions that move no mass
  /// Of every internal mode in the rigid motions of the boundary about the centre of mass, [x y z, about x y z]: Γ =
  /// (M_IB + M_II Ψ) R_B, whose squares are the modal effective masses ([Wij04]); empty if the file is not canonical.
  std::vector<std::array<double, 6>> participation;
  std::array<double, 6> effective_mass_whole{};  ///< mass and inertia in these motions
  std::array<double, 6> effective_mass_left{};   ///< what no internal mode carries: at the boundary, in dropped modes
  std::vector<std::string> warnings;
};

/// What is told of the modal body beside the superelement.
struct ModalBodyCertificate {
  std::string reference;           ///< "center held", "mean axis"
  std::vector<double> frequency;   ///< of its modes
  formats::RigidProperties rigid;  ///< of the lumped masses
  std::string eigenvalue_solver;   ///< name, type, iterations; empty in former files
};

/// What the mesh does to the lowest frequencies: mesh_error/mesh_error.hpp.
struct MeshCertificate {
  bool boundary_held = false;              ///< of the part with its boundary held; else free
  std::vector<double> frequency;           ///< of the reduced part
  std::vector<double> error;  ///< estimate of (f_h − f)/f: positive where the frequency is too high; NaN: unknown
  std::vector<double> beam, shell, solid;  ///< their parts of (λ_h − λ)/λ_h
  std::vector<std::string> place;          ///< property whose elements cause most of it
  std::vector<std::string> unknown;        ///< why it is unknown; "" where it is known
};

/// What is only known while reducing.
struct ModelCertificate {
  std::string content_id;
  std::string part;
  int nodes = 0, elements = 0;
  int beams = 0, shells = 0, solids = 0, springs = 0, masses = 0;
  int coordinates = 0;  ///< independent ones
  int spiders = 0;
  int eliminated = 0;                 ///< coordinates that spiders and equations made dependent
  int redundant = 0;                  ///< equations of theirs that others imply
  std::vector<std::string> inactive;  ///< coordinates without stiffness and mass, removed
  formats::RigidProperties rigid;     ///< of the mesh, from its full mass matrix
  int modes_requested = 0, modes_kept = 0, modes_available = 0;
  int moment_vectors = 0;         ///< internal coordinates behind the modes
  int mechanisms = 0;             ///< internal coordinates without stiffness, before the modes
  std::optional<int> free_modes;  ///< of Rubin's and MacNeal's method: elastic modes of the free part
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
  /// Modal assurance of the full model's modes (rows) and the reduced part's, weighted with the mass.
  std::vector<std::vector<double>> assurance;
  /// Of the free frequencies of the reduced part below the first dropped mode: relative error that the dropped modes
  /// cause, and between which the frequency of the full part lies.
  std::vector<double> truncation_estimate, truncation_lower, truncation_upper;
  MeshCertificate mesh_error;
  std::optional<ModalBodyCertificate> modal_body;
  std::vector<std::string> notes;     ///< whole sentences, for example about a completed cluster
  std::vector<std::string> warnings;  ///< of the way in and of the checks of the mesh
};

/// What is only known while importing matrices of another program: how far they were from what is written.
struct ImportCertificate {
  std::string format;
  std::string source;
  double stiffness_asymmetry = 0.0;  ///< max |a_ij − a_ji| / √(a_ii a_jj)
  double mass_asymmetry = 0.0;
  double rigid_residual = 0.0;      ///< max |S R| / max |S|, rotations scaled, before rigid motions were projected out
  bool filtered = false;            ///< they were
  double stiffness_coupling = 0.0;  ///< max |S_BI| / max |S|
  bool canonical = false;           ///< S_BI = 0, M_II = 1, S_II diagonal and ascending: nothing to do
  int massless_dropped = 0;         ///< internal directions without mass, condensed statically
};

/// `report` is what check() returned for `element`.
FileCertificate certify(const formats::Superelement& element, const formats::SuperelementReport& report);

/// name.superelement.h5 -> name.superelement.certificate.json.
std::string certificate_path(const std::string& superelement_path);

/// The certificate of a reduction as JSON.
std::string certificate_json(const formats::Superelement& element, const FileCertificate& file,
                             const ModelCertificate& model);

/// That of an import as JSON beside the file, whole or not at all.
void write_certificate(const std::string& superelement_path, const formats::Superelement& element,
                       const FileCertificate& file, const ImportCertificate& import);

/// The reduction's part of the JSON beside the file, if it exists and quotes the same content.
std::optional<ModelCertificate> read_certificate(const std::string& superelement_path, const std::string& content_id);

/// The centre of mass without round-off: coordinates below 1e-12 of the largest or of `length` are 0.
Eigen::Vector3d shown_centre(const formats::RigidProperties& rigid, double length);

/// For people; `model` may be absent.
std::string certificate_text(const formats::Superelement& element, const FileCertificate& file,
                             const std::optional<ModelCertificate>& model);

/// Frequency [1/time] of an eigenvalue ω²; 0 where round-off has made it negative.
double frequency(double lambda);

}  // namespace tisserand::reducer
